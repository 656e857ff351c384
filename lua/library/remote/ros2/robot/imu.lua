--[[
An IMU: a dummy on its link, whose poses give rotation and acceleration. At rest it measures the acceleration that holds it up. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')
local odometry = require('remote.ros2.robot.odometry')
local frames = require('remote.ros2.robot.frames')
local mount = require('remote.ros2.robot.mount')

local M = {}

-- Measures in the frame of an object: angular velocity between the last poses, and acceleration between the last velocities.
local function measure(object)
    local pose, velocity
    return function(step)
        local now = sim.getObjectPose(object)
        local last = pose or now
        local moving, gravity, acceleration = {}, sim.getArrayParam(sim.arrayparam_gravity), {}
        for i = 1, 3 do moving[i] = (now[i] - last[i]) / step end
        for i = 1, 3 do acceleration[i] = (velocity and (moving[i] - velocity[i]) / step or 0) - gravity[i] end
        local turn = odometry.turn(last, now)
        -- The first step has no velocity before it that could be compared.
        velocity = pose and moving
        pose = now
        return now, {turn[1] / step, turn[2] / step, turn[3] / step}, odometry.inFrame(now, acceleration)
    end
end

local function vector(numbers, noise)
    local noisy = {}
    for i = 1, 3 do noisy[i] = numbers[i] + mount.noise(noise) end
    return {x = noisy[1], y = noisy[2], z = noisy[3]}
end

local function covariance(noise)
    local square = noise * noise
    return {square, 0.0, 0.0, 0.0, square, 0.0, 0.0, 0.0, square}
end

function M.new(robot, part)
    local values = part.values
    local object = sim.createDummy(0.01)
    local pose = mount.on(robot, part, object, mount.AHEAD)
    local frame = frames.ofSensor(robot, part, pose, '_frame')
    local publisher = robot.topics.publisher(values.topic, 'sensor_msgs/msg/Imu', topics.SENSOR)
    local clock, read = topics.clock(values.rate), measure(object)

    return {
        reset = function()
            clock.reset()
            read = measure(object)
        end,
        sense = function(time, step, stamp)
            local now, rotation, acceleration = read(step)
            if not clock.isDue(time) then return end
            simROS2.publish(publisher, {
                header = {stamp = stamp, frame_id = frame},
                orientation = {x = now[4], y = now[5], z = now[6], w = now[7]},
                angular_velocity = vector(rotation, values.rotation_noise),
                angular_velocity_covariance = covariance(values.rotation_noise),
                linear_acceleration = vector(acceleration, values.acceleration_noise),
                linear_acceleration_covariance = covariance(values.acceleration_noise),
            })
        end,
    }
end

return M
