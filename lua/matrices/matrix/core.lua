--[[
The class Matrix: making, reading and putting together. Its mathematics is in the files beside this one.

The numbers are in one table by rows; a row taken with rowref shares it.
]]

local Matrix = {}

local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end

local function new(rows, cols, data, offset)
    return setmetatable({_rows = rows, _cols = cols, _data = data, _offset = offset or 0}, Matrix)
end

local function checkSize(rows, cols)
    for _, n in ipairs{rows, cols} do
        if math.type(n) ~= 'integer' or n < 0 then error('Matrix: rows and columns are integers from 0', 4) end
    end
    if rows * cols > 1 << 24 then error('Matrix: more than 16777216 elements', 4) end
end

-- One of the two sizes may be -1: what the data give.
local function inferredSize(rows, cols, data)
    if type(data) ~= 'table' then return rows, cols end
    if rows == -1 and cols > 0 then rows = #data // cols end
    if cols == -1 and rows > 0 then cols = #data // rows end
    return rows, cols
end

local function filled(rows, cols, value)
    local data = {}
    for i = 1, rows * cols do data[i] = value end
    return data
end

local function copiedData(rows, cols, data)
    if isMatrix(data) then data = data:data() end
    if #data ~= rows * cols then
        error(('Matrix: %d elements are needed for %d x %d, not %d'):format(rows * cols, rows, cols, #data), 4)
    end
    return table.move(data, 1, #data, 1, {})
end

local function fromFunction(rows, cols, f)
    local data = {}
    for i = 1, rows do
        for j = 1, cols do data[#data + 1] = f(i, j) end
    end
    return data
end

-- Matrix{{1, 2}, {3, 4}}, Matrix{1, 2} (a column), Matrix(rows, cols, data): data are a table by rows, a number, a function of i and j, or nothing for 0.
local function construct(_, rows, cols, data)
    if type(rows) == 'table' then return Matrix:fromtable(rows) or construct(nil, #rows, 1, rows) end
    rows, cols = inferredSize(rows, cols, data)
    checkSize(rows, cols)
    if type(data) == 'table' then return new(rows, cols, copiedData(rows, cols, data)) end
    if type(data) == 'function' then return new(rows, cols, fromFunction(rows, cols, data)) end
    return new(rows, cols, filled(rows, cols, data or 0))
end

--- From rows, or from {dims = {rows, cols}, data = numbers}; nil for other tables.
-- @api Matrix m = Matrix:fromtable(table t)
function Matrix:fromtable(t)
    if isMatrix(t) then return t:copy() end
    if t.dims and t.data then return construct(nil, t.dims[1], t.dims[2], t.data) end
    if type(t[1]) ~= 'table' then return nil end
    local data = {}
    for i, row in ipairs(t) do
        if #row ~= #t[1] then error(('Matrix: row %d has %d elements, not %d'):format(i, #row, #t[1]), 2) end
        table.move(row, 1, #row, #data + 1, data)
    end
    return new(#t, #t[1], data)
end

--- Rows as tables; with a table as format {dims = {rows, cols}, data = numbers}; nil with another format.
-- @api table t = Matrix:totable(any format = nil)
function Matrix:totable(format)
    if type(format) == 'table' then return {dims = {self._rows, self._cols}, data = self:data()} end
    if format ~= nil then return nil end
    local rows = {}
    for i = 1, self._rows do rows[i] = self:row(i):data() end
    return rows
end

--- The number of rows.
-- @api int rows = Matrix:rows()
function Matrix:rows() return self._rows end

--- The number of columns.
-- @api int cols = Matrix:cols()
function Matrix:cols() return self._cols end

--- The number of elements.
-- @api int count = Matrix:count()
function Matrix:count() return self._rows * self._cols end

--- Whether another matrix has the same numbers of rows and columns.
-- @api bool result = Matrix:sameshape(Matrix m)
function Matrix:sameshape(m) return self._rows == m._rows and self._cols == m._cols end

--- Place of an element in dataref().
-- @api int index = Matrix:offset(int i, int j)
function Matrix:offset(i, j)
    if not (math.type(i) == 'integer' and math.type(j) == 'integer' and i >= 1 and i <= self._rows and j >= 1 and j <= self._cols) then
        error(('Matrix: no element %s, %s in %d x %d'):format(i, j, self._rows, self._cols), 3)
    end
    return self._offset + (i - 1) * self._cols + j
end

--- An element.
-- @api float value = Matrix:item(int i, int j)
function Matrix:item(i, j) return self._data[self:offset(i, j)] end

--- Sets an element.
-- @api Matrix:setitem(int i, int j, float value)
function Matrix:setitem(i, j, value) self._data[self:offset(i, j)] = value end

local warned = {}

local function deprecated(old, instead)
    if warned[old] then return end
    warned[old] = true
    addLog(430, ('m:%s is deprecated. use m:%s instead'):format(old, instead)) -- sim.verbosity_scriptwarnings
end

--- Older name of item.
-- @api float value = Matrix:get(int i, int j)
function Matrix:get(i, j)
    deprecated('get(i, j)', 'item(i, j)')
    return self:item(i, j)
end

--- Older name of setitem.
-- @api Matrix:set(int i, int j, float value)
function Matrix:set(i, j, value)
    deprecated('set(i, j, value)', 'setitem(i, j, value)')
    self:setitem(i, j, value)
end

--- The numbers by rows, copied.
-- @api float[] data = Matrix:data()
function Matrix:data() return table.move(self._data, self._offset + 1, self._offset + self:count(), 1, {}) end
--- The numbers themselves; of a row from rowref, those of the whole matrix.
-- @api float[] data = Matrix:dataref()
function Matrix:dataref() return self._data end

--- A copy.
-- @api Matrix m = Matrix:copy()
function Matrix:copy() return new(self._rows, self._cols, self:data()) end

--- The elements from a row and column to another.
-- @api Matrix m = Matrix:slice(int fromrow, int fromcol, int torow, int tocol)
function Matrix:slice(fromrow, fromcol, torow, tocol)
    return construct(nil, math.max(0, torow - fromrow + 1), math.max(0, tocol - fromcol + 1), function(i, j)
        return self:item(fromrow + i - 1, fromcol + j - 1)
    end)
end

--- A copy of a row.
-- @api Matrix m = Matrix:row(int i)
function Matrix:row(i) return self:slice(i, 1, i, self._cols) end

--- A copy of a column.
-- @api Matrix m = Matrix:col(int j)
function Matrix:col(j) return self:slice(1, j, self._rows, j) end
--- A row that shares its numbers with the matrix.
-- @api Matrix m = Matrix:rowref(int i)
function Matrix:rowref(i) return new(1, self._cols, self._data, self:offset(i, 1) - 1) end

--- Writes m into the matrix, from an element on.
-- @api Matrix m = Matrix:assign(int startrow, int startcol, Matrix m)
function Matrix:assign(startrow, startcol, m)
    if not isMatrix(m) then m = Matrix:fromtable(m) end
    for i = 1, m._rows do
        for j = 1, m._cols do self:setitem(startrow + i - 1, startcol + j - 1, m:item(i, j)) end
    end
    return self
end

local function numbersOf(m, count)
    local data = isMatrix(m) and m:data() or m
    if #data ~= count then error(('Matrix: %d elements are needed, not %d'):format(count, #data), 3) end
    return data
end

--- Sets a row.
-- @api Matrix m = Matrix:setrow(int i, any m)
function Matrix:setrow(i, m) return self:assign(i, 1, new(1, self._cols, numbersOf(m, self._cols))) end

--- Sets a column.
-- @api Matrix m = Matrix:setcol(int j, any m)
function Matrix:setcol(j, m) return self:assign(1, j, new(self._rows, 1, numbersOf(m, self._rows))) end

--- Rows (1) or columns (2) in reverse.
-- @api Matrix m = Matrix:flip(int dim = 1)
function Matrix:flip(dim)
    return construct(nil, self._rows, self._cols, function(i, j)
        return dim == 2 and self:item(i, self._cols + 1 - j) or dim ~= 2 and self:item(self._rows + 1 - i, j)
    end)
end

local function without(n, left)
    local list = {}
    for i = 1, n do
        if i ~= left then list[#list + 1] = i end
    end
    return list
end

local function indices(list, n)
    if list == nil then return without(n) end
    if type(list) == 'number' then return {list} end
    return isMatrix(list) and list:data() or list
end

--- The elements where these rows and columns (tables, or nil for all) cross.
-- @api Matrix m = Matrix:at(any rowidx = nil, any colidx = nil)
function Matrix:at(rowidx, colidx)
    rowidx, colidx = indices(rowidx, self._rows), indices(colidx, self._cols)
    return construct(nil, #rowidx, #colidx, function(i, j) return self:item(rowidx[i], colidx[j]) end)
end

--- A copy without a row.
-- @api Matrix m = Matrix:droprow(int i)
function Matrix:droprow(i) return self:at(without(self._rows, i), nil) end

--- A copy without a column.
-- @api Matrix m = Matrix:dropcol(int j)
function Matrix:dropcol(j) return self:at(nil, without(self._cols, j)) end

local function called(self, ...)
    if isMatrix(self) then return {self, ...} end
    return {...}
end

--- One below the other.
-- @api Matrix m = Matrix:vertcat(...)
function Matrix:vertcat(...)
    local parts, rows = called(self, ...), 0
    for _, m in ipairs(parts) do
        if m._cols ~= parts[1]._cols then error('Matrix: numbers of columns differ', 2) end
        rows = rows + m._rows
    end
    local result, at = construct(nil, rows, parts[1]._cols), 1
    for _, m in ipairs(parts) do
        result:assign(at, 1, m)
        at = at + m._rows
    end
    return result
end

--- One beside the other.
-- @api Matrix m = Matrix:horzcat(...)
function Matrix:horzcat(...)
    local parts, cols = called(self, ...), 0
    for _, m in ipairs(parts) do
        if m._rows ~= parts[1]._rows then error('Matrix: numbers of rows differ', 2) end
        cols = cols + m._cols
    end
    local result, at = construct(nil, parts[1]._rows, cols), 1
    for _, m in ipairs(parts) do
        result:assign(1, at, m)
        at = at + m._cols
    end
    return result
end

--- n times below, m times beside each other.
-- @api Matrix m = Matrix:repmat(int n, int m)
function Matrix:repmat(n, m)
    return construct(nil, n * self._rows, m * self._cols, function(i, j)
        return self:item((i - 1) % self._rows + 1, (j - 1) % self._cols + 1)
    end)
end

--- The identity matrix.
-- @api Matrix m = Matrix:eye(int size)
function Matrix:eye(size) return construct(nil, size, size, function(i, j) return i == j and 1 or 0 end) end

--- A matrix of ones.
-- @api Matrix m = Matrix:ones(int rows, int cols = 1)
function Matrix:ones(rows, cols) return construct(nil, rows, cols or 1, 1) end

--- A matrix of zeros.
-- @api Matrix m = Matrix:zeros(int rows, int cols = 1)
function Matrix:zeros(rows, cols) return construct(nil, rows, cols or 1, 0) end

---------------------------------------------------------------- as a Lua value

local function isVector(m) return m._rows == 1 or m._cols == 1 end

--- Elements of a row or column, else rows.
function Matrix:__len() return isVector(self) and self:count() or self._rows end

function Matrix:__index(k)
    if math.type(k) ~= 'integer' then return Matrix[k] end
    if k < 1 or k > #self then return nil end
    return isVector(self) and self._data[self._offset + k] or self:rowref(k)
end

function Matrix:__newindex(k, v)
    if math.type(k) ~= 'integer' or k < 1 or k > #self then error('Matrix: no element ' .. tostring(k), 2) end
    if isVector(self) then self._data[self._offset + k] = v else self:setrow(k, v) end
end

function Matrix:__ipairs()
    return function(m, i)
        if i < #m then return i + 1, m[i + 1] end
    end, self, 0
end
Matrix.__pairs = Matrix.__ipairs

function Matrix:__eq(m)
    if not (isMatrix(self) and isMatrix(m) and self:sameshape(m)) then return false end
    for i = 1, self:count() do
        if self._data[self._offset + i] ~= m._data[m._offset + i] then return false end
    end
    return true
end

function Matrix:__tostring()
    local parts = {}
    for i, value in ipairs(self:data()) do parts[i] = tostring(value) end
    return ('Matrix(%d, %d, {%s})'):format(self._rows, self._cols, table.concat(parts, ', '))
end

function Matrix:__todisplay() return tostring(self) end
function Matrix:__ismatrix() return true end
function Matrix:__tomatrix() return self end
function Matrix:__isvector3() return self:count() == 3 and isVector(self) end
function Matrix:__tovector3() return new(3, 1, numbersOf(self, 3)) end

function Matrix:__tocbor()
    local cbor, head = require('org.conman.cbor'), require('org.conman.cbor_c')
    return head.encode(0xC0, 40) .. cbor.encode({{self._rows, self._cols}, self:data()})
end

--- Prints the rows below each other.
-- @api Matrix:print(string name = nil, table opts = {})
function Matrix:print(name, opts)
    local format = opts and opts.format or '%.4g'
    local lines = {name and name .. ' =' or nil}
    for i = 1, self._rows do
        local cells = {}
        for j = 1, self._cols do
            local value = self:item(i, j)
            cells[j] = ('%12s'):format(type(value) == 'number' and format:format(value) or tostring(value))
        end
        lines[#lines + 1] = table.concat(cells)
    end
    print(table.concat(lines, '\n'))
end

return setmetatable(Matrix, {__call = construct})
