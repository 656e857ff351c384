-- A valve opens at a time and closes at another one.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
opensAt, closesAt, isOpen, openings = 0.5, 1, false, 0

function sysCall_actuation()
    local now = sim.getSimulationTime()
    local opens = not isOpen and openings == 0 and now >= opensAt -- right
    local opens = now == opensAt -- broken
    if opens then isOpen, openings = true, openings + 1 end
    if isOpen and now >= closesAt then isOpen = false end
end
]]

versions.property('the valve opens once', { cases = 100 }, function(g, version)
    local valve = versions.script(CODE, version)
    t.start()
    valve:set('opensAt', g.integer(2, 20) * 0.1)
    valve:set('closesAt', 2.5)
    t.run_for(3)
    assert.are.equal(1, valve:get('openings'))
    assert.is_false(valve:get('isOpen'))
end)
