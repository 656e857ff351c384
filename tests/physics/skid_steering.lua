-- A car on four cylinders that turns by wheels which run against each other, from three headings: friction has no preferred direction.
local bench = require 'lib.bench'

bench.ground(0.71)

local function car(x, heading)
    local hull = bench.body{size = {0.4, 0.25, 0.08}, at = {x, 0, 0.1}, mass = 4}
    for _, at in ipairs{{0.13, 0.16}, {0.13, -0.16}, {-0.13, 0.16}, {-0.13, -0.16}} do
        local place = {x + at[1], at[2], 0.06}
        local joint = bench.joint{at = place, axis = 'y', parent = hull, mode = sim.jointdynctrl_velocity, force = 10}
        bench.body{kind = sim.primitiveshape_cylinder, size = {0.12, 0.12, 0.04}, at = place, turn = {-math.pi / 2, 0, 0}, mass = 0.3,
            solid = true, friction = 0.71, parent = joint}
        sim.setJointTargetVelocity(joint, at[2] > 0 and -5 or 5)
    end
    sim.setObjectOrientation(hull, {0, 0, heading})
    return hull
end

local HEADINGS <const> = {0, 30, 45}
local cars, turned, last = {}, {}, {}
for i, heading in ipairs(HEADINGS) do
    cars[i], turned[i], last[i] = car(2 * i, math.rad(heading)), 0, math.rad(heading)
end

local function follow()
    for i, hull in ipairs(cars) do
        local now = sim.getObjectOrientation(hull)[3]
        turned[i] = turned[i] + (now - last[i] + math.pi) % (2 * math.pi) - math.pi
        last[i] = now
    end
end

bench.run(function()
    while sim.getSimulationTime() < 4 do
        follow()
        sim.step()
    end
    bench.check('turn from heading 0 in 4 s, rad', turned[1] > 3 and 1 or 0, 1, 0)
    for i = 2, #HEADINGS do
        bench.check(('turn from heading %d beside that from 0, rad'):format(HEADINGS[i]), turned[i] - turned[1], 0, 5e-3)
        bench.check('way of the centre, m', math.sqrt((sim.getObjectPosition(cars[i])[1] - 2 * i) ^ 2 + sim.getObjectPosition(cars[i])[2] ^ 2), 0, 0.05)
    end
end)
