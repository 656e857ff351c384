-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: import 2
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'
simAssimp = require 'simAssimp'

local stem = os.tmpname()
local files = {stem}
local function path(ending)
    files[#files + 1] = stem .. ending
    return stem .. ending
end
local function write(ending, text)
    local name = path(ending)
    local f = assert(io.open(name, 'wb'))
    f:write(text)
    f:close()
    return name
end
local function refusal(label, f, ...)
    local ok, e = pcall(f, ...)
    print(label, ok and 'no error' or tostring(e):gsub('\nstack traceback.*', ''):gsub('^.-: ', ''):gsub(stem:gsub('%p', '%%%0'), 'FILE'))
end
local function counts(label, vertices, indices)
    local parts = {}
    for i = 1, #vertices do parts[i] = #vertices[i] // 3 .. '/' .. #indices[i] // 3 end
    print(label, table.concat(parts, ' '))
end
local function box(h)
    local size, pose = sim.getShapeBB(h)
    return string.format('%.3f %.3f %.3f at %.3f %.3f %.3f', size[1], size[2], size[3], pose[1], pose[2], pose[3])
end

local V, T = {0,0,0, 1,0,0, 0,2,0, 0,0,3}, {0,2,1, 0,1,3, 0,3,2, 1,2,3}

-- every format
for format, ending in pairs {[0] = '.obj', [3] = '.text.STL', [4] = '.stl', [5] = '.dae', [6] = '.text.ply', [7] = '.ply'} do
    local name = path(ending)
    sim.exportMesh(format, name, 0, 2, {V, V}, {T, {0, 2, 1}})
end
for _, ending in ipairs {'.obj', '.text.STL', '.stl', '.dae', '.text.ply', '.ply'} do
    local vertices, indices = sim.importMesh(0, stem .. ending, 0, 0, 0.5)
    counts(ending, vertices, indices)
    local top = 0
    for _, part in ipairs(vertices) do for _, x in ipairs(part) do top = math.max(top, x) end end
    print('largest', top)
end
counts('identical', sim.importMesh(0, stem .. '.stl', 1, 0, 1))
sim.exportMesh(0, path('.flat.obj'), 0, 1, V, T)
counts('flat lists', sim.importMesh(0, stem .. '.flat.obj', 0, 0, 1))

-- shapes
local h = sim.importShape(0, stem .. '.stl', 32, 0, 0.01)
print('stl', box(h), sim.getObjectInt32Param(h, sim.shapeintparam_static), sim.getObjectInt32Param(h, sim.shapeintparam_respondable))
print('compound', sim.getShapeGeomInfo(sim.importShape(0, stem .. '.dae', 0, 0, 1)) & 1)

-- colours, units, up axes
write('.colours.mtl', 'newmtl red\nKd 1 0 0\nKs 0.25 0.25 0.25\nd 0.5\n')
local mtl = (stem .. '.colours.mtl'):match('[^/\\]+$')
local obj = write('.colours.obj', 'mtllib ' .. mtl .. '\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nusemtl red\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n')
local function looks(label, h)
    local _, c = sim.getShapeColor(h, nil, sim.colorcomponent_ambient_diffuse)
    local _, t = sim.getShapeColor(h, nil, sim.colorcomponent_transparency)
    print(label, string.format('%.2f %.2f %.2f, opacity %.2f', c[1], c[2], c[3], t[1]))
end
looks('coloured', sim.importShape(0, obj, 0, 0, 1))
looks('plain', sim.importShape(0, obj, 8, 0, 1))
looks('opaque', simAssimp.importShapes(obj, 512, 0, 0, 4)[1])
print('y up', box(simAssimp.importShapes(obj, 512, 0, simAssimp.upVector.y, 64)[1]))
print('as it is', box(simAssimp.importShapes(obj, 512, 0.5, simAssimp.upVector.auto, 64)[1]))

local function dae(asset)
    local f = assert(io.open(stem .. '.dae', 'rb'))
    local text = f:read('a'):gsub('<unit.-</up_axis>', asset)
    f:close()
    return write('.up.dae', text)
end
local up = dae('<unit meter="0.01"/><up_axis>Y_UP</up_axis>')
print('centimetres, y up', box(sim.importShape(0, up, 32, 0, 1)))
print('axis ignored', box(sim.importShape(0, up, 32 + 128, 0, 1)))

-- simAssimp: there and back
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 2, 3})
sim.setObjectPosition(cube, {5, 0, 0})
sim.setShapeColor(cube, nil, sim.colorcomponent_ambient_diffuse, {0, 0.5, 1})
local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {1, 1, 1})
local dummy = sim.createDummy(0.1)
local i = 0
while true do
    local _, extension, id = simAssimp.getExportFormat(i)
    if extension == '' then break end
    local name = path('.' .. id .. '.' .. extension)
    simAssimp.exportShapes({cube, dummy, ball}, name, id, 1, simAssimp.upVector.z, 0)
    local shapes = simAssimp.importShapes(name, 512, 0, 0, 64)
    print(id, #shapes, box(shapes[1]))
    if id == 'collada' or id == 'obj' or id == 'glb2' then looks(id, shapes[1]) end
    simAssimp.exportShapes({cube, ball}, name, id, 1, simAssimp.upVector.y, 512)
    shapes = simAssimp.importShapes(name, 512, 0, 0, 64 + 32)
    print(id .. ', y up', #shapes, box(shapes[1]))
    i = i + 1
end
print('formats', i, select('#', simAssimp.getExportFormat(99)), simAssimp.getImportFormat(0))
local both = stem .. '.obj;' .. stem .. '.stl'
counts('two files', simAssimp.importMeshes(both))
counts('one mesh each', simAssimp.importMeshes(both, 0, 0, 32))
simAssimp.exportMeshes({V}, {T}, path('.meshes.glb'), 'glb2')
counts('meshes', simAssimp.importMeshes(stem .. '.meshes.glb'))

-- textures
local plane, texture = sim.createTexture('', 0, nil, nil, nil, 0, {4, 2})
local pixels = string.rep('\255\0\0', 4) .. string.rep('\0\0\255', 4)
local textured = sim.createShape(64, 0, {0,0,0, 1,0,0, 1,1,0}, {0, 1, 2}, nil, {0,0, 1,0, 1,1}, pixels, {4, 2})
simAssimp.exportShapes({textured}, path('.tex.glb'), 'glb2')
local again = simAssimp.importShapes(stem .. '.tex.glb')[1]
local id, size = sim.getShapeTextureId(again), nil
print('texture', id >= 0, sim.readTexture(id, 0):sub(1, 3) == '\255\0\0', #sim.readTexture(id, 0))
print('without', sim.getShapeTextureId(simAssimp.importShapes(stem .. '.tex.glb', 512, 0, 0, 1)[1]))
simAssimp.exportShapes({textured}, path('.tex.obj'), 'obj')
files[#files + 1] = stem .. '.tex.mtl'
files[#files + 1] = stem .. '.tex-texture' .. sim.getShapeTextureId(textured) .. '.png'
print('beside an OBJ', sim.getShapeTextureId(simAssimp.importShapes(stem .. '.tex.obj')[1]) >= 0)
local viz = sim.getShapeViz(again, 0)
print('coordinates', table.concat(viz.texture.coordinates, ' '))

-- refusals
refusal('missing', sim.importShape, 0, stem .. '.nothing.stl', 0, 0, 1)
refusal('missing mesh', sim.importMesh, 0, stem .. '.nothing.stl', 0, 0, 1)
refusal('extension', sim.importMesh, 0, stem, 0, 0, 1)
refusal('damaged', sim.importMesh, 0, write('.bad.obj', 'v 0 0 0\nf 1 1 2\n'), 0, 0, 1)
refusal('format', sim.exportMesh, 2, stem .. '.obj', 0, 1, {V}, {T})
refusal('index', sim.exportMesh, 0, stem .. '.obj', 0, 1, {V}, {{0, 1, 4}})
refusal('scaling', sim.importMesh, 0, obj, 0, 0, -1)
refusal('not a number', sim.importMesh, 0, obj, 0, 0, 0 / 0)
refusal('format id', simAssimp.exportShapes, {cube}, stem .. '.x', 'x')
refusal('nothing to export', simAssimp.exportShapes, {dummy}, stem .. '.obj', 'obj')
refusal('up vector', simAssimp.importShapes, obj, 512, 0, 7)
refusal('dialog', simAssimp.importShapesDlg, obj)

for _, name in ipairs(files) do os.remove(name) end
os.remove(stem .. '.obj.mtl')
