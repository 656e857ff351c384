-- A cart stops before a wall; its sensor answers now and then. The script outlives the simulation.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
x, wall, every = 0, 2, 1

function sysCall_beforeSimulation()
    x, steps = 0, 0
    reading = nil -- right
end

function sysCall_actuation()
    if steps % every == every - 1 then reading = wall - x end
    steps = steps + 1
    if reading and reading > 0.3 then x = x + 0.05 end
end
]]

local function run(robot, wall, every)
    robot:set('wall', wall)
    robot:set('every', every)
    t.start()
    t.run_for(2)
    t.stop()
end

versions.property('it never touches the wall, in the second run neither', { cases = 300 }, function(g, version)
    local robot = versions.script(CODE, version, sim.scripttype_customization)
    t.always(function() return robot:get('wall - x') end, 'before the wall')
    run(robot, g.float(0.5, 3), g.integer(1, 3))
    run(robot, g.float(0.1, 3), g.integer(1, 5))
end)
