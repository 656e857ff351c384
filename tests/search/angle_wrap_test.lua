-- A robot turns to a heading.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
heading, goal, turned = 0, 0, 0

function sysCall_actuation()
    local e = goal - heading
    e = (e + math.pi) % (2 * math.pi) - math.pi -- right
    local rate = math.max(-2, math.min(2, 3 * e))
    local step = rate * sim.getSimulationTimeStep()
    turned = turned + math.abs(step)
    heading = (heading + step + math.pi) % (2 * math.pi) - math.pi
end
]]

versions.property('it turns the short way', { cases = 200 }, function(g, version)
    local robot = versions.script(CODE, version)
    local from, to = g.float(-math.pi, math.pi), g.float(-math.pi, math.pi)
    t.start()
    robot:set('heading', from)
    robot:set('goal', to)
    robot:set('turned', 0)
    t.always(function() return math.pi + 0.2 - robot:get('turned') end, 'half a turn at most')
    t.run_for(5)
end)
