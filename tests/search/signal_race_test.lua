-- One script counts parts and sends them by a signal, another one takes them from there.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local SENDER <const> = [[
sim = require 'sim'
sent = 0

function send(count)
    sent = sent + count
    local waiting = sim.getInt32Signal('parts') or 0 -- right
    local waiting = 0 -- broken
    sim.setInt32Signal('parts', waiting + count)
end
]]

local TAKER <const> = [[
sim = require 'sim'
taken, every, steps = 0, 1, 0

function sysCall_sensing()
    steps = steps + 1
    if steps % every ~= 0 then return end
    local count = sim.getInt32Signal('parts')
    if not count then return end
    taken = taken + count
    sim.clearInt32Signal('parts')
end
]]

versions.property('no part is lost', { cases = 200 }, function(g, version)
    local sender, taker = versions.script(SENDER, version), versions.script(TAKER, version)
    t.start()
    taker:set('every', g.integer(1, 3))
    for _, step in ipairs(g.list(function() return g.integer(0, 12) end, { max = 6 })) do
        t.at(t.time() + step * 0.05, function() sender:call('send', 1) end)
    end
    t.run_for(1)
    assert.are.equal(sender:get('sent'), taker:get('taken'))
end)
