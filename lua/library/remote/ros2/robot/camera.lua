--[[
A camera: a vision sensor that publishes pictures, depths and points, each if somebody reads it, and what its lens is like. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')
local frames = require('remote.ros2.robot.frames')
local mount = require('remote.ros2.robot.mount')
local clouds = require('remote.ros2.robot.clouds')

local M = {}

local EXPLICIT <const>, PERSPECTIVE <const> = 1, 2
local GREY <const>, METRES <const> = 1, 1
local GREY_FORMATS <const> = {L8 = true, L_INT8 = true, mono8 = true}

-- The angle of a vision sensor is that of its longer side.
local function newSensor(values)
    local tangent = math.tan(values.fov / 2) * math.max(1, values.height / values.width)
    local floats = {values.near, values.far, 2 * math.atan(tangent), 0.01, 0, 0, 0, 0, 0, 0, 0}
    return sim.createVisionSensor(EXPLICIT + PERSPECTIVE, {math.tointeger(values.width), math.tointeger(values.height), 0, 0}, floats)
end

-- A vision sensor of the scene: what it is like is the camera.
local function sensorOfScene(robot, values)
    local object = sim.getObject(values.object, {noError = true, proxy = robot.base})
    if object == -1 then error(("there is no object '%s'"):format(values.object), 0) end
    local resolution = sim.getVisionSensorRes(object)
    values.width, values.height = resolution[1], resolution[2]
    local angle = sim.getObjectFloatParam(object, sim.visionfloatparam_perspective_angle)
    values.fov = 2 * math.atan(math.tan(angle / 2) * math.min(1, values.width / values.height))
    values.near = sim.getObjectFloatParam(object, sim.visionfloatparam_near_clipping)
    values.far = sim.getObjectFloatParam(object, sim.visionfloatparam_far_clipping)
    return object, values.frame or sim.getObjectAlias(object)
end

local function sensorOnLink(robot, part)
    local object = newSensor(part.values)
    local pose = mount.on(robot, part, object, mount.VISION)
    local optical = sim.multiplyPoses(pose, mount.OPTICAL)
    return object, frames.ofSensor(robot, part, optical, '_optical_frame')
end

local function lens(values)
    local focal, cx, cy = values.width / 2 / math.tan(values.fov / 2), (values.width - 1) / 2, (values.height - 1) / 2
    return {
        height = values.height, width = values.width, distortion_model = 'plumb_bob', d = {0.0, 0.0, 0.0, 0.0, 0.0},
        k = {focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0},
        r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0},
        p = {focal, 0.0, cx, 0.0, 0.0, focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0},
    }, focal
end

local function image(values, header, encoding, size, data)
    return {header = header, height = values.height, width = values.width, encoding = encoding, step = values.width * size, data = data}
end

-- The publishers of a camera, each with what publishes a shot.
local function outputs(robot, values, native, focal)
    local found = {}
    local function add(topic, kind, make)
        local publisher = robot.topics.bytesPublisher(topic, 'sensor_msgs/msg/' .. kind)
        found[#found + 1] = {publisher = publisher, publish = function(shot, header) simROS2.publish(publisher, make(shot, header)) end}
    end
    if values.color and GREY_FORMATS[values.format] then
        add(values.topic, 'Image', function(shot, header)
            return image(values, header, 'mono8', 1, native.flippedRows(shot.grey(), values.width))
        end)
    elseif values.color then
        local publisher = robot.topics.imagePublisher(values.topic)
        found[1] = {publisher = publisher, publish = function(shot, header)
            native.publishImage(publisher, shot.colors(), values.width, header.frame_id, header.stamp)
        end}
    end
    if values.depth then
        add(values.depth_topic, 'Image', function(shot, header)
            return image(values, header, '32FC1', 4, native.depthImage(shot.depths(), values.width, values.far))
        end)
    end
    if values.depth and values.points then
        add(values.points_topic, 'PointCloud2', function(shot, header)
            local colors = values.color and shot.colors() or ''
            return clouds.message(header, native.cloudOfDepths(shot.depths(), colors, values.width, focal, values.far), values.width, values.color)
        end)
    end
    return found
end

-- What a sensor sees, read when it is needed.
local function shotOf(object)
    sim.handleVisionSensor(object)
    return {
        colors = function() return (sim.getVisionSensorImg(object)) end,
        grey = function() return (sim.getVisionSensorImg(object, GREY)) end,
        depths = function() return (sim.getVisionSensorDepth(object, METRES)) end,
    }
end

local function infoPublishers(robot, values)
    local found = {robot.topics.publisher(values.info_topic, 'sensor_msgs/msg/CameraInfo', topics.SENSOR)}
    if values.depth and values.depth_info_topic then
        found[2] = robot.topics.publisher(values.depth_info_topic, 'sensor_msgs/msg/CameraInfo', topics.SENSOR)
    end
    return found
end

function M.new(robot, part, native)
    local values = part.values
    local object, frame
    if values.object then object, frame = sensorOfScene(robot, values) else object, frame = sensorOnLink(robot, part) end
    values.width, values.height = math.tointeger(values.width), math.tointeger(values.height)
    local info, focal = lens(values)
    local infos, all, clock = infoPublishers(robot, values), outputs(robot, values, native, focal), topics.clock(values.rate)

    return {
        reset = clock.reset,
        sense = function(time, _, stamp)
            if not clock.isDue(time) then return end
            local header, shot = {stamp = stamp, frame_id = frame}, nil
            for _, output in ipairs(all) do
                if topics.hasReaders(output.publisher) then
                    shot = shot or shotOf(object)
                    output.publish(shot, header)
                end
            end
            info.header = header
            for _, publisher in ipairs(infos) do simROS2.publish(publisher, info) end
        end,
    }
end

return M
