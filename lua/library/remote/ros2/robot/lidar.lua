--[[
A lidar: a vision sensor for each quarter of its turn, whose depths are measured along the rays. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')
local frames = require('remote.ros2.robot.frames')
local mount = require('remote.ros2.robot.mount')
local body = require('remote.ros2.robot.body')
local clouds = require('remote.ros2.robot.clouds')

local M = {}

local MOST_PIXELS <const> = 2048 -- of a side
local EXPLICIT <const>, PERSPECTIVE <const> = 1, 2

-- How many sensors there are, and what each sees: tangents of half of it, pixels as near to each other as rays, with one more on each side.
local function layout(values)
    local angle = values.max_angle - values.min_angle
    local sectors = math.max(1, math.ceil(angle / (math.pi / 2) - 1e-9))
    local half = math.max(angle / sectors / 2, 0.01)
    local spacing = values.samples > 1 and math.max(angle / (values.samples - 1), 1e-4) or half
    local width = math.max(8, math.min(MOST_PIXELS, math.ceil(2 * math.tan(half) / spacing) + 2))
    local tangent = math.tan(half) * width / (width - 2)
    local steepest = math.max(math.abs(values.min_vertical_angle), math.abs(values.max_vertical_angle))
    local up = math.tan(steepest) / math.cos(half)
    local height = steepest < 1e-9 and 1 or math.max(2, math.min(MOST_PIXELS, math.ceil(width * up / tangent) + 2))
    return {sectors = sectors, width = width, height = height, tangent = tangent, half = half, steepest = steepest}
end

local function lidar(values, seen)
    local numbers = {sectors = seen.sectors, width = seen.width, height = seen.height, tangent = seen.tangent}
    for _, name in ipairs {'samples', 'min_angle', 'max_angle', 'vertical_samples', 'min_vertical_angle', 'max_vertical_angle', 'min_range', 'max_range'} do
        numbers[name] = values[name]
    end
    return numbers
end

local function sensor(robot, part, seen, index)
    local values = part.values
    local near = math.max(0.005, values.min_range * math.cos(seen.half) * math.cos(seen.steepest))
    local tangent = seen.tangent * math.max(1, seen.height / seen.width)
    local floats = {near, math.max(values.max_range, near * 1.01), 2 * math.atan(tangent), 0.01, 0, 0, 0, 0, 0, 0, 0}
    local object = sim.createVisionSensor(EXPLICIT + PERSPECTIVE, {seen.width, seen.height, 0, 0}, floats)
    local yaw = values.min_angle + (values.max_angle - values.min_angle) * (index - 0.5) / seen.sectors
    local pose = mount.on(robot, part, object, sim.multiplyPoses(body.rotation({0, 0, 1}, yaw), mount.VISION))
    return object, pose
end

local function scanMessage(values, header, ranges)
    return {
        header = header,
        angle_min = values.min_angle, angle_max = values.max_angle,
        angle_increment = values.samples > 1 and (values.max_angle - values.min_angle) / (values.samples - 1) or 0,
        scan_time = values.rate > 0 and 1 / values.rate or 0,
        range_min = values.min_range, range_max = values.max_range, ranges = ranges,
    }
end

local function addNoise(ranges, deviation)
    if deviation == 0 then return end
    for i, range in ipairs(ranges) do ranges[i] = range + mount.noise(deviation) end
end

function M.new(robot, part, native)
    local values, seen = part.values, layout(part.values)
    local numbers, sensors, pose = lidar(values, seen), {}, nil
    for i = 1, seen.sectors do sensors[i], pose = sensor(robot, part, seen, i) end
    local frame = frames.ofSensor(robot, part, pose, '_frame')
    local isFlat = values.vertical_samples == 1 and values.points_topic ~= values.topic
    local scans = isFlat and robot.topics.publisher(values.topic, 'sensor_msgs/msg/LaserScan', topics.SENSOR)
    local points = robot.topics.bytesPublisher(values.points_topic, 'sensor_msgs/msg/PointCloud2')
    local clock = topics.clock(values.rate)

    local function measure()
        local pictures = {}
        for i, object in ipairs(sensors) do
            sim.handleVisionSensor(object)
            pictures[i] = sim.getVisionSensorDepth(object, 1)
        end
        local ranges = native.ranges(pictures, numbers)
        addNoise(ranges, values.noise)
        return ranges
    end

    return {
        reset = clock.reset,
        sense = function(time, _, stamp)
            if not clock.isDue(time) then return end
            local isScanRead, isCloudRead = scans and topics.hasReaders(scans), topics.hasReaders(points)
            if not (isScanRead or isCloudRead) then return end
            local ranges, header = measure(), {stamp = stamp, frame_id = frame}
            if isScanRead then simROS2.publish(scans, scanMessage(values, header, ranges)) end
            if isCloudRead then simROS2.publish(points, clouds.message(header, native.cloudOfRanges(ranges, numbers), nil, false)) end
        end,
    }
end

return M
