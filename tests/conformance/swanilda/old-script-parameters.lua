-- topic: scripts
-- as: sandbox
-- passes: 0
-- spec: scripts 2, scripts 7, properties 5, vrep-era 2.10
-- note: parameters of scripts by number, and texts of the old parameter dialog
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function refused(f, ...)
    local ok, message = pcall(f, ...)
    print('refused', ok, tostring(message):match('([^: ][^:]*%.)$'))
end

local CODE = 'function sysCall_cleanup() end -- first'
local script = sim.createScript(sim.scripttype_simulation, CODE, 0, 'lua')
sim.setObjectAlias(script, 'worker')
print('name', sim.getScriptName(script), sim.getScriptStringParam(script, sim.scriptstringparam_name))
print('numbers', sim.getScriptInt32Param(script, sim.scriptintparam_type) == sim.scripttype_simulation, sim.getScriptInt32Param(script, sim.scriptintparam_handle) == script, sim.getScriptInt32Param(script, sim.scriptintparam_execorder), sim.getScriptInt32Param(script, sim.scriptintparam_enabled))
sim.setScriptInt32Param(script, sim.scriptintparam_execorder, sim.scriptexecorder_last)
print('order', sim.getScriptInt32Param(script, sim.scriptintparam_execorder), sim.getIntProperty(script, 'execPriority'))
sim.setScriptInt32Param(script, sim.scriptintparam_enabled, 0)
print('disabled', sim.getScriptInt32Param(script, sim.scriptintparam_enabled), sim.getBoolProperty(script, 'scriptDisabled'))
sim.setBoolProperty(script, 'scriptDisabled', false)
print('enabled', sim.getScriptInt32Param(script, sim.scriptintparam_enabled))
print('text', tostring(sim.getScriptStringParam(script, sim.scriptstringparam_text)) == CODE)
sim.setScriptStringParam(script, sim.scriptstringparam_text, 'x = 2')
print('text', sim.getStringProperty(script, 'code'), tostring(sim.getScriptStringParam(script, sim.scriptstringparam_text)))
refused(sim.getScriptInt32Param, 999999, sim.scriptintparam_type)
refused(sim.setScriptStringParam, 999999, sim.scriptstringparam_text, '')

-- Texts that look like something else come back as that, unless the text is wanted. Numbers are floats.
local box = sim.createDummy(0.01)
sim.setObjectParent(script, box, true)
for name, value in pairs{speed = '2.5', count = '3', flag = 'true', off = 'false', nothing = 'nil', word = 'abc', list = '1 2'} do
    sim.setUserParameter(box, name, value)
end
local function read(name) return sim.getScriptSimulationParameter(script, name) end
print('values', read('speed'), read('count'), read('flag'), read('off'), read('nothing'), read('word'), read('list'))
local function word(name) return sim.getScriptSimulationParameter(script, name, true) end
print('texts', word('speed') == '2.5', word('count') == '3', word('flag') == 'true', word('off') == 'false', word('nothing') == 'nil', word('word') == 'abc')
print('object', sim.getScriptSimulationParameter(box, 'speed'), sim.getUserParameter(box, 'speed'), sim.getUserParameter(box, 'word'))

-- Only what is there is changed, and the result does not tell.
print('set', sim.setScriptSimulationParameter(script, 'speed', '4'), read('speed'))
print('set', sim.setScriptSimulationParameter(box, 'word', '-1e2'), read('word'), sim.getUserParameter(box, 'word'))
print('set', sim.setScriptSimulationParameter(script, 'new', '5'))
refused(sim.getScriptSimulationParameter, script, 'new')
local bare = sim.createDummy(0.01)
refused(sim.getScriptSimulationParameter, bare, 'speed')
refused(sim.getScriptSimulationParameter, 999999, 'speed')
refused(sim.setScriptSimulationParameter, 999999, 'speed', '1')
for _, handle in ipairs{sim.handle_tree, sim.handle_chain, sim.handle_all} do
    print('several', select('#', sim.getScriptSimulationParameter(handle, 'speed')))
end

-- A script that is attached as in old scenes has the parameters of its object.
local attached = sim.addScript(sim.scripttype_customization)
sim.associateScriptWithObject(attached, box)
print('attached', sim.getScriptSimulationParameter(attached, 'speed'), sim.setScriptSimulationParameter(attached, 'speed', '6'), read('speed'))

-- From a script on: its own parameters, or those of all below.
local below = sim.createDummy(0.01)
sim.setObjectParent(below, box, true)
sim.setUserParameter(below, 'speed', '0')
sim.setStringProperty(script, 'code', [[
function own() return sim.getScriptSimulationParameter(sim.handle_self, 'speed') end
function setTree() return sim.setScriptSimulationParameter(sim.handle_tree, 'speed', '7') end
]])
sim.initScript(script)
print('self', sim.callScriptFunction('own', script))
print('tree', sim.callScriptFunction('setTree', script), read('speed'), sim.getUserParameter(below, 'speed'))
