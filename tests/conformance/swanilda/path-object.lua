-- as: sandbox
-- passes: 0
-- spec: paths 2; createPath and its data, options, errors; following it; getConfigDistance with types and metric
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function line(what, ...)
    local t = {}
    for _, value in ipairs{...} do
        if type(value) == 'table' then
            for _, x in ipairs(value) do t[#t + 1] = string.format('%.6f', x + 1e-12) end
        else
            t[#t + 1] = tostring(value)
        end
    end
    print(what, table.concat(t, ' '))
end

local function poses(...)
    local t = {}
    for _, p in ipairs{...} do for _, x in ipairs{p[1], p[2], p[3], 0, 0, 0, 1} do t[#t + 1] = x end end
    return t
end

local CORNER <const> = poses({0, 0, 0}, {1, 0, 0}, {1, 1, 0})
local path = sim.createPath(CORNER)
line('object', sim.getObjectAlias(path), sim.getObjectType(path) == sim.sceneobject_dummy, sim.isModel and sim.isModel(path))
local control = sim.unpackDoubleTable(sim.getBufferProperty(path, 'customData.PATHCTRLPTS'))
local points = sim.unpackDoubleTable(sim.getBufferProperty(path, 'customData.PATH'))
line('control points', #control // 7, control[8], control[15], control[16])
line('points', #points // 7)
line('first', points[1], points[2], points[3])
line('last', points[#points - 6], points[#points - 5], points[#points - 4])
local same = sim.unpackDoubleTable(sim.readCustomStringData(path, 'PATH'))
line('by the old function', #same == #points and same[8] == points[8])

-- It cuts the corner by way of a quadratic blend: half way it is at (0.875, 0.125).
local nearest = 9
for i = 1, #points, 7 do nearest = math.min(nearest, math.abs(points[i] - 0.875) + math.abs(points[i + 1] - 0.125)) end
line('rounds the corner', nearest < 0.02)

local sharp = sim.createPath(CORNER, 0, 21, 0.05)
line('subdivisions', #sim.unpackDoubleTable(sim.getBufferProperty(sharp, 'customData.PATH')) // 7)
local closed = sim.unpackDoubleTable(sim.getBufferProperty(sim.createPath(CORNER, 2, 50), 'customData.PATH'))
line('closed', #closed // 7, math.abs(closed[1] - closed[#closed - 6]) < 1e-6 and math.abs(closed[2] - closed[#closed - 5]) < 1e-6)

-- Along x, then y: computed orientations follow, with y upwards (mode 0).
local directed = sim.unpackDoubleTable(sim.getBufferProperty(sim.createPath(CORNER, 16, 100, 1, 0, {0, 0, 1}), 'customData.PATH'))
local function axis(at, column)
    local m = sim.poseToMatrix({table.unpack(directed, 7 * at + 1, 7 * at + 7)})
    return {m[column], m[4 + column], m[8 + column]}
end
line('directed', axis(1, 1), axis(98, 1))
line('upwards', axis(1, 2), axis(98, 2))

local lengths, total = sim.getPathLengths(points, 7)
line('length', total > 1.75 and total < 1.95, #lengths == #points // 7)
local object = sim.createDummy(0.01)
local previous, evenly = nil, true
for i = 0, 10 do
    local pose = sim.getPathInterpolatedConfig(points, lengths, total * i / 10, nil, {0, 0, 0, 2, 2, 2, 2})
    sim.setObjectPose(object, pose)
    local p = sim.getObjectPosition(object)
    if previous then evenly = evenly and math.abs(math.sqrt((p[1] - previous[1]) ^ 2 + (p[2] - previous[2]) ^ 2) - total / 10) < 0.02 end
    previous = p
end
line('followed evenly', evenly, previous)

print(pcall(sim.createPath, poses({0, 0, 0})))
print(pcall(sim.createPath, {1, 2, 3}))
print((pcall(sim.createPath, poses({0, 0, 0}, {0, 0, 0}))))

line('distance', sim.getConfigDistance({0, 0}, {3, 4}), sim.getConfigDistance({0, 0}, {3, 4}, {2, 1}))
local s = math.sqrt(0.5)
line('quaternions', sim.getConfigDistance({0, 0, 0, 1}, {0, 0, s, s}, {1, 1, 1, 1}, {2, 2, 2, 2}),
    sim.getConfigDistance({0, 0, 0, 1}, {0, 0, 0, -1}, {1, 1, 1, 1}, {2, 2, 2, 2}))
-- As in the original: the second value, wrapped.
line('cyclic', sim.getConfigDistance({0.5}, {1}, {1}, {1}), sim.getConfigDistance({3}, {-3}, {1}, {1}))
