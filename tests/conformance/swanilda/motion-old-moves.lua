-- as: simulation
-- passes: 500
-- spec: motion 1; rml names of the Ruckig functions; rmlMoveToJointPositions, rmlMoveToPosition, moveToJointPositions, moveToPosition, moveToObject
-- tol: 1e-3
-- topic: motion
sim = require 'sim'

local function show(what, ...)
    local t = {}
    for i, value in ipairs{...} do t[i] = type(value) == 'table' and '{' .. table.concat(value, ', ', 1) .. '}' or tostring(value) end
    print(what, table.concat(t, ' '))
end

local function rounded(values)
    local t = {}
    for i, value in ipairs(values) do t[i] = string.format('%.3f', value + 1e-9) end
    return t
end

function sysCall_init()
    -- M1: 2.6 s from 0 to 1; M2: 1.1 s to 1 m/s.
    local h = sim.rmlPos(1, 0.0001, 0, {0, 0, 0}, {0.5, 1, 10}, {1}, {1, 0})
    local result, state, sync = sim.rmlStep(h, 0.05)
    show('rmlPos', result, state[1], state[2], state[3], sync)
    sim.rmlRemove(h)
    show('removed', pcall(sim.rmlStep, h, 0.05))
    h = sim.rmlVel(1, 0.0001, -1, {0, 0, 0}, {1, 10}, {1}, {1})
    local t = 0
    repeat
        result, state = sim.rmlStep(h, 0.04)
        t = t + 0.04
    until result ~= 0
    show('rmlVel', result, string.format('%.2f', t), rounded(state))
    sim.rmlRemove(h)
end

local function joint(kind)
    local handle = sim.createJoint(kind, sim.jointmode_kinematic, 0)
    sim.setJointInterval(handle, false, {-10, 20})
    return handle
end

function sysCall_thread()
    local joints = {joint(sim.joint_revolute), joint(sim.joint_prismatic)}
    local function positions() return rounded{sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2])} end
    local result, pos, vel, accel, left =
        sim.rmlMoveToJointPositions(joints, -1, nil, nil, {0.5, 0.5}, {1, 1}, {10, 10}, {0.99, -0.5}, nil)
    show('rmlMoveToJointPositions', result, rounded(pos), rounded(vel), rounded(accel), left >= 0 and left < 0.0501, positions())
    sim.moveToJointPositions(joints, {0, 1}, 2)
    show('moveToJointPositions', positions())
    sim.moveToJointPositions(joints, {0.5, 0.5}, 2, 4)
    show('with an acceleration', positions())

    local object, frame = sim.createDummy(0.01), sim.createDummy(0.01)
    sim.setObjectPose(frame, sim.buildPose({1, 2, 3}, {0, 0, math.pi / 2}))
    local q = {0, 0, math.sin(0.4), math.cos(0.4)}
    local result, p, quaternion, vel4, accel4 = sim.rmlMoveToPosition(object, frame, -1, nil, nil, {0.5, 0.5, 0.5, 1}, {1, 1, 1, 2},
        {10, 10, 10, 20}, {0.1, 0.2, 0.3}, q, nil)
    show('rmlMoveToPosition', result, rounded(p), rounded(quaternion), rounded(vel4), rounded(accel4))
    show('in the world', rounded(sim.getObjectPosition(object)), rounded(sim.getObjectOrientation(object)))
    sim.rmlMoveToPosition(object, -1, -1, nil, nil, {0.5, 0.5, 0.5, 1}, {1, 1, 1, 2}, {10, 10, 10, 20}, {1, 1, 1}, nil, nil)
    show('turned no more', rounded(sim.getObjectPosition(object)), rounded(sim.getObjectOrientation(object)))
    sim.moveToPosition(object, -1, {0, 0, 0}, {0, 0, 0.5}, 1, 2)
    show('moveToPosition', rounded(sim.getObjectPosition(object)), rounded(sim.getObjectOrientation(object)))
    sim.moveToPosition(object, frame, nil, {0, 0, 0}, 1)
    show('only turned', rounded(sim.getObjectPosition(object)), rounded(sim.getObjectOrientation(object)))
    sim.moveToObject(object, frame, 3, nil, 1, 2)
    show('moveToObject', rounded(sim.getObjectPosition(object)), rounded(sim.getObjectOrientation(object)))
    print('end')
end
