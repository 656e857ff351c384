--[[
What `--ros2-bridge` and `--ros2` publish after each step: the time of the simulation (`/clock`), the poses of all objects (`/tf`) and the joints (`/joint_states`).

Frames and joints have the names of the objects, with their parents': `Robot/Arm`. Objects without a parent are in the frame `world`. It is an add-on.
]]

local sim = require 'sim'
local simROS2 = require 'simROS2'
local bridge = {}

local function nameOf(object) return (sim.getObjectAlias(object, 2):gsub('^/', '')) end

local function frameOf(object) return object == -1 and 'world' or nameOf(object) end

-- In the frame of the parent as it is in the scene: that of a joint does not turn with it, so the joint's motion is in the poses of its children.
local function poseOf(object, parent)
    local pose = sim.getObjectPose(object)
    if parent == -1 then return pose end
    local frame = sim.getObjectPose(parent)
    sim.invertPose(frame)
    return sim.multiplyPoses(frame, pose)
end

local function poses(stamp, others)
    local transforms = {}
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if not others[object] and sim.getObjectType(object) ~= sim.sceneobject_script then
            local parent = sim.getObjectParent(object)
            local pose = poseOf(object, parent)
            transforms[#transforms + 1] = {
                header = {stamp = stamp, frame_id = frameOf(parent)},
                child_frame_id = nameOf(object),
                transform = {
                    translation = {x = pose[1], y = pose[2], z = pose[3]},
                    rotation = {x = pose[4], y = pose[5], z = pose[6], w = pose[7]},
                },
            }
        end
    end
    return transforms
end

local function joints(stamp, others)
    local message = {header = {stamp = stamp}, name = {}, position = {}, velocity = {}, effort = {}}
    for _, joint in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.object_joint_type)) do
        if not others[joint] and sim.getJointType(joint) ~= sim.joint_spherical then
            message.name[#message.name + 1] = nameOf(joint)
            message.position[#message.position + 1] = sim.getJointPosition(joint)
            message.velocity[#message.velocity + 1] = sim.getJointVelocity(joint)
            -- Forces of joints are those that act on them, those of ROS what their motors do.
            message.effort[#message.effort + 1] = -(sim.getJointForce(joint) or 0)
        end
    end
    return message
end

--- Creates the publishers; without a node of ROS 2 that is an error of the add-on.
function bridge.start()
    bridge.clock = simROS2.createPublisher('/clock', 'rosgraph_msgs/msg/Clock')
    bridge.joints = simROS2.createPublisher('/joint_states', 'sensor_msgs/msg/JointState')
end

--- Publishes what a step has led to, but for the objects that are keys of a table: they have topics of their own.
function bridge.publish(others)
    local stamp = simROS2.getSimulationTime()
    simROS2.publish(bridge.clock, {clock = stamp})
    local transforms = poses(stamp, others or {})
    if #transforms > 0 then simROS2.sendTransforms(transforms) end
    local message = joints(stamp, others or {})
    if #message.name > 0 or not others or not next(others) then simROS2.publish(bridge.joints, message) end
end

return bridge
