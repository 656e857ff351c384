-- Friction opposes the slip of each point: a disc that spins slides farther than one that does not.
local bench = require 'lib.bench'

bench.ground(1)
-- Spin in rad/s; way at 3 m/s, friction 0.4 and a radius of 0.1 m, with the load on four points of the rim (numerical integration of the equations).
local CASES <const> = {{0, 1.147}, {30, 1.455}, {60, 2.25}}
local discs = {}
for index, case in ipairs(CASES) do
    local disc = bench.body{
        kind = sim.primitiveshape_cylinder, size = {0.2, 0.2, 0.05}, at = {0, 2 * index, 0.025}, mass = 2, solid = true, friction = 0.4,
    }
    sim.setObjectFloatParam(disc, sim.shapefloatparam_init_velocity_x, 3)
    sim.setObjectFloatParam(disc, sim.shapefloatparam_init_velocity_g, case[1])
    discs[index] = disc
end

bench.run(function()
    bench.untilTime(3)
    for index, case in ipairs(CASES) do
        bench.check(('way of a disc that spins at %d rad/s, m'):format(case[1]), sim.getObjectPosition(discs[index])[1], case[2], 0.06)
    end
end)
