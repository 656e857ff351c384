-- as: sandbox
-- passes: 0
-- spec: properties 1, properties 2, properties 3; types as words and functions, conversions, several properties at once
-- tol: 1e-9
-- topic: properties
sim = require 'sim'

local function text(value)
    if isbuffer(value) then return 'buffer ' .. tostring(value) end
    if type(value) ~= 'table' then return tostring(value) end
    local t = {}
    for i, x in ipairs(value) do t[i] = text(x) end
    return '{' .. table.concat(t, ' ') .. '}'
end

local function try(what, f, ...)
    local ok, result = pcall(f, ...)
    if not ok then return print(what, 'error', (result:gsub('^%-?%d+: in ', ''):gsub('^.-in sim', 'sim'))) end
    print(what, text(result), math.type(result) or type(result))
end

-- Words, names of functions and the functions themselves.
for code = -1, 17 do
    local word, getter, setter = sim.getPropertyTypeString(code), sim.getPropertyGetter(code, true), sim.getPropertySetter(code, true)
    local f, g = sim.getPropertyGetter(code), sim.getPropertySetter(code)
    print(code, word, getter, setter, word and sim['propertytype_' .. word] == code, word and f == sim[getter], word and g == sim[setter])
end

-- Guessed types, and types that are passed as a number or a word.
local object = sim.createDummy(0.1)
local function kind(name)
    local code = sim.getPropertyInfo(object, 'customData.' .. name)
    return code and sim.getPropertyTypeString(code)
end
for _, entry in ipairs{
    {'a', 5}, {'b', 5.5}, {'c', 'text'}, {'d', true}, {'e', {1, 2}}, {'f', tobuffer('xyz')}, {'g', 5, sim.propertytype_float}, {'h', 'text', 'buffer'},
    {'i', {1, 2, 3}, 'floatarray'}, {'j', {1, 2, 3}, 'vector3'}, {'k', 7, 'long'}, {'l', {0.5, 0.25, 0.125}, 'color'}, {'m', {1, 0.5, 0}, sim.propertytype_color},
} do
    sim.setProperty(object, 'customData.' .. entry[1], entry[2], entry[3])
    print(entry[1], kind(entry[1]), text(sim.getProperty(object, 'customData.' .. entry[1])))
end
local function refused(what, f)
    local _, message = pcall(f)
    print(what, message)
end
refused('a function', function() sim.setProperty(object, 'customData.x', print) end)
refused('a type for another', function() sim.setProperty(object, 'alias', 'x', 'string') end)
refused('unknown, written', function() sim.setProperty(object, 'nothing', 1) end)
refused('unknown, read', function() local _ = sim.getProperty(object, 'nothing') end)
refused('unknown, read, options', function() local _ = sim.getProperty(object, 'nothing', {noError = false}) end)
print('unknown, no error', sim.getProperty(object, 'nothing', {noError = true}))
sim.setProperty(object, 'alias', 'renamed')
print(sim.getProperty(object, 'alias'))

-- Several at once: those that cannot be written are left out.
sim.setProperties(object, {alias = 'again', objectUid = 5, ['customData.a'] = 6})
local values = sim.getProperties(object)
print(values.alias, values['customData.a'], values.objectUid == sim.getProperty(object, 'objectUid'))
print('unknown among several', (pcall(sim.setProperties, object, {nothing = 1})))

local shape = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {1, 1, 1})
local mesh = sim.getIntArrayProperty(shape, 'meshes')[1]
local all, few = sim.getProperties(mesh), sim.getProperties(mesh, {skipLarge = true})
local left, large, count = {}, {}, 0
for name in pairs(all) do
    count = count + 1
    if few[name] == nil then left[#left + 1] = name end
    if select(2, sim.getPropertyInfo(mesh, name)) & sim.propertyinfo_largedata ~= 0 then large[#large + 1] = name end
end
table.sort(left)
table.sort(large)
print('large', table.concat(left, ' ') == table.concat(large, ' '), #left > 0, #left < count)
for _, name in ipairs{'alias', 'objectUid', 'customData.a'} do
    local info = sim.getPropertyInfos(object, name)
    local code, flags, words = sim.getPropertyInfo(object, name)
    local is = info.flags
    print(name, info.type == code, info.infoTxt == words, is.value == flags, is.readable, is.writable, is.removable, is.large)
end
local is = sim.getPropertyInfos(mesh, 'vertices').flags
print('vertices', is.readable, is.writable, is.removable, is.large)
print('unknown', sim.getPropertyInfos(object, 'nothing'), sim.getPropertiesInfos(object)['alias'].type)

local infos, index, missing = sim.getPropertiesInfos(mesh), 0, 0
repeat
    local name = sim.getPropertyName(mesh, index)
    if name and not (infos[name] and all[name] ~= nil) then missing = missing + 1 end
    index = index + 1
until not name
print('missing', missing, index > 5)

-- The same value in another type.
local T <const> = {}
for _, word in ipairs{'bool', 'int', 'float', 'string', 'buffer', 'vector3', 'floatarray', 'table', 'intarray', 'long'} do T[word] = sim['propertytype_' .. word] end
for _, entry in ipairs{
    {5, 'int', 'int'}, {nil, 'int', 'string'}, {5, 'int', 'string'}, {'5', 'string', 'int'}, {'5.9', 'string', 'int'}, {'5', 'string', 'long'},
    {'0.5', 'string', 'float'}, {5, 'int', 'float'}, {5.9, 'float', 'int'}, {5.9, 'float', 'long'}, {true, 'bool', 'int'}, {false, 'bool', 'float'}, {'no value', 'string', 'int'}, {'x', 'string', 'vector3'}, 
    {0, 'int', 'bool'}, {2, 'int', 'bool'}, {0.0, 'float', 'bool'}, {'true', 'string', 'bool'}, {'false', 'string', 'bool'}, {'0', 'string', 'bool'},
    {'{1, 2, 3}', 'string', 'vector3'}, {{1, 2, 3}, 'vector3', 'floatarray'}, {{1, 2, 3}, 'vector3', 'string'}, {'text', 'string', 'buffer'},
    {tobuffer('text'), 'buffer', 'string'}, {{1, 2}, 'table', 'buffer'}, {tobuffer('{4, 5}'), 'buffer', 'intarray'}, {{1}, 'table', 'int'},
    {{1}, 'table', 'float'}, {{1}, 'table', 'long'}, {{}, 'table', 'bool'}, {true, 'bool', 'string'},
} do
    try(table.concat({text(entry[1]), entry[2], entry[3]}, ' '), sim.convertPropertyValue, entry[1], T[entry[2]], T[entry[3]])
end
refused('where it was called', function() sim.convertPropertyValue({}, T.table, T.int) end)
try('an unknown type', sim.convertPropertyValue, {1}, T.table, 99)

sim.setTableProperty(object, 'customData.t', {x = 1, y = {2}})
print(text(sim.getTableProperty(object, 'customData.t').y))
refused('no table', function() sim.setTableProperty(object, 'customData.t', 5) end)
refused('no name', function() sim.setTableProperty(object, 5, {}) end)
refused('too few', function() sim.setTableProperty(object, 'customData.t') end)
print('no error', pcall(sim.setTableProperty, 123456, 'customData.t', {}, {noError = true}))
