-- A parallelogram closed by a pair of dummies: crank and rocker turn alike, the coupler stays level.
local bench = require 'lib.bench'

local base = bench.body{at = {0.25, 0, 1}, fixed = true}
local function bar(from, size, at, parent, mode)
    local joint = bench.joint{at = from, parent = parent, mode = mode, force = mode and 100}
    return joint, bench.body{size = size, at = at, mass = 0.2, parent = joint}
end
local crank, left = bar({0, 0, 1}, {0.02, 0.02, 0.2}, {0, 0, 1.1}, base, sim.jointdynctrl_velocity)
local _, coupler = bar({0, 0, 1.2}, {0.5, 0.02, 0.02}, {0.25, 0, 1.2}, left)
local rocker, right = bar({0.5, 0, 1}, {0.02, 0.02, 0.2}, {0.5, 0, 1.1}, base)
local hinge = bench.joint{at = {0.5, 0, 1.2}, parent = coupler}
local function tie(parent)
    local dummy = sim.createDummy(0.01)
    sim.setObjectPose(dummy, sim.getObjectPose(hinge))
    sim.setObjectParent(dummy, parent, true)
    sim.setObjectInt32Param(dummy, sim.dummyintparam_dummytype, sim.dummytype_dynloopclosure)
    return dummy
end
local one, other = tie(hinge), tie(right)
sim.setLinkDummy(one, other)
sim.setJointTargetVelocity(crank, 2)

bench.run(function()
    bench.untilTime(5)
    bench.check('crank after 5 s at 2 rad/s, rad', (sim.getJointPosition(crank) + 4 * math.pi) % (2 * math.pi), 10 % (2 * math.pi), 1e-3)
    bench.check('rocker less crank, rad', sim.getJointPosition(rocker) - sim.getJointPosition(crank), 0, 1e-6)
    bench.check('tilt of the coupler, rad', sim.getObjectOrientation(coupler)[2], 0, 1e-6)
    local a, b = sim.getObjectPosition(one), sim.getObjectPosition(other)
    bench.check('gap of the closure, m', math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2), 0, 1e-6)
end)
