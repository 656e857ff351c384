--[[
The class Matrix of simEigen: reading, parts, numbers of a whole matrix, linear algebra, and what Lua does with one.
]]

return function(simEigen, Matrix, tools)
    local made, wrap, isMatrix, fail = tools.made, tools.wrap, tools.isMatrix, tools.fail

    ---------------------------------------------------------------- reading and writing

    function Matrix:rows() return (simEigen.mtxGetSize(self.__handle)) end

    function Matrix:cols() return select(2, simEigen.mtxGetSize(self.__handle)) end

    function Matrix:count()
        local rows, cols = simEigen.mtxGetSize(self.__handle)
        return rows * cols
    end

    local function checkOrder(order)
        if order ~= nil then error('simEigen.Matrix: the argument order is not implemented in Swanilda: numbers are listed by rows', 3) end
    end

    function Matrix:data(order)
        checkOrder(order)
        return simEigen.mtxGetData(self.__handle)
    end

    function Matrix:setdata(data, order)
        checkOrder(order)
        simEigen.mtxSetData(self.__handle, data)
        return self
    end

    function Matrix:item(i, j) return simEigen.mtxGetItem(self.__handle, i - 1, (j or 1) - 1) end

    function Matrix:setitem(i, j, value)
        simEigen.mtxSetItem(self.__handle, i - 1, j - 1, value)
        return self
    end
    Matrix.get, Matrix.set = Matrix.item, Matrix.setitem

    function Matrix:rowdata(i) return simEigen.mtxGetRowData(self.__handle, i - 1) end

    function Matrix:coldata(j) return simEigen.mtxGetColData(self.__handle, j - 1) end

    function Matrix:setrowdata(i, data)
        simEigen.mtxSetRowData(self.__handle, i - 1, data)
        return self
    end

    function Matrix:setcoldata(j, data)
        simEigen.mtxSetColData(self.__handle, j - 1, data)
        return self
    end

    function Matrix:row(i) return self:block(i, 1, 1, -1) end

    function Matrix:col(j) return self:block(1, j, -1, 1) end

    local function numbers(value) return isMatrix(value) and value:data() or value end

    function Matrix:setrow(i, row) return self:setrowdata(i, numbers(row)) end

    function Matrix:setcol(j, col) return self:setcoldata(j, numbers(col)) end

    ---------------------------------------------------------------- parts

    local function one(f)
        return function(self, ...) return wrap(made(f, self.__handle, ...)) end
    end

    Matrix.copy, Matrix.__copy, Matrix.__deepcopy = one(simEigen.mtxCopy), one(simEigen.mtxCopy), one(simEigen.mtxCopy)

    --- A part: p rows and q columns from row i and column j on; -1: all that follow.
    function Matrix:block(i, j, p, q) return wrap(made(simEigen.mtxBlock, self.__handle, (i or 1) - 1, (j or 1) - 1, p or -1, q or -1)) end

    --- Puts a matrix into this one.
    function Matrix:blockassign(m, i, j, p, q)
        simEigen.mtxBlockAssign(self.__handle, Matrix:tomatrix(m).__handle, (i or 1) - 1, (j or 1) - 1, p or -1, q or -1)
        return self
    end

    Matrix.reshaped = one(simEigen.mtxReshaped)

    local function joined(f)
        return function(self, ...)
            local handles = {}
            for _, m in ipairs{isMatrix(self) and self or nil, ...} do handles[#handles + 1] = Matrix:tomatrix(m).__handle end
            return wrap(made(f, handles))
        end
    end

    -- With the class itself, `Matrix:horzcat(a, b)`, the list begins after it.
    local function join(f)
        local all = joined(f)
        return function(self, first, ...)
            if isMatrix(self) then return first and all(self, first, ...) or self:copy() end
            return all(Matrix:tomatrix(first), ...)
        end
    end
    Matrix.horzcat, Matrix.vertcat = join(simEigen.mtxHorzCat), join(simEigen.mtxVertCat)

    function Matrix.__concat(a, b) return Matrix:tomatrix(a):horzcat(b) end

    Matrix.transposed = one(simEigen.mtxTransposed)
    Matrix.t = Matrix.transposed

    function Matrix:transpose()
        simEigen.mtxTranspose(self.__handle)
        return self
    end

    ---------------------------------------------------------------- numbers of a whole matrix

    for name, f in pairs{
        sum = 'Sum', prod = 'Prod', mean = 'Mean', mincoeff = 'MinCoeff', maxcoeff = 'MaxCoeff', trace = 'Trace', norm = 'Norm',
        squarednorm = 'SquaredNorm', det = 'Determinant',
    } do
        local native = simEigen['mtx' .. f]
        Matrix[name] = function(self) return native(self.__handle) end
    end

    function Matrix:normalize()
        simEigen.mtxNormalize(self.__handle)
        return self
    end
    Matrix.normalized = one(simEigen.mtxNormalized)

    ---------------------------------------------------------------- linear algebra

    function Matrix:dot(m) return simEigen.mtxDot(self.__handle, Matrix:tomatrix(m).__handle) end

    function Matrix:cross(m) return wrap(made(simEigen.mtxCross, self.__handle, Matrix:tomatrix(m).__handle)) end

    function Matrix:kron(m) return wrap(made(simEigen.mtxKron, self.__handle, Matrix:tomatrix(m).__handle)) end

    --- Pseudo-inverse, and the solution of self * x = b if there is b.
    function Matrix:pinv(b, damping)
        local inverse, x = made(simEigen.mtxPInv, self.__handle, b and Matrix:tomatrix(b).__handle or nil, damping or 0)
        return wrap(inverse), wrap(x)
    end

    --- Singular values; u and v are empty unless they are wanted; the solution of self * x = b if there is b.
    function Matrix:svd(computeThinU, computeThinV, b)
        local s, u, v, x = made(
            simEigen.mtxSVD, self.__handle, computeThinU or false, computeThinV or false, b and Matrix:tomatrix(b).__handle or nil)
        return wrap(s), wrap(u), wrap(v), wrap(x)
    end

    --- Whether its rows are perpendicular to each other and of length 1.
    function Matrix:isorthogonal(tolerance)
        local rows, cols = simEigen.mtxGetSize(self.__handle)
        if rows ~= cols then return false end
        return (self * self:t() - Matrix:eye(rows)):abs():maxcoeff() <= (tolerance or 1e-6)
    end

    local function checkTransform(m)
        local rows, cols = simEigen.mtxGetSize(m.__handle)
        if rows ~= 4 or cols ~= 4 then error('simEigen.Matrix: a transform is a matrix of 4 by 4', 3) end
    end

    --- The inverse of a transform, a rotation and a translation in a matrix of 4 by 4.
    function Matrix:inversetransform()
        checkTransform(self)
        local turned = self:block(1, 1, 3, 3):t()
        local m = Matrix:eye(4)
        m:blockassign(turned, 1, 1)
        return m:blockassign(-(turned * self:block(1, 4, 3, 1)), 1, 4)
    end

    --- A point of three numbers, or a vector of four, in the frame of a transform.
    function Matrix:transform(v)
        checkTransform(self)
        v = Matrix:tomatrix(v)
        if v:rows() == 4 then return self * v end
        return (self * v:vertcat{1}):block(1, 1, 3, 1)
    end

    ---------------------------------------------------------------- other forms

    --- Rows as tables; with 'data' the numbers by rows; with 'dims' a table that fromtable takes.
    function Matrix:totable(format)
        if format == 'data' then return self:data() end
        if format == 'dims' then return self:togrid() end
        if format ~= nil then fail('the format ' .. tostring(format) .. ' is not known') end
        local rows = {}
        for i = 1, self:rows() do rows[i] = self:rowdata(i) end
        return rows
    end

    --- {dims = {rows, cols}, data = numbers}
    function Matrix:togrid() return {dims = {simEigen.mtxGetSize(self.__handle)}, data = self:data()} end

    function Matrix:__tostring()
        local parts = {}
        for i, x in ipairs(self:data()) do parts[i] = tostring(x) end
        local rows, cols = simEigen.mtxGetSize(self.__handle)
        return ('Matrix(%d, %d, {%s})'):format(rows, cols, table.concat(parts, ', '))
    end

    --- Prints the rows below each other.
    -- @param opts format of a number, default '%.4g'
    function Matrix:print(opts)
        local format, lines = opts and opts.format or '%.4g', {}
        for i, row in ipairs(self:totable()) do
            for j, x in ipairs(row) do row[j] = ('%12s'):format(format:format(x)) end
            lines[i] = table.concat(row)
        end
        print(table.concat(lines, '\n'))
    end

    ---------------------------------------------------------------- as a Lua value

    function Matrix:__len()
        local rows, cols = simEigen.mtxGetSize(self.__handle)
        return cols == 1 and rows or rows == 1 and cols or rows
    end

    local function at(self, k)
        local rows, cols = simEigen.mtxGetSize(self.__handle)
        if rows == 1 and cols > 1 then return 1, k, true end
        return k, 1, cols == 1
    end

    function Matrix:__index(k)
        if math.type(k) ~= 'integer' then return Matrix[k] end
        if k < 1 or k > #self then return nil end
        local i, j, isElement = at(self, k)
        return isElement and self:item(i, j) or not isElement and self:row(k) or nil
    end

    function Matrix:__newindex(k, value)
        if math.type(k) ~= 'integer' or k < 1 or k > #self then error('simEigen.Matrix: no element ' .. tostring(k), 2) end
        local i, j, isElement = at(self, k)
        if isElement then self:setitem(i, j, value) else self:setrow(k, value) end
    end

    function Matrix:__pairs()
        return function(m, i)
            if i < #m then return i + 1, m[i + 1] end
        end, self, 0
    end

    function Matrix.__eq(a, b)
        if not (isMatrix(a) and isMatrix(b)) or a:rows() ~= b:rows() or a:cols() ~= b:cols() then return false end
        local other = b:data()
        for i, x in ipairs(a:data()) do
            if x ~= other[i] then return false end
        end
        return true
    end

    function Matrix:__gc() pcall(simEigen.mtxDestroy, rawget(self, '__handle')) end

    function Matrix:__todisplay() return tostring(self) end

    function Matrix:__ismatrix() return true end

    function Matrix:__tomatrix() return self end

    function Matrix:__isvector3() return self:rows() == 3 and self:cols() == 1 end

    function Matrix:__tovector3() return self:__isvector3() and self or fail('a vector of 3 numbers is needed') end

    function Matrix:__tocbor()
        local cbor, head = require('org.conman.cbor'), require('org.conman.cbor_c')
        return head.encode(0xC0, 40) .. cbor.encode({{simEigen.mtxGetSize(self.__handle)}, self:data()})
    end
end
