-- spec: data 3
-- Properties that the version after 4.10 has as matrices.
sim = require 'sim'

local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 2, 3})
print(sim.getMatrixProperty(shape, 'inertiaMatrix'))
local E = require 'simEigen'
sim.setMatrixProperty(shape, 'inertiaMatrix', E.Matrix(3, 3, {2, 0, 0, 0, 3, 0, 0, 0, 4}))
print(sim.getFloatArrayProperty(shape, 'inertia'))

local mesh = sim.getIntArrayProperty(shape, 'meshes')[1]
local vertices = sim.getMatrixProperty(mesh, 'vertices')
print(vertices:rows(), vertices:cols(), sim.getMatrixProperty(mesh, 'normals'):rows())

local cloud = sim.createPointCloud(0.1, 10, 0, 1)
sim.insertPointsIntoPointCloud(cloud, 0, {1, 2, 3, 4, 5, 6})
print(sim.getMatrixProperty(cloud, 'points'))

local sensor = sim.createVisionSensor(1 + 2 + 128, {4, 3, 0, 0}, {0.1, 10, 1, 0.01, 0, 0, 0, 1, 0, 0, 0})
local depth = sim.getMatrixProperty(sensor, 'depth')
print(depth:rows(), depth:cols())

print(sim.getMatrixProperty(shape, 'depth', {noError = true}))
print(pcall(sim.getMatrixProperty, shape, 'mass'))
