-- as: sandbox
-- passes: 0
-- spec: kinematics 5, paths 2; configurations with full turns, errors of sim.createPath
-- tol: 1e-6
-- topic: joints
sim = require 'sim'

local function joint(kind, cyclic, low, range)
    local h = sim.createJoint(kind, sim.jointmode_kinematic, 0)
    sim.setJointInterval(h, cyclic, {low, range})
    return h
end
local two = joint(sim.joint_revolute, false, -6, 12) -- room for two of most positions
local three = joint(sim.joint_revolute, false, -9, 18)
local one = joint(sim.joint_revolute, false, -3, 6)
local cyclic = joint(sim.joint_revolute, true, 0, 0)
local slider = joint(sim.joint_prismatic, false, -9, 18)

local function show(what, n, ...)
    local flat, t = sim.getAlternateConfigs(...), {}
    for i = 1, #flat, n do
        local one = {}
        for k = 0, n - 1 do one[#one + 1] = string.format('%.4f', flat[i + k]) end
        t[#t + 1] = '{' .. table.concat(one, ' ') .. '}'
    end
    print(what, #flat // n, table.concat(t, ' '))
end
show('two', 1, {two}, {0.5})
show('given the other one', 1, {two}, {0.5 - 2 * math.pi})
show('three', 1, {three}, {0.5})
show('the lowest is within', 1, {two}, {-6})
show('the highest is within', 1, {two}, {6})
show('two, but only one has room', 1, {two}, {0.1 - 2 * math.pi + 6})
show('less than a turn', 1, {one}, {0.5})
show('cyclic', 1, {cyclic}, {0.5})
show('a slider', 1, {slider}, {0.5})
show('all', 5, {two, three, one, cyclic, slider}, {0.5, -0.25, 1, 2, 3})
show('other limits', 2, {two, one}, {0.5, 0.5}, -1, {-1, -7}, {2, 14})
show('limits for a cyclic one', 1, {cyclic}, {0.5}, -1, {-7}, {14})
show('one turn exactly', 1, {two}, {0.5}, -1, {-math.pi}, {2 * math.pi})
show('both ends of a turn', 1, {two}, {math.pi}, -1, {-math.pi}, {2 * math.pi})
show('limits elsewhere', 1, {two}, {0.5}, -1, {20}, {7})
show('no joints', 1, {}, {})
local many, config = {}, {}
for i = 1, 9 do many[i], config[i] = three, 0.5 end
print('at most', #sim.getAlternateConfigs(many, config) // 9)

local function refused(what, f)
    local _, message = pcall(f)
    print(what, message)
end
local P <const> = {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}
refused('too few samples', function() sim.createPath(P, 0, 1) end)
refused('too many samples', function() sim.createPath(P, 0, 100001) end)
print('two samples', #sim.unpackDoubleTable(sim.getBufferProperty(sim.createPath(P, 0, 2), 'customData.PATH')))
-- Default: 100 samples, smoothed, no orientation of its own, nothing hidden, open.
local path = sim.createPath(P)
local info = sim.unpackTable(sim.readCustomStringData(path, 'ABC_PATH_INFO'))
print(info.bitCoded & 0x3f, info.pointCnt, info.smoothing, info.autoOrientation, table.unpack(info.upVector))
