-- An arm moves to a part, closes the gripper, and lifts.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
x, part, speed, isClosed, closedAt = 0, 0.5, 0.5, false, nil

function sysCall_actuation()
    local step = speed * sim.getSimulationTimeStep()
    local left = part - x
    x = x + math.max(-step, math.min(step, left))
    local isThere = math.abs(part - x) < 0.005 -- right
    local isThere = sim.getSimulationTime() >= 2 -- broken
    if isThere and not isClosed then isClosed, closedAt = true, x end
end
]]

versions.property('the gripper closes at the part', { cases = 200 }, function(g, version)
    local arm = versions.script(CODE, version)
    t.start()
    arm:set('part', g.float(-1, 1))
    arm:set('speed', g.float(0.3, 1, 1))
    t.run_until(function() return arm:get('isClosed') end, 8)
    assert.near(arm:get('part'), arm:get('closedAt'), 0.006)
end)
