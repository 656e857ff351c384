-- A lift holds a height with loads of any permitted mass; its motor answers a step later.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
mass, x, v, goal, force = 1, 0, 0, 1, 0

function sysCall_actuation()
    local dt = sim.getSimulationTimeStep()
    v = v + (force / mass - 9.81) * dt
    x = x + v * dt
    local gain = 8 * mass -- right
    local gain = 8 -- broken
    force = gain * (goal - x) - 0.7 * gain * v + 9.81 * mass
end
]]

versions.property('it is at its height after eight seconds', { cases = 200 }, function(g, version)
    local lift = versions.script(CODE, version)
    t.start()
    lift:set('mass', g.float(0.5, 20, 1))
    lift:set('goal', g.float(0, 2))
    t.run_for(8)
    t.always(function() return 0.05 - math.abs(lift:get('goal - x')) end, 'within 5 cm')
    t.run_for(2)
end)
