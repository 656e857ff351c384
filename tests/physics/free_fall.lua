-- A falling body and a projectile, compared with the integrator's sum and with g t^2 / 2.
local bench = require 'lib.bench'

local ball = bench.body{at = {0, 0, 100}, mass = 1}
local thrown = bench.body{at = {10, 0, 0}, mass = 2}
sim.setObjectFloatParam(thrown, sim.shapefloatparam_init_velocity_x, 3)
sim.setObjectFloatParam(thrown, sim.shapefloatparam_init_velocity_z, 4)

bench.run(function()
    local h, n = 0.005, 200
    bench.untilTime(1)
    local z = sim.getObjectPosition(ball)[3]
    bench.check('drop after 1 s, sum over the sub-steps', 100 - z, bench.g * h * h * n * (n + 1) / 2, 1e-5)
    bench.check('drop after 1 s, g t^2 / 2', 100 - z, bench.g / 2, 0.03)
    local p = sim.getObjectPosition(thrown)
    bench.check('distance of a projectile after 1 s', p[1] - 10, 3, 1e-6)
    bench.check('height of a projectile after 1 s', p[3], 4 - bench.g / 2, 0.03)
end)
