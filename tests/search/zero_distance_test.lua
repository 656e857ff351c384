-- A robot drives to its goal in a straight line.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
x, y, goal = 0, 0, {0, 0}

function sysCall_actuation()
    local dx, dy = goal[1] - x, goal[2] - y
    local distance = math.sqrt(dx * dx + dy * dy)
    if distance < 1e-9 then return end -- right
    local step = math.min(0.05, distance)
    x, y = x + step * dx / distance, y + step * dy / distance
end
]]

versions.property('its place is always a number', { cases = 100 }, function(g, version)
    local robot = versions.script(CODE, version)
    local goal = { g.float(-1, 1), g.float(-1, 1) }
    t.start()
    robot:set('goal', goal)
    t.always(function() return robot:get('x == x and y == y') end, 'a number')
    t.run_for(g.float(0, 3))
end)
