-- topic: modules
-- as: sandbox
-- passes: 0
-- loops: 5
-- tol: 1e-9
-- spec: libraries 3; simEigen: matrices, vectors, quaternions, poses, and the functions below them
sim = require 'sim'
local simEigen = require 'simEigen'
local Matrix, Vector, Quaternion, Pose = simEigen.Matrix, simEigen.Vector, simEigen.Quaternion, simEigen.Pose

local function round(list)
    local t = {}
    for i, x in ipairs(type(list) == 'table' and getmetatable(list) and list:data() or list) do
        t[i] = ('%.6f'):format(math.abs(x) < 1e-9 and 0 or x)
    end
    return table.concat(t, ' ')
end

local a, b = Matrix{{1, 2}, {3, 4}}, Matrix(2, 2, {5, 6, 7, 8})
print(a, a:rows(), a:cols(), a:count(), #a, a == Matrix(2, 2, {1, 2, 3, 4}), a == b)
print(a + b, a - 1, 10 - a, a * b, 2 * a, a / 2, -a, b // 3, b % 3)
print(a .. b, a:vertcat(b), Matrix:horzcat(a, {{9}, {9}}))
print(a[1], a[2][1], a:item(2, 1), a:row(2), a:col(2), a:t(), a:det(), a:trace(), a:sum(), a:mean(), a:prod(), a:mincoeff(), a:maxcoeff())
print(a:times(b), a:min(b), a:max(2), a:kron(Matrix:eye(2)))
print(round(a:sqrt()), round(a:sin()), round(a:log10()), round(a:exp()))
local c = a:copy()
print(c:iadd(1), c == a + 1, c:imul(b), c:iabs(), c:transpose())
c[1] = {0, 0}
c:setitem(2, 2, 7):setcoldata(1, {1, 1})
print(c, c:block(2, 1, 1, -1), c:blockassign({{4}}, 1, 2), c:reshaped(1, 4), c:totable(), c:togrid())
print(Matrix:linspace(0, 1, 5), Matrix:ismatrix(a, 2, 2), Matrix:ismatrix(3), Vector:isvector(Vector(3)))

local v, w = Vector{1, 2, 3}, Vector{0, 1, 0}
print(v:dot(w), v:cross(w), v:norm(), v:squarednorm(), round(v:normalized()), v[3], #v)
v[3] = 5
local sum = 0
for i, x in pairs(v) do sum = sum + i * x end
print(v, sum, v:rowdata(2))

local m = Matrix{{4, 0}, {3, -5}, {1, 1}}
local s, u, vt, x = m:svd(true, true, Vector{1, 2, 3})
local diagonal = Matrix(2, 2, {s[1], 0, 0, s[2]})
print(round(s), round(u * diagonal * vt:t()), (u:t() * u - Matrix:eye(2)):abs():maxcoeff() < 1e-12)
print(round((m:pinv() * m)), round(x), round(select(2, m:pinv({1, 2, 3}))), m:svd() == s, select(2, m:svd()):count())
print(round(m:pinv(nil, 0.1)))
local grid = simEigen.pinv({dims = {2, 2}, data = {2, 0, 0, 4}})
print(grid.dims, round(grid.data), #simEigen.svd({dims = {2, 1}, data = {3, 4}}).data)

local q = Quaternion:fromaxisangle({0, 0, 1}, math.pi / 2)
print(round(q), round(q * Vector{1, 0, 0}), round(q:inv()), round(q * q:inv()), q.w == q[4], #q)
local axis, angle = (q * q):toaxisangle()
print(round(axis), round{angle}, round(q:toypr()), round(Quaternion:fromypr{0.1, 0.2, 0.3}:toypr()))
local euler = {0.4, -0.7, 1.1}
print(round(Quaternion:fromeuler(euler):toeuler()), round(Quaternion:fromeuler(euler)), round({table.unpack(sim.buildPose({0, 0, 0}, euler), 4)}))
print(round(Quaternion:fromrotation(q:torotation())), round(Quaternion:fromtwovectors({1, 0, 0}, {0, 2, 0})))
print(round(Quaternion():slerp(0.5, q)), round(Quaternion:fromtwovectors({1, 0, 0}, {-1, 0, 0}) * Vector{1, 0, 0}))
local r = Quaternion:random()
print(math.abs(r:tovector():norm() - 1) < 1e-12, r:torotation():isorthogonal(), r:torotation():det() > 0)

local p = Pose(Vector{1, 2, 3}, q)
print(round(p), round(p * Vector{1, 0, 0}), round(p * p), round(p:inv() * p), round(-p), p.t, #p, p[2])
print(round(p:totransform()), round(Pose:fromtransform(p:totransform())), round(p:interp(0.5, Pose())))
print(round(p:totransform():inversetransform() * p:totransform()), round(p:totransform():transform{1, 0, 0}))
print(round(sim.multiplyPoses(p:data(), p:data())), Pose:ispose(p), Pose:random({5, 5, 5}, {5, 5, 5}).t)

for _, f in ipairs{
    function() return a * v end, function() return a + v end, function() return Matrix(2, 2, {1}) end, function() return a ^ b end,
    function() return a | b end, function() return a:freeze() end, function() return a:data(1) end, function() return a:item(3, 1) end,
    function() return Matrix(-1, 2) end, function() return Matrix(100000, 100000) end, function() return Quaternion{1} end,
    function() return Quaternion{0, 0, 0, 0}:inv() end, function() return m:det() end, function() return Matrix(1, 1, {0 / 0}):svd() end,
    function() return Matrix(100000, 100000, 1) end, function() return Matrix{{1, 2}, {3}} end, function() return Vector{1, 2}:cross(Vector{1, 2}) end, function() return -q end,
    function() return simEigen.mtxGetData('1:Matrix') end, function() return simEigen.mtxOp(simEigen.mtxNew(1, 1), 12) end,
    function() a[5] = 1 end, function() return Quaternion:fromaxisangle({0, 0, 0}, 1) end,
} do
    print((select(2, pcall(f)):gsub('^.-:%d+: ', '')))
end

local h = simEigen.mtxNew(2, 3, {1, 2, 3, 4, 5, 6})
print(simEigen.mtxGetSize(h), simEigen.mtxGetItem(h, 1, 2), simEigen.mtxGetColData(h, 1), simEigen.mtxOpK(h, simEigen.op.times, 2), simEigen.mtxGetData(h))
print(simEigen.mtxGetData(simEigen.mtxBlock(h, 0, 1)), simEigen.mtxGetData(simEigen.mtxLinSpaced(3)), simEigen.mtxDestroy(h), (pcall(simEigen.mtxCopy, h)))

-- Matrices that nobody has any more end by themselves.
for i = 1, 80 do local large = Matrix(1000, 1000) end
print('collected', math.type(simEigen.op.unm))
