-- A machine drives, turns and waits in turn; the emergency stop holds it in whatever state.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
state, since, isStopped, moved = 'drive', 0, false, 0

local NEXT = {drive = 'turn', turn = 'wait', wait = 'drive'}

function stop() isStopped = true end

function sysCall_actuation()
    local now = sim.getSimulationTime()
    if isStopped and state ~= 'turn' then moved = 0 return end -- broken
    if isStopped then moved = 0 return end -- right
    moved = state == 'wait' and 0 or 1
    if now - since >= 0.7 then
        if isStopped then state = 'wait' else state = NEXT[state] end
        since = now
    end
end
]]

versions.property('nothing moves after the emergency stop', { cases = 100 }, function(g, version)
    local machine = versions.script(CODE, version)
    t.start()
    local at = g.float(0, 4)
    t.at(at, function() machine:call('stop') end)
    t.always(function() return t.time() < at + 0.11 or machine:get('moved') == 0 end, 'it stands')
    t.run_for(5)
end)
