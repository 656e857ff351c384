-- Cloths and soft volumes beside closed forms: a sheet under its own weight, a strip as a plate, a balloon, a body on a sheet, rubber between plates, a beam of rubber.
local bench = require 'lib.bench'
simSoft = require 'simSoft'

local function coordinate(handle, point, axis) return simSoft.getPoints(handle)[3 * point + axis] end

local function pinRow(handle, first, last)
    for point = first, last do simSoft.pin(handle, point) end
end

local function pinForce(handle, first, last, axis)
    local sum = 0
    for point = first, last do sum = sum + simSoft.getPinForce(handle, point)[axis] end
    return sum
end

local UPRIGHT <const> = math.sqrt(0.5)

-- A sheet of 0.1 by 0.2 m hangs from its upper edge.
local WEIGHT <const>, STRETCH <const> = 1, 100 -- kg/m2, N/m
local sheet = simSoft.createCloth{size = {0.1, 0.2}, count = {4, 8}, pose = {0, 0, 2, UPRIGHT, 0, 0, UPRIGHT}, areaDensity = WEIGHT, stretchStiffness = STRETCH, poisson = 0, bendStiffness = 0, drag = 2, damping = 0.05}
pinRow(sheet, 40, 44)

-- A strip that is clamped over one row of its 16 cells.
local BEND <const>, CELL <const> = 0.0333, 0.2 / 16
local strip = simSoft.createCloth{size = {0.2, 0.1}, count = {16, 8}, pose = {1, 0, 2, 0, 0, 0, 1}, areaDensity = 0.2, stretchStiffness = 1e5, bendStiffness = BEND, poisson = 0, drag = 3, damping = 0.01}
for row = 0, 8 do pinRow(strip, row * 17, row * 17 + 1) end

-- A balloon, pinned at one point; gas of so much pressure stretches it.
local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
sim.setObjectPosition(ball, {2, 0, 2})
local balloon = simSoft.createCloth{shape = ball, thickness = 0.001, young = 1e6, areaDensity = 0.02, pressure = 20000, drag = 5}
sim.removeObjects{ball}
simSoft.pin(balloon, 0)

-- A box on a sheet that is pinned at its corners.
local hammock = simSoft.createCloth{size = {0.4, 0.4}, count = {8, 8}, pose = {3, 0, 2, 0, 0, 0, 1}, areaDensity = 0.5, stretchStiffness = 2000, thickness = 0.004, drag = 1}
for _, corner in ipairs{0, 8, 72, 80} do simSoft.pin(hammock, corner) end
local box = bench.body{at = {3, 0, 2.03}, size = {0.1, 0.1, 0.05}, mass = 0.4, solid = true, friction = 1}

-- A cube of rubber that does not widen, pulled apart by a hundredth.
local cube = simSoft.createVolume{size = {0.1, 0.1, 0.1}, count = {3, 3, 3}, pose = {4, 0, 2, 0, 0, 0, 1}, young = 1e5, poisson = 0, density = 100, drag = 5}
local plate = bench.body{at = {4, 0, 2.05}, size = {0.1, 0.1, 0.001}, fixed = true}
local points = simSoft.getPoints(cube)
local upper = {}
for point = 0, #points // 3 - 1 do
    if points[3 * point + 3] > 2.0499 then
        simSoft.pin(cube, point, plate)
        upper[#upper + 1] = point
    elseif points[3 * point + 3] < 1.9501 then
        simSoft.pin(cube, point)
    end
end

-- A beam of rubber of six layers, clamped at one end.
local LAYERS <const>, YOUNG <const>, SIDE <const>, LENGTH <const> = 6, 1e6, 0.04, 0.2
local beam = simSoft.createVolume{size = {LENGTH, SIDE, SIDE}, count = {5 * LAYERS, LAYERS, LAYERS}, pose = {5, 0, 2, 0, 0, 0, 1}, young = YOUNG, poisson = 0, drag = 2, damping = 0.02}
local tip
points = simSoft.getPoints(beam)
for point = 0, #points // 3 - 1 do
    if points[3 * point + 1] < 5 - LENGTH / 2 + 1e-6 then simSoft.pin(beam, point) end
    if points[3 * point + 1] > 5 + LENGTH / 2 - 1e-6 then tip = point end
end
local tipHeight = points[3 * tip + 3]

bench.run(function()
    bench.untilTime(0.5)
    local load = 1000 * SIDE ^ 2 * bench.g
    local bending = load * LENGTH ^ 4 / (8 * YOUNG * SIDE ^ 4 / 12)
    local shear = load * LENGTH ^ 2 / 2 / (5 / 6 * YOUNG / 2 * SIDE ^ 2)
    bench.check('deflection of a beam of rubber of six layers, m', tipHeight - coordinate(beam, tip, 3), bending + shear, 0.1 * (bending + shear))
    sim.removeObjects{beam}
    for i = 1, 10 do
        sim.setObjectPosition(plate, {4, 0, 2.05 + 0.001 * i / 10})
        sim.step()
    end
    bench.untilTime(5)
    local pull = 0
    for _, point in ipairs(upper) do pull = pull + simSoft.getPinForce(cube, point)[3] end
    -- Stress by modulus and strain, and half of its own weight.
    bench.check('force on a cube of rubber that is pulled by a hundredth, N', pull, 1e5 * 0.01 * 0.01 + 0.05 * bench.g, 0.01)
    bench.check('elongation of a sheet by its weight, m', 1.9 - coordinate(sheet, 2, 3), WEIGHT * bench.g * 0.2 ^ 2 / 2 / STRETCH, 0.02 * WEIGHT * bench.g * 0.2 ^ 2 / 2 / STRETCH)
    bench.check('weight of that sheet at its pins, N', pinForce(sheet, 40, 44, 3), WEIGHT * 0.02 * bench.g, 1e-3)
    local free = 0.2 - CELL / 2
    local deflection = 0.2 * bench.g * free ^ 4 / (8 * BEND)
    bench.check('deflection of a strip under its weight, m', 2 - coordinate(strip, 16 + 17 * 4, 3), deflection, 0.02 * deflection)
    local volume, pressure, tension = simSoft.getVolume(balloon), simSoft.getPressure(balloon), 0
    local tensions = simSoft.getTensions(balloon)
    for _, each in ipairs(tensions) do tension = tension + each / #tensions end
    local expected = pressure * (volume * 0.75 / math.pi) ^ (1 / 3) / 2
    bench.check('tension of a balloon by pressure and radius, N/m', tension, expected, 0.06 * expected)
    local borne = 0
    for _, corner in ipairs{0, 8, 72, 80} do borne = borne + simSoft.getPinForce(hammock, corner)[3] end
    bench.check('weight of a box and the sheet that bears it, N', borne, (0.4 + 0.5 * 0.16) * bench.g, 0.02)
    bench.check('speed of that box at rest, m/s', sim.getObjectVelocity(box)[3], 0, 1e-3)
end)
