-- topic: kinematics
-- as: sandbox
-- passes: 0
-- spec: kinematics 7
-- tol: 1e-6
-- note: groups of V-REP are solved for the joints that are named, in whatever mode the scene has them
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

-- The arm of old-ik-export.
local joints, parent = {}, -1
for i, x in ipairs{0, 0.5} do
    joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setJointInterval(joints[i], false, {-3, 6})
    sim.setObjectParent(joints[i], parent, true)
    sim.setObjectPose(joints[i], {x, 0, 0, 0, 0, 0, 1}, parent)
    parent = joints[i]
end
local tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectParent(tip, parent, true)
sim.setObjectPose(tip, {0.5, 0, 0, 0, 0, 0, 1}, parent)
sim.setJointPosition(joints[1], 0.3)
sim.setJointPosition(joints[2], 0.6)
sim.setLinkDummy(tip, target)
local reached = sim.getObjectPosition(tip)
sim.setObjectPosition(target, {reached[1] + 0.01, reached[2] - 0.02, 0})
local group = sim.createIkGroup(2, {sim.ik_pseudo_inverse_method, 20}, {0.1})
sim.createIkElement(group, 0, {tip, -1, -1, 3}, {1e-9, 0.01, 1, 1})
print('no Jacobian yet', select('#', sim.getIkGroupMatrix(group, 0)))

local modes = {{'passive', sim.jointmode_passive}, {'kinematic', sim.jointmode_kinematic}, {'force', sim.jointmode_force}, {'ik', sim.jointmode_ik}}
for _, mode in ipairs(modes) do
    for _, joint in ipairs(joints) do sim.setJointMode(joint, mode[2], 0) end
    local result, values = sim.checkIkGroup(group, joints)
    print(mode[1], result, text(values))
    -- The Jacobian is that of the last calculation.
    local jacobian, size = sim.getIkGroupMatrix(group, 0)
    print('jacobian', text(size), jacobian and text(jacobian))
    local path = sim.generateIkPath(group, joints, 3)
    print('path', path and text{path[1], path[2], path[5], path[6]})
    local config = sim.getConfigForTipPose(group, joints, 0.65, 10)
    print('config', config and text{
        0.5 * math.cos(config[1]) + 0.5 * math.cos(config[1] + config[2]) - reached[1],
        0.5 * math.sin(config[1]) + 0.5 * math.sin(config[1] + config[2]) - reached[2],
    })
    print('untouched', sim.getJointMode(joints[1]) == mode[2], sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2]))
end

-- A joint that is not named stays where it is, also where it is in the mode of inverse kinematics.
local result, values = sim.checkIkGroup(group, {joints[2]})
print('second only', result, #values, select(2, sim.getIkGroupMatrix(group, 0))[1])
local y = reached[2] - 0.02 - 0.5 * math.sin(0.3)
sim.setObjectPosition(target, {0.5 * math.cos(0.3) + math.sqrt(0.25 - y * y), reached[2] - 0.02, 0})
result, values = sim.checkIkGroup(group, {joints[2]})
print('within its reach', result, text{0.5 * math.sin(0.3 + values[1]) - y})

-- One that depends on another moves with it.
sim.setJointMode(joints[2], sim.jointmode_dependent, 0)
sim.setJointDependency(joints[2], joints[1], 0, 2)
sim.setIkElementProperties(group, tip, 2, {1e-9, 0.01})
result, values = sim.checkIkGroup(group, joints, {0, 1})
print('dependent', result, text{values[2] - 2 * values[1]})

-- What is no joint cannot move.
print('wrong', pcall(sim.checkIkGroup, group, {tip}))
