-- What all these scenes share: bodies, links, and a look at whether every pose of the scene is made of numbers.
local sim = require 'sim'
local watch = {}

function watch.isFinite(values)
    for _, value in ipairs(values) do
        if value ~= value or math.abs(value) == math.huge then return false end
    end
    return true
end

--- A shape at a place.
function watch.box(alias, at, dynamic, respondable)
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(box, alias)
    sim.setObjectPosition(box, at)
    sim.setObjectInt32Param(box, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(box, sim.shapeintparam_respondable, respondable and 1 or 0)
    return box
end

--- A joint or force sensor at the place of the child, between it and the parent.
function watch.link(link, parent, child)
    sim.setObjectPose(link, sim.getObjectPose(child))
    sim.setObjectParent(link, parent, true)
    sim.setObjectParent(child, link, true)
    return link
end

function watch.joint(type, control)
    local joint = sim.createJoint(type or sim.joint_revolute, sim.jointmode_dynamic, 0)
    if control then sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, control) end
    return joint
end

function watch.sensor()
    return sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.05, 100, 10, 0, 0})
end

--- Raises an error when anything scripts can read has no numbers.
function watch.check()
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        local path = sim.getObjectAlias(object, 2)
        assert(watch.isFinite(sim.getObjectPose(object)), path .. ' is nowhere')
        assert(watch.isFinite(sim.getObjectPose(object, sim.handle_parent)), path .. ' is nowhere in its parent')
        local type = sim.getObjectType(object)
        if type == sim.sceneobject_shape then
            local linear, angular = sim.getVelocity(object)
            assert(watch.isFinite(linear) and watch.isFinite(angular), path .. ' has no velocity')
        elseif type == sim.sceneobject_joint then
            if sim.getJointType(object) ~= sim.joint_spherical then
                assert(watch.isFinite{sim.getJointPosition(object), sim.getJointVelocity(object)}, path .. ' has no position')
                assert(watch.isFinite{sim.getJointForce(object)}, path .. ' has no force')
            end
        elseif type == sim.sceneobject_forcesensor then
            local _, force, torque = sim.readForceSensor(object)
            assert(watch.isFinite(force) and watch.isFinite(torque), path .. ' reads nothing')
        end
    end
    for index = 0, math.huge do
        local shapes, point, force, normal = sim.getContactInfo(sim.handle_all, sim.handle_all, index)
        if #shapes == 0 then break end
        assert(watch.isFinite(point) and watch.isFinite(force) and watch.isFinite(normal), 'a contact is nowhere')
    end
end

return watch
