--[[
Frames of a robot at /tf and /tf_static, as robot_state_publisher has them: links by the joints between them. Internal.
]]

local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')
local body = require('remote.ros2.robot.body')

local M = {}

--- A transform as a message.
function M.message(stamp, parent, child, pose)
    return {
        header = {stamp = stamp, frame_id = parent},
        child_frame_id = child,
        transform = {
            translation = {x = pose[1], y = pose[2], z = pose[3]},
            rotation = {x = pose[4], y = pose[5], z = pose[6], w = pose[7]},
        },
    }
end

-- What never moves: fixed joints, and frames of sensors that the description does not have.
local function publishFixed(robot)
    local fixed, begin = {}, {sec = 0, nanosec = 0}
    for _, joint in ipairs(robot.body.joints) do
        if joint.kind == 'fixed' then fixed[#fixed + 1] = M.message(begin, joint.parent, joint.child, body.transform(robot.body, joint)) end
    end
    for _, frame in ipairs(robot.frames) do fixed[#fixed + 1] = M.message(begin, frame.parent, frame.name, frame.pose) end
    if #fixed == 0 then return end
    local publisher = robot.topics.publisher('tf_static', 'tf2_msgs/msg/TFMessage', topics.LATCHED)
    simROS2.publish(publisher, {transforms = fixed})
end

--- Publishes frames. A robot without odometry is in the world.
function M.new(robot)
    publishFixed(robot)
    local publisher = robot.topics.publisher('tf', 'tf2_msgs/msg/TFMessage', topics.FRAMES)
    local isInWorld = not robot.hasOdometry and robot.body.root ~= 'world'
    local part = {}

    function part.sense(_, _, stamp)
        local transforms = {}
        if isInWorld then transforms[1] = M.message(stamp, 'world', robot.body.root, robot.body.rootPose()) end
        for _, joint in ipairs(robot.body.joints) do
            if joint.kind ~= 'fixed' then transforms[#transforms + 1] = M.message(stamp, joint.parent, joint.child, body.transform(robot.body, joint)) end
        end
        if robot.odometry then transforms[#transforms + 1] = robot.odometry(stamp) end
        if #transforms > 0 then simROS2.publish(publisher, {transforms = transforms}) end
    end

    return part
end

--- The frame in which a sensor measures, whose pose is that in its link's frame: the one that is said, else the link itself, else one of the sensor's own.
function M.ofSensor(robot, part, pose, ending)
    local values = part.values
    local link = values.link or robot.body.root
    local isAtLink = true
    for i = 1, 6 do isAtLink = isAtLink and math.abs(pose[i]) < 1e-9 end
    local name = values.frame or isAtLink and link or part.name .. ending
    if not robot.body.has(name) then robot.frames[#robot.frames + 1] = {name = name, parent = link, pose = pose} end
    return name
end

return M
