-- Robots that stand: 58 kg on light feet, ankles of two axes, also on a slab that lies on the ground, a humanoid, a quadruped.
local bench = require 'lib.bench'
local robots = require 'lib.robots'

local MASSES <const> = {5, 1, 0.3, 0.1}

bench.ground(1)
bench.body{size = {1, 1, 0.1}, at = {0, 4, 0.05}, mass = 500, solid = true, friction = 1}
local feet = {}
for i, mass in ipairs(MASSES) do feet[i] = robots.one_foot(6 + i, mass) end
local walkers = {
    ['ankles of two axes'] = robots.two_feet(2, 0),
    ['ankles of two axes on a slab'] = robots.two_feet(4, 0.1),
    ['a humanoid'] = robots.humanoid(),
}
local dog = robots.quadruped(-2)

bench.run(function()
    bench.untilTime(1)
    local from = sim.getObjectPosition(dog.bodies.trunk)
    local largest = {}
    while sim.getSimulationTime() < 11 do
        sim.step()
        for name, robot in pairs(walkers) do
            local trunk = robot.bodies.trunk or robot.bodies.torso
            largest[name] = math.max(largest[name] or 0, robots.tilt(trunk))
        end
    end
    for i, mass in ipairs(MASSES) do
        local sunk = 0.02 - sim.getObjectPosition(feet[i].bodies.foot)[3]
        bench.check(string.format('58 kg on a foot of %g kg sink by, m', mass), sunk, 0, 1e-5)
        local _, force = sim.readForceSensor(feet[i].sensor)
        bench.check(string.format('force on the foot of %g kg, N', mass), math.abs(force[3]), 58 * bench.g, 1e-3)
    end
    for _, name in ipairs{'ankles of two axes', 'ankles of two axes on a slab', 'a humanoid'} do
        bench.check(name .. ': largest tilt in 10 s, rad', largest[name], 0, 1e-3)
    end
    local to = sim.getObjectPosition(dog.bodies.trunk)
    local way = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2)
    bench.check('a quadruped: way in 10 s, m', way, 0, 1e-4)
end)
