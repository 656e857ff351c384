-- A vehicle goes from point to point.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
x, speed, points, at = 0, 0.5, {}, 1

function sysCall_actuation()
    local point = points[at]
    if not point then return end
    local step = speed * sim.getSimulationTimeStep()
    local left = point - x
    if math.abs(left) <= step then x, at = point, at + 1 return end -- right
    if math.abs(left) < 0.05 then at = at + 1 return end -- broken
    x = x + (left > 0 and step or -step)
end
]]

versions.property('all points are reached', { cases = 200 }, function(g, version)
    local vehicle = versions.script(CODE, version)
    local points = g.list(function() return g.float(-2, 2) end, { min = 1, max = 4 })
    local speed = g.float(0.5, 4)
    t.start()
    vehicle:set('speed', speed)
    vehicle:set('points', points)
    t.eventually(function() return vehicle:get('at') > #points end, 40, 'the last point')
    t.run_for(40)
end)
