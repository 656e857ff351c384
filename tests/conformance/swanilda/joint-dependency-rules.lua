-- as: sandbox
-- passes: 0
-- spec: joints 5; chains of dependencies, circles, limits, spherical joints, modes, removal, copies
-- tol: 1e-6
-- topic: joints
sim = require 'sim'
local try = require('lib.trial').try

local R <const>, S <const>, P <const> = sim.joint_revolute, sim.joint_spherical, sim.joint_prismatic
local KINEMATIC <const>, DEPENDENT <const> = sim.jointmode_kinematic, sim.jointmode_dependent
local link = sim.setJointDependency

local function follower(type) return sim.createJoint(type or R, DEPENDENT, 0) end
local function free(type) return sim.createJoint(type or R, KINEMATIC, 0) end
local function names(...)
    local t = {}
    for i, name in ipairs{'a', 'b', 'c', 'd'} do
        local handle = select(i, ...)
        if handle then
            local master = sim.getJointDependency(handle)
            t[i] = name .. ' follows ' .. (master < 0 and 'nobody' or sim.getObjectAlias(master))
        end
    end
    return table.concat(t, ', ')
end
local function named(handle, name)
    sim.setObjectAlias(handle, name)
    return handle
end

local a, b, c, d = free(), follower(), follower(), follower(P)
try('arguments', link, b, a)
try('results', function() return link(b, a, 0.1, 2), link(c, b, 0.2, 3), link(d, c, 0, -1) end)
sim.setJointPosition(a, 0.3)
try('chain', function() return sim.getJointPosition(b), sim.getJointPosition(c), sim.getJointPosition(d) end)
sim.setJointPosition(c, 5) -- as it is, and only until its master moves
try('for a while', function() return sim.getJointPosition(c), sim.getJointPosition(d) end)
sim.setJointPosition(a, 0.3)
try('again', function() return sim.getJointPosition(c), sim.getJointPosition(d) end)
try('of itself', function() link(c, c, 0, 1) return sim.getJointDependency(c) == b end)

local x, y, z = named(follower(), 'a'), named(follower(), 'b'), named(follower(), 'c')
link(y, x, 0, 1)
link(z, y, 0, 1)
print('before', names(x, y, z))
link(x, z, 0, 1) -- the one of the circle that follows x is freed
print('circle of three', names(x, y, z))
link(z, x, 0, 1)
print('circle of two', names(x, y, z))

try('large', function() link(b, a, 1e9, -1e9) return select(2, sim.getJointDependency(b)) end)
try('nan', function() link(b, a, 0 / 0, 1) return select(2, sim.getJointDependency(b)) end)
try('unknown master', link, b, 99999, 0, 1)
try('unknown', link, 99999, a, 0, 1)
try('dummy', link, sim.createDummy(0.01), a, 0, 1)
try('to a dummy', link, b, sim.createDummy(0.01), 0, 1)
try('spherical', function() local s = free(S) return link(s, a, 0, 1), sim.getJointDependency(s) end)
try('to a spherical one', function() local f = follower() return link(f, free(S), 0, 1), sim.getJointDependency(f) end)
try('spherical mode', function() local s = free(S) return sim.setJointMode(s, DEPENDENT, 0), sim.getJointMode(s) end)
try('none', function() link(b, -1, 0, 1) return sim.getJointDependency(b) end)

try('beyond its interval', function()
    local m, f = free(), follower()
    sim.setJointInterval(f, false, {-0.1, 0.2})
    link(f, m, 0, 2)
    sim.setJointPosition(m, 1)
    return sim.getJointPosition(f)
end)
try('not in the mode', function()
    local m, f = free(), free()
    link(f, m, 0, 2)
    sim.setJointPosition(m, 1)
    local still = sim.getJointPosition(f)
    sim.setJointMode(f, DEPENDENT, 0)
    return still, sim.getJointPosition(f), sim.getJointDependency(f) == m
end)
try('mode left', function()
    local f = follower()
    link(f, a, 0, 2)
    sim.setJointMode(f, KINEMATIC, 0)
    return sim.getJointDependency(f)
end)
try('master removed', function()
    local m, f = free(), follower()
    link(f, m, 0, 2)
    sim.setJointPosition(m, 0.3)
    sim.removeObjects{m}
    return sim.getJointPosition(f), (sim.getJointDependency(f))
end)
try('copied together', function()
    local m, f = free(), follower()
    link(f, m, 0, 2)
    local copies = sim.copyPasteObjects({m, f}, 0)
    return sim.getJointDependency(copies[2]) == copies[1]
end)
try('a long chain', function()
    local first = free()
    local last = first
    for _ = 1, 300 do
        local f = follower()
        link(f, last, 0, 1)
        last = f
    end
    sim.setJointPosition(first, 0.25)
    return sim.getJointPosition(last)
end)
