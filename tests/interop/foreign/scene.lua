-- What packages of others drive: an arm with six joints called UR5, with a tip and a target; a ball, a sensor that looks at it, and a camera above it.
sim = require 'sim'

local function box(alias, size, position, parent)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size, 0)
    sim.setObjectAlias(handle, alias)
    sim.setObjectPosition(handle, position)
    if parent then sim.setObjectParent(handle, parent, true) end
    return handle
end

local function joint(alias, position, axis, parent)
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0, {0.05, 0.02})
    sim.setObjectAlias(handle, alias)
    sim.setObjectOrientation(handle, axis == 'y' and {-math.pi / 2, 0, 0} or {0, 0, 0})
    sim.setObjectPosition(handle, position)
    sim.setObjectParent(handle, parent, true)
    sim.setJointInterval(handle, false, {-3, 6})
    sim.setObjectInt32Param(handle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
    sim.setJointTargetForce(handle, 200)
    return handle
end

local base = box('UR5', {0.2, 0.2, 0.1}, {0, 0, 0.05})
sim.setObjectInt32Param(base, sim.shapeintparam_static, 1)
sim.setModelProperty(base, 0)
local parent = base
for i = 1, 6 do
    local z = 0.1 + 0.1 * (i - 1)
    parent = joint('joint' .. i, {0, 0, z}, i % 2 == 0 and 'y' or 'z', parent)
    parent = box('link' .. i, {0.06, 0.06, 0.08}, {0, 0, z + 0.05}, parent)
    sim.setObjectInt32Param(parent, sim.shapeintparam_static, 0)
    sim.setShapeMass(parent, 0.2)
end
local tip = sim.createDummy(0.02)
sim.setObjectAlias(tip, 'tip')
sim.setObjectPosition(tip, {0, 0, 0.7})
sim.setObjectParent(tip, parent, true)
local target = sim.createDummy(0.02)
sim.setObjectAlias(target, 'target')
sim.setObjectPosition(target, {0, 0, 0.7})
sim.setObjectParent(target, base, true)

local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}, 0)
sim.setObjectAlias(ball, 'Sphere')
sim.setObjectPosition(ball, {1, 1, 0.05})
sim.setShapeColor(ball, nil, sim.colorcomponent_ambient_diffuse, {0.1, 0.9, 0.2})

local eye = sim.createProximitySensor(sim.proximitysensor_ray, 16, 0, {3, 3, 2, 2, 1, 1, 0, 0}, {0, 2, 0.1, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0, 0, 0.01, 0, 0})
sim.setObjectAlias(eye, 'eye')
sim.setObjectPosition(eye, {1, 0, 0.05})
sim.setObjectOrientation(eye, {-math.pi / 2, 0, 0})
local camera = sim.createVisionSensor(1 | 2, {16, 16, 0, 0}, {0.01, 2, 0.2, 0.1, 0, 0, 0, 0, 0, 0, 0})
sim.setObjectAlias(camera, 'visionSensor')
sim.setObjectPosition(camera, {1, 1, 0.6})
sim.setObjectOrientation(camera, {math.pi, 0, 0})

-- The cameras of CoppeliaSim's own scenes are handled in each step as well.
function sysCall_sensing() sim.handleVisionSensor(camera) end
