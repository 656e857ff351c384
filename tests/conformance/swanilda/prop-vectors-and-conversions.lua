-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 1, properties 2, properties 3, data 4, calls 3
-- tol: 1e-9
-- note: pairs of numbers, poses, what is told of a property, values in another type, numbers of 64 bits
sim = require 'sim'
local text = require('lib.trial').text

local function refused(f, ...)
    local ok, message = pcall(f, ...)
    print('refused', ok, message:match('([^: ][^:]*%.)$') or 'unsupported')
end

local d = sim.createDummy(0.01)
sim.setVector2Property(d, 'customData.pair', {1.5, -2})
print('pair', text(sim.getVector2Property(d, 'customData.pair')), sim.getPropertyInfo(d, 'customData.pair'))
print('stored', sim.readCustomDataTags(d))
sim.setVector2Property(d, 'customData.pair', {3, 4, 5})
print('pair', text(sim.getVector2Property(d, 'customData.pair')), text(sim.getProperty(d, 'customData.pair')))
refused(sim.getVector3Property, d, 'customData.pair')
refused(sim.setVector2Property, d, 'customData.pair', {1})
refused(sim.getVector2Property, d, 'customData.none')
refused(sim.setVector2Property, d, 'pose', {1, 2})
print('none', select('#', sim.getVector2Property(d, 'customData.none', {noError = true})), select('#', sim.setVector2Property(d, 'none', {1, 2}, {noError = true})))
sim.setVector2Property(sim.handle_scene, 'signal.pair', {6, 7})
print('signal', text(sim.getVector2Property(sim.handle_scene, 'signal.pair')))

-- A pose moves the object; its quaternion becomes one of length 1.
local parent = sim.createDummy(0.01)
sim.setObjectPosition(parent, {10, 20, 30})
sim.setObjectParent(d, parent, true)
sim.setPoseProperty(d, 'pose', {1, 2, 3, 0, 0, 2, 0})
print('pose', text(sim.getObjectPose(d, parent)), text(sim.getObjectPosition(d)), text(sim.getPoseProperty(d, 'pose')))
sim.setPoseProperty(d, 'customData.pose', {1, 2, 3, 0, 0, 0, 1})
print('pose', text(sim.getPoseProperty(d, 'customData.pose')), (sim.getPropertyInfo(d, 'customData.pose')))
refused(sim.setPoseProperty, d, 'pose', {1, 2, 3})
refused(sim.setPoseProperty, d, 'alias', {1, 2, 3, 0, 0, 0, 1})

local function told(target, name)
    local info = sim.getPropertyInfos(target, name)
    if not info then return print('infos', name, info) end
    local is = info.flags
    print('infos', name, info.type, is.value, is.readable, is.writable, is.removable, is.large)
end
told(d, 'alias')
told(d, 'customData.pair')
told(d, 'objectUid')
told(d, 'no.such')

local function converted(value, from, to) return sim.convertPropertyValue(value, sim['propertytype_' .. from], sim['propertytype_' .. to]) end
print('numbers', converted(3, 'int', 'float'), converted(3.0, 'float', 'int'), converted('12', 'string', 'int'), converted('0.5', 'string', 'float'))
print('truth', converted('true', 'string', 'bool'), converted('false', 'string', 'bool'), converted(0, 'int', 'bool'), converted(2, 'int', 'bool'))
print('texts', converted(12, 'int', 'string'), converted(true, 'bool', 'string'), converted('same', 'string', 'string'), converted('ab', 'string', 'buffer'))
print('lists', text(converted('{1, 2, 3}', 'string', 'vector3')), text(converted({1, 2}, 'intarray2', 'vector2')))
print('no value', converted('x', 'string', 'float'))
refused(converted, true, 'bool', 'int')
refused(converted, {1, 2}, 'table', 'int')

-- Eight bytes each, the lowest first.
local function hex(data) return (tostring(data):gsub('.', function(c) return ('%02x'):format(c:byte()) end)) end
local packed = sim.packInt64Table{1, -2, 0x0102030405060708}
print('packed', hex(packed), isbuffer(packed))
print('part', hex(sim.packInt64Table({1, 2, 3}, 1, 1)), hex(sim.packInt64Table({1, 2, 3}, 2)))
print('unpacked', sim.unpackInt64Table(packed), math.type(sim.unpackInt64Table(packed)[1]))
print('part', sim.unpackInt64Table(packed, 1, 1), sim.unpackInt64Table('abc' .. tostring(packed), 0, 2, 3), math.maxinteger == sim.unpackInt64Table(sim.packInt64Table{math.maxinteger})[1])
