-- The same parallelogram without a motor, through the positions in which it lies flat and could fold the other way: the energy stays.
local bench = require 'lib.bench'

local LENGTH <const>, WIDTH <const>, MASS <const> = 0.2, 0.5, 0.2
local base = bench.body{at = {WIDTH / 2, 0, 1}, fixed = true}
local function bar(from, size, at, parent)
    local joint = bench.joint{at = from, parent = parent}
    return joint, bench.body{size = size, at = at, mass = MASS, parent = joint}
end
local crank, left = bar({0, 0, 1}, {0.02, 0.02, LENGTH}, {0, 0, 1 + LENGTH / 2}, base)
local _, coupler = bar({0, 0, 1 + LENGTH}, {WIDTH, 0.02, 0.02}, {WIDTH / 2, 0, 1 + LENGTH}, left)
local rocker, right = bar({WIDTH, 0, 1}, {0.02, 0.02, LENGTH}, {WIDTH, 0, 1 + LENGTH / 2}, base)
local hinge = bench.joint{at = {WIDTH, 0, 1 + LENGTH}, parent = coupler}
local function tie(parent)
    local dummy = sim.createDummy(0.01)
    sim.setObjectPose(dummy, sim.getObjectPose(hinge))
    sim.setObjectParent(dummy, parent, true)
    sim.setObjectInt32Param(dummy, sim.dummyintparam_dummytype, sim.dummytype_dynloopclosure)
    return dummy
end
sim.setLinkDummy(tie(hinge), tie(right))
sim.setObjectFloatParam(left, sim.shapefloatparam_init_velocity_b, 3)

bench.run(function()
    local first, most, apart = nil, 0, 0
    for _ = 1, 600 do
        sim.step()
        local now = bench.energy(left) + bench.energy(coupler) + bench.energy(right)
        first = first or now
        most = math.max(most, math.abs(now - first))
        local turn = sim.getJointPosition(rocker) - sim.getJointPosition(crank)
        apart = math.max(apart, math.abs((turn + math.pi) % (2 * math.pi) - math.pi))
    end
    local fall = 2 * (MASS * LENGTH + MASS * 2 * LENGTH / 2) * bench.g
    bench.check('largest change of the energy in 30 s, of what falls', most / fall, 0, 5e-2)
    bench.check('rocker less crank at most, rad', apart, 0, 1e-3)
end)
