-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; matrix, matrix-2, matrix-utils
print(require 'matrix', require 'matrix-2'.Matrix == Matrix, require 'matrix-2'.Vector7 == Vector7)
local function near(a, b) return a:sameshape(b) and (a - b):abs():max() < 1e-12 end
local m = Matrix{{1, 2}, {3, 4}}
print(m, m:rows(), m:cols(), m:count(), m[2], m[2][1], #m, m:t(), -m, m:totable(), m:totable{}, m:totable '', Matrix:fromtable{1, 2}, Matrix:fromtable(m:totable{}) == m, Matrix{1, 2})
m[2][1] = 5
m[1] = {7, 8}
print(m, m:row(1), m:col(2), m:rowref(2):setitem(1, 2, 9), m, m:copy():set(1, 1, 0), m:get(1, 2), m == m:copy())
print(Matrix(2, 3), Matrix(2, -1, {1, 2, 3, 4}), Matrix(2, 2, function(i, j) return 10 * i + j end), Vector{1, 2}, Vector(2, 5), Vector3{1, 2, 3})
m = Matrix{{1, 2, 3}, {4, 5, 6}}
print(m:slice(1, 2, 2, 3), m:flip(1), m:flip(2), m:droprow(1), m:dropcol(2), m:at({2}, {3, 1}), m:horzcat(m), pcall(function() return m .. m end), m:vertcat(m), m:repmat(1, 2))
print(Matrix:eye(2), Matrix:ones(1, 2), Matrix:zeros(2), Matrix:diag{1, 2}, m:diag(), Matrix(3, 3):assign(2, 2, m:slice(1, 1, 2, 2)))
print(m + m, m - 1, 2 * m, m / 2, m // 2, m % 2, m ^ 2, 1 - m, m:times(m), m * m:t(), m:mult{1, 0, 1})
print(m:sum(), m:sum(1), m:sum(2), m:prod(), m:mean(2), m:min(), m:max(1), m:max(m * 0 + 3), m:fold(2, 0, math.max))
print(m:gt(3), m:all(), m:any(function(x) return x > 6 end), m:where(m:gt(3), m, 0), m:gt(4):nonzero(), m:isnan():any())
print(m:applyfunc(function(x) return x + 0.5 end):floor(), m:abs(), m:log(2)[1][2], Vector{4}:sqrt(), m:applyfuncidx(function(i, j) return i * j end))
local a, b = Vector3{1, 0, 0}, Vector3{0, 1, 0}
print(a:dot(b), a:cross(b), Vector3{3, 4, 0}:norm(), Vector3{3, 4, 0}:normalized(), a:kron(b):count(), a:hom(), a:hom():nonhom())
local s = Matrix{{4, 7, 2}, {2, 6, 1}, {0, 3, 5}}
print(s:det(), s:trace(), near(s * s:inv(), Matrix:eye(3)), s:power(2) == s * s, near(s:power(-1), s:inv()), Matrix{{1, 2}, {2, 4}}:det(), Matrix{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 3}}:det())
print(pcall(Matrix.inv, Matrix{{1, 2}, {2, 4}}))
print(Matrix{{1, 2}, {3, 4}}:gauss(), near(Matrix{{1, 2}, {3, 4}}:gauss(true), Matrix:eye(2)), select(2, Matrix{{1, 2}, {4, 3}}:gauss()))
local tall = Matrix{{1, 2}, {3, 4}, {5, 6}}
local values, u, v = tall:svd()
print(values:rows(), near(u * Matrix:diag(values) * v:t(), tall), near(tall:pinv() * tall, Matrix:eye(2)), near(tall:t():pinv(), tall:pinv():t()))
print(near(s:pinv{1, 2, 3}, s:inv() * Vector3{1, 2, 3}), near(Matrix{{1, 2}, {2, 4}}:pinv(), Matrix{{1, 2}, {2, 4}} / 25))
print(Vector:range(1, 5, 2), Vector:linspace(0, 1, 3), Vector:linspace(0, 1, 2, false), Vector:logspace(0, 2, 3), near(Vector:geomspace(1, 4, 3), Vector{1, 2, 4}))
local e = {0.1, 0.2, 0.3}
local r = Matrix3x3:fromeuler(e)
print(near(Vector3(Matrix3x3:toeuler(r)), Vector3(e)), near(Matrix3x3:fromquaternion(Matrix3x3:toquaternion(r)), r), Matrix3x3:isorthonormal(r), #Matrix3x3:toquaternion(r, {}))
print(near(Matrix3x3:fromaxisangle({0, 0, 2}, 0.5), Matrix3x3:rotz(0.5)), near(Matrix3x3:random():det() * Matrix:eye(1), Matrix:eye(1)))
for _, angles in ipairs{{math.pi, 0, 0}, {0, math.pi, 0}, {0, 0, math.pi}, {0.3, math.pi / 2, 0}} do
    local rotation = Matrix3x3:fromeuler(angles)
    print(near(Matrix3x3:fromquaternion(Matrix3x3:toquaternion(rotation)), rotation), near(Matrix3x3:fromeuler(Matrix3x3:toeuler(rotation)), rotation))
end
local p = Matrix4x4:fromrt(r, {1, 2, 3})
print(near(Matrix4x4:inv(p) * p, Matrix:eye(4)), near(Matrix4x4:frompose(Matrix4x4:topose(p)), p), Matrix4x4:toposition(p), #Matrix4x4:topose(p), #Matrix4x4:toquaternion(p), #Matrix4x4:toeuler(p), Matrix4x4:frompose{1, 2, 3, 0, 0, 0, 1}:row(4), p:axis('x'):rows(), near(p:mult(a), r * a + Vector3{1, 2, 3}))
print(require 'simCBOR'.decode(require 'simCBOR'.encode(m)) == m)
m:print('m')
for _, bad in ipairs{
    function() return Matrix(2, 2, {1}) end, function() return Matrix(-1, 2) end, function() return m * m end, function() return m + s end,
    function() return m:item(3, 1) end, function() return Vector3{1} end, function() m[5] = 1 end, function() return Matrix(1 << 20, 1 << 20) end,
} do print((select(2, pcall(bad)):gsub('^.-: ', ''))) end
local sim = require 'matrix-utils'
local d = sim.createDummy(0.1)
sim.setObjectPosition(d, Vector3{1, 2, 3})
sim.setObjectOrientation(d, Vector3(e))
print(sim.getObjectPosition(d), near(sim.getObjectOrientation(d), Vector3(e)), sim.getObjectPose(d):rows(), near(sim.getObjectMatrix(d), p))
sim.setObjectMatrix(d, Matrix:eye(4))
print(sim.getObjectPosition(d), near(sim.getObjectQuaternion(d), Vector4{0, 0, 0, 1}))
