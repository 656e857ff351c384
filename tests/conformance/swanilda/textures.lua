-- topic: textures
-- as: sandbox
-- passes: 0
-- spec: shapes 2.2, shapes 3, shapes 8, scene-files 7.1
sim = require 'sim'
local function fails(...)
    return (select(2, pcall(...)):gsub('^%-?%d+: ', ''))
end
local function bytes(buffer)
    return table.concat({string.byte(tostring(buffer), 1, -1)}, ' ')
end
-- a plane with a new image: white, red is written to a corner
local plane, id, res = sim.createTexture('', 1 + 4, {0.4, 0.2}, nil, nil, 1, {2, 2})
print(id == sim.object_texturestart, res, sim.getShapeTextureId(plane) == id, sim.getTextureId('texture'))
print(fails(sim.getTextureId, 'nothing'))
sim.writeTexture(id, 0, string.char(255, 0, 0), 1, 0, 1, 1)
print(bytes(sim.readTexture(id, 0)))
sim.writeTexture(id, 0, string.char(0, 0, 0), 1, 0, 1, 1, 0.5)
print(bytes(sim.readTexture(id, 0, 1, 0, 1, 2)))
print(fails(sim.readTexture, id, 0, 1, 0, 2, 1))
print(fails(sim.writeTexture, id, 0, 'abc'))
print(fails(sim.readTexture, id + 1, 0))
-- what the mesh says of it
local mesh = sim.getProperty(plane, 'meshes')[1]
print(sim.getProperty(mesh, 'textureResolution'), sim.getProperty(mesh, 'textureID') == id, #sim.getProperty(mesh, 'rawTexture'))
print(sim.getProperty(mesh, 'textureInterpolate'), sim.getProperty(mesh, 'textureRepeatU'), sim.getProperty(mesh, 'textureRepeatV'))
sim.setIntProperty(mesh, 'textureApplyMode', sim.textureapplymode_add)
local texture = sim.getShapeViz(plane, 0).texture
print(texture.resolution, texture.applyMode, texture.options, texture.id == id, #texture.coordinates, #tostring(texture.texture))
print(sim.getObjectFloatParam(plane, sim.shapefloatparam_texture_scaling_x), math.abs(sim.getObjectFloatParam(plane, sim.shapefloatparam_texture_g)))
-- copies share it, unless they are to have none
local copy = sim.copyPasteObjects({plane}, 0)[1]
local bare = sim.copyPasteObjects({plane}, 16)[1]
print(sim.getShapeTextureId(copy) == id, sim.getShapeTextureId(bare), sim.getShapeViz(bare, 0).texture)
-- another shape, and a sensor's picture
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setShapeTexture(cube, id, sim.texturemap_cube, 2, {0.1, 0.1}, {0, 0, 0.5}, {0, 0, math.pi / 2})
print(sim.getObjectFloatParam(cube, sim.shapefloatparam_texture_z), math.abs(sim.getObjectFloatParam(cube, sim.shapefloatparam_texture_g) - math.pi / 2) < 1e-12)
print(fails(sim.setShapeTexture, cube, id + 7, 0, 0, {1, 1}))
print(fails(sim.setShapeTexture, cube, id, 4, 0, {1, 1}))
print(fails(sim.setShapeTexture, cube, plane, 0, 0, {1, 1}))
local sensor = sim.createVisionSensor(0, {16, 16, 0, 0})
sim.setShapeTexture(cube, sensor, sim.texturemap_plane, 0, {1, 1})
print(sim.getShapeTextureId(cube) == sensor)
-- a mesh with coordinates; its faces turn with them
local uv = {0, 0, 1, 0, 0, 1}
local image = string.char(1, 1, 1, 2, 2, 2)
local shape = sim.createShape(2 + 4, 0, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, nil, uv, image, {1, 2})
local own = sim.getShapeTextureId(shape)
print(bytes(sim.readTexture(own, 0)), sim.getShapeViz(shape, 0).texture.coordinates)
sim.setBoolProperty(shape, 'flipFaces', true)
print(sim.getProperty(sim.getProperty(shape, 'meshes')[1], 'textureCoordinates'))
print(fails(sim.createShape, 2, 0, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, nil, {0, 0}, image, {1, 2}))
-- files keep it
sim.setModelProperty(plane, 0)
local loaded = sim.loadModel(sim.saveModel(plane))
print(sim.getShapeTextureId(loaded) == id, sim.getShapeViz(loaded, 0).texture.applyMode)
sim.removeObjects({loaded})
-- what nobody uses is forgotten
sim.removeObjects({plane, copy})
print(fails(sim.readTexture, id, 0), sim.getTextureId('texture') == own)
