-- as: simulation
-- passes: 12
-- engine: bullet278
-- spec: dynamics 3.1; a body that is rebuilt (moved, reset, of another mass, made dynamic) leaves nothing behind
-- tol: 1e-3
-- topic: dynamics
sim = require 'sim'

local function box(x, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2})
    sim.setObjectPosition(shape, {x, 0, 1})
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    return shape
end

function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    gone, comer = box(0, true), box(5, true)
    reset, heavier, freed = box(1, true), box(2, true), box(3, false)
end

local steps = 0

function sysCall_actuation()
    if steps == 2 then
        sim.setObjectPosition(gone, {0, 5, 1})
        sim.resetDynamicObject(reset)
        sim.setShapeMass(heavier, 3)
        sim.setObjectInt32Param(freed, sim.shapeintparam_static, 0)
    elseif steps == 3 then
        sim.setObjectPosition(comer, {0, 0, 1})
    end
end

function sysCall_sensing()
    steps = steps + 1
    if steps ~= 10 then return end
    for _, shape in ipairs{gone, comer, reset, heavier, freed} do
        local p = sim.getObjectPosition(shape)
        print(string.format('%.4f %.4f %.4f', p[1], p[2], p[3]))
    end
    print(#sim.getContactInfo(sim.handle_all, sim.handle_all, 0))
end
