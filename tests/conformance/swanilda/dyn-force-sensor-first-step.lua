-- as: simulation
-- passes: 6
-- engine: bullet278
-- spec: dynamics 10; the value is the mean over all passes, those of the first call included
-- tol: 1e-6
-- topic: dynamics
sim = require 'sim'

local function ghost(z, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {0, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

function sysCall_init()
    local base, load = ghost(1, false), ghost(1, true)
    sensor = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.05, 100, 10, 0, 0})
    sim.setObjectPosition(sensor, {0, 0, 1})
    sim.setObjectParent(sensor, base, true)
    sim.setObjectParent(load, sensor, true)
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps > 2 then return end
    local result, force, torque = sim.readForceSensor(sensor)
    print(result, string.format('%.6f', force[3]), string.format('%.6f', torque[1]))
end
