--[[
The functions of the module functional, which are global in every script. They work on arrays; nothing here is lazy.
]]

local M = {}

--- range(to), range(from, to), range(from, to, step): the numbers, both ends included.
-- @api float[] result = functional.range(float from, float to = nil, float step = 1)
function M.range(from, to, step)
    if to == nil then from, to = 1, from end
    local result = {}
    for i = from, to, step or 1 do result[#result + 1] = i end
    return result
end

local function shortest(tables)
    local n = math.huge
    for i = 1, #tables do n = math.min(n, #tables[i]) end
    return n == math.huge and 0 or n
end

local function row(tables, i)
    local values = {}
    for k = 1, #tables do values[k] = tables[k][i] end
    return values
end

--- Table of f(a[i], b[i], ...).
-- @api table result = functional.map(func f, ...)
function M.map(f, ...)
    local tables, result = {...}, {}
    for i = 1, shortest(tables) do result[i] = f(table.unpack(row(tables, i), 1, #tables)) end
    return result
end

--- Folds from the left: f(... f(f(initial, t[1]), t[2]) ..., t[#t]).
-- @api any result = functional.reduce(func f, table t, any initial = 0)
function M.reduce(f, t, initial)
    local result = initial == nil and 0 or initial
    for _, value in ipairs(t) do result = f(result, value) end
    return result
end

--- The elements for which f is true.
-- @api table result = functional.filter(func f, table t)
function M.filter(f, t)
    local result = {}
    for _, value in ipairs(t) do
        if f(value) then result[#result + 1] = value end
    end
    return result
end

--- Calls f(a[i], b[i], ...) for all elements.
-- @api functional.foreach(func f, ...)
function M.foreach(f, ...)
    local tables = {...}
    for i = 1, shortest(tables) do f(table.unpack(row(tables, i), 1, #tables)) end
end

--- Its arguments.
-- @api any... result = functional.identity(...)
function M.identity(...) return ... end

--- Rows of several tables: zip({1, 2}, {3, 4}) is {{1, 3}, {2, 4}}.
-- @api table rows = functional.zip(...)
function M.zip(...)
    local tables, result = {...}, {}
    for i = 1, shortest(tables) do result[i] = row(tables, i) end
    return result
end

--- A function that returns `not f(...)`.
-- @api func result = functional.negate(func f)
function M.negate(f) return function(...) return not f(...) end end

--- Calls f with the elements of the last argument appended to the others.
-- @api any... result = functional.apply(func f, ...)
function M.apply(f, ...)
    local values = {...}
    local last = table.remove(values)
    for _, value in ipairs(last) do values[#values + 1] = value end
    return f(table.unpack(values))
end

--- f with its first arguments fixed.
-- @api func result = functional.partial(func f, ...)
function M.partial(f, ...)
    local fixed = table.pack(...)
    return function(...)
        local values, more = table.move(fixed, 1, fixed.n, 1, {}), table.pack(...)
        table.move(more, 1, more.n, fixed.n + 1, values)
        return f(table.unpack(values, 1, fixed.n + more.n))
    end
end

--- Whether f (default: the value itself) is true for some element.
-- @api bool result = functional.any(func f, table t = nil)
function M.any(f, t)
    if t == nil then f, t = M.identity, f end
    for _, value in ipairs(t) do
        if f(value) then return true end
    end
    return false
end

--- Whether f (default: the value itself) is true for all elements.
-- @api bool result = functional.all(func f, table t = nil)
function M.all(f, t)
    if t == nil then f, t = M.identity, f end
    for _, value in ipairs(t) do
        if not f(value) then return false end
    end
    return true
end

--- Iterator over the elements, without the index.
-- @api func next = functional.iter(table t)
function M.iter(t)
    local i = 0
    return function()
        i = i + 1
        return t[i]
    end
end

local reified = 0

--- Makes a function global, for interfaces that want a name, and returns the name.
-- @api string name = functional.reify(func f, string name = nil)
function M.reify(f, name)
    if type(f) == 'string' then return f end
    if not name then
        reified = reified + 1
        name = '__reified' .. reified
    end
    _G[name] = f
    return name
end

M.operator = {
    add = function(a, b) return a + b end,
    sub = function(a, b) return a - b end,
    mul = function(a, b) return a * b end,
    div = function(a, b) return a / b end,
    mod = function(a, b) return a % b end,
    idiv = function(a, b) return a // b end,
    pow = function(a, b) return a ^ b end,
    unm = function(a) return -a end,
    land = function(a, b) return a & b end,
    lor = function(a, b) return a | b end,
    lxor = function(a, b) return a ~ b end,
    lnot = function(a) return ~a end,
    lshl = function(a, b) return a << b end,
    lshr = function(a, b) return a >> b end,
    concat = function(a, b) return a .. b end,
    len = function(a) return #a end,
    eq = function(a, b) return a == b end,
    neq = function(a, b) return a ~= b end,
    gt = function(a, b) return a > b end,
    ge = function(a, b) return a >= b end,
    lt = function(a, b) return a < b end,
    le = function(a, b) return a <= b end,
}

--- The sum of the elements, and of an initial value.
-- @api float result = functional.sum(float[] t, float initial = 0)
function M.sum(t, initial) return M.reduce(M.operator.add, t, initial) end

--- The product of the elements and an initial value. CoppeliaSim begins with 0 without one, as in reduce: give it 1.
-- @api float result = functional.prod(float[] t, float initial = 0)
function M.prod(t, initial) return M.reduce(M.operator.mul, t, initial) end

function M.unittest()
    local double = function(x) return 2 * x end
    local same = require('tablex.functions').eq
    assert(same(M.map(double, {1, 2}), {2, 4}) and same(M.range(2, 6, 2), {2, 4, 6}) and M.sum{1, 2, 3} == 6)
    assert(M.prod({2, 3}, 1) == 6 and M.prod{2, 3} == 0 and M.reduce(math.max, {-2, -1}) == 0 and M.reduce(math.max, {-2, -1}, -9) == -1)
    assert(same(M.filter(function(x) return x > 1 end, {1, 2, 3}), {2, 3}) and same(M.zip({1, 2}, {3, 4}), {{1, 3}, {2, 4}}))
    assert(M.partial(math.max, 5)(3) == 5 and M.any(M.identity, {false, true}) and not M.all(M.identity, {false, true}))
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return M
