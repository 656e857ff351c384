-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: simgeom 1, simgeom 2, simgeom 3, simgeom 4
-- note: every function of simGeom, with numbers that follow from geometry
simGeom = require 'simGeom'
local zero, unit = {0, 0, 0}, {0, 0, 0, 1}
local function turned(angle) return {0, 0, math.sin(angle / 2), math.cos(angle / 2)} end
local function show(...)
    local texts = {}
    for i = 1, select('#', ...) do
        local value = select(i, ...)
        if type(value) == 'table' then
            local numbers = {}
            for j, number in ipairs(value) do numbers[j] = string.format('%.6g', math.abs(number) < 1e-12 and 0 or number) end
            texts[i] = '{' .. table.concat(numbers, ' ') .. '}'
        elseif type(value) == 'number' then
            texts[i] = string.format('%.9g', value)
        else
            texts[i] = tostring(value)
        end
    end
    print(table.concat(texts, ' '))
end
local function cube(half, pos, quat)
    local v, i = {}, {}
    for _, x in ipairs{-half, half} do for _, y in ipairs{-half, half} do for _, z in ipairs{-half, half} do
        for _, c in ipairs{x, y, z} do v[#v + 1] = c end
    end end end
    i = {0,1,3, 0,3,2, 4,6,7, 4,7,5, 0,4,5, 0,5,1, 2,3,7, 2,7,6, 0,2,6, 0,6,4, 1,5,7, 1,7,3}
    return simGeom.createMesh(v, i, pos, quat)
end

print('structures')
local a, b = cube(0.1), cube(0.1)
local flat = simGeom.createMesh({0,0,0, 1,0,0, 0,1,0}, {0, 1, 2})
local moved = cube(0.1, {1, 0, 0}, turned(math.pi / 2))
show(simGeom.getMeshPointDistance(moved, {1, 0, 0}, turned(math.pi / 2), {0, 0, 0.5}))
local tree = simGeom.createOctreeFromPoints({0.12, 0.07, -0.03}, nil, nil, 0.05, {255, 0, 51}, 7)
show(simGeom.getOctreeVoxels(tree))
local colourful = simGeom.createOctreeFromColorPoints({1.01, 0, 0, 1.01, 1, 0}, {1, 0, 0}, unit, 0.1, {255, 0, 0, 0, 255, 0}, {5, 6})
show(simGeom.getOctreeVoxels(colourful))
local surface = simGeom.createOctreeFromMesh(a, {0.01, 0.01, 0.01}, unit, zero, unit, 0.05)
print(#simGeom.getOctreeVoxels(surface) // 3)
local finer = simGeom.createOctreeFromOctree(tree, zero, unit, zero, unit, 0.025, {1, 2, 3}, 9)
print(#simGeom.getOctreeVoxels(finer) // 3, select(3, simGeom.getOctreeVoxels(finer))[1])
local cloud = simGeom.createPtcloudFromPoints({0,0,0, 0.001,0,0, 1,0,0}, nil, nil, 0.05, 20, {255, 255, 0})
show(simGeom.getPtcloudPoints(cloud))
local painted = simGeom.createPtcloudFromColorPoints({0,0,1, 0,0,2, 0,0,3, 0,0,4}, {0, 0, 1}, unit, 0.05, 20, {255,0,0, 0,255,0, 0,0,255, 51,51,51}, 0)
show(simGeom.getPtcloudPoints(painted, 0.5))

print('copies')
local small = simGeom.copyMesh(a)
simGeom.scaleMesh(small, 0.25)
show(simGeom.getMeshPointDistance(small, zero, unit, {1, 0, 0}), simGeom.getMeshPointDistance(a, zero, unit, {1, 0, 0}))
local large = simGeom.copyOctree(tree)
simGeom.scaleOctree(large, 40)
show(simGeom.getOctreeVoxels(large))
local far = simGeom.copyPtcloud(cloud)
simGeom.scalePtcloud(far, 3)
show(simGeom.getPtcloudPoints(far))
local again = simGeom.createMeshFromSerializationData(simGeom.getMeshSerializationData(small))
show(simGeom.getMeshPointDistance(again, zero, unit, {1, 0, 0}))
show(simGeom.getOctreeVoxels(simGeom.createOctreeFromSerializationData(simGeom.getOctreeSerializationData(large))))
show(simGeom.getPtcloudPoints(simGeom.createPtcloudFromSerializationData(simGeom.getPtcloudSerializationData(painted))))

print('collisions')
show(simGeom.getMeshMeshCollision(a, zero, unit, b, {0.15, 0.05, 0.05}, unit))
local hit, cache, segments = simGeom.getMeshMeshCollision(a, zero, unit, b, {0.15, 0.05, 0.05}, unit, {3, 4}, true)
local length = 0
for i = 1, #segments, 6 do
    length = length + math.sqrt((segments[i] - segments[i + 3])^2 + (segments[i + 1] - segments[i + 4])^2 + (segments[i + 2] - segments[i + 5])^2)
end
show(hit, cache, length)
show(simGeom.getMeshMeshCollision(a, zero, unit, small, zero, unit, nil, true))
show(simGeom.getMeshOctreeCollision(small, {0.125, 0.075, -0.025}, unit, tree, zero, unit))
show(simGeom.getMeshTriangleCollision(a, zero, unit, {0.05, 0, -1}, {0, 0, 2}, {0.01, 0, 2}, -1))
local _, _, cut = simGeom.getMeshTriangleCollision(flat, zero, unit, {0.2, 0.2, -1}, {0, 0, 2}, {0.2, 0, 2}, 5, true)
show(cut)
show(simGeom.getMeshSegmentCollision(flat, zero, unit, {0.2, 0.2, -1}, {0, 0, 3}, -1, true))
show(simGeom.getMeshSegmentCollision(flat, zero, unit, {0.2, 0.2, 1}, {0, 0, 3}, -1, true))
show(simGeom.getOctreeOctreeCollision(tree, zero, unit, tree, {0.03, 0, 0}, turned(0.1)))
show(simGeom.getOctreeOctreeCollision(tree, zero, unit, tree, {0.3, 0, 0}, unit))
show(simGeom.getOctreePtcloudCollision(tree, zero, unit, cloud, {0.12, 0.07, -0.03}, unit))
show(simGeom.getOctreeTriangleCollision(tree, {1, 0, 0}, unit, {0, 0, -0.02}, {9, 0, 0}, {0, 9, 0}))
show(simGeom.getOctreeSegmentCollision(tree, zero, unit, {0.12, 0.07, -1}, {0, 0, 2}))
show(simGeom.getOctreePointCollision(tree, zero, unit, {0.149, 0.07, -0.03}), simGeom.getOctreePointCollision(tree, zero, unit, {0.151, 0.07, -0.03}))

print('distances')
show(simGeom.getMeshMeshDistance(flat, zero, unit, flat, {0, 0, 0.3}, unit, 0.2))
show((simGeom.getMeshMeshDistance(flat, zero, unit, flat, {0, 0, 0.3}, unit)))
show(simGeom.getMeshMeshDistance(a, zero, unit, b, {0.5, 0.5, 0.5}, unit, nil, {1, 2}))
show(simGeom.getMeshMeshDistance(a, zero, unit, small, zero, unit))
show((simGeom.getMeshOctreeDistance(a, {0.125, 0.075, 0.325}, unit, tree, zero, unit)))
show(simGeom.getMeshPtcloudDistance(a, {3, 0, 0}, unit, cloud, zero, unit))
show((simGeom.getOctreeOctreeDistance(tree, zero, unit, tree, {0, 0, 0.3}, unit)))
show(simGeom.getOctreePtcloudDistance(tree, zero, unit, cloud, {0.125, 0.075, 1}, unit))
show(simGeom.getPtcloudPtcloudDistance(cloud, zero, unit, cloud, {0, 3, 0}, turned(math.pi)))
show(simGeom.getMeshTriangleDistance(a, zero, unit, {-9, -9, 0.4}, {18, 0, 0}, {0, 18, 0}, 0.3))
show((simGeom.getMeshTriangleDistance(a, zero, unit, {-9, -9, 0.4}, {99, 0, 0}, {0, 99, 0})))
show(simGeom.getMeshSegmentDistance(a, zero, unit, {1, 0, 0}, {0, 0.05, 0}))
show(simGeom.getMeshPointDistance(a, zero, unit, {0, 0, 0.05}, 1, 8))
show((simGeom.getOctreeTriangleDistance(tree, zero, unit, {-9, -9, 0.4}, {99, 0, 0}, {0, 99, 0})))
show((simGeom.getOctreeSegmentDistance(tree, zero, unit, {0.125, 0.075, 1}, {0, 0, 1})))
show(simGeom.getOctreePointDistance(tree, zero, unit, {0.125, 0.075, -0.02}))
show(simGeom.getPtcloudTriangleDistance(cloud, zero, unit, {-1, -1, 2}, {0, 9, 0}, {1.5, 0, 0}))
show(simGeom.getPtcloudSegmentDistance(cloud, zero, unit, {1, 1, 1}, {0, -2, 0}))
show(simGeom.getPtcloudPointDistance(cloud, zero, unit, {1.5, 0, 0}, 0.4))
show(simGeom.getPtcloudPointDistance(cloud, zero, unit, {1.5, 0, 0}, 0.6))

print('primitives')
local half = {0.1, 0.1, 0.1}
show(simGeom.getBoxPointDistance(zero, unit, half, true, {1, 0, 0}))
show(simGeom.getBoxPointDistance(zero, unit, half, true, {0, 0, 0.05}))
show(simGeom.getBoxPointDistance(zero, unit, half, false, {0, 0, 0.05}))
show((simGeom.getBoxBoxDistance(zero, unit, half, {0.5, 0, 0}, turned(math.pi / 4), half, true)))
show((simGeom.getBoxBoxDistance(zero, unit, half, zero, unit, {0.025, 0.025, 0.025}, true)), (simGeom.getBoxBoxDistance(zero, unit, half, zero, unit, {0.025, 0.025, 0.025}, false)))
show((simGeom.getBoxTriangleDistance({0, 0, 1}, unit, half, true, {-1, -1, 0}, {9, 0, 0}, {0, 9, 0})))
show((simGeom.getBoxTriangleDistance(zero, unit, half, false, {0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0})))
show(simGeom.getBoxSegmentDistance(zero, unit, half, true, {0.05, 0.05, 0.5}, {0, 0, 1}))
show((simGeom.getBoxSegmentDistance(zero, unit, half, false, {0, 0, 0}, {0.02, 0, 0})))
show((simGeom.getTriangleTriangleDistance(zero, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0.7}, {1, 0, 0}, {0, 1, 0})))
show((simGeom.getTriangleTriangleDistance(zero, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -0.7}, {0, 0, 1}, {0, 1, 1})))
show(simGeom.getTriangleSegmentDistance(zero, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 2}, {0, 0, -1.5}))
show(simGeom.getTrianglePointDistance(zero, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}))
show(simGeom.getSegmentSegmentDistance(zero, {1, 0, 0}, {0.5, -1, 1}, {0, 2, 0}))
show(simGeom.getSegmentPointDistance(zero, {1, 0, 0}, {0.25, 3, 4}))
show(simGeom.getTransformedPoints({1, 0, 0}, {0, 0, 1}, {0, 0, 0.70710678, 0.70710678}))
show(simGeom.getTransformedPoints({1, 0, 0, 0, 1, 0}, {0, 0, 1}, {0, 0, math.pi / 2}))
show(simGeom.getTransformedPoints({1, 2, 3}, {2, 0, 0, 1, 0, 2, 0, 1, 0, 0, 2, 1}))

print('refusals')
local function refused(name, ...)
    local ok, message = pcall(simGeom[name], ...)
    print(name, ok, ok or message:gsub('^.-: ', ''))
end
simGeom.destroyMesh(small); simGeom.destroyOctree(large); simGeom.destroyPtcloud(far)
refused('copyMesh', small)
refused('copyOctree', large)
refused('copyPtcloud', far)
refused('destroyMesh', -5)
refused('createMesh', {0, 0, 0}, {0, 1, 2})
refused('createMesh', {0, 0}, {0, 1, 2})
refused('createMesh', {0, 0, 0 / 0}, {0, 0, 0})
refused('scaleMesh', a, 0)
refused('scaleOctree', tree, 0 / 0)
refused('createOctreeFromPoints', {1, 2})
refused('createOctreeFromColorPoints', {1, 2, 3}, nil, nil, 0.05, {1})
refused('createPtcloudFromColorPoints', {1, 2, 3}, nil, nil, 0.05, 20, {1})
refused('createMeshFromSerializationData', 'nonsense')
refused('createOctreeFromSerializationData', simGeom.getMeshSerializationData(a))
refused('createPtcloudFromSerializationData', '')
refused('getMeshPointDistance', a, {0 / 0, 0, 0}, unit, zero)
refused('getMeshPointDistance', a, zero, unit, {math.huge, 0, 0})
refused('getBoxPointDistance', zero, unit, {0 / 0, 1, 1}, true, zero)
refused('getTransformedPoints', {1, 2, 3}, {1, 2})
show((simGeom.getOctreePointDistance(simGeom.createOctreeFromPoints{}, zero, unit, zero)))
show((simGeom.getMeshPointDistance(simGeom.createMesh({0,0,0, 1,0,0, 2,0,0}, {0,1,2}), zero, unit, zero, 3)))
