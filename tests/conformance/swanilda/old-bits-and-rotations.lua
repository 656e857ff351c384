-- topic: maths
-- as: sandbox
-- passes: 0
-- spec: poses 3, vrep-era 2.3, vrep-era 2.12
-- tol: 1e-6
-- note: bits, matrices and rotations in old functions, by closed forms
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

-- 12 = 1100b, 10 = 1010b.
print('bits', sim.boolAnd32(12, 10), sim.boolOr32(12, 10), sim.boolXor32(12, 10))
print('bits', sim.boolAnd16(12, 10), sim.boolOr16(12, 10), sim.boolXor16(12, 10))
-- The names with 16 do not cut to 16 bits.
print('wide', sim.boolAnd16(0x1FFFF, 0x10001), sim.boolOr16(0x10000, 1), sim.boolXor16(0x30000, 0x10000))

-- A quarter turn about z, then a shift.
local turned = {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3}
local copy = sim.copyMatrix(turned)
copy[4] = 9
print('copy', text(copy), turned[4])
print('inverse', text(sim.getInvertedMatrix(turned)), turned[4])
print('inverse', text(simGetInvertedMatrix(turned)), turned[4])
local q = sim.getQuaternionFromMatrix(turned)
print('quaternion', text(q), text(sim.getQuaternionInverse(q)))
-- The axes change places: a third of a turn about the diagonal.
q = sim.getQuaternionFromMatrix({0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0})
print('quaternion', text(q), text(sim.getQuaternionInverse{0.1, -0.7, 0.5, 0.5}))

local identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}
local axis, angle = sim.getRotationAxis(identity, {0, 0, 1, 5, 1, 0, 0, 5, 0, 1, 0, 5})
print('axis', text(axis), angle)
-- From an orientation that is turned itself: the axis is in the frame both are expressed in, not in that of the first.
local s, c = math.sin(math.pi / 6), math.cos(math.pi / 6)
local first = {0, 0, 0, 0, 0, math.sqrt(0.5), math.sqrt(0.5)}
local second = sim.multiplyPoses({1, 2, 3, 0, s, 0, c}, first)
axis, angle = sim.getRotationAxis(first, second)
print('axis', text(axis), angle)
axis, angle = sim.getRotationAxis(sim.poseToMatrix(second), sim.poseToMatrix(first))
print('back', text(axis), angle)

-- Milliseconds beside the seconds of sim.getSystemTime, read before and after.
local function advances(milliseconds, since)
    local outer = sim.getSystemTime()
    local first = milliseconds()
    local inner = sim.getSystemTime()
    while sim.getSystemTime() - inner < 0.02 do end
    local innerEnd = sim.getSystemTime()
    local passed = since and since(first) or milliseconds() - first
    local outerEnd = sim.getSystemTime()
    return math.type(first), passed >= (innerEnd - inner) * 1000 - 1, passed <= (outerEnd - outer) * 1000 + 1
end
print('time', advances(simGetSystemTimeInMilliseconds, simGetSystemTimeInMilliseconds))
print('time', advances(sim.getSystemTimeInMilliseconds))
print('time', advances(function() return sim.getSystemTimeInMs(-1) end, sim.getSystemTimeInMs))
