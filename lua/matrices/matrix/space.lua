--[[
Vectors, and rotations and poses as matrices: Vector, Vector3, Vector4, Vector7, Matrix3x3, Matrix4x4.

Quaternions are x, y, z, w; Euler angles CoppeliaSim's (Rx * Ry * Rz); poses position and quaternion; angles in radians. Matrices and vectors,
which are columns, are Matrix objects; quaternions, Euler angles, positions and poses taken from a matrix are plain tables: a new one, or t.
]]

local Matrix = require 'matrix.core'

local function isMatrix(value) return type(value) == 'table' and getmetatable(value) == Matrix end
local function numbers(value) return isMatrix(value) and value:data() or value end

-- A kind of matrices of fixed size: callable with data, a number for all elements, or nothing.
local function kind(name, rows, cols)
    return setmetatable({}, {
        __call = function(_, data)
            if type(data) ~= 'table' then return Matrix(rows, cols, data or 0) end
            if type(data[1]) == 'table' and not isMatrix(data) then data = Matrix(data) end
            local list = numbers(data)
            if #list ~= rows * cols then error(('%s: %d numbers are needed, not %d'):format(name, rows * cols, #list), 2) end
            return Matrix(rows, cols, list)
        end,
        __index = function(_, key) return Matrix[key] end,
    })
end

local M = {
    Vector3 = kind('Vector3', 3, 1), Vector4 = kind('Vector4', 4, 1), Vector7 = kind('Vector7', 7, 1),
    Matrix3x3 = kind('Matrix3x3', 3, 3), Matrix4x4 = kind('Matrix4x4', 4, 4),
}
local Vector3, Vector4, Vector7, Matrix3x3, Matrix4x4 = M.Vector3, M.Vector4, M.Vector7, M.Matrix3x3, M.Matrix4x4

-- Vector(data), Vector(length, data).
local Vector = setmetatable({}, {
    __call = function(_, len, data)
        if type(len) == 'table' then len, data = #numbers(len), numbers(len) end
        return Matrix(len, 1, data)
    end,
    __index = function(_, key) return Matrix[key] end,
})
M.Vector = Vector

local function result(list, t) return table.move(list, 1, #list, 1, t or {}) end

---------------------------------------------------------------- vectors

--- The numbers from start to stop; both ends are included.
-- @api Matrix v = Vector:range(float start, float stop = nil, float step = 1)
function Vector:range(start, stop, step)
    local list = {}
    if stop == nil then start, stop = 1, start end
    for x = start, stop, step or 1 do list[#list + 1] = x end
    return Vector(list)
end

--- num numbers from start to stop, which is left out when endpoint is false.
-- @api Matrix v = Vector:linspace(float start, float stop, int num = 50, bool endpoint = true)
function Vector:linspace(start, stop, num, endpoint)
    num = num or 50
    local steps = endpoint == false and num or num - 1
    return Vector(num, function(i) return steps > 0 and start + (stop - start) * (i - 1) / steps or start * 1.0 end)
end

--- base to the powers of linspace.
-- @api Matrix v = Vector:logspace(float start, float stop, int num = 50, bool endpoint = true, float base = 10)
function Vector:logspace(start, stop, num, endpoint, base)
    return Vector:linspace(start, stop, num, endpoint):applyfunc(function(x) return (base or 10) ^ x end)
end

--- Numbers with equal ratios.
-- @api Matrix v = Vector:geomspace(float start, float stop, int num = 50, bool endpoint = true)
function Vector:geomspace(start, stop, num, endpoint)
    local sign = start < 0 and -1 or 1
    local powers = Vector:linspace(math.log(start * sign), math.log(stop * sign), num, endpoint)
    return powers:applyfunc(function(x) return sign * math.exp(x) end)
end

--- The point of homogeneous coordinates.
-- @api Matrix v = Vector3:hom(any v)
function Vector3:hom(v)
    v = numbers(v)
    local w = v[4] or 1
    return Vector3{v[1] / w, v[2] / w, v[3] / w}
end

--- The homogeneous coordinates of a point.
-- @api Matrix v = Vector4:hom(any v)
function Vector4:hom(v)
    v = numbers(v)
    return Vector4{v[1], v[2], v[3], v[4] or 1}
end

--- Three random numbers from 0 to 1.
-- @api Matrix v = Vector3:random()
function Vector3:random() return Matrix(3, 1):random() end

--- A direction, all equally likely (Archimedes: z is uniform).
-- @api Matrix v = Vector3:unitrandom()
function Vector3:unitrandom()
    local random = Matrix(2, 1):random()
    local z, angle = 2 * random[1] - 1, 2 * math.pi * random[2]
    local r = math.max(0, 1 - z * z) ^ 0.5
    return Vector3{r * math.cos(angle), r * math.sin(angle), z}
end

---------------------------------------------------------------- rotations

--- The rotation about the x axis.
-- @api Matrix m = Matrix3x3:rotx(float angle)
function Matrix3x3:rotx(angle)
    local c, s = math.cos(angle), math.sin(angle)
    return Matrix3x3{1, 0, 0, 0, c, -s, 0, s, c}
end

--- The rotation about the y axis.
-- @api Matrix m = Matrix3x3:roty(float angle)
function Matrix3x3:roty(angle)
    local c, s = math.cos(angle), math.sin(angle)
    return Matrix3x3{c, 0, s, 0, 1, 0, -s, 0, c}
end

--- The rotation about the z axis.
-- @api Matrix m = Matrix3x3:rotz(float angle)
function Matrix3x3:rotz(angle)
    local c, s = math.cos(angle), math.sin(angle)
    return Matrix3x3{c, -s, 0, s, c, 0, 0, 0, 1}
end

--- The rotation of a quaternion x, y, z, w.
-- @api Matrix m = Matrix3x3:fromquaternion(any q)
function Matrix3x3:fromquaternion(q)
    local x, y, z, w = table.unpack(numbers(q), 1, 4)
    local n = (x * x + y * y + z * z + w * w) ^ 0.5
    x, y, z, w = x / n, y / n, z / n, w / n
    return Matrix3x3{
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    }
end

--- The rotation of Euler angles.
-- @api Matrix m = Matrix3x3:fromeuler(any e)
function Matrix3x3:fromeuler(e)
    e = numbers(e)
    return Matrix3x3:rotx(e[1]) * Matrix3x3:roty(e[2]) * Matrix3x3:rotz(e[3])
end

--- The rotation about an axis.
-- @api Matrix m = Matrix3x3:fromaxisangle(any axis, float angle)
function Matrix3x3:fromaxisangle(axis, angle)
    local a = Vector3(axis):normalized()
    local s = math.sin(angle / 2)
    return Matrix3x3:fromquaternion{a[1] * s, a[2] * s, a[3] * s, math.cos(angle / 2)}
end

-- Quaternion of a rotation, from its largest component (Shepperd 1978).
local function quaternion(m)
    local function r(i, j) return m:item(i, j) end
    local trace = r(1, 1) + r(2, 2) + r(3, 3)
    if trace > 0 then
        local s = (trace + 1) ^ 0.5 * 2
        return {(r(3, 2) - r(2, 3)) / s, (r(1, 3) - r(3, 1)) / s, (r(2, 1) - r(1, 2)) / s, s / 4}
    end
    local i = r(1, 1) >= r(2, 2) and (r(1, 1) >= r(3, 3) and 1 or 3) or (r(2, 2) >= r(3, 3) and 2 or 3)
    local j, k = i % 3 + 1, (i + 1) % 3 + 1
    local s = (1 + r(i, i) - r(j, j) - r(k, k)) ^ 0.5 * 2
    local q = {[4] = (r(k, j) - r(j, k)) / s}
    q[i], q[j], q[k] = s / 4, (r(i, j) + r(j, i)) / s, (r(i, k) + r(k, i)) / s
    return q
end

local function euler(m)
    local b = math.asin(math.max(-1, math.min(1, m:item(1, 3))))
    if math.abs(m:item(1, 3)) > 1 - 1e-12 then return {math.atan(m:item(3, 2), m:item(2, 2)), b, 0.0} end
    return {math.atan(-m:item(2, 3), m:item(3, 3)), b, math.atan(-m:item(1, 2), m:item(1, 1))}
end

--- The quaternion of a rotation; its numbers are written into t if that is a table.
-- @api float[4] q = Matrix3x3:toquaternion(Matrix m, table t = nil)
function Matrix3x3:toquaternion(m, t) return result(quaternion(m), t) end

--- The Euler angles of a rotation; they are written into t if that is a table.
-- @api float[3] e = Matrix3x3:toeuler(Matrix m, table t = nil)
function Matrix3x3:toeuler(m, t) return result(euler(m), t) end

--- All rotations equally likely (Shoemake 1992).
-- @api Matrix m = Matrix3x3:random()
function Matrix3x3:random()
    local u = Matrix(3, 1):random()
    local a, b, tau = (1 - u[1]) ^ 0.5, u[1] ^ 0.5, 2 * math.pi
    return Matrix3x3:fromquaternion{
        a * math.sin(tau * u[2]), a * math.cos(tau * u[2]), b * math.sin(tau * u[3]), b * math.cos(tau * u[3]),
    }
end

--- Whether a matrix is a rotation, within a tolerance.
-- @api bool result = Matrix3x3:isorthonormal(Matrix m, float tol = 1e-9)
function Matrix3x3:isorthonormal(m, tol)
    local off = (m * m:t() - Matrix:eye(3)):abs():max()
    return off <= (tol or 1e-9)
end

---------------------------------------------------------------- poses

--- The pose of a rotation and a position.
-- @api Matrix m = Matrix4x4:fromrt(any r, any t)
function Matrix4x4:fromrt(r, t)
    local m = Matrix:eye(4)
    m:assign(1, 1, r)
    return m:assign(1, 4, Vector3(t))
end

--- The pose of a rotation at the origin.
-- @api Matrix m = Matrix4x4:fromrotation(Matrix m)
function Matrix4x4:fromrotation(m) return Matrix4x4:fromrt(m, {0.0, 0.0, 0.0}) end

--- The pose of a quaternion at the origin.
-- @api Matrix m = Matrix4x4:fromquaternion(any q)
function Matrix4x4:fromquaternion(q) return Matrix4x4:fromrotation(Matrix3x3:fromquaternion(q)) end

--- The pose of Euler angles at the origin.
-- @api Matrix m = Matrix4x4:fromeuler(any e)
function Matrix4x4:fromeuler(e) return Matrix4x4:fromrotation(Matrix3x3:fromeuler(e)) end

--- The pose of a position without rotation.
-- @api Matrix m = Matrix4x4:fromposition(any v)
function Matrix4x4:fromposition(v) return Matrix4x4:fromrt(Matrix:eye(3), v) end

--- The pose of a position and a quaternion.
-- @api Matrix m = Matrix4x4:frompose(any p)
function Matrix4x4:frompose(p)
    p = numbers(p)
    return Matrix4x4:fromrt(Matrix3x3:fromquaternion{p[4], p[5], p[6], p[7]}, {p[1], p[2], p[3]})
end

--- The rotation of a pose.
-- @api Matrix m = Matrix4x4:torotation(Matrix m)
function Matrix4x4:torotation(m) return m:slice(1, 1, 3, 3) end

--- The quaternion of a pose; its numbers are written into t if that is a table.
-- @api float[4] q = Matrix4x4:toquaternion(Matrix m, table t = nil)
function Matrix4x4:toquaternion(m, t) return result(quaternion(m), t) end

--- The Euler angles of a pose; they are written into t if that is a table.
-- @api float[3] e = Matrix4x4:toeuler(Matrix m, table t = nil)
function Matrix4x4:toeuler(m, t) return result(euler(m), t) end

--- The position of a pose; its numbers are written into t if that is a table.
-- @api float[3] v = Matrix4x4:toposition(Matrix m, table t = nil)
function Matrix4x4:toposition(m, t) return result(m:slice(1, 4, 3, 4):data(), t) end

--- The position and quaternion of a pose; its numbers are written into t if that is a table.
-- @api float[7] p = Matrix4x4:topose(Matrix m, table t = nil)
function Matrix4x4:topose(m, t)
    local pose = table.move(quaternion(m), 1, 4, 4, m:slice(1, 4, 3, 4):data())
    return result(pose, t)
end

--- The inverse of a pose: quicker than that of any matrix.
-- @api Matrix m = Matrix4x4:inv(Matrix m)
function Matrix4x4:inv(m)
    local back = Matrix4x4:torotation(m):t()
    return Matrix4x4:fromrt(back, -(back * m:slice(1, 4, 3, 4)))
end

--- A random pose.
-- @api Matrix m = Matrix4x4:random()
function Matrix4x4:random() return Matrix4x4:fromrt(Matrix3x3:random(), Vector3:random()) end

return M
