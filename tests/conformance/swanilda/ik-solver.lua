-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: kinematics 2, kinematics 3, kinematics 6; methods, flags, callbacks, limits, dependencies, old names, wrong arguments
-- tol: 1e-6
-- topic: kinematics
local simIK = require 'simIK'

local function refused(what, f, ...)
    local done, message = pcall(f, ...)
    print(what, done and 'no error' or (tostring(message):gsub('\nstack traceback.*', ''):gsub('^.-: in ', 'in ')))
end

-- Two links of half a metre in the plane; the target is a little away from the tip.
local function arm(dx, dy)
    local env = simIK.createEnvironment()
    local j1 = simIK.createJoint(env, simIK.jointtype_revolute, 'shoulder')
    local j2 = simIK.createJoint(env, simIK.jointtype_revolute, 'elbow')
    local tip, target = simIK.createDummy(env, 'tip'), simIK.createDummy(env, 'target')
    simIK.setObjectParent(env, j2, j1)
    simIK.setObjectPose(env, j2, {0.5, 0, 0, 0, 0, 0, 1}, j1)
    simIK.setObjectParent(env, tip, j2)
    simIK.setObjectPose(env, tip, {0.5, 0, 0, 0, 0, 0, 1}, j2)
    simIK.setJointPosition(env, j1, 0.3)
    simIK.setJointPosition(env, j2, 0.6)
    local pose = simIK.getObjectPose(env, tip)
    pose[1], pose[2] = pose[1] + dx, pose[2] + dy
    simIK.setObjectPose(env, target, pose)
    simIK.setTargetDummy(env, tip, target)
    local group = simIK.createGroup(env, 'arm')
    local element = simIK.addElement(env, group, tip)
    simIK.setElementConstraints(env, group, element, simIK.constraint_x | simIK.constraint_y)
    return {env = env, group = group, element = element, joints = {j1, j2}, tip = tip, target = target}
end

local function config(a) return table.concat(simIK.getConfig(a.env, a.joints), ' ') end

for _, case in ipairs{{'transpose', simIK.method_jacobian_transpose, 0, 1}, {'damped', simIK.method_damped_least_squares, 0.1, 1},
    {'undamped', simIK.method_undamped_pseudo_inverse, 0, 1}, {'pseudo-inverse', simIK.method_pseudo_inverse, 0, 20}} do
    local a = arm(0.01, -0.02)
    simIK.setGroupCalculation(a.env, a.group, case[2], case[3], case[4])
    simIK.setElementPrecision(a.env, a.group, a.element, {1e-9, 1e-9})
    local result, flags = simIK.handleGroup(a.env, a.group)
    print(case[1], config(a), result, flags)
end

local a = arm(0, 0)
print('there', simIK.handleGroup(a.env, a.group))
print(simIK.getGroupCalculation(a.env, a.group))
simIK.setObjectPose(a.env, a.target, {1.2, 0, 0, 0, 0, 0, 1})
local result, flags = simIK.handleGroup(a.env, a.group)
print('out of reach', result, flags & simIK.calc_notwithintolerance)
print(simIK.getFailureDescription(0) == '', #simIK.getFailureDescription(flags) > 0)
simIK.setConfig(a.env, a.joints, {0.3, 0.6})
simIK.setGroupFlags(a.env, a.group, simIK.group_enabled | simIK.group_ignoremaxsteps | simIK.group_restoreonbadlintol)
simIK.handleGroup(a.env, a.group)
print('restored', config(a))
simIK.setElementFlags(a.env, a.group, a.element, 0)
print('disabled', simIK.handleGroup(a.env, a.group))

a = arm(0.01, -0.02)
simIK.setGroupCalculation(a.env, a.group, simIK.method_pseudo_inverse, 0, 1)
local seen
simIK.handleGroup(a.env, a.group, {auxData = 'aux', callback = function(data, aux)
    seen = {aux, data.groupIndex, data.iteration, #data.rows, #data.cols, data.rows[2].constraint, data.cols[2].joint == a.joints[2]}
    print(data.jacobian, data.e)
    return {dq = {0.01, -0.02}}
end})
print(table.unpack(seen))
print(config(a))
refused('short', simIK.handleGroup, a.env, a.group, {callback = function() return {dq = {1}} end})
refused('fails', simIK.handleGroup, a.env, a.group, {callback = function() error('as I like', 0) end})
refused('inside', simIK.handleGroup, a.env, a.group, {callback = function() simIK.getJointPosition(a.env, a.joints[1]) end})

a = arm(0.01, -0.02)
simIK.setJointInterval(a.env, a.joints[1], false, {0.29, 1})
simIK.setGroupCalculation(a.env, a.group, simIK.method_pseudo_inverse, 0, 1)
result, flags = simIK.handleGroup(a.env, a.group)
print('limit', flags & simIK.calc_limithit, simIK.getGroupJointLimitHits(a.env, a.group))

a = arm(0, 0)
simIK.setJointDependency(a.env, a.joints[2], a.joints[1], 0.1, 2)
print(simIK.getJointDependency(a.env, a.joints[2]))
print(config(a), #simIK.getGroupJoints(a.env, a.group))
simIK.setJointDependency(a.env, a.joints[2], a.joints[1], 0, 1, function(env, joint, master) return master * master end)
simIK.setJointPosition(a.env, a.joints[1], 0.5)
print(config(a))
simIK.setJointDependency(a.env, a.joints[2], -1)
print(simIK.getJointDependency(a.env, a.joints[2]))

print(simIK.getJacobian(a.env, a.group))
print(simIK.computeGroupJacobian(a.env, a.group))
print(simIK.computeJacobian(a.env, -1, a.joints[2], simIK.constraint_pose, simIK.getObjectPose(a.env, a.tip)))
print(simIK.getManipulability(a.env, a.group), simIK.getGroupTipTargetDistance(a.env, a.group))
print(simIK.getIkGroupHandle(a.env, 'arm') == a.group, simIK.doesIkGroupExist(a.env, 'leg'), simIK.getObjectHandle(a.env, 'tip') == a.tip)
print(simIK.getIkElementPrecision(a.env, a.group, a.tip | simIK.handleflag_tipdummy), simIK.getElementWeights(a.env, a.group, a.element))
print(simIK.getObjectType(a.env, a.tip), simIK.getJointType(a.env, a.joints[1]), simIK.getObjects(a.env, 1))
print(simIK.getObjects(a.env, 4), simIK.getLinkedDummy(a.env, a.target) == a.tip)

local copy = simIK.createEnvironment()
simIK.load(copy, simIK.save(a.env))
print(simIK.getObjectTransformation(copy, a.tip))
refused('garbage', simIK.load, copy, 'garbage')
local spherical = simIK.createJoint(copy, simIK.jointtype_spherical)
simIK.setSphericalJointRotation(copy, spherical, {0, 0, 0.5})
print(simIK.getJointPose(copy, spherical))
refused('spherical', simIK.setJointPosition, copy, spherical, 1)
refused('no joint', simIK.getJointPosition, copy, a.tip)
refused('NaN', simIK.setJointPosition, copy, a.joints[1], 0 / 0)
refused('NaN pose', simIK.setObjectPose, copy, a.tip, {0 / 0, 0, 0, 0, 0, 0, 1})
refused('circle', simIK.setObjectParent, copy, a.joints[1], a.tip)
refused('no object', simIK.getObjectPose, copy, 999)
refused('no group', simIK.handleGroup, copy, 999)
refused('few', simIK.getObjectPose, copy)
simIK.eraseObject(copy, a.target)
print('without target', simIK.handleGroup(copy, a.group))
simIK.eraseEnvironment(copy)
refused('erased', simIK.createDummy, copy)
