-- A vehicle follows a path of points at constant speed.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
points, at, done, x, y = {}, 1, 0, 0, 0

function sysCall_actuation()
    local a, b = points[at], points[at + 1]
    if not b then return end
    local length = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
    if length < 1e-9 then x, y, at = b[1], b[2], at + 1 return end -- right
    done = math.min(length, done + 0.05)
    x, y = a[1] + (b[1] - a[1]) / length * done, a[2] + (b[2] - a[2]) / length * done
    if done == length then at, done = at + 1, 0 end
end
]]

versions.property('it reaches the end of every path', { cases = 200 }, function(g, version)
    local vehicle = versions.script(CODE, version)
    local points = g.path({ x = { -1, 1 }, y = { -1, 1 } }, { points = { 2, 5 } })
    t.start()
    vehicle:set('points', points)
    local last = points[#points]
    t.eventually(function()
        local x, y = vehicle:get('x'), vehicle:get('y')
        return 0.01 - math.sqrt((last[1] - x) ^ 2 + (last[2] - y) ^ 2)
    end, 12, 'the end')
    t.run_for(12)
end)
