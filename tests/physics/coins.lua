-- Thin things on each other keep their height, and so do light things under heavy ones.
local bench = require 'lib.bench'

bench.ground(1)
local function pile(x, kind, size, mass, count)
    local height, top = size[3], nil
    for level = 1, count do
        local z = height * (level - 0.5)
        top = bench.body{kind = sim['primitiveshape_' .. kind], size = size, at = {x, 0, z}, mass = mass, solid = true, friction = 0.5}
    end
    return top, height * (count - 0.5)
end
local PILES <const> = {
    {'8 coins of 5 g', 'cylinder', {0.02, 0.02, 0.002}, 0.005, 8}, {'16 coins of 1 mg', 'cylinder', {0.02, 0.02, 0.002}, 1e-6, 16},
    {'8 cards of 1 g', 'cuboid', {0.09, 0.06, 0.001}, 0.001, 8}, {'8 plates of 10 kg', 'cuboid', {0.3, 0.3, 0.002}, 10, 8},
}
local tops = {}
for index, it in ipairs(PILES) do
    local top, height = pile(index, table.unpack(it, 2))
    tops[index] = {it[1], top, height, it[3][3]}
end
local foot = bench.body{size = {0.1, 0.1, 0.05}, at = {10, 0, 0.025}, mass = 0.01, solid = true, friction = 1}
local block = bench.body{size = {0.1, 0.1, 0.1}, at = {10, 0, 0.1}, mass = 100, solid = true, friction = 1}

bench.run(function()
    bench.untilTime(2)
    for _, it in ipairs(tops) do
        bench.check(it[1] .. ': height of the top one, m', sim.getObjectPosition(it[2])[3], it[3], 0.02 * it[4])
    end
    bench.check('100 kg on 10 g: height, m', sim.getObjectPosition(block)[3], 0.1, 3e-4)
    bench.check('height of what bears it, m', sim.getObjectPosition(foot)[3], 0.025, 2e-4)
end)
