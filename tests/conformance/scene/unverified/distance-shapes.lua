-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: sensors 2
-- tol: 1e-6
-- topic: sensors
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local function cube(size, ...)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size}, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local function shape(kind, size, ...)
    local h = sim.createPrimitiveShape(kind, size, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local function D(a, b) return (select(2, sim.checkDistance(a, b)))[7] end
local size = {0.2, 0.2, 0.2}
local a, b = shape(sim.primitiveshape_spheroid, size, 0, 0, 0), shape(sim.primitiveshape_spheroid, size, 0.5, 0, 0)
P('vertices', D(a, b))
sim.setObjectOrientation(b, {0, 0, math.pi / 32})
P('turned', D(a, b))
local dummy = sim.createDummy(0.01)
P('centre', D(a, dummy))
local s = 1 / 3 ^ 0.5
sim.setObjectPosition(dummy, {s, s, s})
P('diagonal', D(a, dummy))
local c = shape(sim.primitiveshape_cylinder, size, 0, 0, 3)
sim.setObjectPosition(dummy, {math.cos(math.pi / 32), math.sin(math.pi / 32), 3})
P('side', D(c, dummy))
sim.setObjectPosition(dummy, {1, 0, 3})
P('edge', D(dummy, c))
local outer, other, inner = cube(0.2, 0, 0, 6), cube(0.2, 0.35, 0, 6), cube(0.05, 0, 0, 6)
local all = sim.createCollection(0)
for _, h in ipairs({outer, other, inner}) do sim.addItemToCollection(all, sim.handle_single, h, 0) end
local r, d, pair = sim.checkDistance(all, all)
P('collection', r, d[7], pair[1] == outer, pair[2] == inner)
-- strictly smaller than the threshold
local e, f = cube(0.25, 0, 0, 9), cube(0.25, 1, 0, 9)
P('threshold', sim.checkDistance(e, f, 0.75))
P('larger', (sim.checkDistance(e, f, 0.75 + 1e-9)))
P('negative', (sim.checkDistance(e, f, -1)))
-- a group is one object
local group = sim.groupShapes({cube(0.2, 0, 0, 12), cube(0.2, 1, 0, 12)})
sim.setObjectPosition(dummy, {0.7, 0, 12})
r, d, pair = sim.checkDistance(group, dummy)
P('group', d, pair[1] == group, pair[2] == dummy)
-- intersecting surfaces have a common point
r, d = sim.checkDistance(cube(0.2, 0, 0, 15), cube(0.2, 0.15, 0.05, 15.05))
P('intersecting', r, d[7], math.abs(d[1] - d[4]) < 1e-6, math.abs(d[2] - d[5]) < 1e-6, math.abs(d[3] - d[6]) < 1e-6)
-- points of clouds, voxels, dummies
local cloud, tree = sim.createPointCloud(0.02, 20, 0, 4), sim.createOctree(0.1, 0, 1)
sim.insertPointsIntoPointCloud(cloud, 0, {0, 0, 20, 0, 0, 21})
sim.insertVoxelsIntoOctree(tree, 0, {0.05, 0.05, 22.05})
r, d, pair = sim.checkDistance(cloud, tree)
P('cloud, octree', d, pair[1] == cloud, pair[2] == tree)
sim.setObjectPosition(dummy, {0, 0, 20.25})
P('cloud, dummy', (select(2, sim.checkDistance(cloud, dummy))))
P('empty', (sim.checkDistance(sim.createOctree(0.1, 0, 1), dummy)))
