-- A small robot that other programs drive by ROS 2. Run it:
--
--     swanilda run scenes/ros2_turtle.lua --realtime
--
-- and drive it from a shell of ROS 2, on the same machine (docs/ROS.md says how to find each other):
--
--     ros2 topic pub /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.3}, angular: {z: 0.5}}'
--
-- It reads /cmd_vel and publishes /odom, /scan, /camera/image_raw and /tf. If nobody has sent a command within a second, it drives a circle by
-- itself. It ends after 10 seconds of simulation.
sim = require 'sim'
simROS2 = require 'simROS2'

local ROOM, RANGE, RAYS, LONGEST = 4, 5, 36, 10

-- Walls and two pillars.
local function room()
    local function wall(size, at)
        local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size, 0)
        sim.setObjectPosition(shape, at)
        sim.setObjectSpecialProperty(shape, sim.objectspecialproperty_detectable | sim.objectspecialproperty_renderable)
        return shape
    end
    for _, side in ipairs {-1, 1} do
        sim.setShapeColor(wall({0.1, ROOM, 0.5}, {side * ROOM / 2, 0, 0.25}), nil, 0, {0.8, 0.3, 0.2})
        sim.setShapeColor(wall({ROOM, 0.1, 0.5}, {0, side * ROOM / 2, 0.25}), nil, 0, {0.2, 0.4, 0.8})
        wall({0.2, 0.2, 0.5}, {side, 1, 0.25})
    end
end

local function robot()
    body = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.3, 0.3, 0.1}, 0)
    sim.setObjectAlias(body, 'Turtle')
    sim.setObjectPosition(body, {0, 0, 0.1})
    local numbers, lengths = {32, 32, 1, 16, 1, 1, 0, 0}, {0, RANGE, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.02, 0, 0}
    laser = sim.createProximitySensor(sim.proximitysensor_ray, 16, 1, numbers, lengths)
    sim.setObjectParent(laser, body, false)
    camera = sim.createVisionSensor(1 + 2 + 128, {64, 48, 0, 0}, {0.05, 10, math.rad(60), 0.05, 0, 0, 0.7, 0.8, 0.95, 0, 0})
    sim.setObjectParent(camera, body, false)
    -- It looks along its z axis: forward; its y axis is up.
    sim.setObjectPose(camera, sim.buildPose({0.16, 0, 0.05}, {1, 0, 0}, 9, {0, 0, 1}), body)
end

function sysCall_init()
    room()
    robot()
    command = {linear = 0, angular = 0}
    x, y, heading, scans, images = 0, 0, 0, 0, 0
    simROS2.createSubscription('/cmd_vel', 'geometry_msgs/msg/Twist', function(message)
        command = {linear = message.linear.x, angular = message.angular.z}
        heard = true
    end)
    odometry = simROS2.createPublisher('/odom', 'nav_msgs/msg/Odometry')
    ranges = simROS2.createPublisher('/scan', 'sensor_msgs/msg/LaserScan', 0, false,
        {reliability = simROS2.qos_reliability_policy.best_effort, depth = 5})
    pictures = simROS2.imageTransportCreatePublisher('/camera/image_raw')
    print('drive me by /cmd_vel')
end

local function move(dt)
    heading = heading + command.angular * dt
    local ahead = command.linear * dt
    local limit = ROOM / 2 - 0.25
    x = math.max(-limit, math.min(limit, x + ahead * math.cos(heading)))
    y = math.max(-limit, math.min(limit, y + ahead * math.sin(heading)))
    sim.setObjectPosition(body, {x, y, 0.1})
    sim.setObjectOrientation(body, {0, 0, heading})
end

function sysCall_actuation()
    if not heard and sim.getSimulationTime() > 1 then
        print('nobody has sent a command: a circle')
        own = simROS2.createPublisher('/cmd_vel', 'geometry_msgs/msg/Twist')
        simROS2.publish(own, {linear = {x = 0.3}, angular = {z = 0.5}})
        heard = true
    end
    move(sim.getSimulationTimeStep())
    if sim.getSimulationTime() > LONGEST then sim.stopSimulation() end
end

local function scan()
    local distances = {}
    for i = 1, RAYS do
        local angle = (i - 1) * 2 * math.pi / RAYS - math.pi
        sim.setObjectPose(laser, sim.buildPose({0, 0, 0.1}, {math.cos(angle), math.sin(angle), 0}, 9, {0, 0, 1}), body)
        local found, distance = sim.handleProximitySensor(laser)
        distances[i] = found == 1 and distance or math.huge
    end
    return distances
end

local function publishPose(stamp)
    local turn = {z = math.sin(heading / 2), w = math.cos(heading / 2)}
    simROS2.publish(odometry, {
        header = {stamp = stamp, frame_id = 'odom'},
        child_frame_id = 'base_link',
        pose = {pose = {position = {x = x, y = y}, orientation = turn}},
        twist = {twist = {linear = {x = command.linear}, angular = {z = command.angular}}},
    })
    simROS2.sendTransform {
        header = {stamp = stamp, frame_id = 'odom'},
        child_frame_id = 'base_link',
        transform = {translation = {x = x, y = y}, rotation = turn},
    }
end

function sysCall_sensing()
    local stamp = simROS2.getSimulationTime()
    publishPose(stamp)
    simROS2.publish(ranges, {
        header = {stamp = stamp, frame_id = 'base_link'},
        angle_min = -math.pi, angle_max = math.pi, angle_increment = 2 * math.pi / RAYS,
        range_min = 0.02, range_max = RANGE, ranges = scan(),
    })
    scans = scans + 1
    if scans % 4 == 0 then
        sim.handleVisionSensor(camera)
        local image, resolution = sim.getVisionSensorImg(camera)
        simROS2.imageTransportPublish(pictures, image, resolution[1], resolution[2], 'camera')
        images = images + 1
    end
end

function sysCall_afterSimulation()
    print(('%d scans and %d pictures; at %.2f, %.2f'):format(scans, images, x, y))
end
