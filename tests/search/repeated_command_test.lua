-- An axis moves by relative commands; the network may deliver one twice.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local SENDER <const> = [[
sim = require 'sim'
sent, number = 0, 0

function move(by)
    sent, number = sent + by, number + 1
    sim.broadcastMsg({id = 'move', data = {by = by, number = number}})
end
]]

local AXIS <const> = [[
sim = require 'sim'
place, last = 0, 0

function sysCall_msg(message)
    if message.id ~= 'move' then return end
    if message.data.number <= last then return end -- right
    last = message.data.number
    place = place + message.data.by
end
]]

versions.property('the axis is where it was sent', { cases = 200 }, function(g, version)
    local sender, axis = versions.script(SENDER, version), versions.script(AXIS, version)
    t.start()
    g.faults({ { 'double', sender, 'sim.broadcastMsg', { 0.2, 1 } } }, { most = 1, within = 0.5, lasts = { 0.1, 0.5 } })
    for _ = 1, 6 do
        sender:call('move', g.float(-0.2, 0.2, 0.1))
        t.step(2)
    end
    assert.near(sender:get('sent'), axis:get('place'), 1e-9)
end)
