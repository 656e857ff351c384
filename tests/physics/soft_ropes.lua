-- Ropes between closed forms: a catenary, the tension under a load, the period of a hanging rope, the friction around a cylinder, what a robot's motor bears.
local bench = require 'lib.bench'
simSoft = require 'simSoft'

local ROPE <const> = {radius = 0.002, mass = 0.05, stretchStiffness = 1e5, bendStiffness = 1e-7, twistStiffness = 1e-7, drag = 0, damping = 0}

local function rope(it)
    for name, value in pairs(ROPE) do if it[name] == nil then it[name] = value end end
    return simSoft.createRope(it)
end

local function point(handle, index)
    local points = simSoft.getPoints(handle)
    return points[3 * index + 1], points[3 * index + 2], points[3 * index + 3]
end

-- Length 1, span 0.7: the parameter of the catenary solves 2 a sinh(s / 2a) = 1.
local catenary = rope{points = {0, 0, 2, 0.35, 0, 1.643, 0.7, 0, 2}, count = 60, length = 1, drag = 5}
simSoft.pin(catenary, 0)
simSoft.pin(catenary, 60)

-- A box that hangs from a rope.
local weight = bench.body{at = {2, 0, 1.45}, mass = 3}
local loaded = rope{from = {2, 0, 2}, to = {2, 0, 1.5}, count = 20, mass = 0.1, damping = 0.01, drag = 2}
simSoft.pin(loaded, 0)
simSoft.pin(loaded, 20, weight)

-- Its first mode: a Bessel function of the root of the height.
local function bessel(x)
    local sum, term = 0, 1
    for k = 1, 20 do
        sum, term = sum + term, -term * x * x / (4 * k * k)
    end
    return sum
end
local swinging = {}
for i = 0, 50 do
    local z = 1 - i / 50
    swinging[#swinging + 1], swinging[#swinging + 2], swinging[#swinging + 3] = 4 + 0.01 * bessel(2.404826 * math.sqrt(z)), 0, 1 + z
end
swinging = rope{points = swinging, count = 50, length = 1}
simSoft.pin(swinging, 0)

-- A rope over a drum, with a weight at one end; the other one is drawn down. The friction of a pair is 0.3.
local RADIUS <const>, FRICTION <const> = 0.05, 0.3
bench.body{kind = sim.primitiveshape_cylinder, size = {2 * RADIUS, 2 * RADIUS, 0.2}, at = {6, 0, 2}, turn = {math.pi / 2, 0, 0}, fixed = true, solid = true, friction = 1}
local around = {5.948, 0, 1.6}
for i = 0, 20 do
    local angle = math.pi * i / 20
    around[#around + 1], around[#around + 2], around[#around + 3] = 6 - 0.052 * math.cos(angle), 0, 2 + 0.052 * math.sin(angle)
end
around[#around + 1], around[#around + 2], around[#around + 3] = 6.052, 0, 1.85
local drawn = rope{points = around, count = 70, friction = FRICTION ^ 2, mass = 0.03, damping = 0.002}
local drawnWeight = bench.body{at = {5.948, 0, 1.55}, mass = 1}
simSoft.pin(drawn, 0, drawnWeight)
local hand = bench.body{at = {6.052, 0, 1.85}, size = {0.02, 0.02, 0.02}, fixed = true}
simSoft.pin(drawn, 70, hand)

-- An arm of 1 kg whose motor holds a rope of 60 g at 0.5 m.
local base = bench.body{at = {8, 0, 2}, size = {0.05, 0.05, 0.05}, fixed = true}
local motor = bench.joint{at = {8, 0, 2}, parent = base, mode = sim.jointdynctrl_velocity, force = 100}
sim.setJointTargetVelocity(motor, 0)
local arm = bench.body{at = {8.25, 0, 2}, size = {0.5, 0.02, 0.02}, mass = 1, parent = motor}
local borne = rope{from = {8.5, 0, 2}, to = {8.5, 0, 1.4}, count = 20, mass = 0.06, drag = 2, damping = 0.01}
simSoft.pin(borne, 0, arm)

bench.run(function()
    local passages, last, high, low, count = {}, nil, 0, 0, 0
    while sim.getSimulationTime() < 8 - 1e-6 do
        local t = sim.getSimulationTime()
        sim.setObjectPosition(hand, {6.052, 0, 1.85 - 0.05 * math.min(t, 4)})
        sim.step()
        t = sim.getSimulationTime()
        local x = point(swinging, 50) - 4
        if last and last * x < 0 then passages[#passages + 1] = t - 0.05 * x / (x - last) end
        last = x
        if t > 2 and t < 4 then
            local tensions = simSoft.getTensions(drawn)
            low, high, count = low + tensions[6], high + tensions[#tensions - 3], count + 1
        end
    end
    local _, _, z = point(catenary, 30)
    bench.check('sag of a catenary, m', 2 - z, 0.3197205, 3.2e-3)
    bench.check('its tension at the lowest point, N', simSoft.getTensions(catenary)[30], 0.05 * bench.g * 0.2311062, 1.1e-3)
    bench.check('tension under a box of 3 kg, N', simSoft.getTensions(loaded)[20], 3 * bench.g, 0.1)
    bench.check('force at its pin, N', simSoft.getPinForce(loaded, 0)[3], 3.1 * bench.g, 0.1)
    local period = 2 * (passages[#passages] - passages[1]) / (#passages - 1)
    bench.check('period of a hanging rope, s', period, 4 * math.pi / 2.404826 / math.sqrt(bench.g), 0.02)
    bench.check('tension before a drum with a kilogram behind it, N', low / count, bench.g, 0.3)
    bench.check('ratio of the tensions, e^(0.3 pi)', high / low, math.exp(FRICTION * math.pi), 0.05 * math.exp(FRICTION * math.pi))
    bench.check('torque of a motor that holds an arm and a rope, N m', math.abs(sim.getJointForce(motor)), bench.g * (0.25 + 0.03), 0.01)
end)
