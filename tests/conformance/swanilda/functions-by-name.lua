-- as: simulation
-- passes: 2
-- spec: calls 1; functions of modules called by their names, and their calltips
-- topic: scripting
sim = require 'sim'

function sysCall_init()
    local sandbox = sim.getScript(sim.scripttype_sandbox)
    local dummy = sim.callScriptFunction('sim.createDummy', sandbox, 0.1)
    print('created', sim.getObjectType(dummy) == sim.sceneobject_dummy)
    print('in Lua', sim.callScriptFunction('sim.getObjectType@lua', sandbox, dummy) == sim.sceneobject_dummy)
    print('nobody', (pcall(sim.callScriptFunction, 'sim.nobody', sandbox)))
    print('constant', (pcall(sim.callScriptFunction, 'sim.handle_world', sandbox)))
    print(sim.getApiInfo(-1, 'sim.getObject'))
    print(sim.getApiInfo(-1, 'simIK.createEnvironment'))
    print('unknown', sim.getApiInfo(-1, 'sim.nobody') == '', sim.getApiInfo(-1, '') == '')
    print(table.concat(sim.getApiFunc(-1, 'sim.getObjectPos'), ' '))
    print('none', #sim.getApiFunc(-1, 'nobody.'), #sim.getApiFunc(-1, 'sim'))
    require 'scriptClientBridge'
    local simCBOR = require 'simCBOR'
    local function call(request) return simCBOR.decode(tostring(scriptClientBridge.call(simCBOR.encode(request)))) end
    local answer = call {func = 'sim.getObjectType', args = {dummy}}
    print('bridge', answer.success, answer.result[1] == sim.sceneobject_dummy)
    print('its error', call({func = 'sim.getObjectType', args = {98765}}).success, call({func = 'nobody'}).success)
    print('field', scriptClientBridge.getField('sim.handle_all'), scriptClientBridge.info('nobody.at.all'))
end
