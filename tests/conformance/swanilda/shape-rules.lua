-- as: sandbox
-- passes: 0
-- spec: shapes 5, shapes 6; what groups and merges keep, islands, mass and inertia against closed forms, hulls, refusals
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'
local trial = require 'lib.trial'
local try, text = trial.try, trial.text

local function cube(x, size)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size or 0.1, size or 0.1, size or 0.1})
    sim.setObjectPosition(handle, {x, 0, 0})
    return handle
end

local TETRAHEDRON <const> = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}}
local function tetrahedron() return sim.createShape(0, 0, TETRAHEDRON[1], TETRAHEDRON[2]) end
local group, ungroup = sim.groupShapes, sim.ungroupShape

---------------------------------------------------------------- groups

try('none', group, {})
try('one', group, {cube(0)})
try('one twice', function() local c = cube(0) return group{c, c} end)
try('one that is there', group, {cube(0), 99999})
try('one shape', group, {cube(0), sim.createDummy(0.01)})
try('no list', group, 5)
try('the last one is the master', function()
    local a, b, child, other = cube(0), cube(1), sim.createDummy(0.01), sim.createDummy(0.01)
    sim.setObjectParent(b, a, true)
    sim.setObjectParent(child, a, true)
    sim.setObjectParent(other, b, true)
    sim.setObjectAlias(b, 'master')
    sim.setObjectInt32Param(b, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(b, sim.shapeintparam_respondable, 1)
    sim.setObjectInt32Param(b, sim.shapeintparam_respondable_mask, 0x0f0f)
    local g = group{a, b}
    print(sim.isHandle(a), sim.isHandle(b), sim.getObjectAlias(g), sim.getObjectParent(g), sim.getObjectParent(child), sim.getObjectParent(other) == g)
    return sim.getObjectPosition(g), sim.getObjectInt32Param(g, sim.shapeintparam_static),
        sim.getObjectInt32Param(g, sim.shapeintparam_respondable), sim.getObjectInt32Param(g, sim.shapeintparam_respondable_mask)
end)
try('pure', function() return (sim.getShapeGeomInfo(group{cube(0), cube(1)})) end)
try('convex', function() return (sim.getShapeGeomInfo(group{cube(0), tetrahedron()})) end)
try('turned', function()
    local a, b = cube(0), cube(0.4)
    sim.setObjectOrientation(b, {0, 0, math.pi / 2})
    sim.setShapeMass(a, 1)
    sim.setShapeMass(b, 3)
    local g = group{a, b}
    local inertia, frame = sim.getShapeInertia(g)
    -- In axes of the master: the other one is at y = 0.4. 4/600 for the cubes, 3/4 kg times 0.4 m squared for their distance.
    return sim.getShapeMass(g), {frame[4], frame[8], frame[12]}, {inertia[1], inertia[5], inertia[9]}
end)
try('members', function()
    local a, b = cube(0), cube(0.4)
    sim.setShapeMass(a, 1)
    sim.setShapeMass(b, 3)
    local members = ungroup(group{a, b})
    local masses = {sim.getShapeMass(members[1]), sim.getShapeMass(members[2])}
    return #members, masses, sim.getObjectPosition(members[1])[1] + sim.getObjectPosition(members[2])[1]
end)
try('no group', function() local c = cube(0) return ungroup(c)[1] == c end)
try('merged', function()
    local a, b = cube(0), cube(0.4)
    sim.setShapeMass(a, 1)
    sim.setShapeMass(b, 3)
    merged = group({a, b}, true)
    return (sim.getShapeGeomInfo(merged)), sim.getShapeMass(merged), #sim.getShapeMesh(merged) // 3
end)
try('islands', function()
    local islands = ungroup(-2 - merged)
    local box = sim.getShapeBB(islands[1])
    return #islands, sim.isHandle(merged), box, #sim.getShapeMesh(islands[2]) // 3
end)
try('one island', function() local c = cube(0) return ungroup(-2 - c)[1] == c end)
try('islands of a group', function() return ungroup(-2 - group{cube(0), cube(1)}) end)
try('unknown', ungroup, 99999)
try('islands of the unknown', ungroup, -99999)
try('dummy', ungroup, sim.createDummy(0.01))

---------------------------------------------------------------- mass and inertia

local function computed(what, shape, density)
    try(what, function()
        local result = sim.computeMassAndInertia(shape, density or 1000)
        local inertia, frame = sim.getShapeInertia(shape)
        return result, sim.getShapeMass(shape), {inertia[1], inertia[5], inertia[9]}, {frame[4], frame[8], frame[12]}
    end)
end

computed('cuboid', sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3}))
computed('sphere', sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2}))
computed('cylinder', sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.2, 0.2, 0.3}))
computed('capsule', sim.createPrimitiveShape(sim.primitiveshape_capsule, {0.2, 0.2, 0.5}))
-- A pyramid over 32 sides: 32/2 sin(2 pi / 32) r^2 h / 3, its centre at a quarter of the height.
computed('cone', sim.createPrimitiveShape(sim.primitiveshape_cone, {0.2, 0.2, 0.3}))
print('pyramid', text(1000 * 16 * math.sin(math.pi / 16) * 0.1 ^ 2 * 0.3 / 3))
computed('tetrahedron', tetrahedron(), 1200)
computed('two cubes: their hull', group{cube(0), cube(0.4)})
computed('plane', sim.createPrimitiveShape(sim.primitiveshape_plane, {2, 1, 0}))
computed('triangle', sim.createShape(0, 0, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 2, 1}))
for _, density in ipairs{0, -5, 0 / 0, 1 / 0} do try('density', sim.computeMassAndInertia, cube(0), density) end
computed('light', cube(0), 1e-300)
try('unknown', sim.computeMassAndInertia, 99999, 1000)
try('dummy', sim.computeMassAndInertia, sim.createDummy(0.01), 1000)
try('inertia', sim.setShapeInertia, cube(0), {1, 2}, {1})

---------------------------------------------------------------- hulls and pieces

local hull = sim.getQHull
try('hull', function()
    local v, i = hull{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1, 1, 0, 0}
    return #v // 3, #i // 3
end)
try('no points', hull, {})
try('flat', hull, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})
try('cut off', hull, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})
try('infinite', hull, {0, 0, 0, 1 / 0, 0, 0, 0, 1, 0, 0, 0, 1})
try('small and large', function()
    local small, large = hull{0, 0, 0, 1e-9, 0, 0, 0, 1e-9, 0, 0, 0, 1e-9}, hull{0, 0, 0, 1e30, 0, 0, 0, 1e30, 0, 0, 0, 1e30}
    return #small, #large
end)
try('pieces of a cube', function()
    local c = cube(2)
    local pieces = sim.convexDecompose(c, 0, {0, 0, 0, 0}, {0, 0, 0})
    return pieces ~= c, sim.isHandle(c), sim.getObjectPosition(pieces), (sim.getShapeGeomInfo(pieces)) & 4
end)
try('pieces of the unknown', sim.convexDecompose, 99999, 0)
try('pieces of a dummy', sim.convexDecompose, sim.createDummy(0.01), 0)
