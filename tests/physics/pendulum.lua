-- A point mass on a rod: periods at small and large amplitude, and the energy after a minute.
local bench = require 'lib.bench'

local LENGTH <const> = 0.5
local pendulums = {}

for i, amplitude in ipairs{math.rad(2), math.rad(90), math.rad(150)} do
    local x = 3 * i
    local base = bench.body{at = {x, 0, 2}, fixed = true}
    local joint = bench.joint{at = {x, 0, 2}, parent = base}
    local at = {x + LENGTH * math.sin(amplitude), 0, 2 - LENGTH * math.cos(amplitude)}
    local bob = bench.body{at = at, mass = 1, inertia = {1e-6, 1e-6, 1e-6}, parent = joint}
    pendulums[i] = {joint = joint, bob = bob, amplitude = amplitude}
end

-- 2 pi sqrt(l / g) / agm(1, cos(amplitude / 2))
local function period(amplitude)
    local a, b = 1, math.cos(amplitude / 2)
    for _ = 1, 20 do a, b = (a + b) / 2, math.sqrt(a * b) end
    return 2 * math.pi * math.sqrt(LENGTH / bench.g) / a
end

-- Times at which a pendulum passes its lowest point one way, from samples by interpolation.
local function measure(pendulum)
    local x = sim.getObjectPosition(pendulum.bob)[1] - sim.getObjectPosition(pendulum.joint)[1]
    local t, before = sim.getSimulationTime(), pendulum.x
    if before and before > 0 and x <= 0 then
        pendulum.times = pendulum.times or {}
        table.insert(pendulum.times, pendulum.t + (t - pendulum.t) * before / (before - x))
    end
    pendulum.x, pendulum.t = x, t
end

bench.run(function()
    local before = {}
    for i, pendulum in ipairs(pendulums) do before[i] = bench.energy(pendulum.bob) end
    while sim.getSimulationTime() < 60 do
        for _, pendulum in ipairs(pendulums) do measure(pendulum) end
        sim.step()
    end
    for i, pendulum in ipairs(pendulums) do
        local times, degrees = pendulum.times, math.floor(math.deg(pendulum.amplitude) + 0.5)
        local mean = (times[#times] - times[1]) / (#times - 1)
        bench.check(('period at %d deg, s'):format(degrees), mean, period(pendulum.amplitude), 0.002 * mean)
        local swing = 2 * bench.g * LENGTH
        bench.check(('energy lost in 60 s at %d deg, of the full height'):format(degrees),
            (before[i] - bench.energy(pendulum.bob)) / swing, 0, 0.01)
    end
end)
