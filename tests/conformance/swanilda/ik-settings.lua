-- topic: kinematics
-- as: sandbox
-- passes: 0
-- spec: kinematics 2, kinematics 3, kinematics 4
-- tol: 1e-6
-- note: settings of joints, elements and groups, what they do, and the way to the scene and back
sim = require 'sim'
local simIK = require 'simIK'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_errors)
local text = require('lib.trial').text
local env = simIK.createEnvironment()

local function near(list, wanted)
    for i, x in ipairs(wanted) do if math.abs(x - list[i]) > 1e-9 then return text(list) end end
    return #list == #wanted
end

-- Joints as they are made, then set.
local hinge = simIK.createJoint(env, simIK.jointtype_revolute, 'hinge')
local slider = simIK.createJoint(env, simIK.jointtype_prismatic, 'slider')
local ball = simIK.createJoint(env, simIK.jointtype_spherical, 'ball')
for _, joint in ipairs{hinge, slider} do
    print('made', simIK.getJointMode(env, joint), simIK.getJointWeight(env, joint), simIK.getJointMaxStepSize(env, joint), simIK.getJointLimitMargin(env, joint), simIK.getJointScrewLead(env, joint))
    simIK.setJointMode(env, joint, simIK.jointmode_passive)
    simIK.setJointWeight(env, joint, 0.5)
    simIK.setJointMaxStepSize(env, joint, 0.25)
    simIK.setJointLimitMargin(env, joint, 0.125)
    print('set', simIK.getJointMode(env, joint), simIK.getJointWeight(env, joint), simIK.getJointMaxStepSize(env, joint), simIK.getJointLimitMargin(env, joint))
end

-- A screw of 2 pi metres per turn: 1 metre per radian.
simIK.setJointInterval(env, hinge, false, {-3, 6})
simIK.setJointScrewLead(env, hinge, 2 * math.pi)
print('lead', simIK.getJointScrewLead(env, hinge), simIK.getJointScrewPitch(env, hinge))
simIK.setJointScrewPitch(env, hinge, 0.5)
print('pitch', simIK.getJointScrewLead(env, hinge), simIK.getJointScrewPitch(env, hinge))
simIK.setJointPosition(env, hinge, 0.6)
local c, s = math.cos(0.6), math.sin(0.6)
print('screw', near(simIK.getJointMatrix(env, hinge), {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0.3}))
local position, quaternion, euler = simIK.getJointTransformation(env, hinge)
print('screw', near(position, {0, 0, 0.3}), near(quaternion, {0, 0, math.sin(0.3), math.cos(0.3)}), near(euler, {0, 0, 0.6}))
simIK.setJointScrewLead(env, slider, 1)
print('no screw', simIK.getJointScrewLead(env, slider))

-- A quarter turn about x, as numbers of both kinds.
local r = math.sqrt(0.5)
local quarter = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}
simIK.setJointQuaternion(env, ball, {r, 0, 0, r})
print('ball', near(simIK.getJointMatrix(env, ball), quarter))
simIK.setSphericalJointMatrix(env, ball, {1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9})
print('ball', near(simIK.getJointMatrix(env, ball), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}))
simIK.setSphericalJointMatrix(env, ball, quarter)
print('ball', near(select(2, simIK.getJointTransformation(env, ball)), {r, 0, 0, r}))

-- Poses, in the world and relative to another object.
local a, b = simIK.createDummy(env, 'a'), simIK.createDummy(env, 'b')
simIK.setObjectMatrix(env, a, {1, 0, 0, 1, 0, 0, -1, 2, 0, 1, 0, 3})
print('pose', near(simIK.getObjectPose(env, a), {1, 2, 3, r, 0, 0, r}))
-- y of a is z of the world.
simIK.setObjectTransformation(env, b, {0, 5, 0}, {0, 0, 0}, a)
print('pose', near(simIK.getObjectPose(env, b), {1, 2, 8, r, 0, 0, r}), near(simIK.getObjectMatrix(env, b, a), {1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1, 0}))
simIK.setObjectTransformation(env, b, {1, 0, 0}, {0, 0, 0, 1})
print('pose', near(simIK.getObjectMatrix(env, b), {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0}))
simIK.setObjectParent(env, b, a)
print('parent', simIK.getObjectParent(env, b) == a, simIK.getObjectParent(env, a))
print('exist', simIK.doesObjectExist(env, 'a'), simIK.doesObjectExist(env, 'c'), simIK.doesGroupExist(env, 'arm'))

-- Two links of half a metre; the numbers are those of the example.
local function arm(name)
    local j1 = simIK.createJoint(env, simIK.jointtype_revolute, name .. '1')
    local j2 = simIK.createJoint(env, simIK.jointtype_revolute, name .. '2')
    local tip, target = simIK.createDummy(env, name .. 'Tip'), simIK.createDummy(env, name .. 'Target')
    simIK.setObjectParent(env, j2, j1)
    simIK.setObjectPose(env, j2, {0.5, 0, 0, 0, 0, 0, 1}, j1)
    simIK.setObjectParent(env, tip, j2)
    simIK.setObjectPose(env, tip, {0.5, 0, 0, 0, 0, 0, 1}, j2)
    simIK.setJointPosition(env, j1, 0.3)
    simIK.setJointPosition(env, j2, 0.6)
    local pose = simIK.getObjectPose(env, tip)
    simIK.setObjectPose(env, target, {pose[1] + 0.01, pose[2] - 0.02, 0, pose[4], pose[5], pose[6], pose[7]})
    simIK.setTargetDummy(env, tip, target)
    local group = simIK.createGroup(env, name)
    simIK.setGroupCalculation(env, group, simIK.method_pseudo_inverse, 0, 1)
    local element = simIK.addElement(env, group, tip)
    local function show(what, success) print(what, success, simIK.getJointPosition(env, j1), simIK.getJointPosition(env, j2)) end
    local function back()
        simIK.setJointPosition(env, j1, 0.3)
        simIK.setJointPosition(env, j2, 0.6)
    end
    return {j1 = j1, j2 = j2, tip = tip, target = target, group = group, element = element, show = show, back = back}
end
local x = arm 'arm'
local group, element = x.group, x.element
print('group', simIK.getGroupHandle(env, 'arm') == group, simIK.doesGroupExist(env, 'arm'), simIK.getGroupFlags(env, group))
local precision = simIK.getElementPrecision(env, group, element)
print('element', simIK.getElementFlags(env, group, element), precision[1], math.deg(precision[2]), text(simIK.getElementWeights(env, group, element)), simIK.getElementBase(env, group, element))
simIK.setElementConstraints(env, group, element, simIK.constraint_x | simIK.constraint_y)
print('element', simIK.getElementConstraints(env, group, element))
simIK.setElementPrecision(env, group, element, {1e-9, 1e-9})
x.show('one iteration', (simIK.handleGroups(env, {group})))
x.back()
x.show('old name', (simIK.handleIkGroup(env, group)))
x.back()
-- A joint without weight stays; so does a passive one, and one outside of the chain. The other one alone meets the target as well as it can:
-- dq = -J2 . (-e) / J2 . J2 with J2 = 0.5 (-sin 0.9, cos 0.9).
local alone = (0.01 * -math.sin(0.9) + -0.02 * math.cos(0.9)) / 0.5
local function isAlone(what)
    simIK.handleGroups(env, {group})
    print(what, math.abs(simIK.getJointPosition(env, x.j1) - 0.3) < 1e-9, math.abs(simIK.getJointPosition(env, x.j2) - 0.6 - alone) < 1e-6)
    x.back()
end
simIK.setJointWeight(env, x.j1, 0)
isAlone('weight')
simIK.setJointWeight(env, x.j1, 1)
simIK.setJointMode(env, x.j1, simIK.jointmode_passive)
isAlone('passive')
simIK.setJointMode(env, x.j1, simIK.jointmode_ik)
simIK.setElementBase(env, group, element, x.j1)
print('base', simIK.getElementBase(env, group, element) == x.j1)
isAlone('base')
simIK.setElementBase(env, group, element, -1)
-- Half the error counts, half the step is made.
simIK.setElementWeights(env, group, element, {0.5, 1})
print('weights', text(simIK.getElementWeights(env, group, element)))
x.show('half', (simIK.handleGroups(env, {group})))
x.back()
simIK.setElementWeights(env, group, element, {1, 1})
-- Steps that are too large are cut to the largest over 1.1, all in proportion: 0.0335 is the larger one here.
simIK.setGroupFlags(env, group, simIK.group_enabled)
print('flags', simIK.getGroupFlags(env, group))
simIK.setJointMaxStepSize(env, x.j1, 0.011)
local _, flags = simIK.handleGroups(env, {group})
x.show('cut', flags & simIK.calc_stepstoobig ~= 0)
x.back()
simIK.setElementFlags(env, group, element, 0)
print('disabled', simIK.getElementFlags(env, group, element), (simIK.handleGroups(env, {group})))
require 'matrix'
print('display', select('#', simIK.debugJacobianDisplay{jacobian = Matrix{{1, 2}, {3, 4}}, e = Matrix{{5}, {6}}}))

-- The same arm in the scene.
local joints, parent = {}, -1
for i, place in ipairs{0, 0.5} do
    joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectParent(joints[i], parent, true)
    sim.setObjectPose(joints[i], {place, 0, 0, 0, 0, 0, 1}, parent)
    parent = joints[i]
end
local tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectParent(tip, parent, true)
sim.setObjectPose(tip, {0.5, 0, 0, 0, 0, 0, 1}, parent)
local copied = simIK.createGroup(env, 'copied')
local _, toIk, toSim = simIK.addIkElementFromScene(env, copied, -1, tip, target, simIK.constraint_x | simIK.constraint_y)
print('copied', toSim[toIk[joints[1]]] == joints[1], toSim[toIk[tip]] == tip)
sim.setJointPosition(joints[1], 0.25)
sim.setJointPosition(joints[2], -0.5)
sim.setObjectPosition(target, {0.5, 0.5, 0})
simIK.applySceneToIkEnvironment(env, copied)
print('applied', simIK.getJointPosition(env, toIk[joints[1]]), simIK.getJointPosition(env, toIk[joints[2]]), near(simIK.getObjectPose(env, toIk[target]), {0.5, 0.5, 0, 0, 0, 0, 1}))
simIK.setJointPosition(env, toIk[joints[1]], 1)
simIK.setJointPosition(env, toIk[joints[2]], 0.125)
print('before', sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2]))
simIK.syncToSim(env, {copied})
print('after', sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2]))
