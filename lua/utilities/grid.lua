--[[
Grids of numbers in any number of dimensions. Loading this makes the class Grid global; it returns nothing.

    Grid({2, 3}, data)     a grid of 2 x 3: data are a table, the last index running fastest, a number for all, or nothing for 0
    a + b, a - b           element by element, with a grid of the same dimensions or a number
    a * b, -a              the same; there is no product of matrices
    a == b, tostring(a)

An index is a table with a number from 1 for each dimension. Of the original only names and parameters are known: dimensions and indices are
checked, operators go element by element.
]]

Grid = {}

local Grid = Grid

local function isGrid(value) return type(value) == 'table' and getmetatable(value) == Grid end

local function isSize(n) return math.type(n) == 'integer' and n >= 0 end

local MAX_ELEMENTS <const> = 1 << 24

local function sizeOf(dims)
    local size = 1
    for _, n in ipairs(dims) do
        if not isSize(n) then error('Grid: dimensions are integers from 0', 3) end
        size = size * n
        if size > MAX_ELEMENTS then error(('Grid: more than %d elements'):format(MAX_ELEMENTS), 3) end
    end
    return size
end

local function construct(_, dims, data)
    if type(dims) ~= 'table' then error('Grid: a table of dimensions is needed', 2) end
    local size, values = sizeOf(dims), {}
    if type(data) == 'table' then
        if #data ~= size then error(('Grid: %d elements are needed, not %d'):format(size, #data), 2) end
        table.move(data, 1, size, 1, values)
    else
        for i = 1, size do values[i] = data or 0 end
    end
    return setmetatable({_dims = table.move(dims, 1, #dims, 1, {}), _data = values}, Grid)
end

--- The sizes along the dimensions.
-- @api int[] dims = Grid:dims()
function Grid:dims() return table.move(self._dims, 1, #self._dims, 1, {}) end

--- How far apart in the data two elements are whose indices differ by 1 in a dimension.
-- @api int stride = Grid:stride(int dim)
function Grid:stride(dim)
    local stride = 1
    for i = dim + 1, #self._dims do stride = stride * self._dims[i] end
    return stride
end

--- The place of an element in the data, from 1.
-- @api int offset = Grid:offset(int[] index)
function Grid:offset(index)
    local offset, stride = 1, 1
    for i = #self._dims, 1, -1 do
        local k = index[i]
        if math.type(k) ~= 'integer' or k < 1 or k > self._dims[i] then error(('Grid: no index %s in dimension %d'):format(k, i), 3) end
        offset, stride = offset + (k - 1) * stride, stride * self._dims[i]
    end
    return offset
end

--- An element.
-- @api float value = Grid:get(int[] index)
function Grid:get(index) return self._data[self:offset(index)] end

--- Sets an element.
-- @api Grid:set(int[] index, float value)
function Grid:set(index, value) self._data[self:offset(index)] = value end

--- The elements with an index of `val` in a dimension: a grid of one dimension less.
-- @api Grid g = Grid:project(int dim, int val)
function Grid:project(dim, val)
    local dims, stride, data = self:dims(), self:stride(dim), {}
    local size = table.remove(dims, dim)
    if not size or math.type(val) ~= 'integer' or val < 1 or val > size then
        error(('Grid: no index %s in dimension %s'):format(val, dim), 2)
    end
    if #self._data == 0 then return construct(nil, dims, data) end
    for first = (val - 1) * stride, #self._data - 1, stride * size do table.move(self._data, first + 1, first + stride, #data + 1, data) end
    return construct(nil, dims, data)
end

--- A copy.
-- @api Grid g = Grid:copy()
function Grid:copy() return construct(nil, self._dims, self._data) end

---------------------------------------------------------------- tables

local function nested(g, dim, first)
    if dim > #g._dims then return g._data[first] end
    local rows, stride = {}, g:stride(dim)
    for i = 1, g._dims[dim] do rows[i] = nested(g, dim + 1, first + (i - 1) * stride) end
    return rows
end

--- Tables in tables; with a table as format {dims = sizes, data = numbers}.
-- @api table t = Grid:totable(table format = nil)
function Grid:totable(format)
    if type(format) == 'table' then return {dims = self:dims(), data = table.move(self._data, 1, #self._data, 1, {})} end
    return nested(self, 1, 1)
end

local function collect(t, dims, depth, data)
    if type(t) ~= 'table' then
        if depth <= #dims then error('Grid: tables of different depths', 4) end
        data[#data + 1] = t
        return
    end
    if depth > #dims and #data > 0 then error('Grid: tables of different depths', 4) end
    dims[depth] = dims[depth] or #t
    if #t ~= dims[depth] then error(('Grid: tables of %d and %d elements'):format(dims[depth], #t), 4) end
    for _, inner in ipairs(t) do collect(inner, dims, depth + 1, data) end
end

--- The grid of tables in tables, or of {dims = sizes, data = numbers}.
-- @api Grid g = Grid:fromtable(table t)
function Grid:fromtable(t)
    if t.dims and t.data then return construct(nil, t.dims, t.data) end
    local dims, data = {}, {}
    collect(t, dims, 1, data)
    return construct(nil, dims, data)
end

---------------------------------------------------------------- operators

local function sameDims(a, b)
    if #a._dims ~= #b._dims then return false end
    for i, n in ipairs(a._dims) do
        if n ~= b._dims[i] then return false end
    end
    return true
end

local function elementwise(a, b, f)
    local like = isGrid(a) and a or b
    if isGrid(a) and isGrid(b) and not sameDims(a, b) then error('Grid: dimensions differ', 3) end
    local data = {}
    for i = 1, #like._data do data[i] = f(isGrid(a) and a._data[i] or a, isGrid(b) and b._data[i] or b) end
    return construct(nil, like._dims, data)
end

function Grid.__add(a, b) return (elementwise(a, b, function(x, y) return x + y end)) end
function Grid.__sub(a, b) return (elementwise(a, b, function(x, y) return x - y end)) end
function Grid.__mul(a, b) return (elementwise(a, b, function(x, y) return x * y end)) end
function Grid:__unm() return (elementwise(self, -1, function(x, y) return x * y end)) end

function Grid.__eq(a, b)
    if not (isGrid(a) and isGrid(b) and sameDims(a, b)) then return false end
    for i, x in ipairs(a._data) do
        if x ~= b._data[i] then return false end
    end
    return true
end

function Grid:__tostring()
    local numbers = {}
    for i, x in ipairs(self._data) do numbers[i] = tostring(x) end
    return ('Grid({%s}, {%s})'):format(table.concat(self._dims, ', '), table.concat(numbers, ', '))
end

Grid.__index = Grid

setmetatable(Grid, {__call = construct, __tostring = function() return 'class Grid' end})
