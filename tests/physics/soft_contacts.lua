-- What is soft touches what is soft and what is thin: a rope that lies on a cloth, which bears it, and a ball of rubber between two thin fingers that press it to half its size.
local bench = require 'lib.bench'
simSoft = require 'simSoft'

-- A cloth of 0.4 by 0.4 m that is pinned at its border, and a rope above it.
local cloth = simSoft.createCloth{size = {0.4, 0.4}, count = {8, 8}, pose = {0, 0, 0.3, 0, 0, 0, 1}, thickness = 0.004, areaDensity = 0.3, stretchStiffness = 2000, damping = 0.02, drag = 2}
local pins = {}
for point = 0, 80 do
    if point % 9 == 0 or point % 9 == 8 or point < 9 or point > 71 then
        simSoft.pin(cloth, point)
        pins[#pins + 1] = point
    end
end
local RADIUS <const>, DENSITY <const>, LENGTH <const> = 0.004, 3000, 0.2
local rope = simSoft.createRope{from = {-0.1, 0.012, 0.31}, to = {0.1, 0.02, 0.31}, count = 20, radius = RADIUS, density = DENSITY, friction = 0.5, drag = 2}

-- A ball between two fingers, each on a motor that keeps its position.
local ball, fingers, joints
local SIZE <const>, THICK <const>, START <const>, SQUEEZED <const> = 0.1, 0.012, 0.06, 0.031
do
    local solid = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {SIZE, SIZE, SIZE})
    sim.setObjectPosition(solid, {2, 0, 1})
    ball = simSoft.createVolume{shape = solid, cell = 0.025, young = 4e4, density = 300, friction = 1, drag = 5}
    sim.removeObjects{solid}
    fingers, joints = {}, {}
    local base = bench.body{at = {2, 0, 2}, fixed = true}
    bench.body{at = {2, 0, 0.9}, size = {0.03, 0.03, 0.1}, fixed = true, solid = true}
    for i, side in ipairs{-1, 1} do
        joints[i] = bench.joint{type = sim.joint_prismatic, axis = 'y', at = {2, side * START, 1}, parent = base, mode = sim.jointdynctrl_position, force = 400, interval = {-1, 1}}
        fingers[i] = bench.body{at = {2, side * START, 1}, size = {0.06, THICK, 0.12}, mass = 0.2, solid = true, friction = 1, parent = joints[i]}
    end
end

-- Width of the ball between the fingers, metres.
local function width()
    local points, low, high = simSoft.getPoints(ball), 1, -1
    for i = 1, #points, 3 do
        if math.abs(points[i] - 2) < 0.025 and math.abs(points[i + 2] - 1) < 0.05 then
            low, high = math.min(low, points[i + 1]), math.max(high, points[i + 1])
        end
    end
    return high - low
end

-- Mean force of what the rope touches in the last step, N, upwards.
local function borne()
    local sum, first, last, index = 0, 1e9, 0, 0
    while true do
        local shapes, _, force = sim.getContactInfo(sim.handle_all, rope, index)
        if #shapes == 0 then break end
        assert(shapes[1] == rope and shapes[2] == cloth)
        sum, index = sum + force[3], index + 1
    end
    return sum * sim.getSimulationTimeStep() ^ -1 * 0.005
end

bench.run(function()
    for step = 1, 30 do
        local way = (START - SQUEEZED) * math.min(step / 20, 1)
        sim.setJointTargetPosition(joints[1], way)
        sim.setJointTargetPosition(joints[2], -way)
        sim.step()
    end
    local between = 2 * SQUEEZED - THICK
    bench.check('distance of two fingers that press a ball, m', sim.getObjectPosition(fingers[2])[2] - sim.getObjectPosition(fingers[1])[2] - THICK, between, 4e-3)
    bench.check('width of the ball between them, m', width(), between - 0.002, 5e-3)
    sim.removeObjects{ball}
    bench.untilTime(4)
    local weight = math.pi * RADIUS ^ 2 * LENGTH * DENSITY * bench.g
    local held = 0
    for _, point in ipairs(pins) do held = held + simSoft.getPinForce(cloth, point)[3] end
    bench.check('weight of a rope on a cloth, and of the cloth, at the pins, N', held, weight + 0.3 * 0.16 * bench.g, 0.01)
    bench.check('weight of the rope at its contacts, N', borne(), weight, 0.02 * weight)
    local points, lowest = simSoft.getPoints(rope), 1
    for i = 3, #points, 3 do lowest = math.min(lowest, points[i]) end
    local sheet = simSoft.getPoints(cloth)
    bench.check('height of the rope above the cloth, m', lowest - sheet[3 * 40 + 3], RADIUS + 0.002, 3e-3)
end)
