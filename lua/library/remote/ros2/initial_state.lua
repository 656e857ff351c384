--[[
Where objects were when the simulation began, for a reset of the state alone by the standard simulation interfaces of ROS 2. Internal.
]]

local sim = require('sim')

local M = {}

local poses, positions = {}, {} -- by object; positions of joints

--- Notes where objects are.
function M.note()
    poses, positions = {}, {}
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        local kind = sim.getObjectType(object)
        if kind == sim.sceneobject_joint and sim.getJointType(object) ~= sim.joint_spherical then
            positions[object] = sim.getJointPosition(object)
        elseif kind ~= sim.sceneobject_script then
            poses[object] = {parent = sim.getObjectParent(object), pose = sim.getObjectPose(object, sim.handle_parent)}
        end
    end
end

--- Brings back those that are still there; bodies rest, or have the velocity they began with.
function M.restore()
    for joint, position in pairs(positions) do
        if sim.isHandle(joint) then sim.setJointPosition(joint, position) end
    end
    for object, was in pairs(poses) do
        if sim.isHandle(object) and sim.getObjectParent(object) == was.parent then
            sim.setObjectPose(object, was.pose, sim.handle_parent)
        end
    end
    sim.resetDynamicObject(sim.handle_all)
end

return M
