-- topic: objects
-- as: customization
-- passes: 10
-- spec: objects 8
-- note: copies made during a run that are not removed at its end go back to the state they began with, other new objects do not
sim = require 'sim'
sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_init() sim.setBoolProperty(sim.handle_scene, 'removeNewObjectsAtEnd', false) n = 0 end
function sysCall_actuation()
    n = n + 1
    if n == 2 then
        local new = sim.createDummy(0.1)
        sim.setObjectPosition(new, {1, 2, 3})
        local copy = sim.copyPasteObjects({new}, 0)[1]
        sim.setObjectPosition(copy, {4, 4, 4})
    end
    if n == 4 then sim.stopSimulation() end
end
]], 0, 'lua')
local hidden = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
sim.setObjectProperty(hidden, sim.objectproperty_selectable | 0x10000)
function sysCall_sensing() if not seen then seen = true print(sim.getBoolProperty(hidden, 'visible'), sim.getIntProperty(hidden, 'layer')) end end
function sysCall_afterSimulation()
    for _, h in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_dummy)) do print(sim.getObjectPosition(h)) end
    print(sim.getBoolProperty(hidden, 'visible'), sim.getIntProperty(hidden, 'layer'))
end
