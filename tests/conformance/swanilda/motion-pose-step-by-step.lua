-- as: sandbox
-- passes: 0
-- spec: motion 3; poses advanced by hand: axes and angle in phase, a metric, frames, what a callback sees and does
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function text(list)
    local t = {}
    for i, x in ipairs(list) do t[i] = string.format('%.6f', math.abs(x) < 5e-7 and 0.0 or x) end
    return table.concat(t, ' ')
end

local function about(angle, x, y, z, sign) return {x, y, z, 0, 0, math.sin(angle / 2) * (sign or 1), math.cos(angle / 2) * (sign or 1)} end

local LIMITS <const> = {maxVel = {0.5, 0.5, 0.5, 0.4}, maxAccel = {1, 1, 1, 0.8}, maxJerk = {10, 10, 10, 8}}

local function pose(what, params, shown)
    print(what)
    params.timeStep = params.timeStep or 0.25
    for field, value in pairs(LIMITS) do params[field] = params[field] or value end
    local data, result, count = sim.moveToPose_init(params), nil, 0
    repeat
        result, data = sim.moveToPose_step(data)
        count = count + 1
        if shown and shown[count] or result ~= 0 then
            print(count, result, text(data.pose), text(data.vel), text(data.accel), result == 1 and text{data.timeLeft} or '')
        end
    until result ~= 0 or count > 100
    local same = true
    for i, x in ipairs(sim.poseToMatrix(data.pose)) do same = same and math.abs(x - data.matrix[i]) < 1e-12 end
    local target, near = #params.targetPose == 7 and params.targetPose or data.pose, true
    for i = 1, 3 do near = near and math.abs(data.pose[i] - target[i]) < 1e-9 end
    sim.moveToPose_cleanup(data)
    print('matrix', same, 'arrived', near, 'over', data.ruckigObj == nil and data.startPose == nil)
    return data
end

local START <const> = about(0, 0, 0, 0)
-- x as in 0 to 1 in 2.6 s, 0.35 m after one second; the angle is 0.8 times that.
pose('position and angle', {pose = START, targetPose = about(0.8, 1, 0.5, -0.25)}, {[1] = true, [4] = true})
pose('the other quaternion', {pose = START, targetPose = about(0.8, 1, 0.5, -0.25, -1)}, {[4] = true})
pose('no rotation', {pose = about(0.3, 0, 0, 0), targetPose = about(0.3, 1, 0, 0)}, {[4] = true})
pose('rotation only', {pose = about(0.3, 0, 0, 0), targetPose = about(-0.5, 0, 0, 0)}, {[4] = true})
pose('a little rotation', {pose = START, targetPose = about(0.001, 1, 0, 0)}, {[4] = true})
pose('too little to turn', {pose = START, targetPose = about(2e-5, 1, 0, 0)}, {[4] = true})
pose('numbers', {pose = START, targetPose = about(0, 1, 0, 0), maxVel = 0.5, maxAccel = 1, maxJerk = 10}, {[4] = true})
pose('to a matrix', {pose = sim.poseToMatrix(START), targetPose = sim.poseToMatrix(about(0.8, 1, 0, 0))}, {[4] = true})
-- A metric: one distance. 0.6 m and 0.8 rad make 1; so does 0.3 m counted twice.
local ONE <const> = {maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}}
local function metric(what, m, target, shown, timeStep)
    pose(what, {
        pose = START, targetPose = target, metric = m, maxVel = ONE.maxVel, maxAccel = ONE.maxAccel, maxJerk = ONE.maxJerk, timeStep = timeStep,
    }, shown)
end
metric('metric', {1, 1, 1, 1}, about(0.8, 0.6, 0, 0), {[4] = true})
metric('metric, factors', {2, 3, 4, 0}, about(0.8, 0.3, 0.08 / 3 * 10, 0), {[4] = true})
metric('metric, z and angle', {0, 0, 5, 2}, about(0.4, 9, 9, 0.12), {[4] = true})
pose('metric, from elsewhere, about x', {
    pose = {1, 2, 3, 0, 0, 0, 1}, targetPose = {1.6, 2, 3, math.sin(0.4), 0, 0, math.cos(0.4)}, metric = {1, 1, 1, 1},
    maxVel = ONE.maxVel, maxAccel = ONE.maxAccel, maxJerk = ONE.maxJerk,
}, {[4] = true})
metric('metric, nothing to do', {1, 1, 1, 1}, about(0, 9e-7, 0, 0), nil, 0.005)
-- Four parts of (2e-6 / 2 / 10)^(1/3) s: 0.018566 s.
metric('metric, almost nothing', {1, 1, 1, 1}, about(0, 2e-6, 0, 0), nil, 0.005)

local frame, object = sim.createDummy(0.1), sim.createDummy(0.1)
sim.setObjectPose(frame, about(math.pi / 2, 1, 2, 3))
sim.setObjectPose(object, about(math.pi / 2, 1, 3, 3))
local function where() print('at', text(sim.getObjectPose(object))) end
pose('object', {object = object, targetPose = about(math.pi / 2, 2, 3, 3)}, {[4] = true})
where()
-- In the frame it is at (1, -1, 0) and goes to (1, 0, 0): in the world from (2, 3, 3) to (1, 3, 3).
pose('object in a frame', {object = object, relObject = frame, targetPose = about(0, 1, 0, 0)}, {[4] = true})
where()
pose('object with a callback', {object = object, targetPose = about(0, 5, 5, 5), callback = function(data) return data.pose[1] > 2 end})
where()

print('older form')
local seen = 0
local function callback(value, v, a, x)
    seen = seen + 1
    if seen == 4 then print('callback', text(value), text(v), text(a), x) end
end
local last, left = sim.moveToPose(-1, START, LIMITS.maxVel, LIMITS.maxAccel, LIMITS.maxJerk, about(0.8, 1, 0, 0), callback, 'aux', nil, 0.25)
print(text(last), text{left}, seen)
last, left = sim.moveToPose(-1, sim.poseToMatrix(START), LIMITS.maxVel, LIMITS.maxAccel, LIMITS.maxJerk, about(0.8, 1, 0, 0), function() end, nil, nil, 0.25)
print(#last, last[4], text{last[1], left})
last, left = sim.moveToPose(-1, START, {0.5}, {1}, {10}, about(0.8, 0.6, 0, 0), function(_, v) seen = #v end, nil, {1, 1, 1, 1}, 0.25)
print(text(last), text{left}, seen)
-- More limits than there are axes; the time step of the simulation: 0.99 m take 2.58 s, 52 steps of 0.05 s.
local MORE <const> = {{0.5, 0.5, 0.5, 0.4, 9}, {1, 1, 1, 0.8, 9}, {10, 10, 10, 8, 9}}
last, left = sim.moveToPose(-1, START, MORE[1], MORE[2], MORE[3], about(0, 0.99, 0, 0), function() end)
print(text(last), text{left})
last, left = sim.moveToPose(-1, START, MORE[1], MORE[2], MORE[3], about(0, 1, 0, 0), function() end, nil, {1, 1, 1, 1}, 0.25)
print(text(last), text{left})

-- Nothing happens where no motion is possible.
seen = 0
local impossible = sim.moveToPose_init{pose = START, targetPose = about(0, 1, 0, 0), maxVel = 1, maxAccel = 0, maxJerk = 10, callback = function() seen = seen + 1 end}
local result, same = sim.moveToPose_step(impossible)
print(result < 0, same == impossible, seen, text(impossible.pose))
sim.moveToPose_cleanup(impossible)
