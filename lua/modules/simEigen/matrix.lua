--[[
The classes Matrix and Vector of simEigen: a vector is a matrix with one column. An object holds the handle of a native matrix, which ends with it.
]]

return function(simEigen)
    local Matrix = {}
    simEigen.Matrix = Matrix

    local OUT_OF_MEMORY <const> = 'the matrices of a script take'

    local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end

    local function retried(f, ok, result, ...)
        if ok then return result, ... end
        if not tostring(result):find(OUT_OF_MEMORY, 1, true) then error(result, 0) end
        -- Matrices that nobody has any more still take memory until they are collected.
        collectgarbage()
        return f()
    end

    -- What a function that makes matrices returns.
    local function made(f, ...)
        local arguments = table.pack(...)
        local function call() return f(table.unpack(arguments, 1, arguments.n)) end
        return retried(call, pcall(call))
    end

    local function wrap(handle) return handle and setmetatable({__handle = handle}, Matrix) end

    local function fail(text) error('simEigen.Matrix: ' .. text, 3) end

    ---------------------------------------------------------------- making

    local function flat(rows)
        local data, cols = {}, #rows[1]
        for i, row in ipairs(rows) do
            if type(row) ~= 'table' or #row ~= cols then fail(('row %d has not %d numbers'):format(i, cols)) end
            table.move(row, 1, cols, (i - 1) * cols + 1, data)
        end
        return #rows, cols, data
    end

    --- From rows, from the numbers of a column, or from {dims = {rows, cols}, data = numbers}.
    function Matrix:fromtable(t)
        if isMatrix(t) then return t:copy() end
        if t.dims and t.data then return Matrix(t.dims[1], t.dims[2], t.data) end
        if type(t[1]) == 'table' then return Matrix(flat(t)) end
        return Matrix(#t, 1, t)
    end

    local function create(_, rows, cols, data, order)
        if order ~= nil then fail('the argument order is not implemented in Swanilda: numbers are listed by rows') end
        if type(rows) == 'table' then return Matrix:fromtable(rows) end
        if type(data) == 'table' and rows == -1 and cols > 0 then rows = #data // cols end
        if type(data) == 'table' and cols == -1 and rows > 0 then cols = #data // rows end
        if type(data) == 'number' then return wrap(made(simEigen.mtxNew, rows, cols)):iadd(data) end
        return wrap(made(simEigen.mtxNew, rows, cols, data or {}))
    end

    --- A matrix of any value that is one: a matrix, a table of numbers or of rows.
    function Matrix:tomatrix(value, rows, cols)
        if value == nil and isMatrix(self) then return self end
        if isMatrix(value) then return value end
        local meta = type(value) == 'table' and getmetatable(value)
        if type(meta) == 'table' and meta.__tomatrix then return meta.__tomatrix(value) end
        if type(value) ~= 'table' then fail('a matrix or a table is needed') end
        return rows and Matrix(rows, cols or 1, value) or Matrix:fromtable(value)
    end

    function Matrix:eye(size)
        local m = Matrix(size, size)
        for i = 1, size do m:setitem(i, i, 1) end
        return m
    end

    function Matrix:linspace(low, high, count) return wrap(made(simEigen.mtxLinSpaced, count, low, high)) end

    --- Random numbers from -1 to 1, or within a range {low, high}.
    function Matrix:random(rows, cols, range)
        local m = wrap(made(simEigen.mtxRandom, rows, cols))
        if not range then return m end
        return m:iadd(1):itimes((range[2] - range[1]) / 2):iadd(range[1])
    end

    function Matrix:ismatrix(m, rows, cols)
        if m == nil and isMatrix(self) then m = self end
        return isMatrix(m) and (not rows or m:rows() == rows) and (not cols or m:cols() == cols)
    end

    --- Whether a value is a matrix with one column.
    function Matrix:isvector(m, count)
        if m == nil and isMatrix(self) then m = self end
        return isMatrix(m) and m:cols() == 1 and (not count or m:rows() == count)
    end

    function Matrix:freeze() fail('freeze is not implemented in Swanilda: what it does is not known') end

    require('simEigen.matrix_parts')(simEigen, Matrix, {made = made, wrap = wrap, isMatrix = isMatrix, fail = fail})

    ---------------------------------------------------------------- element by element

    local UNARY <const> = {
        'abs', 'acos', 'asin', 'atan', 'ceil', 'cos', 'deg', 'exp', 'floor', 'log', 'log2', 'log10', 'rad', 'sin', 'sqrt', 'tan',
    }
    local BINARY <const> = {'add', 'sub', 'times', 'div', 'intdiv', 'mod', 'min', 'max'}

    --- An operation of simEigen.op.
    -- @param x the second operand, a number or a matrix
    -- @param inplace whether the matrix itself changes
    function Matrix:op(op, x, inplace)
        inplace = inplace or false
        local result
        if type(x) == 'number' then
            result = made(simEigen.mtxOpK, self.__handle, op, x, inplace)
        else
            result = made(simEigen.mtxOp, self.__handle, op, x ~= nil and Matrix:tomatrix(x).__handle or nil, inplace)
        end
        return inplace and self or wrap(result)
    end

    for _, name in ipairs(UNARY) do
        local op = simEigen.op[name]
        Matrix[name] = function(self) return self:op(op) end
        Matrix['i' .. name] = function(self) return self:op(op, nil, true) end
    end

    for _, name in ipairs(BINARY) do
        local op = simEigen.op[name]
        local function check(x)
            if type(x) ~= 'number' and type(x) ~= 'table' then error(('simEigen.Matrix: %s needs a number or a matrix'):format(name), 3) end
        end
        Matrix[name] = function(self, x)
            check(x)
            return self:op(op, x)
        end
        Matrix['i' .. name] = function(self, x)
            check(x)
            return self:op(op, x, true)
        end
    end

    -- A number as a matrix of the shape of another.
    local function alike(value, m)
        if type(value) == 'number' then return Matrix(m:rows(), m:cols(), value) end
        return Matrix:tomatrix(value)
    end

    for meta, name in pairs{__add = 'add', __sub = 'sub', __div = 'div', __idiv = 'intdiv', __mod = 'mod'} do
        Matrix[meta] = function(a, b) return Matrix[name](isMatrix(a) and a or alike(a, b), b) end
    end

    function Matrix:__unm() return self:op(simEigen.op.unm) end

    --- The product; with a number that of each element.
    function Matrix:mul(m)
        if type(m) == 'number' then return self:times(m) end
        return wrap(made(simEigen.mtxMul, self.__handle, Matrix:tomatrix(m).__handle))
    end

    function Matrix:imul(m)
        if type(m) == 'number' then return self:itimes(m) end
        simEigen.mtxIMul(self.__handle, Matrix:tomatrix(m).__handle)
        return self
    end

    function Matrix.__mul(a, b)
        if type(a) == 'number' then return b:times(a) end
        return Matrix:tomatrix(a):mul(b)
    end

    for meta, sign in pairs{__pow = '^', __bor = '|'} do
        Matrix[meta] = function()
            error(('simEigen.Matrix: the operator %s is not implemented in Swanilda: what it does is not known'):format(sign), 2)
        end
    end

    setmetatable(Matrix, {__call = create, __tostring = function() return 'class Matrix' end})

    ---------------------------------------------------------------- vectors

    local Vector = {}
    simEigen.Vector = Vector

    --- A vector of a table of numbers, or of a size and numbers or a value for all.
    function Vector:new(size, value)
        if type(size) == 'table' then return isMatrix(size) and size:copy() or Matrix(#size, 1, size) end
        return Matrix(size, 1, value)
    end

    function Vector:random(size, range) return Matrix:random(size, 1, range) end

    function Vector:isvector(...) return Matrix.isvector(Matrix, ...) end

    --- A vector of any value that is one.
    function Vector:tovector(value, rows)
        local v = Matrix:tomatrix(value)
        if v:cols() ~= 1 or rows and v:rows() ~= rows then error('simEigen.Vector: a vector is needed', 2) end
        return v
    end

    setmetatable(Vector, {__call = Vector.new, __tostring = function() return 'class Vector' end})
end
