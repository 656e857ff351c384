--[[
Odometry of a robot: messages, and where it really is. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')
local body = require('remote.ros2.robot.body')
local frames = require('remote.ros2.robot.frames')

local M = {}

-- 6 x 6 numbers with those on the diagonal.
local function covariance(diagonal)
    local all = {}
    for i = 1, 36 do all[i] = 0.0 end
    for i = 1, 6 do all[7 * i - 6] = diagonal and diagonal[i] or 0.0 end
    return all
end

--- Publishes poses with their twists, and the transform to the robot. `measure(step)` returns a pose, and the linear and angular velocity in its frame.
function M.publish(robot, values, measure)
    local publisher = robot.topics.publisher(values.odom_topic, 'nav_msgs/msg/Odometry', topics.SENSOR)
    local clock = topics.clock(values.publish_rate or 0)
    local frame, child = values.odom_frame_id or 'odom', values.base_frame_id or robot.body.root
    local ofPose, ofTwist = covariance(values.pose_covariance_diagonal), covariance(values.twist_covariance_diagonal)
    local pose = {0, 0, 0, 0, 0, 0, 1}
    robot.hasOdometry = true
    if values.enable_odom_tf ~= false then
        robot.odometry = function(stamp) return frames.message(stamp, frame, child, pose) end
    end

    return {
        reset = function() clock.reset() end,
        sense = function(time, step, stamp)
            local linear, angular
            pose, linear, angular = measure(step)
            if not clock.isDue(time) then return end
            simROS2.publish(publisher, {
                header = {stamp = stamp, frame_id = frame},
                child_frame_id = child,
                pose = {
                    pose = {
                        position = {x = pose[1], y = pose[2], z = pose[3]},
                        orientation = {x = pose[4], y = pose[5], z = pose[6], w = pose[7]},
                    },
                    covariance = ofPose,
                },
                twist = {
                    twist = {linear = {x = linear[1], y = linear[2], z = linear[3]}, angular = {x = angular[1], y = angular[2], z = angular[3]}},
                    covariance = ofTwist,
                },
            })
        end,
    }
end

--- The turn between two poses as an axis times an angle, in the frame of the first.
function M.turn(before, now)
    local between = sim.multiplyPoses(body.inverse(before), now)
    local x, y, z, w = table.unpack(between, 4, 7)
    if w < 0 then x, y, z, w = -x, -y, -z, -w end
    local length = math.sqrt(x * x + y * y + z * z)
    local factor = length > 1e-12 and 2 * math.atan(length, w) / length or 2
    return {x * factor, y * factor, z * factor}
end

--- A vector of the world in the frame of a pose.
function M.inFrame(pose, vector)
    local turn = {0, 0, 0, table.unpack(pose, 4, 7)}
    local moved = sim.multiplyPoses(body.inverse(turn), {vector[1], vector[2], vector[3], 0, 0, 0, 1})
    return {moved[1], moved[2], moved[3]}
end

--- Measures a pose of the world, with its velocities between steps.
function M.truth(pose)
    local before
    local function measure(step)
        local now = pose()
        local last = before or now
        before = now
        local way, turn = {}, M.turn(last, now)
        for i = 1, 3 do way[i], turn[i] = (now[i] - last[i]) / step, turn[i] / step end
        return now, M.inFrame(now, way), turn
    end
    return measure, function() before = nil end
end

--- Where the robot really is.
function M.new(robot, part)
    local measure, forget = M.truth(robot.body.rootPose)
    local made = M.publish(robot, part.values, measure)
    return {
        sense = made.sense,
        reset = function()
            forget()
            made.reset()
        end,
    }
end

return M
