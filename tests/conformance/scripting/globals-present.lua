-- topic: globals
-- as: sandbox
-- passes: 2
-- spec: scripts 9
sim = require 'sim'
local SIMU, CUST = sim.scripttype_simulation, sim.scripttype_customization
local function mk(kind, alias, parent, code)
    local h = sim.createScript(kind, code, 0, 'lua')
    sim.setObjectAlias(h, alias)
    if parent then sim.setObjectParent(h, parent, true) end
    return h
end
mk(SIMU, 'a', nil, [[
local list = {'_S', 'wrap', 'import', 'loadstring', 'print', 'printf', 'printBytes', 'hexdump', 'printToConsole', 'getAsString', 'help', 'quit', 'exit', 'isbuffer', 'tobuffer',
 'map', 'filter', 'foreach', 'reduce', 'range', 'zip', 'any', 'all', 'sum', 'prod', 'partial', 'apply', 'iter', 'identity', 'negate', 'reify', 'operator', 'getvar', 'setvar', 'getlocals',
 'addLog', 'auxFunc', 'loadPlugin', 'unloadPlugin', 'quitSimulator', 'setAutoYield', 'getAutoYield', 'setYieldAllowed', 'getYieldAllowed', 'registerScriptFuncHook', 'registerCodeEditorInfos',
 '_evalExec', '_evalExecRet', 'sim', 'require', 'io', 'os', 'debug', 'coroutine', 'package', 'rerequire', 'sim_script_handle', 'sim_plugin_namespaces', 'callMethod'}
local r = {}
for _, n in ipairs(list) do r[#r + 1] = n .. '=' .. type(_G[n]) end
for i = 1, #r, 6 do printToConsole(table.concat(r, ' ', i, math.min(i + 5, #r))) end
sim = require 'sim'
print(sim == require 'sim', type(unpack), math.type(sim_script_handle) or type(sim_script_handle))
print(loadstring('return 1 + 1')(), tostring(_VERSION):sub(1, 5))
]])
