-- A rope of 17 links on ball joints hangs at rest: the faces of neighbours touch, without a force between them.
local bench = require 'lib.bench'

local LINKS <const>, LENGTH <const> = 17, 0.06

local parent = bench.body{at = {0, 0, 2.05}, fixed = true, solid = true}
for i = 1, LINKS do
    local top = 2 - LENGTH * (i - 1)
    local joint = bench.joint{type = sim.joint_spherical, at = {0, 0, top}, parent = parent}
    parent = bench.body{
        kind = sim.primitiveshape_cylinder, size = {0.02, 0.02, LENGTH}, at = {0, 0, top - LENGTH / 2}, mass = 0.02,
        solid = true, friction = 1, parent = joint,
    }
end
local tip = parent

bench.run(function()
    local height = sim.getObjectPosition(tip)[3]
    bench.untilTime(20)
    local position, velocity = sim.getObjectPosition(tip), sim.getVelocity(tip)
    bench.check('height of the lowest link after 20 s, m', position[3], height, 1e-5)
    bench.check('its displacement, m', math.sqrt(position[1] ^ 2 + position[2] ^ 2), 0, 1e-4)
    bench.check('its speed, m/s', math.sqrt(velocity[1] ^ 2 + velocity[2] ^ 2 + velocity[3] ^ 2), 0, 1e-3)
end)
