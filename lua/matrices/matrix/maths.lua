--[[
Functions of the elements of a Matrix: one by one, two by two, and over rows and columns.
]]

local Matrix = require 'matrix.core'

local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end

--- f(i, j, element) of each element.
function Matrix:applyfuncidx(f)
    return Matrix(self._rows, self._cols, function(i, j) return f(i, j, self:get(i, j)) end)
end

function Matrix:applyfunc(f)
    return Matrix(self._rows, self._cols, function(i, j) return f(self:get(i, j)) end)
end

function Matrix:applyfunc2(m2, f)
    if not self:sameshape(m2) then
        error(('Matrix: shapes differ: %d x %d, %d x %d'):format(self._rows, self._cols, m2._rows, m2._cols), 3)
    end
    return Matrix(self._rows, self._cols, function(i, j) return f(self:get(i, j), m2:get(i, j)) end)
end

--- op of the elements of two matrices, or of each element and a number.
function Matrix:binop(m, op)
    if isMatrix(m) then return self:applyfunc2(m, op) end
    return self:applyfunc(function(x) return op(x, m) end)
end

for _, name in ipairs{'abs', 'acos', 'asin', 'ceil', 'cos', 'deg', 'exp', 'floor', 'rad', 'sin', 'sqrt', 'tan', 'tointeger'} do
    local f = math[name]
    Matrix[name] = function(self) return self:applyfunc(f) end
end

function Matrix:atan(m) return m and self:binop(m, math.atan) or self:applyfunc(math.atan) end
function Matrix:fmod(m) return self:binop(m, math.fmod) end
function Matrix:ult(m2) return self:binop(m2, math.ult) end
function Matrix:isnan() return self:applyfunc(function(x) return x ~= x end) end

function Matrix:log(base)
    return self:applyfunc(function(x) return base and math.log(x, base) or math.log(x) end)
end

-- The generator of the script: same numbers in every run.
local function randomFloat() return (package.loaded.sim or require 'sim').getRandom() end

--- Random numbers in the shape of the matrix: from 0 to 1, or integers from a to b (1 to a).
function Matrix:random(a, b)
    if a and not b then a, b = 1, a end
    return self:applyfunc(function()
        local x = randomFloat()
        return a and a + math.floor(x * (b - a + 1)) or x
    end)
end

local OPERATORS = {
    add = function(a, b) return a + b end,
    sub = function(a, b) return a - b end,
    times = function(a, b) return a * b end,
    div = function(a, b) return a / b end,
    idiv = function(a, b) return a // b end,
    mod = function(a, b) return a % b end,
    pow = function(a, b) return a ^ b end,
    eq = function(a, b) return a == b end,
    ne = function(a, b) return a ~= b end,
    lt = function(a, b) return a < b end,
    gt = function(a, b) return a > b end,
    le = function(a, b) return a <= b end,
    ge = function(a, b) return a >= b end,
}

for name, op in pairs(OPERATORS) do
    Matrix[name] = function(self, m) return self:binop(m, op) end
end

for _, name in ipairs{'add', 'sub', 'div', 'idiv', 'mod', 'pow'} do
    local op = OPERATORS[name]
    Matrix['__' .. name] = function(a, b)
        if isMatrix(a) then return a:binop(b, op) end
        return b:applyfunc(function(x) return op(a, x) end)
    end
end

function Matrix:__unm() return self:applyfunc(function(x) return -x end) end

---------------------------------------------------------------- over rows and columns

-- f of the numbers of each column (dim 1) or row (2), or of all.
local function along(m, dim, f)
    if not dim then return f(m:data()) end
    if dim == 1 then return Matrix(1, m._cols, function(_, j) return f(m:col(j):data()) end) end
    if dim ~= 2 then error('Matrix: the dimension is 1 or 2', 3) end
    return Matrix(m._rows, 1, function(i) return f(m:row(i):data()) end)
end

--- op(...op(op(start, x1), x2)..., xn) of each column (dim 1), of each row (2), or of all elements.
function Matrix:fold(dim, start, op)
    return along(self, dim, function(values)
        local result = start
        for _, x in ipairs(values) do result = op(result, x) end
        return result
    end)
end

function Matrix:sum(dim) return self:fold(dim, 0, OPERATORS.add) end
function Matrix:prod(dim) return self:fold(dim, 1, OPERATORS.times) end

function Matrix:mean(dim)
    local count = not dim and self:count() or dim == 1 and self._rows or self._cols
    return self:sum(dim) / count
end

function Matrix:_minmax(dim, better, choose)
    if isMatrix(dim) then return self:applyfunc2(dim, choose) end
    return along(self, dim, function(values)
        local best = values[1]
        for _, x in ipairs(values) do
            if better(x, best) then best = x end
        end
        return best
    end)
end

--- Smallest element; of each column (1) or row (2); or of each pair of elements with another matrix.
function Matrix:min(dim_or_mtx2) return self:_minmax(dim_or_mtx2, OPERATORS.lt, math.min) end
function Matrix:max(dim_or_mtx2) return self:_minmax(dim_or_mtx2, OPERATORS.gt, math.max) end

local function identity(x) return x end

--- Whether f (default: the element itself) is true for all elements; 0 is not.
function Matrix:all(f)
    f = f or identity
    for _, x in ipairs(self:data()) do
        local value = f(x)
        if not value or value == 0 then return false end
    end
    return true
end

function Matrix:any(f)
    f = f or identity
    for _, x in ipairs(self:data()) do
        local value = f(x)
        if value and value ~= 0 then return true end
    end
    return false
end

--- Row and column of the elements that are neither 0 nor false, one per row.
function Matrix:nonzero()
    local places = {}
    self:applyfuncidx(function(i, j, x)
        if x and x ~= 0 then table.move({i, j}, 1, 2, #places + 1, places) end
        return 0
    end)
    return Matrix(#places // 2, 2, places)
end

--- Elements of x where cond is true, else of y; both may be numbers.
function Matrix:where(cond, x, y)
    if y == nil then cond, x, y = self, cond, x end
    return cond:applyfuncidx(function(i, j, c)
        local source = c and c ~= 0 and x
        if not source then source = y end
        return isMatrix(source) and source:get(i, j) or source
    end)
end

return Matrix
