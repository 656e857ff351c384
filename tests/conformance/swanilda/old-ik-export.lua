-- topic: kinematics
-- as: sandbox
-- passes: 0
-- spec: kinematics 3, kinematics 7, vrep-era 1.2
-- tol: 1e-6
-- note: groups of V-REP by the names of today, and exported for simIK
sim = require 'sim'
local simIK = require 'simIK'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

-- Two links of 0.5 m in a plane. Numbers of the example in kinematics 3.
local joints, parent = {}, -1
for i, x in ipairs{0, 0.5} do
    joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectName(joints[i], 'hinge_' .. i)
    sim.setJointMode(joints[i], sim.jointmode_ik, 0)
    sim.setJointInterval(joints[i], false, {-3, 6})
    sim.setObjectParent(joints[i], parent, true)
    sim.setObjectPose(joints[i], {x, 0, 0, 0, 0, 0, 1}, parent)
    parent = joints[i]
end
local tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectName(tip, 'hand')
sim.setObjectParent(tip, parent, true)
sim.setObjectPose(tip, {0.5, 0, 0, 0, 0, 0, 1}, parent)
sim.setJointPosition(joints[1], 0.3)
sim.setJointPosition(joints[2], 0.6)
sim.setLinkDummy(tip, target)
local reached = sim.getObjectPosition(tip)
sim.setObjectPosition(target, {reached[1] + 0.01, reached[2] - 0.02, 0})

local group = sim.createIkGroup(2, {sim.ik_damped_least_squares_method, 1}, {0.1})
print('made', group, sim.createIkElement(group, 0, {tip, -1, -1, 3}, {0.0005, 0.01, 1, 1}))
local result, values = sim.checkIkGroup(group, joints)
print('damped', result, text(values))
print('set', sim.setIkGroupProperties(group, sim.ik_pseudo_inverse_method, 20, 0.1), sim.setIkElementProperties(group, tip, 3, {1e-9, 0.01}, {1, 1}))
result, values = sim.checkIkGroup(group, joints)
print('precise', result, text(values))

-- Columns from base to tip, rows x and y: how the tip moves with each joint.
print('jacobian', sim.computeJacobian(group, 0), text(sim.getIkGroupMatrix(group, 0)), select(2, sim.getIkGroupMatrix(group, 0)))
local path = sim.generateIkPath(group, joints, 3)
print('path', #path, text{path[1], path[2], path[5], path[6]})
local config = sim.getConfigForTipPose(group, joints, 0.65, 10)
local x = 0.5 * math.cos(config[1]) + 0.5 * math.cos(config[1] + config[2])
local y = 0.5 * math.sin(config[1]) + 0.5 * math.sin(config[1] + config[2])
print('config', math.abs(x - reached[1] - 0.01) < 1e-6, math.abs(y - reached[2] + 0.02) < 1e-6)
print('untouched', sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2]))

local file = os.tmpname()
print('export', sim.exportIk(file))
local handle = io.open(file, 'rb')
local data = handle:read 'a'
handle:close()
os.remove(file)
local environment = simIK.createEnvironment()
simIK.load(environment, data)
local copies = {simIK.getObjectHandle(environment, 'hinge_1'), simIK.getObjectHandle(environment, 'hinge_2')}
print('loaded', simIK.getJointPosition(environment, copies[1]), simIK.getJointPosition(environment, copies[2]), text(simIK.getObjectPose(environment, simIK.getObjectHandle(environment, 'hand'))) == text(sim.getObjectPose(tip)))
print('solved', (simIK.handleGroup(environment, simIK.getGroupHandle(environment, 'IK_Group'))), simIK.getJointPosition(environment, copies[1]), simIK.getJointPosition(environment, copies[2]))

print('removed', sim.removeIkGroup(group), (pcall(sim.checkIkGroup, group, joints)), sim.getIkGroupHandle('IK_Group@silentError'))
