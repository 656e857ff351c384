--[[
Linear algebra of Matrix: products, elimination, inverses, singular values.

Dense and small: what robots need. Singular values by one-sided Jacobi rotations (Hestenes 1958).
]]

local Matrix = require 'matrix.core'

local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end

local function checkSquare(m)
    if m._rows ~= m._cols then error('Matrix: not square', 3) end
end

--- Transposed.
-- @api Matrix m = Matrix:t()
function Matrix:t() return Matrix(self._cols, self._rows, function(i, j) return self:item(j, i) end) end

--- Product of matrices, or of each element and a number.
-- @api Matrix m = Matrix:mul(any m)
function Matrix:mul(m)
    if not isMatrix(m) then return self:times(m) end
    if self._cols ~= m._rows then
        error(('Matrix: no product of %d x %d and %d x %d'):format(self._rows, self._cols, m._rows, m._cols), 3)
    end
    return Matrix(self._rows, m._cols, function(i, j)
        local sum = 0
        for k = 1, self._cols do sum = sum + self:item(i, k) * m:item(k, j) end
        return sum
    end)
end

function Matrix.__mul(a, b)
    if isMatrix(a) then return a:mul(b) end
    return b:times(a)
end

--- Product with a vector; one of 3 elements is moved by a 4 x 4 matrix as a point.
-- @api Matrix m = Matrix:mult(any v)
function Matrix:mult(v)
    if not isMatrix(v) then v = Matrix(#v, 1, v) end
    if self._cols == 4 and v:count() == 3 then return (self * v:hom()):nonhom() end
    return self * Matrix(v:count(), 1, v:data())
end

--- Integer power of a square matrix; a negative one is of the inverse.
-- @api Matrix m = Matrix:power(int k)
function Matrix:power(k)
    checkSquare(self)
    if math.type(k) ~= 'integer' or math.abs(k) > 1 << 32 then error('Matrix: the power is an integer', 2) end
    local base, result = k < 0 and self:inv() or self, Matrix:eye(self._rows)
    k = math.abs(k)
    while k > 0 do
        if k % 2 == 1 then result = result * base end
        base, k = base * base, k // 2
    end
    return result
end

--- The dot product of two vectors.
-- @api float result = Matrix:dot(Matrix m)
function Matrix:dot(m)
    if self:count() ~= m:count() then error('Matrix: vectors of different lengths', 2) end
    local a, b, sum = self:data(), m:data(), 0
    for i = 1, #a do sum = sum + a[i] * b[i] end
    return sum
end

--- The cross product of two vectors of 3 elements.
-- @api Matrix m = Matrix:cross(Matrix m)
function Matrix:cross(m)
    if self:count() ~= 3 or m:count() ~= 3 then error('Matrix: cross is for vectors of 3 elements', 2) end
    local a, b = self:data(), m:data()
    return Matrix(self._rows, self._cols, {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]})
end

--- The Kronecker product.
-- @api Matrix m = Matrix:kron(Matrix m)
function Matrix:kron(m)
    return Matrix(self._rows * m._rows, self._cols * m._cols, function(i, j)
        local a = self:item((i - 1) // m._rows + 1, (j - 1) // m._cols + 1)
        return a * m:item((i - 1) % m._rows + 1, (j - 1) % m._cols + 1)
    end)
end

--- Columns as homogeneous coordinates: a row of ones below.
-- @api Matrix m = Matrix:hom()
function Matrix:hom()
    if self._rows == 1 and self._cols > 1 then return self:t():hom():t() end
    return self:vertcat(Matrix(1, self._cols, 1))
end

--- The reverse: divided by the last row.
-- @api Matrix m = Matrix:nonhom()
function Matrix:nonhom()
    if self._rows == 1 and self._cols > 1 then return self:t():nonhom():t() end
    local n = self._rows
    return Matrix(n - 1, self._cols, function(i, j) return self:item(i, j) / self:item(n, j) end)
end

--- The Euclidean norm of all elements.
-- @api float norm = Matrix:norm()
function Matrix:norm() return self:dot(self) ^ 0.5 end

--- The matrix divided by its norm.
-- @api Matrix m = Matrix:normalized()
function Matrix:normalized() return self / self:norm() end

--- The diagonal as a column; Matrix:diag(t) is a matrix with the diagonal t.
-- @api Matrix m = Matrix:diag(any t = nil)
function Matrix:diag(t)
    if t == nil then return Matrix(math.min(self._rows, self._cols), 1, function(i) return self:item(i, i) end) end
    local values = isMatrix(t) and t:data() or t
    return Matrix(#values, #values, function(i, j) return i == j and values[i] or 0 end)
end

--- The sum of the diagonal.
-- @api float trace = Matrix:trace()
function Matrix:trace() return self:diag():sum() end

--- Column x, y or z (or 1 to 3) of a rotation or pose as a vector of 3.
-- @api Matrix v = Matrix:axis(any which)
function Matrix:axis(which)
    local j = ({x = 1, y = 2, z = 3})[which] or which
    return self:slice(1, j, 3, j)
end

local function swapRows(m, a, b)
    local row = m:row(a)
    m:setrow(a, m:row(b))
    m:setrow(b, row)
end

local function pivotRow(m, from, col)
    local best = from
    for i = from + 1, m._rows do
        if math.abs(m:item(i, col)) > math.abs(m:item(best, col)) then best = i end
    end
    return best
end

-- Makes a pivot 1 and clears the column below it; if `jordan`, above it too.
local function eliminate(m, row, col, jordan)
    m:setrow(row, m:row(row) / m:item(row, col))
    for i = jordan and 1 or row + 1, m._rows do
        local factor = i ~= row and m:item(i, col) or 0
        if factor ~= 0 then m:setrow(i, m:row(i) - m:row(row) * factor) end
    end
end

--- Row echelon form by elimination with pivoting, reduced if `jordan`; and the determinant of the first square part.
-- @api Matrix m, float det = Matrix:gauss(bool jordan = false)
function Matrix:gauss(jordan)
    local m, row, det = self * 1.0, 1, 1.0
    for col = 1, m._cols do
        if row > m._rows then break end
        local pivot = pivotRow(m, row, col)
        local value = m:item(pivot, col)
        if value == 0 then
            if col <= m._rows then det = 0.0 end
        else
            if pivot ~= row then
                swapRows(m, pivot, row)
                det = -det
            end
            det = det * value
            eliminate(m, row, col, jordan)
            row = row + 1
        end
    end
    return m, det
end

--- The determinant; up to 3 x 3 by its formula, which is exact for integers.
-- @api float det = Matrix:det()
function Matrix:det()
    checkSquare(self)
    local m = self:data()
    if #m == 1 then return m[1] end
    if #m == 4 then return m[1] * m[4] - m[2] * m[3] end
    if #m == 9 then
        return m[1] * (m[5] * m[9] - m[6] * m[8]) - m[2] * (m[4] * m[9] - m[6] * m[7]) + m[3] * (m[4] * m[8] - m[5] * m[7])
    end
    return (select(2, self:gauss()))
end

--- The inverse.
-- @api Matrix m = Matrix:inv()
function Matrix:inv()
    checkSquare(self)
    local n = self._rows
    local reduced, det = self:horzcat(Matrix:eye(n)):gauss(true)
    if det == 0 or det ~= det then error('Matrix: singular', 2) end
    return reduced:slice(1, n + 1, n, 2 * n)
end

---------------------------------------------------------------- singular values

-- Rotates columns p and q of u (and v) until they are orthogonal; true when they were.
local function orthogonalize(u, v, p, q)
    local alpha, beta, gamma = 0, 0, 0
    for i = 1, u._rows do
        local a, b = u:item(i, p), u:item(i, q)
        alpha, beta, gamma = alpha + a * a, beta + b * b, gamma + a * b
    end
    if math.abs(gamma) <= 1e-15 * (alpha * beta) ^ 0.5 then return true end
    local zeta = (beta - alpha) / (2 * gamma)
    local t = (zeta >= 0 and 1 or -1) / (math.abs(zeta) + (1 + zeta * zeta) ^ 0.5)
    local c = 1 / (1 + t * t) ^ 0.5
    for _, m in ipairs{u, v} do
        for i = 1, m._rows do
            local a, b = m:item(i, p), m:item(i, q)
            m:setitem(i, p, c * (a - t * b))
            m:setitem(i, q, c * (t * a + b))
        end
    end
    return false
end

-- For at least as many rows as columns: U (its columns not normed) and V.
local function jacobi(m)
    local u, v = m * 1.0, Matrix:eye(m._cols) * 1.0
    for _ = 1, 60 do
        local done = true
        for p = 1, m._cols - 1 do
            for q = p + 1, m._cols do done = orthogonalize(u, v, p, q) and done end
        end
        if done then break end
    end
    return u, v
end

--- Singular values (a column, the largest first), U, V, and with b the least-squares solution of A x = b. U and V are thin.
-- @api Matrix s, Matrix u, Matrix v, Matrix x = Matrix:svd(bool computeu = nil, bool computev = nil, Matrix b = nil)
function Matrix:svd(_, _, b)
    if self._rows < self._cols then
        local s, v, u = self:t():svd()
        return s, u, v, b and self:pinv(b)
    end
    local u, v = jacobi(self)
    local norms, order = {}, {}
    for j = 1, self._cols do norms[j], order[j] = u:col(j):norm(), j end
    table.sort(order, function(i, j) return norms[i] > norms[j] or norms[i] == norms[j] and i < j end)
    local s = Matrix(self._cols, 1, function(i) return norms[order[i]] end)
    local normed = u:at(nil, order):applyfuncidx(function(_, j, x) return s[j] > 0 and x / s[j] or x end)
    return s, normed, v:at(nil, order), b and self:pinv(b)
end

--- Pseudo-inverse, or its product with b. With a damping d each singular value s counts as (s^2 + d^2) / s.
-- @api Matrix m = Matrix:pinv(Matrix b = nil, float damping = 0)
function Matrix:pinv(b, damping)
    local s, u, v = self:svd()
    local smallest = 1e-12 * math.max(self._rows, self._cols) * (s:count() > 0 and s[1] or 0)
    local d = damping or 0
    local inverse = Matrix:diag(s:applyfunc(function(x)
        if x <= smallest then return 0 end
        return x / (x * x + d * d)
    end))
    local result = v * inverse * u:t()
    if b == nil then return result end
    return result * (isMatrix(b) and b or Matrix(#b, 1, b))
end

return Matrix
