-- A client asks a server for the next job; messages may be lost.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CLIENT <const> = [[
sim = require 'sim'
done, waitsSince, number = 0, nil, 0

function ask()
    waitsSince = sim.getSimulationTime()
    sim.broadcastMsg({id = 'ask', data = {number = number}})
end

function sysCall_actuation()
    if done == 5 then return end
    if not waitsSince then ask() return end
    if sim.getSimulationTime() - waitsSince > 0.5 then ask() end -- right
end

function sysCall_msg(message)
    if message.id ~= 'job' or message.data.number ~= number then return end
    done, number, waitsSince = done + 1, number + 1, nil
end
]]

local SERVER <const> = [[
sim = require 'sim'

asked = {}

function sysCall_msg(message)
    if message.id == 'ask' then asked[#asked + 1] = message.data.number end
end

function sysCall_sensing()
    for _, number in ipairs(asked) do sim.broadcastMsg({id = 'job', data = {number = number}}) end
    asked = {}
end
]]

versions.property('five jobs are done', { cases = 200 }, function(g, version)
    local server, client = versions.script(SERVER, version), versions.script(CLIENT, version)
    t.start()
    g.faults({
        { 'lose', client, 'sim.broadcastMsg', 1 },
        { 'lose', server, 'sim.broadcastMsg', 1 },
    }, { most = 2, within = 1, lasts = { 0.05, 0.6 } })
    t.eventually(function() return client:get('done') == 5 end, 6, 'all jobs')
    t.run_for(6)
end)
