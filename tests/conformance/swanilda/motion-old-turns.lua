-- as: sandbox
-- passes: 0
-- spec: vrep-era 4; directions of sim.rmlMoveToJointPositions: n turns up or down to the target
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function joint(cyclic)
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setJointInterval(handle, cyclic, {-20, 40})
    return handle
end
local cyclic, limited = joint(true), joint(false)
local MAX <const>, JERK <const> = {10, 10}, {100, 100}

local function move(what, direction, a, b)
    sim.setJointPosition(cyclic, 0.5)
    sim.setJointPosition(limited, 0.5)
    local result, pos, vel, accel, left = sim.rmlMoveToJointPositions({cyclic, limited}, -1, nil, nil, MAX, MAX, JERK, {a, b}, nil, direction)
    local function text(list) return string.format('%.6f %.6f', list[1], list[2]) end
    print(what, result, text(pos), text(vel), text(accel), left >= 0 and left <= 0.05)
end
move('as they are', nil, 1, -1)
for _, direction in ipairs{0, 1, 2, 3, -1, -2, -3} do
    move('up, ' .. direction, {direction, direction}, 1, 1)
    move('down, ' .. direction, {direction, direction}, 0.25, 0.25)
end
move('only the first', {2, 0}, 1, 1)
move('only the second', {0, 2}, 1, 1)
sim.setJointPosition(cyclic, 0.5)
local _, _, velocities = sim.rmlMoveToJointPositions({cyclic, limited}, -1, {0.5, 0}, nil, MAX, MAX, JERK, {1, 1}, {0.5, 0}, nil)
print('with a velocity', string.format('%.6f %.6f', table.unpack(velocities)))
sim.setJointPosition(cyclic, 0.5)
local _, last = sim.rmlMoveToJointPositions({limited, cyclic}, -1, nil, nil, MAX, MAX, JERK, {1, 1}, nil, {0, 2})
print('the other way round', string.format('%.6f %.6f', table.unpack(last)))

-- 0.99 m take 2.58 s, 52 steps of 0.05 s.
local object = sim.createDummy(0.1)
local function moved(what, position, quaternion)
    local result, p, q, vel, accel, left = sim.rmlMoveToPosition(object, -1, -1, nil, nil, {0.5, 0.5, 0.5, 9}, {1, 1, 1, 9}, {10, 10, 10, 99}, position, quaternion)
    print(what, result, string.format('%.6f %.6f %.6f', table.unpack(p)), string.format('%.6f %.6f %.6f %.6f', table.unpack(q)),
        table.concat(vel, ' '), table.concat(accel, ' '), string.format('%.6f', left))
end
moved('position', {0.99, 0, 0}, nil)
moved('both', {0, 0, 0}, {0.1, 0.3, 0.3, 0.9})
moved('orientation', nil, {0, 0, 0, 1})

local function refused(what, ...)
    local arguments = table.pack(...)
    local _, message = pcall(function() sim.rmlMoveToJointPositions({cyclic, limited}, -1, table.unpack(arguments, 1, arguments.n)) end)
    print(what, message)
end
local TWO <const> = {1, 1}
refused('vel', {0}, nil, MAX, MAX, JERK, TWO)
refused('accel', nil, {0}, MAX, MAX, JERK, TWO)
refused('maxVel', nil, nil, {1}, MAX, JERK, TWO)
refused('maxAccel', nil, nil, MAX, {1}, JERK, TWO)
refused('maxJerk', nil, nil, MAX, MAX, {1}, TWO)
refused('target', nil, nil, MAX, MAX, JERK, {1})
refused('target velocity', nil, nil, MAX, MAX, JERK, TWO, {1})
refused('direction', nil, nil, MAX, MAX, JERK, TWO, nil, {1})
refused('no table', 5, nil, MAX, MAX, JERK, TWO)
local function refusedPose(what, maxVel, maxAccel, maxJerk, quaternion)
    local _, message = pcall(function() sim.rmlMoveToPosition(object, -1, -1, nil, nil, maxVel, maxAccel, maxJerk, nil, quaternion) end)
    print(what, message)
end
local FOUR <const> = {1, 1, 1, 1}
refusedPose('maxVel', TWO, FOUR, FOUR)
refusedPose('maxAccel', FOUR, TWO, FOUR)
refusedPose('maxJerk', FOUR, FOUR, TWO)
refusedPose('quaternion', FOUR, FOUR, FOUR, TWO)
refusedPose('three', {1, 1, 1}, FOUR, FOUR)
