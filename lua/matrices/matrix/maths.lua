--[[
Functions of the elements of a Matrix: one by one, two by two, and over rows and columns.
]]

local Matrix = require 'matrix.core'

local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end

--- f(i, j, element) of each element.
-- @api Matrix m = Matrix:applyfuncidx(func f)
function Matrix:applyfuncidx(f)
    return Matrix(self._rows, self._cols, function(i, j) return f(i, j, self:item(i, j)) end)
end

--- f(element) of each element.
-- @api Matrix m = Matrix:applyfunc(func f)
function Matrix:applyfunc(f)
    return Matrix(self._rows, self._cols, function(i, j) return f(self:item(i, j)) end)
end

--- f(a, b) of the elements of two matrices.
-- @api Matrix m = Matrix:applyfunc2(Matrix m2, func f)
function Matrix:applyfunc2(m2, f)
    if not self:sameshape(m2) then
        error(('Matrix: shapes differ: %d x %d, %d x %d'):format(self._rows, self._cols, m2._rows, m2._cols), 3)
    end
    return Matrix(self._rows, self._cols, function(i, j) return f(self:item(i, j), m2:item(i, j)) end)
end

--- op of the elements of two matrices, or of each element and a number.
-- @api Matrix m = Matrix:binop(any m, func op)
function Matrix:binop(m, op)
    if isMatrix(m) then return self:applyfunc2(m, op) end
    return self:applyfunc(function(x) return op(x, m) end)
end

--- The function of `math` of each element.
-- @api Matrix m = Matrix:abs()
-- @api Matrix m = Matrix:acos()
-- @api Matrix m = Matrix:asin()
-- @api Matrix m = Matrix:ceil()
-- @api Matrix m = Matrix:cos()
-- @api Matrix m = Matrix:deg()
-- @api Matrix m = Matrix:exp()
-- @api Matrix m = Matrix:floor()
-- @api Matrix m = Matrix:rad()
-- @api Matrix m = Matrix:sin()
-- @api Matrix m = Matrix:sqrt()
-- @api Matrix m = Matrix:tan()
-- @api Matrix m = Matrix:tointeger()
for _, name in ipairs{'abs', 'acos', 'asin', 'ceil', 'cos', 'deg', 'exp', 'floor', 'rad', 'sin', 'sqrt', 'tan', 'tointeger'} do
    local f = math[name]
    Matrix[name] = function(self) return self:applyfunc(f) end
end

--- The arc tangent of each element, or of its quotient with that of another matrix.
-- @api Matrix m = Matrix:atan(any m = nil)
function Matrix:atan(m) return m and self:binop(m, math.atan) or self:applyfunc(math.atan) end

--- The remainder of each element, with its sign.
-- @api Matrix m = Matrix:fmod(any m)
function Matrix:fmod(m) return self:binop(m, math.fmod) end

--- Whether each element is smaller as an unsigned integer.
-- @api Matrix m = Matrix:ult(any m2)
function Matrix:ult(m2) return self:binop(m2, math.ult) end

--- Whether each element is not a number.
-- @api Matrix m = Matrix:isnan()
function Matrix:isnan() return self:applyfunc(function(x) return x ~= x end) end

--- The logarithm of each element.
-- @api Matrix m = Matrix:log(float base = nil)
function Matrix:log(base)
    return self:applyfunc(function(x) return base and math.log(x, base) or math.log(x) end)
end

-- The generator of the script: same numbers in every run.
local function randomFloat() return _quietRequire('sim').getRandom() end

--- Random numbers in the shape of the matrix: from 0 to 1, or integers from a to b (1 to a).
-- @api Matrix m = Matrix:random(int a = nil, int b = nil)
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

--- The operator on the elements of two matrices, or on each element and a number.
-- @api Matrix m = Matrix:add(any m)
-- @api Matrix m = Matrix:sub(any m)
-- @api Matrix m = Matrix:times(any m)
-- @api Matrix m = Matrix:div(any m)
-- @api Matrix m = Matrix:idiv(any m)
-- @api Matrix m = Matrix:mod(any m)
-- @api Matrix m = Matrix:pow(any m)
-- @api Matrix m = Matrix:eq(any m)
-- @api Matrix m = Matrix:ne(any m)
-- @api Matrix m = Matrix:lt(any m)
-- @api Matrix m = Matrix:gt(any m)
-- @api Matrix m = Matrix:le(any m)
-- @api Matrix m = Matrix:ge(any m)
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
-- @api any result = Matrix:fold(int dim, float start, func op)
function Matrix:fold(dim, start, op)
    return along(self, dim, function(values)
        local result = start
        for _, x in ipairs(values) do result = op(result, x) end
        return result
    end)
end

--- The sum of all elements, of each column (dim 1) or of each row (2).
-- @api any result = Matrix:sum(int dim = nil)
function Matrix:sum(dim) return self:fold(dim, 0, OPERATORS.add) end

--- The product of all elements, of each column (dim 1) or of each row (2).
-- @api any result = Matrix:prod(int dim = nil)
function Matrix:prod(dim) return self:fold(dim, 1, OPERATORS.times) end

--- The mean of all elements, of each column (dim 1) or of each row (2).
-- @api any result = Matrix:mean(int dim = nil)
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
-- @api any result = Matrix:min(any dim_or_mtx2 = nil)
function Matrix:min(dim_or_mtx2) return self:_minmax(dim_or_mtx2, OPERATORS.lt, math.min) end

--- Largest element; of each column (1) or row (2); or of each pair of elements with another matrix.
-- @api any result = Matrix:max(any dim_or_mtx2 = nil)
function Matrix:max(dim_or_mtx2) return self:_minmax(dim_or_mtx2, OPERATORS.gt, math.max) end

local function identity(x) return x end

--- Whether f (default: the element itself) is true for all elements; 0 is not.
-- @api bool result = Matrix:all(func f = nil)
function Matrix:all(f)
    f = f or identity
    for _, x in ipairs(self:data()) do
        local value = f(x)
        if not value or value == 0 then return false end
    end
    return true
end

--- Whether f (default: the element itself) is true for some element; 0 is not.
-- @api bool result = Matrix:any(func f = nil)
function Matrix:any(f)
    f = f or identity
    for _, x in ipairs(self:data()) do
        local value = f(x)
        if value and value ~= 0 then return true end
    end
    return false
end

--- Row and column of the elements that are neither 0 nor false, one per row.
-- @api Matrix indices = Matrix:nonzero()
function Matrix:nonzero()
    local places = {}
    self:applyfuncidx(function(i, j, x)
        if x and x ~= 0 then table.move({i, j}, 1, 2, #places + 1, places) end
        return 0
    end)
    return Matrix(#places // 2, 2, places)
end

--- Elements of x where cond is true, else of y; both may be numbers.
-- @api Matrix m = Matrix:where(Matrix cond, any x, any y)
function Matrix:where(cond, x, y)
    if y == nil then cond, x, y = self, cond, x end
    return cond:applyfuncidx(function(i, j, c)
        local source = c and c ~= 0 and x
        if not source then source = y end
        return isMatrix(source) and source:item(i, j) or source
    end)
end

return Matrix
