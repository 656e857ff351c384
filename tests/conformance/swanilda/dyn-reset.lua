-- as: customization
-- passes: 20
-- engine: bullet278
-- spec: dynamics 8, objects 8; resetDynamicObject, initial velocities, models flagged not_reset
-- tol: 1e-6
-- topic: dynamics
sim = require 'sim'

local function ghost(x, z, parent)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    if parent then sim.setObjectParent(shape, parent, true) end
    return shape
end

function sysCall_init()
    free, single, start = ghost(0, 100), ghost(1, 100), ghost(2, 100)
    model = sim.createDummy(0.01)
    sim.setModelProperty(model, 0)
    inModel = {ghost(3, 100, model), ghost(4, 100, model)}
    lasting = sim.createDummy(0.01)
    sim.setModelProperty(lasting, sim.modelproperty_not_reset)
    stays = ghost(5, 100, lasting)
end

-- The way of a fall that began `steps` steps of ten sub-steps ago.
local function fallen(steps) return 9.81 * 0.005 ^ 2 * (10 * steps) * (10 * steps + 1) / 2 end
local function height(shape) return sim.getObjectPosition(shape)[3] end

local steps = 0

function sysCall_actuation()
    steps = steps + 1
    if steps == 4 then
        sim.resetDynamicObject(single)
        sim.setObjectFloatParam(start, sim.shapefloatparam_init_velocity_x, 2)
        sim.resetDynamicObject(model | sim.handleflag_model)
    elseif steps == 5 then
        sim.resetDynamicObject(start)
    elseif steps == 8 then
        sim.resetDynamicObject(sim.handle_all)
    end
end

function sysCall_sensing()
    if steps == 3 then print('falls', 100 - height(free) - fallen(3), 100 - height(stays) - fallen(3)) end
    if steps == 7 then
        print('never reset', 100 - height(free) - fallen(7), sim.getVelocity(free)[3] + 9.81 * 0.35)
        print('reset at 4', 100 - height(single) - fallen(3) - fallen(4), sim.getVelocity(single)[3] + 9.81 * 0.2)
        print('in a model', 100 - height(inModel[1]) - fallen(3) - fallen(4), 100 - height(inModel[2]) - fallen(3) - fallen(4))
        local v = sim.getVelocity(start)
        print('its initial velocity now', sim.getObjectFloatParam(start, sim.shapefloatparam_init_velocity_x))
        print('thrown at 5', v[1] - 2, sim.getObjectPosition(start)[1] - 2 - 2 * 0.15, v[3] + 9.81 * 0.15)
    end
    if steps == 9 then
        print('all of them', 100 - height(free) - fallen(7) - fallen(2), sim.getVelocity(stays)[3] + 9.81 * 0.1)
        lastHeight = height(stays)
    end
end

function sysCall_beforeSimulation() steps = 0 end

function sysCall_afterSimulation()
    print('put back', height(free) - 100, height(inModel[1]) - 100)
    print('left where it is', height(stays) < lastHeight, 'velocities', sim.getVelocity(stays)[3], sim.getVelocity(free)[3])
end
