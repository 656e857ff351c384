-- A vehicle goes along a rectangle and detects obstacles ahead.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
corners, at, x, y, obstacles = {{2, 0}, {2, 2}, {0, 2}, {0, 0}}, 1, 0, 0, {}

-- The distance to the nearest obstacle in the direction of travel.
local function ahead(dx, dy)
    local least = math.huge
    for _, o in ipairs(obstacles) do
        local along = (o[1] - x) * dx + (o[2] - y) * dy
        local across = math.abs((o[1] - x) * dy - (o[2] - y) * dx)
        if along > 0 and across < 0.3 then least = math.min(least, along) end
    end
    return least
end

function sysCall_actuation()
    local corner = corners[at]
    local dx, dy = corner[1] - x, corner[2] - y
    local left = math.sqrt(dx * dx + dy * dy)
    if left < 0.03 then
        x, y, at = corner[1], corner[2], at % 4 + 1
        return
    end
    if ahead(dx / left, dy / left) < 0.4 then return end -- right
    if left > 0.5 and ahead(dx / left, dy / left) < 0.4 then return end -- broken
    x, y = x + 0.025 * dx / left, y + 0.025 * dy / left
end
]]

versions.property('it never touches an obstacle', { cases = 400 }, function(g, version)
    local vehicle = versions.script(CODE, version)
    local obstacles = g.list(function() return { g.float(-0.5, 2.5), g.float(-0.5, 2.5) } end, { max = 3 })
    for _, o in ipairs(obstacles) do g.assume(o[1] ^ 2 + o[2] ^ 2 > 0.6) end
    t.start()
    vehicle:set('obstacles', obstacles)
    -- What stands beside the way is not looked at: it may be as close as the vehicle is wide.
    t.always(function()
        local x, y, least = vehicle:get('x'), vehicle:get('y'), math.huge
        for _, o in ipairs(obstacles) do least = math.min(least, math.sqrt((o[1] - x) ^ 2 + (o[2] - y) ^ 2)) end
        return least - 0.15
    end, 'clearance')
    t.run_for(20)
end)
