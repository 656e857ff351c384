-- Two rods, released horizontally: chaotic, but energy is conserved.
local bench = require 'lib.bench'

local parent = bench.body{at = {0, 0, 2}, fixed = true}
local rods = {}
for i = 1, 2 do
    local x = 0.3 * (i - 1)
    local joint = bench.joint{at = {x, 0, 2}, parent = parent}
    rods[i] = bench.body{size = {0.3, 0.02, 0.02}, at = {x + 0.15, 0, 2}, mass = 1, parent = joint}
    parent = rods[i]
end

bench.run(function()
    local function total() return bench.energy(rods[1]) + bench.energy(rods[2]) end
    local before, worst = total(), 0
    local scale = bench.g * (0.15 + 0.45) -- what there is to turn into motion
    while sim.getSimulationTime() < 10 do
        sim.step()
        worst = math.max(worst, math.abs(total() - before) / scale)
    end
    bench.check('largest change of energy in 10 s, relative', worst, 0, 0.05)
end)
