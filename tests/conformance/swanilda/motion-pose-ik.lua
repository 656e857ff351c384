-- as: sandbox
-- passes: 0
-- spec: motion 3, kinematics 4; the tip of an arm moved by inverse kinematics: which joints move, what happens where it does not reach
-- tol: 2e-3
-- topic: motion
sim = require 'sim'
local simIK = require 'simIK'

-- Two links of 1 m in the plane, from the base: the tip is at (cos a + cos (a + b), sin a + sin (a + b)).
local function arm(a, b)
    local base = sim.createDummy(0.1)
    local joints, parent = {}, base
    for i = 1, 2 do
        joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setObjectParent(joints[i], parent, false)
        sim.setObjectPose(joints[i], {i - 1, 0, 0, 0, 0, 0, 1}, sim.handle_parent)
        parent = joints[i]
    end
    local tip, target = sim.createDummy(0.1), sim.createDummy(0.1)
    sim.setObjectParent(tip, parent, false)
    sim.setObjectPose(tip, {1, 0, 0, 0, 0, 0, 1}, sim.handle_parent)
    sim.setObjectParent(target, base, false)
    sim.setJointPosition(joints[1], a)
    sim.setJointPosition(joints[2], b)
    return joints, {base = base, tip = tip, target = target, constraints = simIK.constraint_x | simIK.constraint_y}
end

local function text(...)
    local t = {}
    for i, x in ipairs{...} do t[i] = string.format('%.4f', x) end
    return table.concat(t, ' ')
end

-- From (1, 1), the second link upright, to a place of the tip; the last pose of the target and the posture are shown.
local function move(what, x, y, changes, more)
    local joints, ik = arm(0, math.pi / 2)
    for field, value in pairs(changes or {}) do ik[field] = value == 'joints' and joints or value == 'second' and {joints[2]} or value end
    local goal = sim.getObjectPose(ik.tip)
    goal[1], goal[2] = x, y
    local params = {ik = ik, targetPose = goal, maxVel = 0.5, maxAccel = 1, maxJerk = 10, timeStep = 0.05}
    for field, value in pairs(more or {}) do params[field] = value end
    local ok, data = pcall(sim.moveToPose, params)
    local place = sim.getObjectPosition(ik.tip)
    if what == 'off the circle' then return print(what, ok, text(sim.getJointPosition(joints[1])), sim.getJointPosition(joints[2]) < 1.5) end
    if x == 2.5 then -- how far it gets is up to the solver
        local shown = ok and text(data.pose[1], data.pose[2]) or data
        return print(what, shown, math.sqrt(place[1] ^ 2 + place[2] ^ 2) > 1.9, place[1] > 1.7)
    end
    print(what, ok and text(data.pose[1], data.pose[2]) or data, text(place[1], place[2]),
        text(sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2])))
end

-- At (1.2, 0.9): the distance is 1.5, so b = acos(1.5^2 / 2 - 1) = 1.4455, a = atan(0.9 / 1.2) - b / 2 = -0.0792.
move('reached', 1.2, 0.9)
move('back and forth', 1, 1)
move('given joints', 1.2, 0.9, {joints = 'joints'})
-- Along a circle about the first joint only that one is needed; the second alone moves on a circle about (1, 0).
move('the second alone', 1 + math.cos(1.2), math.sin(1.2), {joints = 'second', precision = {0.05, 1}})
move('off the circle', 1.2, 0.9, {joints = 'second', precision = {0.3, 1}})
move('stops', 1.2, 0.9, nil, {callback = function(data) return data.pose[1] > 1.1 end})
-- 2 m are all there is.
move('too far', 2.5, 0.9)
move('too far, nearest', 2.5, 0.9, {allowError = true})
move('too far, refused', 2.5, 0.9, {breakFlags = simIK.calc_notwithintolerance})
move('too far, other flags', 2.5, 0.9, {breakFlags = 64})
move('reached, refused flags', 1.2, 0.9, {breakFlags = simIK.calc_notwithintolerance})

-- The environment of a motion is gone when it ends.
local joints, ik = arm(0, math.pi / 2)
local goal = sim.getObjectPose(ik.tip)
goal[1] = 0.9
local data = sim.moveToPose_init{ik = ik, targetPose = goal, maxVel = 1, maxAccel = 1, maxJerk = 10}
local env = data.ik.env
print('under way', math.type(env), data.startPose ~= nil)
sim.moveToPose_cleanup(data)
print('ended', data.ik.env, data.startPose, (pcall(simIK.getObjects, env, 0)))
sim.moveToPose_cleanup(data)
