-- Balls of up to 600 m/s, which move by 3 m in a sub-step, do not pass a wall of 1 cm.
local bench = require 'lib.bench'

bench.gravity(0)
bench.body{size = {0.01, 4, 4}, at = {5, 0, 2}, fixed = true, solid = true}
local SPEEDS <const> = {50, 100, 300, 600}
local balls = {}
for i, speed in ipairs(SPEEDS) do
    balls[i] = bench.body{
        kind = sim.primitiveshape_spheroid, size = {0.1, 0.1, 0.1}, at = {0, -1.5 + 0.5 * i, 2}, mass = 1, solid = true,
    }
    sim.setObjectFloatParam(balls[i], sim.shapefloatparam_init_velocity_x, speed)
end

bench.run(function()
    bench.untilTime(0.5)
    for i, speed in ipairs(SPEEDS) do
        bench.check(string.format('ball of %g m/s stops at the wall, m', speed), sim.getObjectPosition(balls[i])[1], 4.945, 5e-3)
    end
end)
