-- as: sandbox
-- passes: 0
-- spec: shapes 8; colours of an entity changed and restored, looks copied from shape to shape
-- tol: 1e-6
-- topic: shapes
sim = require 'sim'

local function cuboid() return sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}) end

local function color(shape, component)
    local _, c = sim.getShapeColor(shape, nil, component or 0)
    local t = {}
    for i, x in ipairs(c) do t[i] = string.format('%.3f', x) end
    return table.concat(t, ' ')
end

local AMBIENT <const>, SPECULAR <const>, EMISSION <const>, TRANSPARENCY <const> =
    sim.colorcomponent_ambient_diffuse, sim.colorcomponent_specular, sim.colorcomponent_emission, sim.colorcomponent_transparency
local a, b, c = cuboid(), cuboid(), cuboid()
for i, shape in ipairs{a, b, c} do sim.setShapeColor(shape, nil, AMBIENT, {0.1 * i, 0.2, 0.3}) end

local saved = sim.changeEntityColor(a, {1, 0, 0})
print('one', #saved, saved[1].comp, color(a), color(b))
sim.restoreEntityColor(saved)
print('restored', color(a))
saved = sim.changeEntityColor(a, {0, 0, 1}, SPECULAR)
print('specular', saved[1].comp, color(a), color(a, SPECULAR))
sim.restoreEntityColor(saved)
print('restored', color(a), color(a, SPECULAR))

local group = sim.createCollection(0)
local dummy = sim.createDummy(0.1)
for _, object in ipairs{a, dummy, b} do sim.addItemToCollection(group, sim.handle_single, object, 0) end
saved = sim.changeEntityColor(group, {0, 1, 0})
print('collection', #saved, color(a), color(b), color(c))
sim.removeObjects{a}
sim.restoreEntityColor(saved)
print('what is left', color(b))
print('no shape', #sim.changeEntityColor(dummy, {1, 1, 1}))
print(pcall(function() sim.changeEntityColor(b, {1, 1}) end))

sim.setShapeColor(b, nil, SPECULAR, {0.4, 0.5, 0.6})
sim.setShapeColor(b, nil, EMISSION, {0.7, 0.8, 0.9})
sim.setShapeColor(b, nil, TRANSPARENCY, {0.25})
sim.setObjectInt32Param(b, sim.shapeintparam_edge_visibility, 1)
sim.setObjectInt32Param(b, sim.shapeintparam_wireframe, 1)
sim.setObjectInt32Param(b, sim.objintparam_visibility_layer, 12)
local function look(what, shape)
    print(what, sim.getObjectInt32Param(shape, sim.shapeintparam_edge_visibility), sim.getObjectInt32Param(shape, sim.shapeintparam_wireframe),
        sim.getObjectInt32Param(shape, sim.objintparam_visibility_layer), color(shape), color(shape, SPECULAR), color(shape, EMISSION), color(shape, TRANSPARENCY))
end
local appearance = sim.getShapeAppearance(b)
print('appearance', appearance.edges, appearance.wireframe, appearance.visibility, #appearance.colors, appearance.colors[1].comp)
look('before', c)
print('returned', sim.setShapeAppearance(c, appearance) == c)
look('after', c)

-- A compound keeps one colour per part, if the parts are as many; else all get the first.
local function compound(red, blue)
    local parts = {cuboid(), cuboid()}
    sim.setShapeColor(parts[1], nil, AMBIENT, {red, 0, 0})
    sim.setShapeColor(parts[2], nil, AMBIENT, {0, 0, blue})
    return sim.groupShapes(parts)
end
local function parts(shape)
    local _, colors = sim.getShapeColor(shape, '@compound', AMBIENT)
    local t = {}
    for i, x in ipairs(colors) do t[i] = string.format('%.2f', x) end
    return table.concat(t, ' ')
end
local one, two = compound(0.1, 0.2), compound(0.3, 0.4)
print('parts', parts(one), parts(two))
sim.setShapeAppearance(one, appearance)
print('from one colour', parts(one))
sim.setShapeAppearance(c, sim.getShapeAppearance(two))
look('from two colours', c)
sim.setShapeAppearance(c, {edges = 1, wireframe = 0, visibility = 2, colors = {{comp = AMBIENT}}})
look('no colours given', c)
