-- A tool turns from one orientation to another by interpolation of quaternions.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
from, to, share, q = {0, 0, 0, 1}, {0, 0, 0, 1}, 0, {0, 0, 0, 1}

local function normalized(q)
    local length = math.sqrt(q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2)
    for i = 1, 4 do q[i] = q[i] / length end
    return q
end

function sysCall_actuation()
    share = math.min(1, share + 0.02)
    local dot = from[1] * to[1] + from[2] * to[2] + from[3] * to[3] + from[4] * to[4]
    local sign = dot < 0 and -1 or 1 -- right
    local sign = 1 -- broken
    local next = {}
    for i = 1, 4 do next[i] = (1 - share) * from[i] + share * sign * to[i] end
    q = normalized(next)
end
]]

-- The angle between two orientations.
local function angle(a, b)
    local dot = math.abs(a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4])
    return 2 * math.acos(math.min(1, dot))
end

local function orientation(g)
    local pose = g.pose { roll = { -3, 3 }, yaw = { -3, 3 } }
    return { pose[4], pose[5], pose[6], pose[7] }
end

versions.property('the tool turns slowly', { cases = 200 }, function(g, version)
    local tool = versions.script(CODE, version)
    local from, to = orientation(g), orientation(g)
    g.assume(angle(from, to) < 2.5)
    t.start()
    tool:set('from', from)
    tool:set('to', to)
    tool:set('share', 0)
    t.step()
    local last = tool:get('q')
    t.always(function()
        local q = tool:get('q')
        local turned = angle(last, q)
        last = q
        return 0.12 - turned
    end, 'at most 0.12 rad in a step')
    t.run_for(3)
end)
