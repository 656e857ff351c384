-- Cars at rest, held by their motors and on free wheels, neither creep nor turn; nothing but inertia holds free wheels.
local bench = require 'lib.bench'

bench.ground(1)

local function car(y, mode)
    local chassis = bench.body{size = {0.5, 0.3, 0.1}, at = {0, y, 0.12}, mass = 5}
    for _, x in ipairs{-0.18, 0.18} do
        for _, across in ipairs{-0.18, 0.18} do
            local at = {x, y + across, 0.08}
            local joint = bench.joint{at = at, parent = chassis, mode = mode, force = 10}
            sim.setJointTargetVelocity(joint, 0)
            bench.body{
                kind = sim.primitiveshape_cylinder, size = {0.16, 0.16, 0.04}, at = at, turn = {math.pi / 2, 0, 0}, mass = 0.3,
                solid = true, friction = 1, parent = joint,
            }
        end
    end
    return chassis
end

local held, free = car(0, sim.jointdynctrl_velocity), car(2, sim.jointdynctrl_free)

bench.run(function()
    bench.untilTime(1)
    local from = {sim.getObjectPosition(held), sim.getObjectPosition(free)}
    bench.untilTime(31)
    for i, name in ipairs{'held by motors', 'on free wheels'} do
        local body = i == 1 and held or free
        local to = sim.getObjectPosition(body)
        local way = math.sqrt((to[1] - from[i][1]) ^ 2 + (to[2] - from[i][2]) ^ 2)
        bench.check(name .. ': way in 30 s, m', way, 0, i == 1 and 1e-4 or 0.1)
        bench.check(name .. ': turn, rad', sim.getObjectOrientation(body)[3], 0, 1e-4)
    end
end)
