-- topic: shapes
-- as: sandbox
-- passes: 0
-- spec: shapes 3, shapes 8, objects 1.4, objects 7, sensors 3.3, sensors 4
-- tol: 1e-6
-- note: how a shape looks, sizes of boxes of shapes and models, options of point clouds, the resolution of a sensor
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

local function cube(x)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
    sim.setObjectPosition(shape, {x or 0, 0, 0})
    return shape
end
local PLAIN <const>, SHINE <const>, GLOW <const>, CLEAR <const> = sim.colorcomponent_ambient_diffuse, sim.colorcomponent_specular, sim.colorcomponent_emission, sim.colorcomponent_transparency

-- The looks of one shape for another one, and back.
local red, other = cube(), cube()
sim.setShapeColor(red, nil, PLAIN, {0.75, 0, 0})
sim.setShapeColor(red, nil, SHINE, {0.5, 0.25, 0})
sim.setShapeColor(red, nil, GLOW, {0, 0.25, 0.5})
sim.setShapeColor(red, nil, CLEAR, {0.25})
sim.setObjectInt32Param(red, sim.shapeintparam_edge_visibility, 1)
local function look(shape)
    local looks = {}
    for i, component in ipairs{PLAIN, SHINE, GLOW, CLEAR} do looks[i] = text(select(2, sim.getShapeColor(shape, nil, component))) end
    return table.concat(looks, ' '), sim.getObjectInt32Param(shape, sim.shapeintparam_edge_visibility)
end
local before = sim.getShapeAppearance(other)
local first = look(other)
print('set', sim.setShapeAppearance(other, sim.getShapeAppearance(red)) == other, look(other))
sim.setShapeAppearance(other, before)
print('back', look(other) == first, look(red) == first)
-- A group keeps the colour of each of its parts.
local blue = cube(2)
sim.setShapeColor(blue, nil, PLAIN, {0, 0, 0.5})
local group = sim.groupShapes{red, blue}
local saved = sim.getShapeAppearance(group)
sim.setShapeColor(group, nil, PLAIN, {1, 1, 1})
sim.setShapeAppearance(group, saved)
print('group', text(select(2, sim.getShapeColor(group, '@compound', PLAIN))))

-- A box of another size: the mesh fills it, mass and inertia stay.
local box = cube()
local mass, inertia = sim.getShapeMass(box), sim.getShapeInertia(box)
sim.setShapeBB(box, {2, 4, 6})
local vertices, extent = sim.getShapeMesh(box), {0, 0, 0}
for i, x in ipairs(vertices) do extent[(i - 1) % 3 + 1] = math.max(extent[(i - 1) % 3 + 1], x) end
print('box', text(sim.getShapeBB(box)), text(extent), text(select(3, sim.getShapeGeomInfo(box))))
print('mass', sim.getShapeMass(box) == mass, text(sim.getShapeInertia(box)) == text(inertia))
local plane = sim.createPrimitiveShape(sim.primitiveshape_plane, {0.2, 0.2, 0})
print('flat', (pcall(sim.setShapeBB, plane, {1, 1, 1})), (pcall(sim.setShapeBB, plane, {1, 1, 0})), text(sim.getShapeBB(plane)))

-- The box of a model is in the frame of its base: here from -0.5 to 2.5 along x. What the box leaves out does not count.
local base, part = cube(), cube(2)
sim.setObjectParent(part, base, true)
sim.setModelProperty(base, 0)
print('model', text(sim.getModelBB(base)))
sim.setObjectPose(base, {5, 6, 7, 0, 0, math.sqrt(0.5), math.sqrt(0.5)})
print('model', text(sim.getModelBB(base)))
sim.setObjectProperty(part, sim.getObjectProperty(part) | sim.objectproperty_dontshowasinsidemodel)
print('model', text(sim.getModelBB(base)))

local cloud = sim.createPointCloud(0.25, 20, 0, 3)
print('cloud', sim.getPointCloudOptions(cloud))
sim.setPointCloudOptions(cloud, 0.125, 5, 2 | 8, 4)
print('cloud', sim.getPointCloudOptions(cloud))
print('cloud', sim.getFloatProperty(cloud, 'cellSize'), sim.getIntProperty(cloud, 'pointSize'))
sim.setPointCloudOptions(cloud, 0.125, 5, 0, 4)
print('cloud', (select(3, sim.getPointCloudOptions(cloud))))
print('no cloud', (pcall(sim.getPointCloudOptions, box)), (pcall(sim.setPointCloudOptions, box, 0.1, 5, 0, 1)))

local eye = sim.createVisionSensor(2, {32, 16, 0, 0}, {0.01, 10, 1, 0.1, 0.1, 0.1, 0, 0, 0, 0, 0})
print('resolution', sim.getVisionSensorResolution(eye), (pcall(sim.getVisionSensorResolution, box)))
