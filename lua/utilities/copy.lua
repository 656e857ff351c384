--[[
Copies of values.

An object whose metatable has __copy or __deepcopy is copied by that.
]]

local tablex = require 'tablex.functions'

local copy = {}

local function own(o, name)
    local meta = type(o) == 'table' and getmetatable(o)
    return type(meta) == 'table' and meta[name]
end

--- A copy with the same elements.
-- @api any result = copy.copy(any o, any opts = nil)
function copy.copy(o, opts)
    local byObject = own(o, '__copy')
    if byObject then return byObject(o, opts) end
    return tablex.clone(o)
end

--- A copy in which tables are copied too; a table that occurs twice is copied once.
-- @api any result = copy.deepcopy(any o, any opts = nil, table copies = {})
function copy.deepcopy(o, opts, copies)
    if type(o) ~= 'table' then return o end
    copies = copies or {}
    if copies[o] then return copies[o] end
    local byObject = own(o, '__deepcopy')
    local result = byObject and byObject(o, opts, copies) or {}
    copies[o] = result
    if byObject then return result end
    for key, value in next, o do result[copy.deepcopy(key, opts, copies)] = copy.deepcopy(value, opts, copies) end
    return setmetatable(result, getmetatable(o))
end

function copy.unittest()
    local inner = {1}
    local t = {inner, inner, x = {2}}
    t.self = t
    local shallow, deep = copy.copy(t), copy.deepcopy(t)
    assert(shallow[1] == inner and deep[1] ~= inner and deep[1] == deep[2] and deep.self == deep and deep.x[1] == 2)
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return copy
