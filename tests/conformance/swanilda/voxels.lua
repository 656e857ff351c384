-- topic: sensors
-- as: sandbox
-- passes: 0
-- spec: SPEC-sensors 4
-- note: voxels of octrees, points of point clouds
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
