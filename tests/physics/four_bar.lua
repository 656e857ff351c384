-- A parallelogram closed by a pair of dummies: crank and rocker turn equally, the coupler stays horizontal.
local bench = require 'lib.bench'

local it = require('lib.four_bar').build(sim.jointdynctrl_velocity)
sim.setJointTargetVelocity(it.crank, 2)

bench.run(function()
    bench.untilTime(5)
    bench.check('crank after 5 s at 2 rad/s, rad', (sim.getJointPosition(it.crank) + 4 * math.pi) % (2 * math.pi), 10 % (2 * math.pi), 1e-3)
    bench.check('difference of rocker and crank, rad', sim.getJointPosition(it.rocker) - sim.getJointPosition(it.crank), 0, 1e-6)
    bench.check('tilt of the coupler, rad', sim.getObjectOrientation(it.coupler)[2], 0, 1e-6)
    local a, b = sim.getObjectPosition(it.ties[1]), sim.getObjectPosition(it.ties[2])
    bench.check('gap of the closure, m', math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2), 0, 1e-6)
end)
