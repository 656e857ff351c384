-- Newton's cradle with gaps of 1 cm, so that the collisions happen one after the other: only the last ball keeps moving.
local bench = require 'lib.bench'

bench.gravity(0)
local RADIUS <const> = 0.05
local balls = {}
for i = 1, 5 do
    local x = i == 1 and -0.5 or 0.11 * i
    balls[i] = bench.body{
        kind = sim.primitiveshape_spheroid, size = {2 * RADIUS, 2 * RADIUS, 2 * RADIUS}, at = {x, 0, 1}, mass = 0.2,
        solid = true, bounce = 1,
    }
end
sim.setObjectFloatParam(balls[1], sim.shapefloatparam_init_velocity_x, 1)

bench.run(function()
    bench.untilTime(2)
    local momentum = 0
    for i = 1, 5 do
        local v = sim.getVelocity(balls[i])[1]
        momentum = momentum + 0.2 * v
        bench.check(('speed of ball %d, m/s'):format(i), v, i == 5 and 1 or 0, 0.05)
    end
    bench.check('momentum, N s', momentum, 0.2, 1e-6)
end)
