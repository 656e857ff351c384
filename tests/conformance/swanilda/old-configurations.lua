-- topic: deprecated configurations, window functions, point clouds of V-REP
-- as: sandbox
-- passes: 0
-- spec: vrep-era
sim = require 'sim'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function numbers(list) local t = {} for i, v in ipairs(list) do t[i] = ('%.3f'):format(v + 0.0) end return table.concat(t, ' ') end

-- a tree: a dummy, a joint below it, a ball joint, a dummy at the end, and a dummy beside it
local root, hinge, ball, tip, other = sim.createDummy(0.1), sim.createJoint(sim.joint_revolute_subtype, sim.jointmode_kinematic, 0), sim.createJoint(sim.joint_spherical_subtype, sim.jointmode_kinematic, 0), sim.createDummy(0.1), sim.createDummy(0.1)
sim.setObjectParent(hinge, root) sim.setObjectParent(ball, hinge) sim.setObjectParent(tip, ball)
sim.setObjectPosition(hinge, {1, 0, 0})
sim.setJointPosition(hinge, 0.5)
sim.setObjectPosition(tip, {3, 0, 0})
sim.setQuaternionProperty(ball, 'quaternion', {0, 0, 0.6, 0.8})
local before = numbers(sim.getObjectPose(tip))
local tree, single = sim.getConfigurationTree(root), sim.getObjectConfiguration(hinge)
sim.setObjectPosition(root, {0, 0, 5})
sim.setObjectPosition(hinge, {2, 2, 2})
sim.setJointPosition(hinge, -1)
sim.setQuaternionProperty(ball, 'quaternion', {0, 0, 0, 1})
sim.setObjectPosition(tip, {9, 9, 9})
sim.setObjectPosition(other, {1, 2, 3})
sim.setObjectConfiguration(single)
print(('%.3f'):format(sim.getJointPosition(hinge)), numbers(sim.getObjectPosition(hinge)), numbers(sim.getObjectPosition(root)))
sim.setConfigurationTree(tree)
print(before == numbers(sim.getObjectPose(tip)), numbers(sim.getObjectPosition(root)), numbers(sim.getObjectPosition(other)), numbers(sim.getQuaternionProperty(ball, 'quaternion')))
-- what is gone is left out, the rest is restored
sim.removeObjects({tip})
sim.setJointPosition(hinge, 2)
sim.setConfigurationTree(tree)
print(('%.3f'):format(sim.getJointPosition(hinge)))
e(sim.setConfigurationTree, 'nonsense')
e(sim.getConfigurationTree, 12345)

-- the window
print(sim.getNavigationMode(), sim.getPage())
print(select('#', sim.setNavigationMode(sim.navigation_camerafly)), select('#', sim.setPage(3)))
print(sim.getNavigationMode() == sim.navigation_camerafly, sim.getPage(), sim.announceSceneContentChange(), sim.refreshDialogs(0))

-- points
local cloud = sim.addPointCloud(255, 255, other, 0, 4, {0, 0, 0, 1, 1, 1, 2, 2, 2}, {255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})
print(math.type(cloud))
print(sim.removeDrawingObject(cloud))
