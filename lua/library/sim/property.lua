--[[
Reading and writing properties of any type, and several at once.

Does not read or write a property itself: the typed functions are native.
]]

local sim = ...
local M = {}

-- Codes of sim.propertytype_*; the word is the end of the constant's name, the other names the typed functions.
local TYPES <const> = {
    [0] = {'bool', 'Bool'}, {'int', 'Int'}, {'float', 'Float'}, {'string', 'String'}, {'buffer', 'Buffer'},
    {'vector3', 'Vector3'}, {'quaternion', 'Quaternion'}, {'pose', 'Pose'}, [10] = {'color', 'Color'},
    [11] = {'floatarray', 'FloatArray'}, [12] = {'table', 'Table'}, [13] = {'intarray', 'IntArray'},
    [14] = {'vector2', 'Vector2'}, [15] = {'intarray2', 'IntArray2'}, [16] = {'long', 'Long'},
}
local getinfo <const> = debug.getinfo
local NOT_WRITABLE <const>, NOT_READABLE <const>, REMOVABLE <const>, LARGE_DATA <const> = 1, 2, 4, 0x100

local function getter(code) return TYPES[code] and sim['get' .. TYPES[code][2] .. 'Property'] end
local function setter(code) return TYPES[code] and sim['set' .. TYPES[code][2] .. 'Property'] end

local function typeCode(word)
    for code, names in pairs(TYPES) do
        if names[1] == word then return code end
    end
end

--- Word for a type of property.
-- @api string word = sim.getPropertyTypeString(int type, bool forApi = false)
-- @param type sim.propertytype_*
-- @param forApi the word in names of functions instead, as in sim.getIntProperty
-- @return word what follows propertytype_
function M.getPropertyTypeString(ptype, forApi) return TYPES[ptype] and TYPES[ptype][forApi and 2 or 1] end

--- Function that reads properties of a type, or its name.
-- @api func getter = sim.getPropertyGetter(int type, bool onlyName = false)
-- @param type sim.propertytype_*
-- @param onlyName return the name instead
-- @return getter for instance sim.getIntProperty
function M.getPropertyGetter(ptype, onlyName)
    if not TYPES[ptype] then return nil end
    return onlyName and 'get' .. TYPES[ptype][2] .. 'Property' or getter(ptype)
end

--- Function that writes properties of a type, or its name.
-- @api func setter = sim.getPropertySetter(int type, bool onlyName = false)
-- @param type sim.propertytype_*
-- @param onlyName return the name instead
-- @return setter for instance sim.setIntProperty
function M.getPropertySetter(ptype, onlyName)
    if not TYPES[ptype] then return nil end
    return onlyName and 'set' .. TYPES[ptype][2] .. 'Property' or setter(ptype)
end

-- Raises an error at the line that called the function of sim; at a line here where that was called by a native function, as by pcall.
local function refuse(message)
    local caller = getinfo(3, 'l')
    error(message, caller and caller.currentline > 0 and 3 or 2)
end

--- Value of a property of any type.
-- @api any value = sim.getProperty(int target, string name, map options = {})
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param name of the property
-- @param options noError: nil if there is no such property
-- @return value in the type of the property
function M.getProperty(target, name, options)
    local ptype = sim.getPropertyInfo(target, name)
    if ptype then return getter(ptype)(target, name, options) end
    if not (options and options.noError) then refuse('no such property: ' .. tostring(name)) end
    return nil
end

local function guessType(value)
    local kind = math.type(value) or type(value)
    if isbuffer(value) then return typeCode 'buffer' end
    local word = ({integer = 'int', float = 'float', string = 'string', boolean = 'bool', table = 'table'})[kind]
    return word and typeCode(word)
end

--- Sets a property of any type.
-- @api sim.setProperty(int target, string name, any value, int type = nil)
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param name of the property; new ones only below customData
-- @param value of the right kind
-- @param type for custom data only: sim.propertytype_*, or the word after it
function M.setProperty(target, name, value, ptype)
    if name:find('^customData%.') then
        if type(ptype) == 'string' then ptype = typeCode(ptype) end
        local kind = ptype or guessType(value) or refuse('unsupported property type: ' .. type(value))
        return setter(kind)(target, name, value)
    end
    if ptype ~= nil then refuse('cannot specify type for static properties') end
    local known = sim.getPropertyInfo(target, name) or refuse('no such property: ' .. name)
    setter(known)(target, name, value)
end

local function names(target)
    local index = -1
    return function()
        index = index + 1
        return (sim.getPropertyName(target, index))
    end
end

--- All properties of a target.
-- @api map values = sim.getProperties(int target, map options = {})
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param options skipLarge: leave out properties with much data
-- @return values by name
function M.getProperties(target, options)
    local values = {}
    for name in names(target) do
        local ptype, flags = sim.getPropertyInfo(target, name)
        local skipped = flags & NOT_READABLE ~= 0 or (options and options.skipLarge and flags & LARGE_DATA ~= 0)
        local get = getter(ptype)
        if get and not skipped then values[name] = get(target, name, {noError = true}) end
    end
    return values
end

--- Sets several properties.
-- @api sim.setProperties(int target, map values)
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param values by name; those that cannot be written are left out
function M.setProperties(target, values)
    for name, value in pairs(values) do
        local _, flags = sim.getPropertyInfo(target, name)
        if not flags or flags & NOT_WRITABLE == 0 then M.setProperty(target, name, value) end
    end
end

--- Type, flags and description of one property, as a table.
-- @api map info = sim.getPropertyInfos(int target, string name, map options = {})
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param name of the property
-- @param options as in sim.getPropertyInfo
-- @return info with type, infoTxt and flags, a table of value, readable, writable, removable and large; nil without such a property
function M.getPropertyInfos(target, name, options)
    local ptype, flags, text = sim.getPropertyInfo(target, name, options or {})
    if not ptype then return nil end
    local is = {
        value = flags, readable = flags & NOT_READABLE == 0, writable = flags & NOT_WRITABLE == 0,
        removable = flags & REMOVABLE ~= 0, large = flags & LARGE_DATA ~= 0,
    }
    return {type = ptype, flags = is, infoTxt = text}
end

--- Type, flags and description of all properties.
-- @api map infos = sim.getPropertiesInfos(int target, map options = {})
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param options as in sim.getPropertyInfo
-- @return infos by name, as from sim.getPropertyInfos
function M.getPropertiesInfos(target, options)
    local infos = {}
    for name in names(target) do infos[name] = M.getPropertyInfos(target, name, options) end
    return infos
end

local function evaluated(text)
    local chunk = load('return ' .. text, '=value', 't', {})
    return chunk and chunk()
end

--- The same value in another type of property, through text where needed.
-- @api any value = sim.convertPropertyValue(any value, int fromType, int toType)
-- @param value in the first type
-- @param fromType sim.propertytype_*
-- @param toType sim.propertytype_*
-- @return value in the second type; an error if there is no sensible one, such as a boolean's number
function M.convertPropertyValue(value, fromType, toType)
    local to = TYPES[toType] and TYPES[toType][1]
    if fromType == toType or value == nil then return value end
    if to == 'string' then
        if type(value) == 'string' or isbuffer(value) then return tostring(value) end
        return getAsString(value)
    end
    if to == 'buffer' then return tobuffer(type(value) == 'string' and value or getAsString(value)) end
    if type(value) == 'string' or isbuffer(value) then value = evaluated(tostring(value)) end
    if to == 'bool' then return type(value) == 'number' and value ~= 0 or value == true end
    if value == nil then return nil end -- a text without a value
    if type(value) == 'number' and (to == 'int' or to == 'long') then return math.floor(value) end
    if type(value) == 'number' and to == 'float' then return value + 0.0 end
    if type(value) == 'table' and not ({int = 1, long = 1, float = 1})[to] then return value end
    error('unsupported conversion of a property value', 2)
end

local TABLE_ARGS = {{type = 'int'}, {type = 'string'}, {type = 'table'}, {type = 'table', default = {}}}

--- Sets a property that holds a table.
-- @api sim.setTableProperty(int target, string name, map value, map options = {})
-- @param target object, sim.handle_scene, sim.handle_app, ...
-- @param name of the property
-- @param value the table
-- @param options noError: no error if the property cannot be written
function M.setTableProperty(...)
    local target, name, value, options = ...
    local isComplete = select('#', ...) == 3 and math.type(target) == 'integer' and type(name) == 'string'
    if not (isComplete and type(value) == 'table') then
        target, name, value, options = require('checkargs.check')(TABLE_ARGS, ...)
    end
    sim._setTableProperty(target, name, value, options)
end

return M
