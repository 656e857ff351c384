-- topic: objects
-- as: sandbox
-- passes: 0
-- spec: objects 1.2, objects 1.4, objects 2, objects 4, objects 9, sensors 5, shapes 7, shapes 8, vrep-era 1.1
-- note: objects in old functions: parameters, names, selection, collections, removal
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function count(...) return select('#', ...) end
local function dummy(name, parent)
    local handle = sim.createDummy(0.01)
    sim.setObjectAlias(handle, name)
    if parent then sim.setObjectParent(handle, parent, true) end
    return handle
end
local function names(handles)
    local list = {}
    for i, handle in ipairs(handles) do list[i] = sim.getObjectAlias(handle) end
    return table.concat(list, ' ')
end

local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
print('int', sim.setObjectInt32Parameter(box, sim.objintparam_visibility_layer, 0x30), sim.getIntProperty(box, 'layer'))
print('float', sim.setObjectFloatParameter(box, sim.shapefloatparam_mass, 2.5), sim.getShapeMass(box))
sim.setObjectStringParameter(box, sim.shapestringparam_colorname, 'PAINT')
print('string', sim.getObjectStringParameter(box, sim.shapestringparam_colorname))
sim.setShapeColor(box, 'PAINT', sim.colorcomponent_ambient_diffuse, {0.25, 0.5, 0.75})
print('string', sim.getShapeColor(box, 'PAINT', sim.colorcomponent_ambient_diffuse))
print('none', count(sim.getObjectFloatArrayParam(box, 77777)), count(sim.setObjectFloatArrayParam(box, 77777, {1, 2})), count(sim.getObjectStringParameter(box, 77777)))
for _, f in ipairs{sim.getObjectFloatArrayParam, sim.getObjectStringParameter} do
    print('no object', (select(2, pcall(f, 999999, 1)):match('object does not exist%.$')))
end

local a, b, c = dummy('a'), dummy('b'), dummy('c')
print('unique', sim.getObjectUniqueIdentifier(a) == sim.getObjectUid(a), sim.getObjectUniqueIdentifier(a) ~= sim.getObjectUniqueIdentifier(b))
sim.setObjectSelection{b, a}
print('selected', names(sim.getObjectSelection()), names(sim.getObjectSel()))
sim.setObjectSelection{}
print('selected', #sim.getObjectSelection())

-- Names: no suffix of the script is appended, and none missing is an error.
sim.setObjectName(a, 'arm')
sim.setNameSuffix(3)
print('names', sim.getObjectHandle('arm@silentError'), sim.getObjectHandle_noErrorNoSuffixAdjustment('arm') == a, sim.getObjectHandle_noErrorNoSuffixAdjustment('leg'))
sim.setNameSuffix(-1)
sim.setObjectName(a, 'arm#2')
sim.setSimilarName(b, 'arm#2', '_tip')
sim.setSimilarName(c, 'arm#2', '_tip')
local first, second = sim.getObjectName(b), sim.getObjectName(c)
print('similar', first:match('^arm_tip%d*#2$') == first, second:match('^arm_tip%d*#2$') == second, first ~= second, sim.getObjectAlias(b))

-- Collections: items apply in order; 1 subtracts, 2 leaves out the object itself.
local root = dummy('root')
local child = dummy('child', root)
local leaf = dummy('leaf', child)
local goods = sim.createCollection(0)
sim.addObjectToCollection(goods, root, sim.handle_tree, 0)
print('tree', names(sim.getCollectionObjects(goods)))
sim.addObjectToCollection(goods, child, sim.handle_single, 1)
print('without one', names(sim.getCollectionObjects(goods)))
sim.emptyCollection(goods)
print('empty', #sim.getCollectionObjects(goods))
sim.addObjectToCollection(goods, leaf, sim.handle_chain, 2)
local above = sim.getCollectionObjects(goods)
table.sort(above)
print('chain above', names(above))

-- What is below stays where it is in the world.
sim.setObjectPosition(child, {1, 2, 3})
sim.setObjectPosition(leaf, {4, 5, 6})
sim.removeObject(child)
print('removed', sim.isHandle(child), sim.getObjectAlias(sim.getObjectParent(leaf)), sim.getObjectPosition(leaf))
print('again', (pcall(sim.removeObject, child)))

local sensor = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.01, 1, 1, 0, 0})
sim.setObjectPosition(sensor, {1, 1, 1})
sim.setObjectParent(box, sensor, true)
sim.setObjectPosition(box, {3, 2, 1})
sim.breakForceSensor(sensor)
print('broken', sim.getObjectParent(box), sim.getObjectPosition(box), sim.isHandle(sensor))
print('no sensor', (select(2, pcall(sim.breakForceSensor, box)):match('([^: ][^:]*%.)$')))
