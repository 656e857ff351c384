--[[
Robots of ROS 2, for `--ros2`: what tags of a URDF, parameters of ros2_control or a TOML file say becomes sensors in the scene, topics and controllers.
It is a part of the add-on of the standard simulation interfaces (`remote.ros2`). Internal.

A robot consists of parts (`remote.ros2.robot.*`): tables with `actuate(time, step)` before a step, `sense(time, step, stamp)` after it, and `reset()` at the end of
a simulation. They end with the robot's object.
]]

local _, native = ...
local sim = require('sim')
local simROS2 = require('simROS2')
local body = require('remote.ros2.robot.body')
local topics = require('remote.ros2.robot.topics')
local joints = require('remote.ros2.robot.joints')
local frames = require('remote.ros2.robot.frames')

topics.hasReaders = native.hasReaders

local MAKERS <const> = {
    lidar = require('remote.ros2.robot.lidar'),
    camera = require('remote.ros2.robot.camera'),
    imu = require('remote.ros2.robot.imu'),
    diff_drive = require('remote.ros2.robot.drive'),
    trajectory = require('remote.ros2.robot.trajectory'),
    forward = require('remote.ros2.robot.forward'),
    odometry = require('remote.ros2.robot.odometry'),
}

local M = {}

local robots = {} -- in the order in which they came
local settings -- the TOML file of the command line
local ofScene -- the file of the scene whose robot was looked for

---------------------------------------------------------------- robots

local function report(robot, description)
    for _, problem in ipairs(description.problems) do
        sim.addLog(sim.verbosity_scriptwarnings, ('ROS 2: not understood: %s'):format(problem))
    end
    local names = {}
    for _, topic in ipairs(robot.topics.all()) do names[#names + 1] = topic end
    sim.addLog(sim.verbosity_scriptinfos, ('ROS 2: robot %s: %s'):format(sim.getObjectAlias(robot.base, 2), table.concat(names, ', ')))
end

-- A part that cannot be made is reported, and the others are there.
local function addPart(robot, maker, part)
    local ok, made = pcall(maker.new, robot, part, native)
    if not ok then
        sim.addLog(sim.verbosity_scriptwarnings, ("ROS 2: '%s' of the robot is left out: %s"):format(part.name, tostring(made):match('^[^\n]*')))
    else
        robot.parts[#robot.parts + 1] = made
    end
end

-- Broadcasters of an IMU name a sensor; without one of that name they measure in their frame.
local function withBroadcasters(parts)
    local all, imus = {}, {}
    for _, part in ipairs(parts) do
        if part.kind == 'imu' then imus[part.name] = part end
    end
    for _, part in ipairs(parts) do
        if part.kind == 'imu_broadcaster' then
            local values = {}
            for key, value in pairs((imus[part.values.sensor_name] or {values = {rate = 0, rotation_noise = 0, acceleration_noise = 0}}).values) do values[key] = value end
            values.topic, values.frame = part.values.topic, part.values.frame_id or values.frame
            values.link = values.link or values.frame
            all[#all + 1] = {kind = 'imu', name = part.name, values = values}
        else
            all[#all + 1] = part
        end
    end
    return all
end

local function addParts(robot, description)
    local states = {}
    for _, part in ipairs(withBroadcasters(description.parts)) do
        if part.kind == 'joint_states' then
            states[#states + 1] = part
        elseif MAKERS[part.kind] then
            addPart(robot, MAKERS[part.kind], part)
        end
    end
    if #states == 0 and #robot.joints.all > 0 then states[1] = {name = 'joint_states', values = {topic = 'joint_states', rate = 0}} end
    for _, part in ipairs(states) do addPart(robot, joints.states, part) end
    if robot.body.isDescribed then robot.parts[#robot.parts + 1] = frames.new(robot) end
end

local function publishDescription(robot, description)
    if not description.urdf then return end
    local publisher = robot.topics.publisher('robot_description', 'std_msgs/msg/String', topics.LATCHED)
    simROS2.publish(publisher, {data = description.urdf})
end

-- Each joint is moved by the first part that asks for it, until another one is told something.
local function claim(robot)
    for _, part in ipairs(robot.parts) do
        if part.claim then part.claim() end
    end
end

--- Gives an object the topics that a description says. `namespace` is nil or a name.
function M.attach(base, description, namespace)
    local robot = {base = base, parts = {}, frames = {}}
    robot.topics = topics.new(namespace or description.namespace)
    robot.body = body.new(base, description)
    robot.joints = joints.new(robot, description)
    addParts(robot, description)
    claim(robot)
    publishDescription(robot, description)
    robot.objects = robot.body.isDescribed and sim.getObjectsInTree(base) or {}
    robots[#robots + 1] = robot
    report(robot, description)
end

--- What a file says of a robot, or nil; an error is in the log.
function M.describe(file, ofSettings)
    local ok, description = pcall(native.describe, file, ofSettings)
    if ok then return description end
    sim.addLog(sim.verbosity_scripterrors, ('ROS 2: %s'):format(tostring(description):match('^[^\n]*')))
end

--- Gives an object that was loaded from a file what the file says.
function M.attachFile(base, file, namespace)
    local description = M.describe(file)
    if description then M.attach(base, description, namespace) end
end

-- Ends the robots whose objects are gone.
local function forget()
    local left = {}
    for _, robot in ipairs(robots) do
        if sim.isHandle(robot.base) then left[#left + 1] = robot else robot.topics.close() end
    end
    robots = left
end

---------------------------------------------------------------- the robot of the scene

-- The object that a description is about.
local function baseOf(description)
    if description.model then return sim.getObject(description.model, {noError = true}) end
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.handle_all, 2)) do
        if body.isOf(object, description) then return object end
    end
    return -1
end

--- Looks for the robot of a scene that has been loaded.
function M.look()
    local file = sim.getStringParam(sim.stringparam_scene_path_and_name)
    if file == '' and not settings or file == ofScene then return end
    ofScene = file
    forget()
    if #robots > 0 then return end
    local description = M.describe(file ~= '' and file or settings, settings)
    if not description then return end
    local base = baseOf(description)
    if base ~= -1 then return M.attach(base, description) end
    sim.addLog(sim.verbosity_scriptwarnings, ('ROS 2: the robot of %s is not in the scene'):format(file))
end

--- A scene is loaded: its robot is looked for anew.
function M.lookAgain()
    ofScene = nil
    M.look()
end

---------------------------------------------------------------- hooks

--- `file` is the TOML file of the command line, or nil.
function M.start(file) settings = file end

local function each(hook, ...)
    for _, robot in ipairs(robots) do
        if sim.isHandle(robot.base) then
            for _, part in ipairs(robot.parts) do
                if part[hook] then part[hook](...) end
            end
        end
    end
end

function M.actuate() each('actuate', sim.getSimulationTime(), sim.getSimulationTimeStep()) end

function M.sense()
    forget()
    each('sense', sim.getSimulationTime(), sim.getSimulationTimeStep(), simROS2.getSimulationTime())
end

function M.reset()
    forget()
    each('reset')
    for _, robot in ipairs(robots) do
        robot.joints.release()
        claim(robot)
    end
end

--- The objects of robots that publish their own frames and joints, as keys of a table.
function M.owned()
    local owned = {}
    for _, robot in ipairs(robots) do
        for _, object in ipairs(robot.objects) do owned[object] = true end
    end
    return owned
end

return M
