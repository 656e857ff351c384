-- topic: files
-- as: sandbox
-- loops: 1
-- note: what a file cannot hold is refused where it is made, and leaves the object as it was; so every scene can be saved
sim = require 'sim'
local function try(f, ...) print(pcall(f, ...)) end
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}, 0)
local mesh = sim.createShape(0, 0, {0,0,0, 1,0,0, 0,1,0}, {0,1,2})
try(sim.createShape, 0, 0, {1e39,0,0, 1,0,0, 0,1,0}, {0,1,2})
try(sim.createShape, 0, 0, {0,0,0, 1,0,0, 0,1,0}, {0,1,2}, {1e39,0,0, 1,0,0, 0,1,0})
try(sim.createHeightfieldShape, 0, 0, 2, 2, 1, {1e300, 0, 0, 0})
try(sim.scaleObject, mesh, 1e39, 1, 1)
for _ = 1, 3 do try(sim.scaleObject, mesh, 1, 1e12, 1) end
try(sim.scaleObjects, {sim.createDummy(0.1)}, 1e39, false)
for _ = 1, 3 do try(sim.scaleObjects, {cube, mesh}, 1e12, true) end
try(sim.relocateShapeFrame, mesh, {1e50, 0, 0, 0, 0, 0, 1})
print(sim.getShapeMesh(mesh))
print(#sim.saveScene() > 1000)
