--[[
The functions of the module tablex. They come into the global table the first time one of them is asked for.
]]

local M = {}
local floor, min = math.floor, math.min

--- Number of elements, as in Lua 5.0.
-- @api int n = tablex.getn(table t)
function M.getn(t) return #t end

--- Without effect; for old code.
-- @api tablex.setn(...)
function M.setn() end

--- Unpacks up to n values starting at i.
-- @api any... values = tablex.unpackx(table t, int n = nil, int i = 1)
function M.unpackx(t, n, i)
    i = i or 1
    return table.unpack(t, i, n and i + n - 1 or #t)
end

--- A function that looks keys up in t.
-- @api func result = tablex.index(table t)
function M.index(t) return function(key) return t[key] end end

--- Whether two values are equal, tables by content. Anything that is not a table is not compared: false.
-- @api bool result = tablex.eq(any a, any b)
function M.eq(a, b)
    if type(a) ~= 'table' or type(b) ~= 'table' then return false end
    local function same(x, y)
        if type(x) == 'table' and type(y) == 'table' then return rawequal(x, y) or M.eq(x, y) end
        return x == y
    end
    for key, value in pairs(a) do
        if not same(value, b[key]) then return false end
    end
    for key in pairs(b) do
        if a[key] == nil then return false end
    end
    return true
end

--- The keys of a table.
-- @api table keys = tablex.keys(table t)
function M.keys(t)
    local keys = {}
    for key in pairs(t) do keys[#keys + 1] = key end
    return keys
end

--- The values of a table.
-- @api table values = tablex.values(table t)
function M.values(t)
    local values = {}
    for _, value in pairs(t) do values[#values + 1] = value end
    return values
end

--- The entries whose key starts with opts.matchKeyPrefix.
-- @api table result = tablex.filter(table t, table opts = {})
function M.filter(t, opts)
    opts = opts or {}
    local prefix, result = opts.matchKeyPrefix or '', {}
    for key, value in pairs(t) do
        if type(key) == 'string' and key:sub(1, #prefix) == prefix then
            result[opts.stripKeyPrefix and key:sub(#prefix + 1) or key] = value
        end
    end
    return result
end

--- Values become keys.
-- @api table result = tablex.invert(table t, table opts = {})
function M.invert(t, opts)
    local result = {}
    for key, value in pairs(t) do
        if result[value] ~= nil and not (opts and opts.errorOnClash == false) then
            error('value occurs more than once: ' .. tostring(value), 2)
        end
        result[value] = key
    end
    return result
end

--- Whether the keys of a table are 1 to n.
-- @api bool result = tablex.isarray(table t)
function M.isarray(t)
    local count = 0
    for key in pairs(t) do
        if math.type(key) ~= 'integer' or key < 1 then return false end
        count = count + 1
    end
    return count == 0 or t[count] ~= nil
end

--- Text of the elements with sep between them; strings are not quoted.
-- @api string text = tablex.join(table t, string sep = ', ')
function M.join(t, sep)
    local parts = {}
    for i = 1, #t do parts[i] = getAsDisplayString(t[i]) end
    return table.concat(parts, sep or ', ')
end

--- The text of a table; with a separator, that between its entries.
-- @api string text = tablex.tostring(table t, string sep = nil)
function M.tostring(t, sep)
    if not sep then return getAsString(t) end
    local parts, n = {}, #t
    for i = 1, n do parts[i] = getAsString(t[i]) end
    for key, value in pairs(t) do
        local isElement = math.type(key) == 'integer' and key >= 1 and key <= n
        if not isElement then parts[#parts + 1] = tostring(key) .. ' = ' .. getAsString(value) end
    end
    return '{' .. table.concat(parts, sep) .. '}'
end

--- Prints a table.
-- @api tablex.print(table t)
function M.print(t) print(t) end

--- The elements from an index to another.
-- @api table result = tablex.slice(table t, int first = 1, int last = #t, int step = 1)
function M.slice(t, first, last, step)
    local result = {}
    for i = first or 1, last or #t, step or 1 do result[#result + 1] = t[i] end
    return result
end

--- Index of item, or nothing.
-- @api int index = tablex.find(table t, any item, func equals = nil)
function M.find(t, item, equals)
    for i = 1, #t do
        if equals and equals(t[i], item) or not equals and t[i] == item then return i end
    end
end

--- -1, 0 or 1 by the first element that differs.
-- @api int order = tablex.compare(table a, table b, func compare = nil)
function M.compare(a, b, compare)
    compare = compare or function(x, y) return x < y and -1 or x > y and 1 or 0 end
    for i = 1, min(#a, #b) do
        local order = compare(a[i], b[i])
        if order ~= 0 then return order end
    end
    return #a < #b and -1 or #a > #b and 1 or 0
end

--- The elements in reverse order.
-- @api table result = tablex.reversed(table t)
function M.reversed(t)
    local result = {}
    for i = #t, 1, -1 do result[#result + 1] = t[i] end
    return result
end

--- A sorted copy.
-- @api table result = tablex.sorted(table t, func compare = nil)
function M.sorted(t, compare)
    local result = table.move(t, 1, #t, 1, {})
    table.sort(result, compare)
    return result
end

--- A copy whose elements are the same values.
-- @api any copy = tablex.clone(any t)
function M.clone(t)
    if type(t) ~= 'table' then return t end
    local copy = {}
    for key, value in next, t do copy[key] = value end
    return setmetatable(copy, getmetatable(t))
end

--- A copy in which tables are copied too; a table met twice is copied once.
-- @api any copy = tablex.deepcopy(any t, any opts = nil, table copies = {})
function M.deepcopy(t, opts, copies)
    if type(t) ~= 'table' then return t end
    copies = copies or {}
    if copies[t] then return copies[t] end
    local copy = {}
    copies[t] = copy
    for key, value in next, t do copy[M.deepcopy(key, opts, copies)] = M.deepcopy(value, opts, copies) end
    return setmetatable(copy, getmetatable(t))
end

--- A new table with the elements of all.
-- @api table result = tablex.add(...)
function M.add(...)
    local result = {}
    M.extend(result, ...)
    return result
end

--- Appends the elements of the other tables to t.
-- @api tablex.extend(table t, ...)
function M.extend(t, ...)
    for _, other in ipairs{...} do table.move(other, 1, #other, #t + 1, t) end
end

--- A list with a value several times.
-- @api table result = tablex.rep(any value, int size)
function M.rep(value, size)
    local result = {}
    for i = 1, size do result[i] = value end
    return result
end

--- Tables of n elements each, the last one with the rest.
-- @api table result = tablex.batched(table t, int n)
function M.batched(t, n)
    local result = {}
    for i = 1, #t, n do result[#result + 1] = table.move(t, i, min(i + n - 1, #t), 1, {}) end
    return result
end

--- Nested maps become one map with keys like a.b.c.
-- @api table result = tablex.flatten(table t, table opts = {})
function M.flatten(t, opts, prefix, result)
    result = result or {}
    for key, value in pairs(t) do
        local name = prefix and prefix .. '.' .. tostring(key) or key
        if type(value) == 'table' and not isbuffer(value) and next(value) ~= nil and not M.isarray(value) then
            M.flatten(value, opts, tostring(name), result)
        else
            result[name] = value
        end
    end
    return result
end

--- The reverse of flatten.
-- @api table result = tablex.unflatten(table t)
function M.unflatten(t)
    local result = {}
    for key, value in pairs(t) do
        local owner, last = result, key
        if type(key) == 'string' then
            local path
            path, last = key:match('^(.-)([^.]*)$')
            for name in path:gmatch('[^.]+') do
                owner[name] = type(owner[name]) == 'table' and owner[name] or {}
                owner = owner[name]
            end
        end
        owner[last] = value
    end
    return result
end

--- Replaces elements that are tables by their elements, depth times.
-- @api table result = tablex.collapse(table t, int depth = 1)
function M.collapse(t, depth)
    local result = t
    for _ = 1, depth or 1 do
        local flat = {}
        for _, value in ipairs(result) do
            if type(value) == 'table' then M.extend(flat, value) else flat[#flat + 1] = value end
        end
        result = flat
    end
    return result
end

--- Copies the entries of the other tables into t.
-- @api table t = tablex.update(table t, ...)
function M.update(t, ...)
    for _, other in ipairs{...} do
        for key, value in pairs(other) do t[key] = value end
    end
    return t
end

--- Pairs {key, value}; sorted by key if opts.sort.
-- @api table items = tablex.items(table t, table opts = {})
function M.items(t, opts)
    local result = {}
    for key, value in pairs(t) do result[#result + 1] = {key, value} end
    if opts and opts.sort then table.sort(result, function(a, b) return tostring(a[1]) < tostring(b[1]) end) end
    return result
end

--- The table of a list of pairs {key, value}, or of an iterator such as pairs(t).
-- @api table result = tablex.frompairs(any items, any state = nil, any key = nil)
function M.frompairs(items, state, key)
    local result = {}
    if type(items) == 'function' then
        for name, value in items, state, key do result[name] = value end
    else
        for _, item in ipairs(items) do result[item[1]] = item[2] end
    end
    return result
end

--- A table of the values of an iterator such as ipairs(t).
-- @api table result = tablex.fromipairs(func iterator, any state, any index)
function M.fromipairs(iterator, state, index)
    local result = {}
    for _, value in iterator, state, index do result[#result + 1] = value end
    return result
end

--- Index at which an element would keep a sorted table sorted.
-- @api int index = tablex.bisect(table t, any value)
function M.bisect(t, value)
    local low, high = 1, #t + 1
    while low < high do
        local middle = floor((low + high) / 2)
        if t[middle] < value then low = middle + 1 else high = middle end
    end
    return low
end

function M.unittest()
    assert(M.eq({1, {a = 2}}, {1, {a = 2}}) and not M.eq({1}, {1, 2}) and M.isarray{1, 2} and not M.isarray{a = 1})
    assert(M.eq(M.slice({1, 2, 3, 4}, 2, 4, 2), {2, 4}) and M.eq(M.flatten{a = {b = 1}}, {['a.b'] = 1}))
    assert(M.eq(M.batched({1, 2, 3}, 2), {{1, 2}, {3}}) and M.compare({1, 2}, {1, 3}) == -1 and M.find({5, 6}, 6) == 2)
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return M
