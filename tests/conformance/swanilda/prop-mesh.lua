-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 6, events 8
sim = require 'sim'
local a = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3})
local b = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setObjectPosition(b, {1, 0, 0})
local one = sim.getIntArrayProperty(a, 'meshes')
print(#one, sim.getIntProperty(one[1], 'shapeUid') == sim.getObjectUid(a), sim.getStringProperty(one[1], 'objectType'))
print(#sim.getProperty(one[1], 'vertices'), #sim.getProperty(one[1], 'indices'), #sim.getProperty(one[1], 'normals'))
-- one storage behind the mesh, the shape and the old functions
sim.setColorProperty(one[1], 'color.diffuse', {1, 0.5, 0})
print(select(2, sim.getShapeColor(a, nil, sim.colorcomponent_ambient_diffuse)))
sim.setShapeColor(a, nil, sim.colorcomponent_specular, {0, 1, 0})
print(sim.getColorProperty(one[1], 'color.specular'))
sim.setColorProperty(a, 'applyColor.emission', {0, 0, 1})
print(sim.getObjectColor(a, 0, sim.colorcomponent_emission))
sim.setFloatProperty(a, 'applyColor.transparency', 0.75)
print(sim.getFloatProperty(one[1], 'color.transparency'), sim.getObjectColor(a, 0, sim.colorcomponent_transparency))
sim.setBoolProperty(a, 'applyCulling', true)
print(sim.getBoolProperty(one[1], 'culling'), sim.getObjectInt32Param(a, sim.shapeintparam_culling))
sim.setFloatProperty(one[1], 'shadingAngle', 0.5)
print(sim.getObjectFloatParam(a, sim.shapefloatparam_shading_angle))
sim.setStringProperty(one[1], 'colorName', 'paint')
print((sim.getShapeColor(a, 'paint', sim.colorcomponent_specular)), (sim.getShapeColor(a, 'rust', sim.colorcomponent_specular)))
-- flipped faces turn the other way
local before = sim.getProperty(one[1], 'normals')
sim.setBoolProperty(a, 'flipFaces', true)
local after = sim.getProperty(one[1], 'normals')
print(#before == #after, before[1] == -after[1], before[2] == -after[2], before[3] == -after[3])
print(pcall(sim.getBoolProperty, a, 'flipFaces'))
-- without a texture
print(#sim.getProperty(one[1], 'rawTexture'), #sim.getProperty(one[1], 'textureCoordinates'), sim.getProperty(one[1], 'textureID'))
-- meshes of compounds, and of copies, are their own
local c = sim.copyPasteObjects({a}, 0)[1]
print(sim.getProperty(c, 'meshes')[1] ~= one[1], sim.getProperty(sim.getProperty(c, 'meshes')[1], 'colorName'))
local g = sim.groupShapes({a, b})
local two = sim.getProperty(g, 'meshes')
print(#two, two[1] ~= two[2])
print((select(2, pcall(sim.getProperty, one[1], 'culling')):gsub('^%-?%d+: ', '')))
print(sim.getProperty(two[1], 'colorName'), sim.getProperty(two[2], 'colorName') == '')
sim.removeObjects({g})
print((select(2, pcall(sim.getBoolProperty, two[1], 'culling')):gsub('^%-?%d+: ', '')))
