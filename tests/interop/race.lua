local sim = require 'sim'
local box, goal

function sysCall_init()
    box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
    sim.setObjectAlias(box, 'Box')
end

function sysCall_actuation()
    if sim.getInt32Signal 'move' then
        sim.setObjectPosition(box, {goal / 2, 0, 0.05})
    end
end

function sysCall_sensing()
    goal = sim.getFloatSignal 'goal'
end
