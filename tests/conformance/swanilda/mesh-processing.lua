-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: import 6
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'
simOpenMesh = require 'simOpenMesh'
simICP = require 'simICP'

local function refusal(label, f, ...)
    local ok, e = pcall(f, ...)
    print(label, ok and 'no error' or tostring(e):gsub('\nstack traceback.*', ''):gsub('^.-: ', ''))
end
local function triangles(h)
    local _, i = sim.getShapeMesh(h)
    return #i // 3
end
local function volume(h)
    local v, i = sim.getShapeMesh(h)
    local sum = 0
    for k = 1, #i, 3 do
        local a, b, c = 3 * i[k], 3 * i[k + 1], 3 * i[k + 2]
        sum = sum + v[a + 1] * (v[b + 2] * v[c + 3] - v[b + 3] * v[c + 2]) + v[a + 2] * (v[b + 3] * v[c + 1] - v[b + 1] * v[c + 3])
            + v[a + 3] * (v[b + 1] * v[c + 2] - v[b + 2] * v[c + 1])
    end
    return sum / 6
end

-- decimation
local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {1, 1, 1})
sim.setObjectAlias(ball, 'ball')
sim.setObjectPose(ball, {1, 2, 3, 0, 0.6, 0, 0.8})
sim.setShapeColor(ball, nil, sim.colorcomponent_ambient_diffuse, {1, 0.5, 0.25})
local all = triangles(ball)
local function decimated(label, params)
    local h = simOpenMesh.decimate(ball, params)
    local n = triangles(h)
    print(label, n <= all, math.abs(volume(h) / volume(ball) - 1) < 0.05)
    return h, n
end
local h, n = decimated('half', nil)
print(math.abs(n / all - 0.5) < 0.01, sim.getObjectAlias(h), sim.getShapeMass(h) == sim.getShapeMass(ball))
local p, q = sim.getObjectPose(h), sim.getObjectPose(ball)
print('pose', math.abs(p[1] - q[1]) + math.abs(p[3] - q[3]) + math.abs(p[5] - q[5]) < 1e-9)
local _, c = sim.getShapeColor(h, nil, sim.colorcomponent_ambient_diffuse)
print('colour', c[1], c[2], c[3])
print('triangles', select(2, decimated('count', {triangles = 100})) <= 100)
print('vertices', #sim.getShapeMesh(decimated('vertices', {vertices = 60})) // 3 <= 60)
print('tenth', select(2, decimated('tenth', {percentage = 0.1})) <= math.ceil(all / 10))
local _, fine = decimated('fine', {error = 1e-3})
local _, coarse = decimated('coarse', {error = 1e-2})
print('error', coarse < fine, fine < all)
print('share', triangles(simOpenMesh.getDecimatedShape(ball, 0.25)) <= math.ceil(all / 4))
local group = sim.groupShapes({sim.copyPasteObjects({ball}, 0)[1], sim.copyPasteObjects({ball}, 0)[1]})
print('compound', triangles(simOpenMesh.decimate(group, {triangles = 200})) <= 202)
local v, i = sim.getShapeMesh(ball)
local v2, i2 = sim.getDecimatedMesh(v, i, 0.5)
print('mesh', math.abs(#i2 / #i - 0.5) < 0.01, #v2 < #v)
refusal('field', simOpenMesh.decimate, ball, {faces = 3})
refusal('value', simOpenMesh.decimate, ball, {percentage = 2})
refusal('type', simOpenMesh.decimate, ball, {triangles = 'x'})
refusal('no shape', simOpenMesh.decimate, sim.createDummy(0.1))
refusal('share', simOpenMesh.getDecimatedShape, ball, -1)
refusal('ratio', sim.getDecimatedMesh, v, i, 1)
refusal('index', sim.getDecimatedMesh, {0, 0, 0}, {0, 1, 2}, 0.5)
refusal('old', simOpenMesh.getDecimated, v, i, 0.5)

-- registration: a block without symmetry but half turns, and points of it
local block = sim.groupShapes({
    sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.4, 0.2, 0.1}),
    (function()
        local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.3})
        sim.setObjectPosition(h, {0.12, 0.05, 0.15})
        return h
    end)(),
})
local start = sim.getObjectMatrix(block)
local function error_of(m, expected)
    local sum = 0
    for k = 1, 12 do sum = math.max(sum, math.abs(m[k] - expected[k])) end
    return sum
end
local function cloud(shape)
    local h = sim.createPointCloud(0.02, 20, 0, 2)
    sim.insertObjectIntoPointCloud(h, shape, 0, 0.03)
    return h
end
for number, euler in ipairs {{0.1, -0.05, 0.08}, {1.5, 0.5, -2}, {3, -1, 0.4}} do
    sim.setObjectMatrix(block, start)
    local points = cloud(block)
    local target = sim.buildMatrix({0.3, -0.2, 0.5}, euler)
    local expected = sim.multiplyMatrices(target, sim.getMatrixInverse(start))
    sim.setObjectMatrix(block, target)
    local m = simICP.matchToShape(block, points)
    local others = cloud(block)
    local n = simICP.match(points, points)
    print('pose ' .. number, #m, error_of(m, expected) < 0.02, error_of(n, sim.getObjectMatrix(points)) < 1e-9)
    sim.removeObjects({points, others})
end
-- surfaces of points
local globe = sim.createPointCloud(0.05, 50, 0, 2)
local globe_points = {}
for k = 0, 1999 do
    local z, angle = 1 - 2 * (k + 0.5) / 2000, 2.399963229728653 * k
    local ring = math.sqrt(1 - z * z)
    for _, x in ipairs {ring * math.cos(angle), ring * math.sin(angle), z} do globe_points[#globe_points + 1] = x end
end
sim.insertPointsIntoPointCloud(globe, 2, globe_points)
sim.setObjectPosition(globe, {1, 2, 3})
local simSurfRec = require 'simSurfRec'
local skin = simSurfRec.reconstruct_scale_space(globe)
print('skin', math.abs(volume(skin) / (4 / 3 * math.pi) - 1) < 0.02, sim.getObjectPosition(skin)[3])
print('larger ball', #sim.getShapeMesh(simSurfRec.reconstruct_scale_space(globe, 0, 12, 300, 0.04)) > 3000)
refusal('no points', simSurfRec.reconstruct_scale_space, sim.createPointCloud(0.02, 20, 0, 2))
refusal('too small', simSurfRec.reconstruct_scale_space, globe, 0, 12, 300, 1e-8)
refusal('neighbors', simSurfRec.reconstruct_scale_space, globe, 0, 1)
refusal('no cloud', simSurfRec.reconstruct_scale_space, ball)
refusal('nothing', simICP.match, block, sim.createPointCloud(0.02, 20, 0, 2))
refusal('no shape', simICP.matchToShape, sim.createDummy(0.1), block)
refusal('no object', simICP.match, 123456, block)
