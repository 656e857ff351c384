-- spec: data 3
-- Properties are read and written under their names of 4.10 and of the version after it.
sim = require 'sim'

local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
local dummy = sim.createDummy(0.1)
local sensor = sim.createForceSensor(0, {0, 0, 0, 0, 0}, {0.1, 1, 1, 0, 0})
local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})

-- Written under one name, read under both.
local function both(kind, target, name, later, value, other)
    local get, set = sim['get' .. kind .. 'Property'], sim['set' .. kind .. 'Property']
    set(target, later, value)
    local here = {get(target, name), get(target, later)}
    set(target, name, other)
    print(later, here[1], here[2], get(target, name), get(target, later))
end
both('String', joint, 'alias', 'name', 'Elbow', 'Knee')
-- Before there is a target to move to.
both('Float', joint, 'jointPosition', 'joint.position', 0.5, 0.25)
both('Float', joint, 'targetPos', 'targetPosition', 0.5, 0.25)
both('Float', joint, 'targetVel', 'targetVelocity', 0.5, 0.25)
both('Float', joint, 'jointLength', 'length', 0.5, 0.25)
both('Int', joint, 'jointMode', 'mode', sim.jointmode_dynamic, sim.jointmode_kinematic)
both('Int', joint, 'dynCtrlMode', 'dynamics.ctrlMode', sim.jointdynctrl_position, sim.jointdynctrl_velocity)
both('Float', joint, 'ode.bounce', 'dynamics.ode.bounce', 0.5, 0.25)
both('FloatArray', joint, 'interval', 'bounds', {0, 1}, {0, 0.5})
both('Float', dummy, 'dummySize', 'size', 0.5, 0.25)
both('Float', sensor, 'sensorSize', 'size', 0.5, 0.25)
both('Float', shape, 'bullet.friction', 'dynamics.bullet.friction', 0.5, 0.25)
both('Float', sim.handle_scene, 'timeStep', 'simulation.timeStep', 0.02, 0.05)
both('Vector3', sim.handle_scene, 'gravity', 'dynamics.gravity', {0, 0, -1}, {0, 0, -9.81})
local other = sim.createDummy(0.1)
sim.setHandleProperty(dummy, 'linkedDummy', other)
print('linked', sim.getHandleProperty(dummy, 'linkedDummy') == other, sim.getIntProperty(dummy, 'linkedDummyHandle') == other)
sim.setHandleArrayProperty(dummy, 'customData.list', {joint, shape})
local list = sim.getHandleArrayProperty(dummy, 'customData.list')
print('list', #list, list[1] == joint, list[2] == shape)

sim.setObjectParent(dummy, shape, true)
print('parent', sim.getHandleProperty(dummy, 'parent') == shape, sim.getIntProperty(dummy, 'parentHandle') == shape)
print('objects', #sim.getHandleArrayProperty(sim.handle_scene, 'objects') == #sim.getIntArrayProperty(sim.handle_scene, 'objectHandles'))
print('info', sim.getPropertyInfo(joint, 'targetPosition') == sim.getPropertyInfo(joint, 'targetPos'), sim.getProperty(joint, 'targetPosition'))
print('path', sim.getStringProperty(sim.handle_app, 'paths.temp') == sim.getStringProperty(sim.handle_app, 'tempPath'))
-- True under the one name where it is false under the other.
local script = sim.createScript(sim.scripttype_customization, '')
both('Bool', script, 'scriptDisabled', 'enabled', true, true)
both('Bool', script, 'scriptDisabled', 'enabled', false, false)
print('type', sim.getPropertyInfo(script, 'enabled') == sim.propertytype_bool, pcall(sim.setIntProperty, script, 'enabled', 1))
print('removed', pcall(sim.removeProperty, script, 'enabled'))
for i = 0, 200 do
    if sim.getPropertyName(script, i) == 'enabled' then print('listed') end
end
for i = 0, 200 do
    local name = sim.getPropertyName(joint, i)
    if name == 'targetPosition' or name == 'dynamics.ode.bounce' then print('listed', name) end
end
