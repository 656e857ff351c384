-- topic: sensors
-- as: sandbox
-- passes: 0
-- spec: sensors 4
-- note: voxels of octrees, points of point clouds, objects as a whole
sim = require 'sim'
local function numbers(list)
    local out = {}
    for i, number in ipairs(list) do out[i] = string.format('%.3f', number) end
    print(table.concat(out, ' '))
end
local tree = sim.createOctree(0.05, 0, 1)
print(sim.insertVoxelsIntoOctree(tree, 1, {0.12, 0.07, -0.03}))
numbers(sim.getOctreeVoxels(tree))
print(sim.insertVoxelsIntoOctree(tree, 1, {0.10001, 0.0501, -0.049}, {255, 0, 0}, {9}))
print(sim.insertVoxelsIntoOctree(tree, 1, {0.16, 0.07, -0.03}))
print(sim.checkOctreePointOccupancy(tree, 1, {0.11, 0.06, -0.01}))
print(sim.checkOctreePointOccupancy(tree, 1, {0.11, 0.06, -0.01, 0.16, 0.06, -0.01}))
print(sim.checkOctreePointOccupancy(tree, 1, {0.11, 0.06, -0.01, 0.26, 0.06, -0.01}))
sim.setObjectPosition(tree, {1, 0, 0})
print(sim.checkOctreePointOccupancy(tree, 0, {1.11, 0.06, -0.01}))
print(sim.removeVoxelsFromOctree(tree, 0, {1.11, 0.06, -0.01}))
print(sim.removeVoxelsFromOctree(tree, 0, nil))
local cloud = sim.createPointCloud(0.02, 20, 0, 4)
print(sim.insertPointsIntoPointCloud(cloud, 0, {0, 0, 0, 0.001, 0, 0, 1, 0, 0}, nil, 0.01))
numbers(sim.getPointCloudPoints(cloud))
print(sim.intersectPointsWithPointCloud(cloud, 0, {1, 0, 0.005}, 0.01))
print(sim.removePointsFromPointCloud(cloud, 0, {1, 0, 0}, 0.01))
-- objects: a cube's faces, solid voxels, a dummy
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setObjectPosition(cube, {1, 0, 0})
local fine, coarse = sim.createOctree(0.02, 0, 1), sim.createOctree(0.1, 0, 1)
sim.setObjectPosition(fine, {1, 0, 0})
print(sim.insertObjectIntoOctree(fine, cube, 0, {1, 2, 3}, 7))
print(sim.checkOctreePointOccupancy(fine, 1, {0.05, 0.01, 0.01}))
print(sim.checkOctreePointOccupancy(fine, 1, {0.01, 0.01, 0.01}))
print(sim.subtractObjectFromOctree(fine, cube, 0))
sim.setObjectPosition(coarse, {1, 0, 0})
print(sim.insertVoxelsIntoOctree(coarse, 1, {0.05, 0.05, 0.05}), sim.insertObjectIntoOctree(fine, coarse, 0))
local dummy = sim.createDummy(0.01)
sim.setObjectPosition(dummy, {1.01, 0.01, 0.01})
print(sim.subtractObjectFromOctree(fine, dummy, 0), sim.insertObjectIntoOctree(fine, dummy, 0))
print(sim.insertObjectIntoPointCloud(cloud, cube, 0, 0.05), sim.insertObjectIntoPointCloud(cloud, cube, 0, 0.05, {0, 0, 0}, 0.001))
print(sim.insertObjectIntoPointCloud(cloud, dummy, 0, 0.05), sim.subtractObjectFromPointCloud(cloud, dummy, 0, 0.001))
print(sim.subtractObjectFromPointCloud(cloud, cube, 0, 0.03), #sim.getPointCloudPoints(cloud))
print(sim.insertObjectIntoPointCloud(cloud, fine, 0, 0.05), sim.subtractObjectFromPointCloud(cloud, coarse, 0, 0))
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
print((select(2, pcall(sim.insertObjectIntoOctree, fine, joint, 0)):gsub('^%-?%d+: ', '')))
print((select(2, pcall(sim.insertObjectIntoOctree, cube, fine, 0)):gsub('^%-?%d+: ', '')))
print(sim.getExtensionString(dummy, -1) == '', sim.getExtensionString(dummy, -1, 'a@b'))
print(sim.getExtensionString(cube, 0) == '', (select(2, pcall(sim.getExtensionString, dummy, 1)):gsub('^%-?%d+: ', '')))
