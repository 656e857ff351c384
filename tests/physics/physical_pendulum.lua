-- A rod that swings about its end: its period, which depends on the inertia.
local bench = require 'lib.bench'

local LENGTH <const>, AMPLITUDE <const> = 0.6, math.rad(3)
local base = bench.body{at = {0, 0, 2}, fixed = true}
local joint = bench.joint{at = {0, 0, 2}, parent = base}
local half = LENGTH / 2
local rod = bench.body{
    size = {0.02, 0.02, LENGTH}, mass = 2, turn = {0, -AMPLITUDE, 0}, parent = joint,
    at = {half * math.sin(AMPLITUDE), 0, 2 - half * math.cos(AMPLITUDE)},
}

bench.run(function()
    local times, before, t = {}
    while sim.getSimulationTime() < 30 do
        local x, now = sim.getObjectPosition(rod)[1], sim.getSimulationTime()
        if before and before > 0 and x <= 0 then times[#times + 1] = t + (now - t) * before / (before - x) end
        before, t = x, now
        sim.step()
    end
    local inertia = 2 * LENGTH ^ 2 / 12 + 2 * 0.02 ^ 2 / 12 + 2 * half ^ 2
    local period = 2 * math.pi * math.sqrt(inertia / (2 * bench.g * half)) * (1 + AMPLITUDE ^ 2 / 16)
    bench.check('period of a rod about its end, s', (times[#times] - times[1]) / (#times - 1), period, 0.001)
end)
