--[[
The command line of CoppeliaSim's user interface, as far as applicable without one.

    exec(lang, code)                 runs code in the selected script and prints the result. Lua only
    setSelectedScript(handle, lang)  selects a script; default: the sandbox
    help(), helpText()               prints, or returns, a few hints for beginners
    helpClose(), setVisible(visible), clearHistory(), toggleStatusbarHeight()     have no effect
]]

local sim = require('sim')

local simCmd = {}

local selected -- handle of a script; nil: the sandbox

local HELP <const> = [[
sim.getObject('/path')      an object by its path
sim.startSimulation()       starts the simulation; sim.stopSimulation() ends it
help 'sim.getObject'        what a function does; docs/api has all of them
print(x)                    shows a value; results are shown by themselves]]

local function show(result, first, ...)
    if result == 0 and (select('#', ...) > 0 or type(first) ~= 'table' or next(first) ~= nil) then print(first, ...) end
end

function simCmd.exec(...)
    local lang, code = require('checkargs')({{type = 'string'}, {type = 'string'}}, ...)
    if lang:lower() ~= 'lua' then error('not implemented in Swanilda: simCmd.exec in ' .. lang, 2) end
    show(sim.executeScriptString(code .. '@Lua', selected or sim.getScript(sim.scripttype_sandbox)))
end

function simCmd.setSelectedScript(...)
    selected = require('checkargs')({{type = 'int'}, {type = 'string', default = ''}}, ...)
end

function simCmd.helpText() return HELP end
function simCmd.help() print(HELP) end
function simCmd.helpClose() end
function simCmd.setVisible(...) require('checkargs')({{type = 'bool'}}, ...) end
function simCmd.clearHistory() end
function simCmd.toggleStatusbarHeight() end

return simCmd
