-- A square peg that is dropped over a square hole with half a millimetre of play falls as if there were no hole around it.
local bench = require 'lib.bench'

local WIDTH <const>, LENGTH <const>, PLAY <const>, DEPTH <const> = 0.02, 0.06, 5e-4, 0.05

-- Four walls around a hole at x, their tops at z = 0.
local function hole(x, y)
    local wall, half = 0.1, (WIDTH + PLAY) / 2
    for _, side in ipairs{{1, 0}, {-1, 0}, {0, 1}, {0, -1}} do
        local away = half + wall / 2
        local size = side[1] ~= 0 and {wall, 2 * (half + wall), DEPTH} or {2 * half, wall, DEPTH}
        bench.body{size = size, at = {x + side[1] * away, y + side[2] * away, -DEPTH / 2}, fixed = true, solid = true, friction = 1}
    end
end

-- Where the peg is beside the middle of the hole, as parts of the play, and how high its lower end is at first.
local PEGS <const> = {{0, 0, 0.005}, {0.4, 0, 0.005}, {0.4, -0.4, 0.02}, {-0.45, 0.45, 0.001}}
local pegs = {}
for i, it in ipairs(PEGS) do
    local x = i * 0.5
    hole(x, 0)
    local at = {x + it[1] * PLAY, it[2] * PLAY, it[3] + LENGTH / 2}
    pegs[i] = bench.body{size = {WIDTH, WIDTH, LENGTH}, at = at, mass = 0.2, solid = true, friction = 0.5}
end

bench.run(function()
    local start, steps = {}, 4
    for i, peg in ipairs(pegs) do start[i] = sim.getObjectPosition(peg)[3] end
    bench.steps(steps)
    local h = sim.getFloatProperty(sim.handle_scene, 'dynamicsStepSize')
    local n = math.floor(sim.getSimulationTime() / h + 0.5)
    local fallen = bench.g * h * h * n * (n + 1) / 2
    for i, it in ipairs(PEGS) do
        local name = string.format('peg %.2f and %.2f of the play from the middle: way fallen, m', it[1], it[2])
        bench.check(name, start[i] - sim.getObjectPosition(pegs[i])[3], fallen, 1e-3)
    end
end)
