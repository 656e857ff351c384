-- A light barrier counts parts on a belt. Parts that touch each other count by their length.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
parts, moved, count, wasDark, darkFrom = {}, 0, 0, false, 0

local LENGTH = 0.2

function sysCall_sensing()
    moved = moved + 0.01
    local isDark = false
    for _, start in ipairs(parts) do
        if moved >= start and moved < start + LENGTH then isDark = true end
    end
    if isDark and not wasDark then darkFrom = moved end
    if wasDark and not isDark then
        count = count + math.max(1, math.floor((moved - darkFrom) / LENGTH + 0.5)) -- right
        count = count + 1 -- broken
    end
    wasDark = isDark
end
]]

versions.property('all parts are counted', { cases = 200 }, function(g, version)
    local belt = versions.script(CODE, version)
    local parts, place = {}, 0.1
    for i, between in ipairs(g.list(function() return g.float(0, 0.3, 0.3) end, { max = 5 })) do
        -- Less than the barrier can see is none.
        place = place + (between < 0.02 and 0 or between)
        parts[i] = place
        place = place + 0.2
    end
    t.start()
    belt:set('parts', parts)
    t.run_for((place + 0.3) / 0.01 * 0.05)
    assert.are.equal(#parts, belt:get('count'))
end)
