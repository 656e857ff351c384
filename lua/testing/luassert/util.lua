--[[
Comparing and copying tables, as the assertions do.

    local util = require 'luassert.util'
    util.deepcompare(a, b, ignore_mt)   whether two values are alike; if not, also the keys that lead to the first difference,
                                        the innermost first. Equality by metatables counts unless `ignore_mt` is true
    util.deepcopy(t)                    a copy of a table and of those in it, with their metatables
    util.deepcopy(t, true)              the same with copies of their metatables
    util.shallowcopy(t, deepmt)         a copy of one table; with `deepmt` also of its metatable
    util.callable(x), util.hastostring(x)
    util.pack(...), util.unpack(list, first, last)      lists with their length in `n`
    util.tinsert(list [, index], value), util.tremove(list [, index])       for such lists
]]

local sortedKeys = require 'luassert.keys'

-- Unlike `getmetatable` not turned away by a field `__metatable`.
local metatableOf = debug.getmetatable

local util = {}

util.pack = table.pack

-- @api any values = luassert.util.unpack(table list, int first = 1, int last = nil)
function util.unpack(list, first, last) return table.unpack(list, first or 1, last or list.n or #list) end

-- @api luassert.util.tinsert(table list, ...)
function util.tinsert(list, ...)
    local index, value = ...
    list.n = (list.n or #list) + 1
    if select('#', ...) < 2 then index, value = list.n, index end
    table.move(list, index, list.n - 1, index + 1)
    list[index] = value
end

-- @api any value = luassert.util.tremove(table list, int index = nil)
function util.tremove(list, index)
    local count = list.n or #list
    index = index or count
    local value = list[index]
    table.move(list, index + 1, count + 1, index)
    list.n = math.max(count - 1, 0)
    return value
end

-- @api bool result = luassert.util.callable(any value)
function util.callable(value)
    if type(value) == 'function' then return true end
    local metatable = metatableOf(value)
    return metatable ~= nil and util.callable(rawget(metatable, '__call'))
end

-- @api bool result = luassert.util.hastostring(any value)
function util.hastostring(value)
    local metatable = metatableOf(value)
    return metatable ~= nil and type(rawget(metatable, '__tostring')) == 'function'
end

-- The metamethod that says whether two tables are equal, if both have the same.
local function equality(a, b)
    local metatable, other = metatableOf(a), metatableOf(b)
    if not (metatable and other) then return nil end
    local method = rawget(metatable, '__eq')
    return method == rawget(other, '__eq') and method or nil
end

-- Notes that two tables are being compared; whether that was noted before.
local function meet(met, a, b)
    met[a] = met[a] or {}
    local before = met[a][b]
    met[a][b] = true
    return before
end

local compareTables

local function compare(a, b, search)
    if rawequal(a, b) then return true end
    if type(a) ~= 'table' or type(b) ~= 'table' then return a == b end
    if not search.ignoresMetatables and equality(a, b) then return a == b end
    -- Tables met again are part of themselves, and differ only if something else in them does.
    return meet(search.met, a, b) or compareTables(a, b, search)
end

local function differAt(key, search)
    if search.path then table.insert(search.path, key) end
    return false
end

function compareTables(a, b, search)
    for key, value in search.each(a) do
        if not compare(value, rawget(b, key), search) then return differAt(key, search) end
    end
    for key in search.each(b) do
        if rawget(a, key) == nil then return differAt(key, search) end
    end
    return true
end

local function inAnyOrder(t) return next, t end

local function inOrder(t)
    local keys, i = sortedKeys(t), 0
    return function()
        i = i + 1
        local key = keys[i]
        if key ~= nil then return key, rawget(t, key) end
    end
end

-- @api bool equal = luassert.util.deepcompare(any a, any b, bool ignore_mt = false)
function util.deepcompare(a, b, ignore_mt)
    if compare(a, b, {each = inAnyOrder, met = {}, ignoresMetatables = ignore_mt}) then return true end
    local path = {}
    compare(a, b, {each = inOrder, met = {}, ignoresMetatables = ignore_mt, path = path})
    if #path == 0 then return false end
    return false, path
end

-- Whether two of the values are the same, or alike when `deep`.
local function isAmong(value, others, deep)
    for _, other in ipairs(others) do
        if value == other or deep and util.deepcompare(value, other, true) then return true end
    end
    return false
end

--- Whether no value of a table is there twice. With `deep`, tables are the same that are alike.
-- @api table list = luassert.util.unique(table t, bool deep = false)
function util.unique(t, deep)
    local plain, objects = {}, {}
    for _, value in next, t do
        local isObject = type(value) == 'table' or type(value) == 'userdata'
        if isObject and isAmong(value, objects, deep) or plain[value] then return false end
        if isObject then
            objects[#objects + 1] = value
        elseif value == value then
            plain[value] = true
        end
    end
    return true
end

-- @api any copy = luassert.util.shallowcopy(any t, bool deepmt = false)
function util.shallowcopy(t, deepmt)
    if type(t) ~= 'table' then return t end
    local copy = {}
    for key, value in next, t do copy[key] = value end
    local metatable = metatableOf(t)
    return setmetatable(copy, deepmt and util.shallowcopy(metatable) or metatable)
end

-- Objects with a finalizer stay themselves: it must not run once more for a copy.
local function isFinalized(t)
    local metatable = metatableOf(t)
    return metatable ~= nil and rawget(metatable, '__gc') ~= nil
end

local function copyDeep(value, deepmt, copies)
    if type(value) ~= 'table' or isFinalized(value) then return value end
    if copies[value] then return copies[value] end
    local copy, metatable = {}, metatableOf(value)
    copies[value] = copy
    for key, element in next, value do copy[key] = copyDeep(element, deepmt, copies) end
    return setmetatable(copy, deepmt and copyDeep(metatable, deepmt, copies) or metatable)
end

-- @api any copy = luassert.util.deepcopy(any t, bool deepmt = false)
function util.deepcopy(t, deepmt) return copyDeep(t, deepmt, {}) end

return util
