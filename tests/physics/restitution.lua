-- Balls dropped from 1 m: the rebound height is the restitution squared.
local bench = require 'lib.bench'

local RADIUS <const> = 0.1
bench.ground(0, 1)
local balls = {}
for i, bounce in ipairs{0, 0.25, 0.5, 0.75, 1} do
    balls[i] = {
        bounce = bounce, top = 0,
        body = bench.body{
            kind = sim.primitiveshape_spheroid, size = {2 * RADIUS, 2 * RADIUS, 2 * RADIUS}, at = {i, 0, 1 + RADIUS},
            mass = 1, solid = true, bounce = bounce,
        },
    }
end

bench.run(function()
    while sim.getSimulationTime() < 1.4 do
        sim.step()
        for _, ball in ipairs(balls) do
            local z, v = sim.getObjectPosition(ball.body)[3] - RADIUS, sim.getVelocity(ball.body)[3]
            -- Between two samples the top is missed: the energy that the integration keeps, in sub-steps of 5 ms, tells it.
            if sim.getSimulationTime() > 0.5 then ball.top = math.max(ball.top, z + v * v / (2 * bench.g) - v * 0.0025) end
        end
    end
    for _, ball in ipairs(balls) do
        bench.check(('rebound height at restitution %.2f, m'):format(ball.bounce), ball.top, ball.bounce ^ 2, 0.002)
    end
end)
