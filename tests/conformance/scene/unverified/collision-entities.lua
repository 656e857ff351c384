-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: sensors 2
-- tol: 1e-6
-- topic: sensors
sim = require 'sim'
local case = require 'lib.case'
local P, X = case.P, case.X
local function cube(size, ...)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size}, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local A, B = cube(0.2, 0, 0, 0), cube(0.2, 0.15, 0, 0)
local far = cube(0.2, 5, 0, 0)
local name = {[A] = 'A', [B] = 'B', [far] = 'far', [-1] = -1}
local function C(label, r, pair) P(label, r, name[pair[1]] or pair[1], name[pair[2]] or pair[2]) end
X('all as first', sim.checkCollision, sim.handle_all, A)
X('unknown', sim.checkDistance, A, 12345)
X('one argument', sim.checkCollisionEx, A)
C('itself', sim.checkCollision(A, A))
P('distance to itself', sim.checkDistance(A, A))
C('all', sim.checkCollision(A, sim.handle_all))
C('all from B', sim.checkCollision(B, sim.handle_all))
local AB = sim.createCollection(0)
sim.addItemToCollection(AB, sim.handle_single, A, 0)
sim.addItemToCollection(AB, sim.handle_single, B, 0)
sim.addItemToCollection(AB, sim.handle_single, far, 0)
C('collection with itself', sim.checkCollision(AB, AB))
C('collection with a member', sim.checkCollision(AB, A))
C('collection with all others', sim.checkCollision(AB, sim.handle_all))
sim.setObjectInt32Param(B, sim.objintparam_collection_self_collision_indicator, 1)
C('neighbours', sim.checkCollision(AB, AB))
sim.setObjectInt32Param(B, sim.objintparam_collection_self_collision_indicator, 2)
C('no neighbours', sim.checkCollision(AB, AB))
-- flags count within collections only
sim.setObjectSpecialProperty(B, 0)
C('without flag, in a collection', sim.checkCollision(AB, AB))
C('without flag, alone', sim.checkCollision(A, B))
C('without flag, all', sim.checkCollision(A, sim.handle_all))
local override = sim.createCollection(1)
sim.addItemToCollection(override, sim.handle_all, -1, 0)
C('flags overridden', sim.checkCollision(override, override))
sim.setObjectSpecialProperty(B, 3)
-- octrees are solid; dummies collide with nothing else
local tree, dummy = sim.createOctree(0.1, 0, 1), sim.createDummy(0.01)
sim.insertVoxelsIntoOctree(tree, 0, {3.05, 0.05, 0.05})
sim.setObjectPosition(dummy, {3.07, 0.05, 0.05})
P('dummy in a voxel', (sim.checkCollision(dummy, tree)), (select(2, sim.checkDistance(dummy, tree)))[7])
sim.setObjectPosition(dummy, {0, 0, 0})
P('dummy in a cube', (sim.checkCollision(dummy, A)), (select(2, sim.checkDistance(dummy, A)))[7])
local small = cube(0.02, 3.05, 0.05, 0.05)
P('cube in a voxel', (sim.checkCollision(small, tree)))
sim.setObjectPosition(small, {3.1, 0.05, 0.05})
P('across a voxel', (sim.checkCollision(small, tree)))
P('no contour', sim.checkCollisionEx(small, tree))
P('joint', (sim.checkCollision(sim.createJoint(sim.joint_revolute_subtype, sim.jointmode_kinematic, 0), A)))
-- the contour lies on both surfaces
sim.setObjectPosition(B, {0.15, 0.05, 0.05})
local n, segments = sim.checkCollisionEx(A, B)
local on, length = true, 0
for i = 1, #segments, 3 do
    local d = {0, 0}
    for axis, offset in ipairs({0.15, 0.05, 0.05}) do
        local x = segments[i + axis - 1]
        d[1], d[2] = math.max(d[1], math.abs(x)), math.max(d[2], math.abs(x - offset))
    end
    on = on and math.abs(d[1] - 0.1) < 1e-6 and math.abs(d[2] - 0.1) < 1e-6
end
for i = 1, #segments, 6 do
    local sum = 0
    for axis = 0, 2 do sum = sum + (segments[i + axis] - segments[i + 3 + axis]) ^ 2 end
    length = length + sum ^ 0.5
end
P('contour', n > 0, n == #segments // 6, on)
-- two rectangles' sides of 0.05, 0.15 and 0.15 m each
P('at least its length', length > 2 * (0.05 + 0.15 + 0.15) - 1e-6)
sim.setBoolParam(sim.boolparam_collision_handling_enabled, false)
C('switched off', sim.checkCollision(A, B))
P('no contour', sim.checkCollisionEx(A, B))
