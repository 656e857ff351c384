-- as: customization
-- passes: 32
-- engine: bullet278
-- spec: dynamics 2, shapes 7; range of 1000 m, sleep at start, suspended collision response
-- tol: 1e-3
-- topic: dynamics
sim = require 'sim'

local function box(x, z, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    return shape
end

local function height(shape) return string.format('%.3f', sim.getObjectPosition(shape)[3]) end

function sysCall_init()
    sleeper, pushed, hit, hitter = box(0, 1, true), box(1, 1, true), box(2, 1, true), box(2, 1.5, true)
    for _, shape in ipairs{sleeper, pushed, hit} do sim.setObjectInt32Param(shape, sim.shapeintparam_sleepmodestart, 1) end
    box(3, -0.1, false)
    suspended = box(3, 0.1, true)
    sim.setObjectInt32Param(suspended, sim.shapeintparam_respondablesuspendcnt, 1)
    far, back = box(1000.5, 3, true), box(0, 2000, true)
    child = box(1000.5, 5, true)
    sim.setObjectParent(child, far, true)
end

local steps = 0

function sysCall_actuation()
    if steps == 8 then sim.addForceAndTorque(pushed, {0, 0, 1e-3}) end
    if steps == 8 then sim.setObjectInt32Param(suspended, sim.shapeintparam_respondablesuspendcnt, 1) end
    if steps == 10 then sim.setObjectInt32Param(suspended, sim.shapeintparam_respondablesuspendcnt, 0) end
    if steps == 8 then sim.setObjectPosition(back, {5, 0, 1}) end
end

function sysCall_sensing()
    steps = steps + 1
    if steps == 7 then
        print('suspended at start', height(suspended))
        print('far', height(far), height(child), height(back), sim.isDynamicallyEnabled(far), sim.isDynamicallyEnabled(child))
        print('asleep', height(pushed), sim.isDynamicallyEnabled(pushed))
    end
    if steps == 10 then print('suspended', tonumber(height(suspended)) < 0.06) end
    if steps == 18 then
        print('asleep', height(sleeper), 'pushed', tonumber(height(pushed)) < 0.5, 'hit', tonumber(height(hit)) < 0.9)
        print('back', sim.isDynamicallyEnabled(back), tonumber(height(back)) < 0.5)
        print('far', height(far), height(child))
    end
end
