--[[
The command line of CoppeliaSim's user interface, as far as applicable without one.
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

--- Runs code as the user would: in the selected script, and prints its results.
-- @api simCmd.exec(string lang, string code)
-- @param lang only Lua
function simCmd.exec(...)
    local lang, code = require('checkargs.check')({{type = 'string'}, {type = 'string'}}, ...)
    if lang:lower() ~= 'lua' then error('not implemented in Swanilda: simCmd.exec in ' .. lang, 2) end
    show(sim.executeScriptString(code .. '@Lua', selected or sim.getScript(sim.scripttype_sandbox)))
end

--- Chooses the script in which `exec` runs code; the sandbox is chosen first.
-- @api simCmd.setSelectedScript(int scriptHandle, string lang = '')
function simCmd.setSelectedScript(...)
    selected = require('checkargs.check')({{type = 'int'}, {type = 'string', default = ''}}, ...)
end

--- A few hints for beginners.
-- @api string text = simCmd.helpText()
function simCmd.helpText() return HELP end

--- Prints the hints for beginners.
-- @api simCmd.help()
function simCmd.help() print(HELP) end

--- No effect: there is no window.
-- @api simCmd.helpClose()
function simCmd.helpClose() end

--- No effect: there is no window.
-- @api simCmd.setVisible(bool visible)
function simCmd.setVisible(...) require('checkargs.check')({{type = 'bool'}}, ...) end

--- No effect: there is no window.
-- @api simCmd.clearHistory()
function simCmd.clearHistory() end

--- No effect: there is no window.
-- @api simCmd.toggleStatusbarHeight()
function simCmd.toggleStatusbarHeight() end

return simCmd
