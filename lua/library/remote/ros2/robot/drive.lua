--[[
A drive with wheels on two sides, told by twists, with odometry of its wheels: as diff_drive_controller has it. Internal.
]]

local sim = require('sim')
local odometry = require('remote.ros2.robot.odometry')
local body = require('remote.ros2.robot.body')

local M = {}

-- How fast something may become, from what it is: limits of speed and acceleration that are said.
local function limiter(values, prefix)
    local function of(name, has)
        if values[prefix .. has] == false then return nil end
        return values[prefix .. name]
    end
    local fastest, slowest = of('max_velocity', 'has_velocity_limits'), of('min_velocity', 'has_velocity_limits')
    local gain, loss = of('max_acceleration', 'has_acceleration_limits'), of('min_acceleration', 'has_acceleration_limits')
    slowest, loss = slowest or fastest and -fastest, loss or gain and -gain
    return function(wanted, now, step)
        wanted = math.max(slowest or -math.huge, math.min(fastest or math.huge, wanted))
        return math.max(now + (loss or -math.huge) * step, math.min(now + (gain or math.huge) * step, wanted))
    end
end

-- How far a wheel has turned since the last call; positions of wheels begin anew after a turn.
local function encoder(joint)
    local last
    return function(step)
        local now = joint:position()
        local before = last or now
        last = now
        local turns = math.floor((joint:velocity() * step - (now - before)) / (2 * math.pi) + 0.5)
        return now - before + turns * 2 * math.pi
    end
end

local function encoders(joints)
    local all
    local function reset()
        all = {}
        for i, joint in ipairs(joints) do all[i] = encoder(joint) end
    end
    reset()
    return {
        reset = reset,
        -- The mean of the wheels of a side.
        turned = function(step)
            local sum = 0
            for _, turned in ipairs(all) do sum = sum + turned(step) end
            return sum / #all
        end,
    }
end

-- Where the wheels have taken the robot, from where the simulation began.
local function wheelOdometry(sides, shape)
    local x, y, heading
    local made = {}

    function made.reset()
        x, y, heading = 0, 0, 0
        sides.left.encoders.reset()
        sides.right.encoders.reset()
    end

    function made.measure(step)
        local left = sides.left.encoders.turned(step) * shape.leftRadius
        local right = sides.right.encoders.turned(step) * shape.rightRadius
        local way, turn = (left + right) / 2, (right - left) / shape.separation
        x, y = x + way * math.cos(heading + turn / 2), y + way * math.sin(heading + turn / 2)
        heading = heading + turn
        local pose = body.rotation({0, 0, 1}, heading)
        pose[1], pose[2] = x, y
        return pose, {way / step, 0, 0}, {0, 0, turn / step}
    end

    made.reset()
    return made
end

local function subscribe(robot, topic, command)
    local function take(twist) command.linear, command.angular, command.time = twist.linear.x, twist.angular.z, sim.getSimulationTime() end
    robot.topics.subscription(topic, 'geometry_msgs/msg/Twist', take)
    robot.topics.subscription(topic, 'geometry_msgs/msg/TwistStamped', function(message) take(message.twist) end)
    if topic:find('cmd_vel$') then robot.topics.subscription(topic .. '_unstamped', 'geometry_msgs/msg/Twist', take) end
end

local function isFinite(number) return number == number and math.abs(number) ~= math.huge end

local function shapeOf(values)
    return {
        separation = values.wheel_separation * (values.wheel_separation_multiplier or 1),
        leftRadius = values.wheel_radius * (values.left_wheel_radius_multiplier or 1),
        rightRadius = values.wheel_radius * (values.right_wheel_radius_multiplier or 1),
    }
end

local function side(robot, names)
    local joints = robot.joints.named(names)
    return {joints = joints, encoders = encoders(joints)}
end

function M.new(robot, part)
    local values, shape = part.values, shapeOf(part.values)
    local sides = {left = side(robot, values.left_wheel_names), right = side(robot, values.right_wheel_names)}
    local limits = {linear = limiter(values, 'linear.x.'), angular = limiter(values, 'angular.z.')}
    local command, now = {linear = 0, angular = 0, time = -math.huge}, {linear = 0, angular = 0}
    local ofWheels = wheelOdometry(sides, shape)
    local truth, forget = odometry.truth(robot.body.rootPose)
    local published = odometry.publish(robot, values, values.ground_truth and truth or ofWheels.measure)
    subscribe(robot, values.topic, command)
    local made = {sense = published.sense}

    local function turnWheels(joints, speed)
        for _, joint in ipairs(joints) do joint:command('velocity', speed) end
    end

    local function drive(step)
        for _, axis in ipairs {'linear', 'angular'} do
            now[axis] = limits[axis](isFinite(command[axis]) and command[axis] or 0, now[axis], step)
        end
        local half = now.angular * shape.separation / 2
        turnWheels(sides.left.joints, (now.linear - half) / shape.leftRadius)
        turnWheels(sides.right.joints, (now.linear + half) / shape.rightRadius)
        for _, one in pairs(sides) do
            for _, joint in ipairs(one.joints) do joint:actuate(step) end
        end
    end

    --- A robot whose last command is too old stands still.
    function made.actuate(time, step)
        local timeout = values.cmd_vel_timeout
        if timeout > 0 and time - command.time > timeout + 1e-9 then command.linear, command.angular = 0, 0 end
        drive(step)
    end

    function made.reset()
        command.linear, command.angular, command.time = 0, 0, -math.huge
        now.linear, now.angular = 0, 0
        ofWheels.reset()
        forget()
        published.reset()
    end

    function made.claim()
        turnWheels(sides.left.joints, 0)
        turnWheels(sides.right.joints, 0)
    end

    return made
end

return M
