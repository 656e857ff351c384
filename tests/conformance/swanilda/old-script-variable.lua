-- topic: old functions
-- as: simulation
-- passes: 1
-- spec: vrep-era 2.3; variables of other scripts
sim = require 'sim'

function sysCall_init()
    local object = sim.createDummy(0.01)
    local script = sim.createScript(sim.scripttype_customization, 'function read() return speed, place and place.x end')
    sim.setObjectParent(script, object)
    sim.setObjectAlias(object, 'robot')
    simSetObjectName(object, 'robot')
    sim.initScript(script)
    print(sim.setScriptVariable('speed', script, 0.5), sim.callScriptFunction('read', script))
    print(simSetScriptVariable('speed@robot', sim.scripttype_customization, {1, 2}), #sim.callScriptFunction('read', script))
    print(simSetScriptVariable('place.x', script, 'there'), select(2, sim.callScriptFunction('read', script)))
    print((pcall(sim.setScriptVariable, 'speed@nobody', sim.scripttype_customization, 1)))
    print((pcall(sim.setScriptVariable, 'speed', 77777, 1)))
end
