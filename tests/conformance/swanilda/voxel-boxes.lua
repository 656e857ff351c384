-- topic: sensors
-- as: sandbox
-- passes: 0
-- spec: sensors 4
sim = require 'sim'

-- The box of an octree is around its voxels, that of a point cloud around its points, in the frame of the object.
local function metres(v) return ('%.3f'):format(math.abs(v) < 5e-4 and 0 or v) end

local function box(h)
    local t = {}
    for i = sim.objfloatparam_objbbox_min_x, sim.objfloatparam_objbbox_max_z do
        t[#t + 1] = metres(sim.getObjectFloatParam(h, i))
    end
    return table.concat(t, ' ')
end

local function half(h)
    local v = sim.getVector3Property(h, 'bbHSize')
    return table.concat({metres(v[1]), metres(v[2]), metres(v[3])}, ' ')
end

local tree = sim.createOctree(0.1, 0, 1)
print('empty', box(tree), half(tree))
sim.insertVoxelsIntoOctree(tree, 1, {0.05, 0.05, 0.05, 0.35, 0.05, -0.25}, {255, 0, 0})
print('two voxels', box(tree), half(tree))
sim.removeVoxelsFromOctree(tree, 1, {0.35, 0.05, -0.25})
print('one', box(tree), half(tree))
local cloud = sim.createPointCloud(0.02, 20, 0, 2)
print('empty', box(cloud), half(cloud))
sim.insertPointsIntoPointCloud(cloud, 1, {0, 0, 1, 0.5, -0.25, 2, 0.25, 0.75, 1.5})
print('three points', box(cloud), half(cloud))
-- A model's box contains what hangs on its base.
local base = sim.createDummy(0.02)
sim.setModelProperty(base, 0)
sim.setObjectParent(cloud, base, true)
local p = sim.objfloatparam_modelbbox_max_z
print('model', metres(sim.getObjectFloatParam(base, p)))
