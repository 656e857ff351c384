-- as: simulation
-- passes: 300
-- engine: bullet278
-- spec: motion 3; positional form with poses and matrices, init/step/cleanup, relative frame, callback that stops, limits as scalars
-- tol: 2e-3
-- topic: motion
sim = require 'sim'

local function line(what, ...)
    local t = {}
    for _, value in ipairs{...} do
        if type(value) == 'table' then
            for _, x in ipairs(value) do t[#t + 1] = string.format('%.4f', x + 1e-12) end
        else
            t[#t + 1] = type(value) == 'number' and string.format('%.4g', value) or tostring(value)
        end
    end
    print(what, table.concat(t, ' '))
end

local START <const> = {0, 0, 0, 0, 0, 0, 1}
local GOAL <const> = {0.3, 0.4, 0, 0, 0, 0, 1}
-- A way of 0.5 m at 0.5 m/s, 1 m/s2, 10 m/s3 takes 1.6 s.
local LIMITS <const> = {{0.5}, {1}, {10}}

function sysCall_thread()
    local calls, straight, aux = 0, true, {}
    local function follow(pose, vel, accel, data)
        calls = calls + 1
        straight = straight and math.abs(pose[2] - pose[1] * 4 / 3) < 1e-9 and #vel == 1 and #accel == 1 and data == aux
    end
    local before = sim.getSimulationTime()
    local pose, left = sim.moveToPose(-1, START, LIMITS[1], LIMITS[2], LIMITS[3], GOAL, follow, aux, {1, 1, 1, 0.1}, 0.04)
    line('poses', #pose, pose[1], pose[2], straight, math.abs(calls - 40) <= 1, left >= 0 and left <= 0.0401)

    local kept = true
    local function kind(matrix) kept = kept and #matrix == 12 end
    local matrix = sim.moveToPose(-1, sim.poseToMatrix(START), {0.5, 0.5, 0.5, 1}, {1, 1, 1, 2}, {10, 10, 10, 20},
        sim.poseToMatrix(GOAL), kind)
    line('matrices', #matrix, kept, matrix[4], matrix[8], matrix[12])

    local count = 0
    local stopped = sim.moveToPose{pose = START, targetPose = GOAL, metric = {1, 1, 1, 0.1}, maxVel = 0.5, maxAccel = 1, maxJerk = 10,
        callback = function(data) count = count + 1 return data.pose[1] > 0.15 end}
    line('stopped half way', stopped.pose[1] > 0.15 and stopped.pose[1] < 0.19, math.abs(stopped.pose[2] - stopped.pose[1] * 4 / 3) < 1e-9)

    -- Turned by 90 deg about z: one metre of the metric is a tenth of a radian.
    local turned = sim.moveToPose{pose = START, targetPose = sim.buildPose({0, 0, 0}, {0, 0, math.pi / 2}), metric = {1, 1, 1, 0.1},
        maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, callback = function(data) end}
    line('turned', turned.pose)
    local there = sim.moveToPose{pose = GOAL, targetPose = GOAL, metric = {1, 1, 1, 0.1}, maxVel = {1}, maxAccel = {1}, maxJerk = {1},
        callback = function() end}
    line('there already', there.pose)

    local frame, object = sim.createDummy(0.01), sim.createDummy(0.01)
    sim.setObjectPosition(frame, {1, 0, 0})
    sim.moveToPose{object = object, relObject = frame, targetPose = GOAL, maxVel = 1, maxAccel = 2, maxJerk = 20}
    line('relative', sim.getObjectPosition(object))

    local data = sim.moveToPose_init{object = object, targetPose = START, metric = {1, 1, 1, 0.1}, maxVel = {0.5}, maxAccel = {1},
        maxJerk = {10}, timeStep = 0.05}
    local result, steps = 0, 0
    while result == 0 do
        result, data = sim.moveToPose_step(data)
        steps = steps + 1
    end
    sim.moveToPose_cleanup(data)
    -- 1.36 m: 0.5 s + 0.1 s to speed, the same to stand, and 2.72 s minus 0.6 s between.
    local way = math.sqrt(1.3 ^ 2 + 0.4 ^ 2)
    line('steps', result, math.abs(steps * 0.05 - (way / 0.5 + 0.6)) <= 0.0501, sim.getObjectPosition(object))
    print('end')
end
