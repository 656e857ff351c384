-- Colliders of all kinds: a ball in a height field, a box on a mesh, compounds on a plane, a decomposed mesh on the ground.
local bench = require 'lib.bench'

local SIDE <const>, WIDTH <const>, CURVE <const> = 101, 4, 0.25 -- height: CURVE times the square of the distance from the middle
local heights = {}
for row = 0, SIDE - 1 do
    for column = 0, SIDE - 1 do
        local x, y = (column / (SIDE - 1) - 0.5) * WIDTH, (row / (SIDE - 1) - 0.5) * WIDTH
        heights[#heights + 1] = CURVE * (x * x + y * y)
    end
end
sim.setObjectPosition(sim.createHeightfieldShape(0, 0, SIDE, SIDE, WIDTH, heights), {0, 0, 5})
local RADIUS <const>, START <const> = 0.05, 0.5
local ball = bench.body{
    kind = sim.primitiveshape_spheroid, size = {2 * RADIUS, 2 * RADIUS, 2 * RADIUS}, mass = 1, solid = true, friction = 1,
    at = {START, 0, 5 + CURVE * START ^ 2 + RADIUS * 1.04},
}

local mesh = sim.createShape(0, 0, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, {0, 1, 2, 0, 2, 3})
sim.setObjectPosition(mesh, {10, 0, 1})
sim.setBoolProperty(mesh, 'respondable', true)
local box = bench.body{at = {10, 0.2, 1.051}, mass = 1, solid = true, friction = 1}

bench.body{kind = sim.primitiveshape_plane, size = {4, 4, 0}, at = {-10, 0, 0}, fixed = true, solid = true, friction = 1}
local function compound(y)
    local low, high = sim.createPrimitiveShape(3, {0.4, 0.4, 0.1}), sim.createPrimitiveShape(3, {0.1, 0.1, 0.3})
    sim.setObjectPosition(low, {-10, y, 0.051})
    sim.setObjectPosition(high, {-10, y, 0.251})
    return sim.groupShapes{high, low}
end
local inner = compound(0)
local knob = sim.createPrimitiveShape(2, {0.1, 0.1, 0.1})
sim.setObjectPosition(knob, {-10, 0, 0.451})
local group = sim.groupShapes{knob, inner}
sim.setBoolProperty(group, 'dynamic', true)
sim.setBoolProperty(group, 'respondable', true)

local divided = sim.convexDecompose(compound(1), 1)
sim.setBoolProperty(divided, 'dynamic', true)
sim.setBoolProperty(divided, 'respondable', true)

bench.run(function()
    -- A ball that rolls without sliding in a bowl swings like a pendulum, with 5/7 of gravity.
    local crossings, before = {}, START
    while sim.getSimulationTime() < 6 do
        sim.step()
        local x = sim.getObjectPosition(ball)[1]
        if before * x < 0 then crossings[#crossings + 1] = sim.getSimulationTime() - sim.getSimulationTimeStep() * x / (x - before) end
        before = x
    end
    local stiffness = 2 * CURVE / (1 - 2 * CURVE * RADIUS) -- curvature of the way of the ball's centre
    local period = 2 * math.pi / math.sqrt(5 / 7 * bench.g * stiffness)
    bench.check('period of a ball in a bowl, s', crossings[3] - crossings[1], period, 0.05 * period)
    bench.check('displacement of the ball out of its plane, m', sim.getObjectPosition(ball)[2], 0, 0.01)
    bench.check('height of a box at rest on a mesh, m', sim.getObjectPosition(box)[3], 1.05, 1e-3)
    bench.check('height of nested groups at rest on a plane, m', sim.getObjectPosition(group)[3], 0.05, 1e-3)
    bench.check('height of a decomposed shape at rest on a plane, m', sim.getObjectPosition(divided)[3], 0.05, 5e-3)
end)
