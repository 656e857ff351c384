-- topic: custom data
-- as: sandbox
-- passes: 0
-- spec: data 4, data 5; the kind of a block, names by a pattern, references that are added and objects removed by them
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function dummy(name, parent)
    local handle = sim.createDummy(0.01)
    sim.setObjectAlias(handle, name)
    if parent then sim.setObjectParent(handle, parent, true) end
    return handle
end

local d = dummy('d')
print('none', (sim.readCustomDataBlockEx(d, 'table')))
sim.writeCustomDataBlockEx(d, 'table', sim.packTable{1, 'two'}, {dataType = 'table'})
local data, kind = sim.readCustomDataBlockEx(d, 'table')
print('table', kind, sim.unpackTable(data), sim.readCustomTableData(d, 'table'))
-- 82 05 F5: an array of 5 and true.
sim.writeCustomDataBlockEx(d, 'cbor', '\x82\x05\xF5', {dataType = 'cbor'})
data, kind = sim.readCustomDataBlockEx(d, 'cbor')
print('cbor', kind, #data, sim.readCustomTableData(d, 'cbor'))
-- What sim.writeCustomTableData writes tells its kind as well.
sim.writeCustomTableData(d, 'written', {5, true}, {dataType = 'cbor'})
data, kind = sim.readCustomDataBlockEx(d, 'written')
print('written', kind, sim.readCustomTableData(d, 'written'))
sim.writeCustomStringData(d, 'plain', 'text')
data, kind = sim.readCustomDataBlockEx(d, 'plain')
print('plain', tostring(data), kind)
sim.writeCustomDataBlockEx(sim.handle_scene, 'scene', 'bytes', {dataType = 'table'})
print('scene', sim.readCustomStringData(sim.handle_scene, 'scene'), select(2, sim.readCustomDataBlockEx(sim.handle_scene, 'scene')))
sim.writeCustomDataBlockEx(d, 'cbor', '', {dataType = 'cbor'})
print('removed', (sim.readCustomDataBlockEx(d, 'cbor')), sim.readCustomStringData(d, 'cbor'))

for _, name in ipairs{'arm.1', 'arm.2', 'leg.1'} do sim.persistentDataWrite(name, 'x') end
local function matching(pattern)
    local tags = sim.getMatchingPersistentDataTags(pattern)
    table.sort(tags)
    return table.concat(tags, ' ')
end
print('matching', matching('^arm%.'), '|', matching('1$'), '|', matching('none'))

local function names(handles)
    local list = {}
    for i, handle in ipairs(handles) do list[i] = handle == -1 and '-' or sim.getObjectAlias(handle) end
    return #list == 0 and '(none)' or table.concat(list, ' ')
end
local a, b, c = dummy('a'), dummy('b'), dummy('c')
local below = dummy('below', c)
local deep = dummy('deep', below)
sim.addReferencedHandle(d, b)
sim.addReferencedHandle(d, a)
sim.addReferencedHandle(d, b)
sim.addReferencedHandle(d, c, 'tree', {wholeTree = true})
sim.addReferencedHandle(d, a, 'tag')
sim.addReferencedHandle(d, d, 'tag')
print('order', names(sim.getReferencedHandles(d)))
print('tree', names(sim.getReferencedHandles(d, 'tree')))
print('tag', names(sim.getReferencedHandles(d, 'tag')))

-- Only what has the tag is removed, with all references to it; what is below survives.
sim.removeReferencedObjects(d)
print('removed', sim.isHandle(a), sim.isHandle(b), sim.isHandle(c), sim.isHandle(d))
print('left', names(sim.getReferencedHandles(d)), names(sim.getReferencedHandles(d, 'tag')), names(sim.getReferencedHandles(d, 'tree')))
sim.setReferencedHandles(d, {c}, 'one')
sim.removeReferencedObjects(d, 'one')
print('removed', sim.isHandle(c), sim.isHandle(below), sim.getObjectParent(below), names(sim.getReferencedHandles(d, 'tree')))
sim.removeReferencedObjects(d, 'nothing')
sim.removeReferencedObjects(d, 'tree')
print('removed', sim.isHandle(below), sim.isHandle(deep), sim.isHandle(d))
