-- as: sandbox
-- passes: 0
-- spec: motion 1, motion 2, motion 3; motions advanced by hand: limits, minima, time steps, what a callback sees and does
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function text(list)
    local t = {}
    for i, x in ipairs(list) do t[i] = string.format('%.6f', math.abs(x) < 5e-7 and 0.0 or x) end
    return table.concat(t, ' ')
end

local function config(what, params, shown)
    print(what)
    local data, result, count = sim.moveToConfig_init(params), nil, 0
    repeat
        result, data = sim.moveToConfig_step(data)
        count = count + 1
        if not shown or shown[count] or result ~= 0 then
            print(count, result, text(data.pos), text(data.vel), text(data.accel), result == 1 and text{data.timeLeft} or '')
        end
    until result ~= 0 or count > 200
    sim.moveToConfig_cleanup(data)
    if data.ruckigObj then print('not over') end
    return data
end

-- 2.6 s: 0.35 m after one second, cruising at 0.5 m/s from 0.6 to 2 s.
config('up', {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25})
-- Down at 0.25 m/s, with 0.5 m/s^2 instead of 1 for what decreases the velocity.
config('down', {pos = {1}, targetPos = {0}, maxVel = {0.5}, minVel = {-0.25}, maxAccel = {1}, minAccel = {-0.5}, maxJerk = {10}, timeStep = 0.25})
config('minima as numbers', {pos = {1}, targetPos = {0}, maxVel = {0.5}, minVel = -0.25, maxAccel = 1, minAccel = -0.5, maxJerk = 10, timeStep = 0.25}, {})
config('two, in phase', {pos = {0, 0}, targetPos = {1, -0.5}, maxVel = {0.5, 0.5}, maxAccel = 1, maxJerk = 10, timeStep = 0.25}, {[4] = true})
config('two, each for itself', {pos = {0, 0}, targetPos = {1, -0.5}, maxVel = {0.5, 0.5}, maxAccel = 1, maxJerk = 10, timeStep = 0.25, flags = 3}, {[4] = true})
config('under way already', {pos = {0}, vel = {0.5}, accel = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25}, {[4] = true})
config('goes on', {pos = {0}, targetPos = {1}, targetVel = {0.5}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25}, {[4] = true})
config('at once', {pos = {0, 1}, targetPos = {1, 5}})
-- Without limits 9999 m/s, 99999 m/s^2, 9999999 m/s^3 and steps of 10 s: 1e6 / 9999 + 9999 / 99999 + 99999 / 9999999 = 100.11999 s.
config('far', {pos = {0}, targetPos = {1e6}}, {})
config('longer tables', {pos = {0}, vel = {0, 9}, accel = {0, 9}, targetVel = {0, 9}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25}, {[4] = true})
config('default time step', {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}}, {[20] = true})
config('no multiple of 0.1 ms', {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 1 / 24}, {[24] = true})

print('callbacks')
local aux = {calls = 0}
local data = config('stopped by the callback', {
    pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25, auxData = aux,
    callback = function(state)
        state.auxData.calls = state.auxData.calls + 1
        return state.pos[1] > 0.3
    end,
})
print('its data', data.auxData == aux, aux.calls)
function byName(state) aux.calls = aux.calls - state.vel[1] end
config('by name', {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 1, callback = 'byName'}, {})
print('its data', text{aux.calls}) -- 4 - 0.5 at 1 s - 0.5 at 2 s - 0 at the end

local object = setmetatable({}, {__call = function(_, state) return state.pos[1] > 0.3 end})
config('an object as function', {pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 0.25, callback = object}, {})
sim.moveToConfig{pos = {0}, targetPos = {1}, maxVel = {0.5}, maxAccel = {1}, maxJerk = {10}, timeStep = 1, callback = function() print('level', getAutoYield()) end}
print('level', getAutoYield())

local function joint(position)
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setJointPosition(handle, position)
    return handle
end
print('joints')
local joints = {joint(3), joint(0.5)}
local function positions() print('at', text{sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2])}) end
-- Cyclic: from 3 the short way to -3 is up to 2 pi - 3.
config('the first one cyclic', {joints = joints, cyclicJoints = {true, false}, targetPos = {-3, 1}, maxVel = {1, 1}, maxAccel = 10, maxJerk = 100, timeStep = 0.09}, {})
positions()
config('several turns', {pos = {0.2, 7}, cyclicJoints = {true}, targetPos = {4 * math.pi + 0.1, 0}, maxVel = {9, 9}, maxAccel = 90, maxJerk = 900, timeStep = 1}, {})
sim.moveToConfig{joints = joints, targetPos = {0.25, -0.5}, maxVel = {1, 1}, maxAccel = {1, 1}, maxJerk = {10, 10}, callback = function() end}
positions()
local moved = sim.moveToConfig{joints = joints, targetPos = {0.25, -0.5}, maxVel = {1, 1}, maxAccel = {1, 1}, maxJerk = {10, 10}}
positions()
print(text(moved.pos), text(moved.vel))

print('older form')
local seen = 0
local pos, vel, accel, left = sim.moveToConfig(-1, {0}, {0}, {0}, {0.5}, {1}, {10}, {1}, {0}, function(p, v, a, x)
    seen = seen + 1
    if seen == 4 then print('callback', text(p), text(v), text(a), x) end
end, 'aux', nil, 0.25)
print(text(pos), text(vel), text(accel), text{left}, seen)
pos, vel, accel, left = sim.moveToConfig(0x300, {1}, nil, nil, {0.5, -0.25}, {1, -0.5}, {10}, {0}, nil, function() end, nil, nil, 0.25)
print('minima', text(pos), text(vel), text(accel), text{left})
pos, vel, accel, left = sim.moveToConfig(0, {1}, nil, nil, {0.5, -0.25}, {1, -0.5}, {10}, {0}, nil, function() end, nil, nil, 0.25)
print('minima, not announced', text(pos), text(vel), text(accel), text{left})
pos, vel, accel, left = sim.moveToConfig(0x200, {1}, nil, nil, {0.5, -0.25}, {1, -0.5}, {10}, {0}, nil, function() end, nil, nil, 0.25)
print('only of the accelerations', text(pos), text(vel), text(accel), text{left})
pos, vel, accel, left = sim.moveToConfig(0x100, {1}, nil, nil, {0.5, -0.25}, {1, -0.5}, {10}, {0}, nil, function() end, nil, nil, 0.25)
print('only of the velocities', text(pos), text(vel), text(accel), text{left})
pos, vel, accel, left = sim.moveToConfig(0x303, {1, 0}, nil, nil, {0.5, 0.5, -0.25, -0.5}, {1, 1, -0.5, -1}, {10, 10}, {0, 0.5}, nil, function() end, nil, nil, 0.25)
print('minima of two', text(pos), text(vel), text(accel), text{left})

pos, vel, accel, left = sim.moveToConfig(0x303, {0, 0}, nil, nil, {0.5, 0.5}, {1, 1}, {10, 10}, {1, 0}, nil, function() end, nil, nil, 0.25)
print('minima announced, not given', text(pos), text(vel), text(accel), text{left})

-- Nothing happens where no motion is possible.
local impossible = sim.moveToConfig_init{pos = {0}, targetPos = {1}, maxVel = {1}, maxAccel = {0}, maxJerk = {10}, callback = function() seen = 'called' end}
seen = nil
local result, same = sim.moveToConfig_step(impossible)
print(result < 0, same == impossible, seen, text(impossible.pos))
sim.moveToConfig_cleanup(impossible)
