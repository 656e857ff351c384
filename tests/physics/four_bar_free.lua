-- The same parallelogram without a motor, through its singular positions: energy is conserved.
local bench = require 'lib.bench'

local bars = require 'lib.four_bar'
local it = bars.build()
sim.setObjectFloatParam(it.left, sim.shapefloatparam_init_velocity_b, 3)

bench.run(function()
    local first, most, apart = nil, 0, 0
    for _ = 1, 600 do
        sim.step()
        local now = bench.energy(it.left) + bench.energy(it.coupler) + bench.energy(it.right)
        first = first or now
        most = math.max(most, math.abs(now - first))
        local turn = sim.getJointPosition(it.rocker) - sim.getJointPosition(it.crank)
        apart = math.max(apart, math.abs((turn + math.pi) % (2 * math.pi) - math.pi))
    end
    local fall = 2 * bars.MASS * 2 * bars.LENGTH * bench.g
    -- What a passage costs depends on how near the bars come to the singular position: 0.015 to 0.1 for first velocities of 2.7 to 3.3 rad/s.
    bench.check('largest change of energy in 30 s, relative', most / fall, 0, 0.1)
    bench.check('largest difference of rocker and crank, rad', apart, 0, 1e-3)
end)
