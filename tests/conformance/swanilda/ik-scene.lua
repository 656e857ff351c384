-- as: simulation
-- passes: 200
-- engine: bullet278
-- spec: kinematics 4, motion 3; chains of the scene, moveToPose with the field ik
-- tol: 1e-5
-- topic: kinematics
sim = require 'sim'
local simIK = require 'simIK'

local joints, tip, target, base, follower = {}, nil, nil, nil, nil

local function build()
    base = sim.createDummy(0.01)
    local steps = {{0, 0, 0.2}, {0, 0, 0.1}, {0.4, 0, 0}, {0.3, 0, 0}, {0, 0, 0.1}, {0.1, 0, 0}}
    local turns = {{0, 0, 0}, {-math.pi / 2, 0, 0}, {0, 0, 0}, {0, 0, 0}, {math.pi / 2, 0, 0}, {0, math.pi / 2, 0}}
    local parent = base
    for i = 1, 6 do
        joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setJointInterval(joints[i], false, {-3, 6})
        sim.setObjectParent(joints[i], parent, true)
        sim.setObjectMatrix(joints[i], sim.buildMatrix(steps[i], turns[i]), parent)
        parent = joints[i]
    end
    tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
    sim.setObjectParent(tip, parent, true)
    sim.setObjectPose(tip, {0, 0, 0.1, 0, 0, 0, 1}, parent)
    for i, q in ipairs{0.2, -0.6, 0.8, 0.3, -0.4, 0.5} do sim.setJointPosition(joints[i], q) end
    sim.setObjectPose(target, sim.getObjectPose(tip))
end

local function gap()
    local a, b = sim.getObjectPosition(tip), sim.getObjectPosition(target)
    return math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2)
end

local function positions()
    local list = {}
    for i, joint in ipairs(joints) do list[i] = sim.getJointPosition(joint) end
    return list
end

local function isSame(a, b)
    for i, x in ipairs(a) do if x ~= b[i] then return false end end
    return true
end

function sysCall_init()
    build()
    local env = simIK.createEnvironment()
    local group = simIK.createGroup(env, 'arm')
    simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.01, 30)
    local element, toIk, toSim = simIK.addElementFromScene(env, group, base, tip, target, simIK.constraint_pose)
    print(toSim[toIk[tip]] == tip, simIK.getTargetDummy(env, toIk[tip]) == toIk[target], simIK.getJointInterval(env, toIk[joints[1]]))
    print(#simIK.getGroupJoints(env, group), simIK.getElementBase(env, group, element) == toIk[base])

    local pose, before = sim.getObjectPose(target), positions()
    pose[1], pose[2], pose[3] = pose[1] + 0.05, pose[2] - 0.04, pose[3] + 0.03
    sim.setObjectPose(target, pose)
    print('alone', simIK.handleGroup(env, group) == 1, isSame(before, positions()))
    print('synced', simIK.handleGroup(env, group, {syncWorlds = true}) == 1, gap() < 0.0005)

    sim.setObjectPose(target, {5, 0, 0, 0, 0, 0, 1})
    before = positions()
    local result, flags = simIK.handleGroup(env, group, {syncWorlds = true})
    print('out of reach', result, flags & simIK.calc_notwithintolerance, isSame(before, positions()))
    print('or', simIK.applyIkEnvironmentToScene(env, group, true) == 2, isSame(before, positions()))
    simIK.handleGroup(env, group, {syncWorlds = true, allowError = true})
    print('allowed', isSame(before, positions()))

    -- The whole arm moves: targets count as seen from the base.
    for i, q in ipairs(before) do sim.setJointPosition(joints[i], q) end
    sim.setObjectPose(base, {3, 2, 1, 0, 0, 0.6, 0.8})
    sim.setObjectPose(target, sim.getObjectPose(tip))
    print('moved', simIK.handleGroup(env, group, {syncWorlds = true}) == 1, gap() < 0.0005)
    sim.setObjectPose(base, {0, 0, 0, 0, 0, 0, 1})

    -- A joint that follows another one is part of the chain.
    sim.setJointMode(joints[6], sim.jointmode_dependent, 0)
    sim.setJointDependency(joints[6], joints[1], 0.1, 0.5)
    sim.setObjectPose(target, sim.getObjectPose(tip))
    local other = simIK.createEnvironment()
    local second = simIK.createGroup(other)
    local _, copies = simIK.addElementFromScene(other, second, base, tip, target, simIK.constraint_position)
    print(simIK.getJointDependency(other, copies[joints[6]]))
    local p = sim.getObjectPosition(target)
    sim.setObjectPosition(target, {p[1], p[2] + 0.03, p[3]})
    simIK.setGroupCalculation(other, second, simIK.method_pseudo_inverse, 0, 20)
    print('dependent', simIK.handleGroup(other, second, {syncWorlds = true}) == 1, gap() < 0.0005)
    print(math.abs(sim.getJointPosition(joints[6]) - 0.1 - 0.5 * sim.getJointPosition(joints[1])) < 1e-9)
    sim.setJointMode(joints[6], sim.jointmode_kinematic, 0)
    sim.setJointDependency(joints[6], -1, 0, 1)

    sim.removeObjects{target}
    print('removed', pcall(simIK.handleGroup, env, group, {syncWorlds = true}))
    print(pcall(simIK.addElementFromScene, env, group, base, tip, 12345, simIK.constraint_pose))
    target = sim.createDummy(0.01)
end

function sysCall_thread()
    sim.setStepping(true)
    local limits = {maxVel = {0.5, 0.5, 0.5, 1}, maxAccel = {1, 1, 1, 1}, maxJerk = {10, 10, 10, 10}}
    local pose = sim.getObjectPose(tip)
    pose[3] = pose[3] - 0.05
    limits.ik, limits.targetPose = {tip = tip, target = target, base = base}, pose
    local data = sim.moveToPose(limits)
    print('there', gap() < 0.001, sim.getObjectPosition(tip)[3] - pose[3] < 0.001, data.timeLeft)
    pose[3] = pose[3] + 0.05
    data = sim.moveToPose{ik = {tip = tip, target = target, base = base, joints = {joints[1], joints[2], joints[3], joints[4], joints[5]},
        constraints = simIK.constraint_position}, targetPose = pose, metric = {1, 1, 1, 0.1}, maxVel = 0.5, maxAccel = 1, maxJerk = 10}
    print('back', gap() < 0.002, sim.getObjectPosition(tip)[3] - pose[3] < 0.002)
    local done, message = pcall(sim.moveToPose, {ik = {tip = tip, target = target, base = base, breakFlags = simIK.calc_notwithintolerance},
        targetPose = {5, 0, 0, 0, 0, 0, 1}, metric = {1, 1, 1, 0.1}, maxVel = 5, maxAccel = 10, maxJerk = 100})
    print(done, message:match('inverse kinematics failed'))
end
