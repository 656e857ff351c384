-- Cables as beams: cantilevers under a load at the end, far into large deflections, and a column at Euler's load.
local bench = require 'lib.bench'
simSoft = require 'simSoft'

local STIFFNESS <const>, LENGTH <const>, EDGES <const> = 0.1, 0.5, 30

-- The clamped edge ends where the free length begins; a box at the end is the load.
local function cantilever(y, load)
    local edge = LENGTH / EDGES
    local cable = simSoft.createCable{
        from = {-edge, y, 2}, to = {LENGTH, y, 2}, count = EDGES + 1, radius = 0.002, mass = 1e-4,
        stretchStiffness = 1e5, bendStiffness = STIFFNESS, twistStiffness = STIFFNESS, drag = 3, damping = 0.01,
    }
    simSoft.pin(cable, 0, -1, {clamp = true})
    local mass = load * STIFFNESS / LENGTH ^ 2 / bench.g
    local box = bench.body{at = {LENGTH, y, 2}, size = {0.02, 0.02, 0.02}, mass = mass}
    simSoft.pin(cable, EDGES + 1, box)
    sim.setEngineFloatParam(sim.bullet_body_lineardamping, box, 0.9)
    return box
end

-- K. Bisshopp and D. Drucker, Large deflection of cantilever beams, 1945: along and across, by the length.
local KNOWN <const> = {{0.05, nil, 0.05 / 3}, {1, 0.05643, 0.30172}, {2, 0.16064, 0.49346}, {5, 0.38763, 0.71379}, {10, 0.555, 0.81061}}
local boxes = {}
for i, known in ipairs(KNOWN) do boxes[i] = cantilever(i, known[1]) end

-- A column between two hinges, pressed together by a thousandth of its length.
local points = {}
for i = 0, 40 do
    local x = i / 40
    points[#points + 1], points[#points + 2], points[#points + 3] = x, -1, 2 + 1e-4 * math.sin(math.pi * x)
end
local column = simSoft.createCable{
    points = points, radius = 0.002, mass = 1e-4, stretchStiffness = 1e6, bendStiffness = STIFFNESS, twistStiffness = STIFFNESS, drag = 5, damping = 0.01,
}
local plate = bench.body{at = {1, -1, 2}, size = {0.02, 0.02, 0.02}, fixed = true}
simSoft.pin(column, 0)
simSoft.pin(column, 40, plate)

bench.run(function()
    for i = 1, 20 do
        sim.setObjectPosition(plate, {1 - 0.001 * i / 20, -1, 2})
        sim.step()
    end
    bench.untilTime(12)
    for i, known in ipairs(KNOWN) do
        local position = sim.getObjectPosition(boxes[i])
        local what = 'cantilever with P L^2 / E I = ' .. known[1] .. ': '
        bench.check(what .. 'deflection, of the length', (2 - position[3]) / LENGTH, known[3], 0.03 * known[3])
        if known[2] then bench.check(what .. 'shortening, of the length', 1 - position[1] / LENGTH, known[2], 0.03 * known[2]) end
    end
    bench.check('buckling load of a column, N', -simSoft.getPinForce(column, 40)[1], math.pi ^ 2 * STIFFNESS, 0.03 * math.pi ^ 2 * STIFFNESS)
end)
