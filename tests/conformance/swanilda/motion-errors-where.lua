-- as: sandbox
-- passes: 0
-- spec: motion 2, motion 3, conventions 2; errors of motions point at the line of the script that asked for them
-- topic: motion
sim = require 'sim'

local function where(what, f)
    local _, message = pcall(f)
    print(what, message)
end

local function with(base, changes)
    local params = {}
    for field, value in pairs(base) do params[field] = value end
    for field, value in pairs(changes) do
        if value == 'none' then params[field] = nil else params[field] = value end
    end
    return params
end

local CONFIG <const> = {pos = {0, 0}, targetPos = {1, 1}, maxVel = {1, 1}, maxAccel = {1, 1}, maxJerk = {10, 10}, timeStep = 0.5}
local POSE <const> = {pose = {0, 0, 0, 0, 0, 0, 1}, targetPose = {1, 0, 0, 0, 0, 0, 1}, maxVel = 1, maxAccel = 1, maxJerk = 10, timeStep = 0.5}
local WRONG <const> = {
    {maxVel = 'none'}, {maxAccel = 'none'}, {maxJerk = 'none'}, {maxAccel = 'none', maxJerk = 'none'}, {maxVel = 'none', maxJerk = 'none'},
    {maxVel = {1}}, {maxAccel = {}}, {maxJerk = 'x'}, {minVel = {1}}, {minAccel = 'x'}, {vel = {0}}, {accel = {}}, {targetVel = 'x'},
    {flags = 1.5}, {timeStep = -1}, {timeStep = 'x'}, {callback = 5}, {callback = {}}, {minVel = {1}, minAccel = 'x'}, {maxJerk = 'none', minVel = {1}},
}
for i, changes in ipairs(WRONG) do
    local config, pose = with(CONFIG, changes), with(POSE, changes)
    where('config ' .. i, function() local _ = sim.moveToConfig_init(config) end)
    where('config ' .. i, function() local _ = sim.moveToConfig(config) end)
    where('pose ' .. i, function() local _ = sim.moveToPose_init(pose) end)
    where('pose ' .. i, function() local _ = sim.moveToPose(pose) end)
end
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
for i, changes in ipairs{
    {pos = 'none'}, {pos = {}}, {pos = 'x'}, {joints = {joint}}, {joints = {joint, 99999}}, {joints = {}, pos = 'none'}, {joints = 5, pos = 'none'},
    {targetPos = 'none'}, {targetPos = {1}}, {cyclicJoints = true}, {pos = {0 / 0, 0}},
} do
    local config = with(CONFIG, changes)
    where('config, own ' .. i, function() local _ = sim.moveToConfig_init(config) end)
    where('config, own ' .. i, function() local _ = sim.moveToConfig(config) end)
end
for i, changes in ipairs{
    {pose = 'none'}, {pose = {1}}, {targetPose = 'none'}, {targetPose = {1}}, {metric = 5}, {metric = {1, 1}}, {pose = 'none', object = 99999},
    {pose = 'none', object = joint, relObject = 99999}, {pose = 'none', ik = 5}, {pose = 'none', ik = {}}, {pose = 'none', ik = {tip = joint}},
    {pose = 'none', object = {}}, {pose = 'none', ik = {target = joint}},
} do
    local pose = with(POSE, changes)
    where('pose, own ' .. i, function() local _ = sim.moveToPose_init(pose) end)
    where('pose, own ' .. i, function() local _ = sim.moveToPose(pose) end)
end
for i, value in ipairs{5, 'x', {}, {startPose = false}} do
    where('no motion ' .. i, function() local _ = sim.moveToConfig_step(value) end)
    where('no motion ' .. i, function() local _ = sim.moveToPose_step(value) end)
    where('no motion ' .. i, function() print(select('#', sim.moveToConfig_cleanup(value)), select('#', sim.moveToPose_cleanup(value))) end)
end
where('no parameters', function() local _ = sim.moveToConfig_init(5) end)
where('no parameters', function() local _ = sim.moveToPose_init(5) end)

-- The older forms.
local function nothing() end
where('older config', function() local _ = sim.moveToConfig(0, {0}, {0}, {0}, {1}, {1}, {10}, {1}, {0}, 5) end)
where('older config', function() local _ = sim.moveToConfig(0, {0}, {0}, {0}, {}, {1}, {10}, {1}, {0}, nothing) end)
where('older config', function() local _ = sim.moveToConfig(0, {0}, 'x', {0}, {1}, {1}, {10}, {1}, {0}, nothing) end)
where('older pose', function() local _ = sim.moveToPose(0, POSE.pose, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, POSE.targetPose, 5) end)
where('older pose', function() local _ = sim.moveToPose(0, POSE.pose, {1}, {1, 1, 1, 1}, {1, 1, 1, 1}, POSE.targetPose, nothing) end)
where('older pose', function() local _ = sim.moveToPose(0, POSE.pose, 'x', {1, 1, 1, 1}, {1, 1, 1, 1}, POSE.targetPose, nothing) end)

-- What a motion cannot do, and a callback that is none; the level of stepping is as before.
local level = sim.setStepping(0)
sim.setStepping(level)
where('impossible', function() local _ = sim.moveToConfig(with(CONFIG, {maxAccel = {0, 0}})) end)
where('impossible', function() local _ = sim.moveToPose(with(POSE, {maxAccel = 0})) end)
where('no such function', function() local _ = sim.moveToConfig(with(CONFIG, {callback = 'nobody'})) end)
where('no such function', function() local _ = sim.moveToPose(with(POSE, {callback = 'nobody'})) end)
where('raised', function() local _ = sim.moveToConfig(with(CONFIG, {callback = function() error('by the callback', 0) end})) end)
print(sim.setStepping(level) == level)
