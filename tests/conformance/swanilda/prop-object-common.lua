-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 6, objects 1, objects 5, addressing 4
sim = require 'sim'
local d = sim.createDummy(0.2)
local s = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.4})
print(sim.getVector3Property(d, 'bbHSize'), sim.getVector3Property(s, 'bbHSize'), #sim.getPoseProperty(d, 'bbPose'))
-- deprecated names are the same values
sim.setModelProperty(d, 0)
sim.setBoolProperty(d, 'modelNotVisible', true)
print(sim.getBoolProperty(d, 'model.notVisible'), sim.getModelProperty(d) == sim.modelproperty_not_visible)
sim.setBoolProperty(d, 'movPrefRotX', true)
print(sim.getBoolProperty(d, 'mov.prefRotX'), sim.getIntProperty(d, 'mov.preferredAxesFlags'), sim.getIntProperty(d, 'movementPreferredAxesFlags'))
print(sim.getFloatArrayProperty(d, 'mov.stepSize'), sim.getIntArrayProperty(d, 'mov.relativity'), sim.getIntProperty(d, 'mov.optionsFlags'))
-- visible: the layer, and the models above
sim.setObjectParent(s, d, true)
print(sim.getBoolProperty(s, 'visible'), sim.getBoolProperty(s, 'modelInvisible'))
sim.setBoolProperty(d, 'model.notVisible', false)
print(sim.getBoolProperty(s, 'visible'), sim.getObjectInt32Param(s, sim.objintparam_visible))
sim.setIntProperty(s, 'layer', 256) print(sim.getBoolProperty(s, 'visible'))
-- old numbers, same values
sim.setIntProperty(s, 'hierarchyColor', 3) print(sim.getObjectInt32Param(s, sim.objintparam_hierarchycolor))
sim.setObjectStringParam(d, sim.dummystringparam_assemblytag, 'plug') print(sim.getStringProperty(d, 'assemblyTag'))
print(sim.getObjectStringParam(d, sim.objstringparam_unique_id) == sim.getStringProperty(d, 'persistentUid'))
-- copies share the dna only
local c = sim.copyPasteObjects({d}, 1)[1]
print(sim.getBufferProperty(c, 'dna') == sim.getBufferProperty(d, 'dna'), sim.getStringProperty(c, 'persistentUid') == sim.getStringProperty(d, 'persistentUid'))
print(sim.getStringProperty(c, 'assemblyTag'), sim.getIntProperty(c, 'mov.preferredAxesFlags'))
-- copies of a model have its hash until something that counts is changed
local function hash(h) return sim.getStringProperty(h, 'modelHash') end
local child = sim.getObjectChild(c, 0)
print(#hash(d) > 0, hash(d) == hash(c), hash(child) == '')
sim.setIntProperty(d, 'signal.x', 1) sim.setObjectSel({d}) print(hash(d) == hash(c))
sim.setIntProperty(child, 'customData.x', 1) print(hash(d) == hash(c))
sim.removeProperty(child, 'customData.x') print(hash(d) == hash(c))
sim.setColorProperty(sim.getProperty(child, 'meshes')[1], 'color.diffuse', {1, 0, 0}) print(hash(d) == hash(c))
