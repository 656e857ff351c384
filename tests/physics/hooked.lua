-- A plate with a leg that hangs down beside the table on which it slides: the leg stops at a wall that is lower than the table.
local bench = require 'lib.bench'

local function box(size, at) return bench.body{size = size, at = at, fixed = true, solid = true} end
box({1, 1, 0.1}, {-0.5, 0, 0.45})
box({0.1, 1, 0.3}, {0.17, 0, 0.15})

local parts = {bench.body{size = {0.8, 0.1, 0.05}, at = {-0.35, 0, 0.525}, mass = 4, solid = true},
               bench.body{size = {0.02, 0.1, 0.3}, at = {0.04, 0, 0.35}, mass = 0.6, solid = true}}
local plate = sim.groupShapes(parts)
sim.setObjectFloatParam(plate, sim.shapefloatparam_init_velocity_x, 0.3)

bench.run(function()
    local from = sim.getObjectPosition(plate)
    local farthest = 0
    while sim.getSimulationTime() < 2 do
        sim.step()
        farthest = math.max(farthest, sim.getObjectPosition(plate)[1] - from[1])
    end
    bench.check('farthest way, to the wall, m', farthest, 0.07, 1e-3)
    bench.check('way down, m', from[3] - sim.getObjectPosition(plate)[3], 0, 1e-3)
end)
