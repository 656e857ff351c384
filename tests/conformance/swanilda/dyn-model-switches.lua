-- as: customization
-- passes: 16
-- engine: bullet278
-- spec: dynamics 2, dynamics 3; models that are not dynamic or not respondable, dynamic flags
-- tol: 1e-6
-- topic: dynamics
sim = require 'sim'

local function box(x, z, dynamic, parent)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    if parent then sim.setObjectParent(shape, parent, true) end
    return shape
end

local function model(parent)
    local dummy = sim.createDummy(0.01)
    sim.setModelProperty(dummy, 0)
    if parent then sim.setObjectParent(dummy, parent, true) end
    return dummy
end

local function linked(x, parent)
    local base, child = box(x, 3, true, parent), box(x, 2.8, true)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {x, 0, 2.9})
    sim.setObjectParent(joint, base, true)
    sim.setObjectParent(child, joint, true)
    return {base = base, joint = joint, child = child}
end

function sysCall_init()
    outer = model()
    inner = model(outer)
    deep = linked(0, inner)
    other = linked(1, model())
    ground = box(2, 0, false)
    thrown = box(2, 0.2, true, outer)
    ghosts = model()
    through = box(3, 0.2, true, model(ghosts))
    box(3, 0, false)
    flagSensor = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.05, 100, 10, 0, 0})
    sim.setObjectParent(flagSensor, other.child, false)
    sim.setObjectParent(box(5, 3, true), flagSensor, true)
    sim.setModelProperty(outer, sim.modelproperty_not_dynamic)
    sim.setModelProperty(ghosts, sim.modelproperty_not_respondable)
end

local function height(shape) return sim.getObjectPosition(shape)[3] end
local function enabled(...)
    local t = {}
    for i, handle in ipairs{...} do t[i] = tostring(sim.isDynamicallyEnabled(handle)) end
    return table.concat(t, ' ')
end
local function flags(...)
    local t = {}
    for i, handle in ipairs{...} do t[i] = sim.getIntProperty(handle, 'dynamicFlag') end
    return table.concat(t, ' ')
end

local steps = 0

function sysCall_actuation()
    steps = steps + 1
    if steps == 5 then sim.setModelProperty(outer, 0) end
    if steps == 9 then sim.setModelProperty(inner, sim.modelproperty_not_dynamic) end
end

function sysCall_sensing()
    if steps == 4 then
        print('not dynamic', height(deep.base), height(deep.child), height(thrown), enabled(deep.base, deep.joint, deep.child))
        print('another model', height(other.base) < 3, enabled(other.base, other.joint, other.child, flagSensor))
        print('flags', flags(deep.child, other.child, other.joint, flagSensor, ground, through))
    end
    if steps == 8 then
        print('dynamic again', height(deep.base) - 3 + 9.81 * 0.005 ^ 2 * 40 * 41 / 2, enabled(deep.base, deep.joint, deep.child))
        stopped = height(deep.base)
    end
    if steps == 12 then
        print('the inner model not', height(deep.base) - stopped, enabled(deep.base, thrown))
        print('on the ground', height(thrown) > 0.09, 'through it', height(through) < -0.5)
    end
end

function sysCall_afterSimulation() print('stopped', enabled(deep.base, other.joint), flags(other.child)) end
