-- A robot keeps a distance from a wall by a range sensor, which sometimes sees nothing.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
x, wall, last = 0, 2, nil

function read() return 1, wall - x end

function sysCall_actuation()
    local isSeen, distance = read()
    if isSeen ~= 1 then return end -- right
    last = distance -- right
    last = isSeen == 1 and distance or 5 -- broken
    if last and last > 0.2 then x = x + math.min(0.2, 0.5 * (last - 0.2)) end
end
]]

versions.property('it stays before the wall', { cases = 200 }, function(g, version)
    local robot = versions.script(CODE, version)
    t.start()
    robot:set('wall', g.float(1, 3, 2))
    g.faults({ { 'dropout', robot, 'read', { 0.05, 0.4 }, 0, 0 } }, { most = 1, within = 2, lasts = { 0.1, 0.4 } })
    t.always(function() return robot:get('wall - x') end, 'before the wall')
    t.run_for(4)
end)
