-- as: customization
-- passes: 8
-- engine: mujoco
-- spec: dynamics 5; MuJoCo takes the larger of two frictions, the other engines their product
-- tol: 5e-3
-- topic: dynamics
sim = require 'sim'

local function box(x, z, size, dynamic, friction)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    sim.setEngineFloatParam(sim.mujoco_body_friction1, shape, friction)
    return shape
end

function sysCall_init()
    sim.setInt32Param(sim.intparam_dynamic_engine, sim.physics_mujoco)
    box(0, -0.05, {4, 4, 0.1}, false, 0.3)
    slider = box(0, 0.1, {0.2, 0.2, 0.2}, true, 0)
    sim.setObjectFloatParam(slider, sim.shapefloatparam_init_velocity_x, 1)
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps == 4 then print(string.format('%.3f', sim.getVelocity(slider)[1])) end
end
