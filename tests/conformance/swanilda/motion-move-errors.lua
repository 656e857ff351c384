-- as: simulation
-- passes: 40
-- engine: bullet278
-- spec: motion 2, motion 3; fields that are missing or wrong, what is under way when a callback fails, both forms
-- tol: 1e-9
-- topic: motion
sim = require 'sim'

local function refused(what, f, ...)
    local done, message = pcall(f, ...)
    print(what, (done and 'no error' or tostring(message):gsub('\nstack traceback.*', ''):gsub('^.-:%d+: ', '')))
end

local function with(base, changes)
    local t = {}
    for key, value in pairs(base) do t[key] = value end
    for key, value in pairs(changes) do t[key] = value end
    return t
end

local nan <const> = 0 / 0
local START <const>, GOAL <const> = {0, 0, 0, 0, 0, 0, 1}, {0.3, 0.4, 0, 0, 0, 0, 1}
local CONFIG <const> = {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, callback = print}
local POSE <const> = {pose = START, targetPose = GOAL, maxVel = 0.5, maxAccel = 1, maxJerk = 10, callback = print}

local function configs()
    for _, change in ipairs{
        {'pos', 5}, {'pos', {}}, {'pos', {nan}}, {'pos', {'a'}}, {'joints', 5}, {'joints', {1, 2}}, {'joints', {12345}},
        {'targetPos', {nan}}, {'targetPos', {1, 2}}, {'vel', 'x'}, {'accel', {}}, {'targetVel', {nan}}, {'maxVel', {nan}}, {'maxVel', 1},
        {'maxVel', {1, 2}}, {'maxAccel', {}}, {'maxJerk', 'x'}, {'minVel', {-1, -1}}, {'minAccel', true}, {'flags', 'x'}, {'flags', 0.5},
        {'timeStep', -1}, {'timeStep', 'x'}, {'cyclicJoints', true}, {'callback', 7}, {'callback', 'nobody'}, {'maxVel', {0}},
    } do
        refused('config ' .. change[1], sim.moveToConfig, with(CONFIG, {[change[1]] = change[2]}))
    end
    refused('config', sim.moveToConfig_init, 5)
    refused('config', sim.moveToConfig_step, {})
    refused('config', sim.moveToConfig_cleanup, {})
    local data = sim.moveToConfig_init(CONFIG)
    sim.moveToConfig_cleanup(data)
    refused('config ended', sim.moveToConfig_step, data)
    refused('config', sim.moveToConfig, -1, {0}, nil, nil, {0.5}, {1}, {10}, {1}, nil, 7)
    refused('config', sim.moveToConfig, -1, {0, 0}, nil, nil, {0.5}, {1}, {10}, {1, 1}, nil, print)
end

local function poses()
    refused('pose', sim.moveToPose, {})
    for _, change in ipairs{
        {'pose', {1, 2}}, {'pose', {nan, 0, 0, 0, 0, 0, 1}}, {'targetPose', {1, 2}}, {'targetPose', {0, 0, 0, 0, 0, 0, 1 / 0}},
        {'metric', 1}, {'metric', {1, 1}}, {'metric', {1, 1, 1, nan}}, {'vel', {0}}, {'maxVel', {1, 2}}, {'maxAccel', 'x'},
        {'timeStep', -0.1}, {'callback', {}},
    } do
        refused('pose ' .. change[1], sim.moveToPose, with(POSE, {[change[1]] = change[2]}))
    end
    local moved = {targetPose = GOAL, maxVel = 1, maxAccel = 1, maxJerk = 1}
    refused('object', sim.moveToPose, with(moved, {object = 12345}))
    refused('object', sim.moveToPose, with(moved, {object = 'x'}))
    refused('relObject', sim.moveToPose, with(moved, {object = sim.createDummy(0.01), relObject = 12345}))
    local tip = sim.createDummy(0.01)
    refused('ik', sim.moveToPose, with(moved, {ik = 5}))
    refused('ik', sim.moveToPose, with(moved, {ik = {tip = tip}}))
    refused('ik', sim.moveToPose, with(moved, {ik = {tip = tip, target = sim.createDummy(0.01), breakFlags = 1}}))
    refused('pose', sim.moveToPose_step, {})
    local data = sim.moveToPose_init(POSE)
    sim.moveToPose_cleanup(data)
    refused('pose ended', sim.moveToPose_step, data)
    refused('pose', sim.moveToPose, -1, START, {0.5}, {1}, {10}, GOAL, print) -- four axes without a metric
    local zero = sim.moveToPose(with(POSE, {targetPose = {0, 0, 0, 0, 0, 0, 0}, callback = function() end}))
    print('no orientation', table.concat(zero.pose, ' '))
end

function sysCall_thread()
    configs()
    poses()
    -- A callback that fails leaves nothing behind: the object is gone, and the thread is pre-empted again as before.
    local object
    refused('fails', sim.moveToConfig, with(CONFIG, {callback = function(data) object = data.ruckigObj error('as I like') end}))
    print('stepping', sim.setStepping(false), pcall(sim.ruckigStep, object, 0.05))
    -- What the caller hands over stays as it is, also when it contains itself; auxData is the caller's own.
    local aux, own = {}, {1}
    own.me = own
    local params = with(CONFIG, {auxData = aux, more = own, callback = function(data) return data.more.me == data.more and data.more ~= own end})
    local data = sim.moveToConfig(params)
    print(data.auxData == aux, data.more ~= own, params.vel, params.pos[1], data.timeLeft)
end
