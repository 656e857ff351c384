-- A cart with two driven wheels and a sliding foot: distance driven, and radius of a circle.
local bench = require 'lib.bench'

local RADIUS <const>, TRACK <const> = 0.1, 0.4
bench.ground(1)

local function cart(y, left, right)
    local chassis = bench.body{size = {0.3, 0.3, 0.06}, at = {0, y, RADIUS}, mass = 2}
    local foot = sim.createForceSensor(0, {0, 1, 10, 0, 0}, {0.02, 100, 10, 0, 0})
    sim.setObjectPosition(foot, {0.15, y, RADIUS / 2})
    sim.setObjectParent(foot, chassis, true)
    bench.body{
        kind = sim.primitiveshape_spheroid, size = {RADIUS, RADIUS, RADIUS}, at = {0.15, y, RADIUS / 2}, mass = 0.1,
        solid = true, friction = 0, parent = foot,
    }
    local motors = {}
    for i, speed in ipairs{left, right} do
        local at = {0, y + (i == 1 and 0.5 or -0.5) * TRACK, RADIUS}
        motors[i] = bench.joint{at = at, parent = chassis, mode = sim.jointdynctrl_velocity, force = 10}
        bench.body{
            kind = sim.primitiveshape_cylinder, size = {2 * RADIUS, 2 * RADIUS, 0.02}, at = at, turn = {math.pi / 2, 0, 0},
            mass = 0.5, solid = true, friction = 1, parent = motors[i],
        }
        sim.setJointTargetVelocity(motors[i], speed)
    end
    return chassis, motors
end

local straight, motors = cart(0, 3, 3)
local circling = cart(6, 2, 3)

bench.run(function()
    bench.untilTime(2) -- the start slips
    local from, turned = sim.getObjectPosition(straight), sim.getJointPosition(motors[1])
    local xs, ys = {}, {}
    local angle = 0
    local low, high = {math.huge, math.huge}, {-math.huge, -math.huge}
    while sim.getSimulationTime() < 30 do
        local before = sim.getJointPosition(motors[1])
        sim.step()
        angle = angle + (sim.getJointPosition(motors[1]) - before + math.pi) % (2 * math.pi) - math.pi
        local p = sim.getObjectPosition(circling)
        for i = 1, 2 do low[i], high[i] = math.min(low[i], p[i]), math.max(high[i], p[i]) end
    end
    local to = sim.getObjectPosition(straight)
    bench.check('distance of a cart, radius times angle, m', to[1] - from[1], RADIUS * angle, 0.01 * RADIUS * angle)
    bench.check('its lateral drift, m', to[2] - from[2], 0, 0.05)
    -- The middle of the axle goes round at track / 2 * (vr + vl) / (vr - vl).
    local radius = TRACK / 2 * (3 + 2) / (3 - 2)
    bench.check('radius of the circle, m', (high[1] - low[1]) / 2, radius, 0.05 * radius)
    bench.check('radius across, m', (high[2] - low[2]) / 2, radius, 0.05 * radius)
end)
