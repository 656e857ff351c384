-- as: sandbox
-- passes: 0
-- spec: shapes 2.3; simConvex: hulls of objects and points with growth, pieces, refusals
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'
local try = require('lib.trial').try
simConvex = require 'simConvex'

local function cube(x, size)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size or 0.1, size or 0.1, size or 0.1})
    sim.setObjectPosition(handle, {x, 0, 0})
    return handle
end

-- Volume, by the divergence theorem, and extents.
local function measure(v, i)
    local volume, low, high = 0, {1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}
    for k = 1, #i, 3 do
        local a, b, c = 3 * i[k], 3 * i[k + 1], 3 * i[k + 2]
        volume = volume + v[a + 1] * (v[b + 2] * v[c + 3] - v[b + 3] * v[c + 2]) + v[a + 2] * (v[b + 3] * v[c + 1] - v[b + 1] * v[c + 3])
            + v[a + 3] * (v[b + 1] * v[c + 2] - v[b + 2] * v[c + 1])
    end
    for k = 1, #v do
        local axis = (k - 1) % 3 + 1
        low[axis], high[axis] = math.min(low[axis], v[k]), math.max(high[axis], v[k])
    end
    return volume / 6, low, high
end

local UNIT <const> = {}
for i = 0, 7 do for axis = 0, 2 do UNIT[#UNIT + 1] = (i >> axis) & 1 end end

try('points', function() local v, i = simConvex.qhull(UNIT) return #v // 3, #i // 3, (measure(v, i)) end)
local simQHull = require 'simQHull'
try('old module', function() local v, i = simQHull.compute(UNIT, true) return #v // 3, #i // 3, (measure(v, i)) end)
try('corners only', function() local v, i = simQHull.compute(UNIT, false) return #v // 3, #i end)
try('of shapes', function() return (measure(sim.getShapeMesh(simQHull.computeShape{cube(0), cube(1)}))) end)
-- The faces go out by half a metre, edges and corners are cut off: 1 + 6/2 + 12/8 + 8/48.
try('grown', function() return measure(simConvex.qhull(UNIT, 0.5)) end)
try('inside does not count', function() return #(simConvex.qhull{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1}) // 3 end)
try('nothing', simConvex.qhull, {})
try('cut off', simConvex.qhull, {0, 0, 0, 1})
try('flat', simConvex.qhull, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})
try('infinite', simConvex.qhull, UNIT, 1 / 0)
try('nan', simConvex.qhull, {0 / 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})

try('two cubes', function()
    local a, b = cube(0), cube(1)
    local h = simConvex.hull{a, b}
    local v, i = sim.getShapeMesh(h)
    print(sim.isHandle(a), sim.isHandle(b), sim.getObjectAlias(h), sim.getShapeMass(h), (sim.getShapeGeomInfo(h)))
    return sim.getObjectPose(h), measure(v, i)
end)
try('and a dummy', function()
    local d = sim.createDummy(0.01)
    sim.setObjectPosition(d, {0, 0, 0.35})
    return measure(sim.getShapeMesh(simConvex.hull{cube(0), d}))
end)
try('turned', function()
    local c = cube(2)
    sim.setObjectOrientation(c, {0, 0, math.pi / 4})
    return measure(sim.getShapeMesh(simConvex.hull({c}, 0)))
end)
try('points of a cloud', function()
    local cloud = sim.createPointCloud(0.02, 20, 0, 2)
    sim.insertPointsIntoPointCloud(cloud, 0, UNIT)
    return measure(sim.getShapeMesh(simConvex.hull{cloud}))
end)
try('cells of an octree', function()
    local tree = sim.createOctree(0.1, 0, 1)
    sim.insertVoxelsIntoOctree(tree, 0, {0.05, 0.05, 0.05})
    return measure(sim.getShapeMesh(simConvex.hull{tree}))
end)
try('of nothing', simConvex.hull, {})
try('of a joint', simConvex.hull, {sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)})
try('of the unknown', simConvex.hull, {99999})

local function pieces(f, ...)
    local angle = sim.groupShapes({cube(0, 0.1), cube(0.1, 0.1), cube(0.2, 0.1)}, true)
    local arm = cube(0.2, 0.1)
    sim.setObjectPosition(arm, {0.2, 0, 0.1})
    angle = sim.groupShapes({arm, angle}, true)
    sim.setObjectPosition(angle, {1, 2, 3})
    local list = f(angle, ...)
    local volume, convex = 0, true
    for _, piece in ipairs(list) do
        volume = volume + measure(sim.getShapeMesh(piece))
        convex = convex and sim.getShapeGeomInfo(piece) & 4 ~= 0
    end
    return #list > 1, convex, math.abs(volume - 0.004) < 1.5e-3, sim.isHandle(angle), sim.getObjectPosition(list[1])
end
try('vhacd', pieces, simConvex.vhacd)
try('vhacd, coarse', pieces, simConvex.vhacd, {resolution = 20000, concavity = 0.01, max_vertices = 20})
try('hacd', pieces, simConvex.hacd, {min_cluster_cnt = 2})
try('convex already', function() local c = cube(0) local list = simConvex.vhacd(c) return #list, list[1] ~= c end)
try('resolution', simConvex.vhacd, cube(0), {resolution = 'x'})
try('concavity', simConvex.vhacd, cube(0), {concavity = -1})
try('not a shape', simConvex.vhacd, sim.createDummy(0.01))
try('no volume', simConvex.hacd, sim.createPrimitiveShape(sim.primitiveshape_plane, {1, 1, 0}))
