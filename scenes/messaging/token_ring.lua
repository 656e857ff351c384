-- A ring of stations that pass a token by signals: only the station that holds it may speak.
--
--     swanilda run scenes/messaging/token_ring.lua
--
-- Each station is a thread that sleeps until the signal with its number appears. Signals belong to the script that set them last, and
-- vanish with it: when the run ends, nothing is left behind.

sim = require 'sim'

local STATIONS = 5
local ROUNDS = 3

local STATION = [[
sim = require 'sim'

function sysCall_thread()
    local number, next, rounds = ...
    while true do
        -- The value of the signal is the round. It is taken off the ring, so that it is there once.
        local round = sim.waitForSignal(sim.handle_scene, 'token.' .. number)
        sim.removeProperty(sim.handle_scene, 'signal.token.' .. number)
        print(string.format('t = %.2f s   station %d speaks in round %d', sim.getSimulationTime(), number, round))
        sim.step() -- it takes a step to speak
        if next == 1 then round = round + 1 end
        if round > rounds then
            print('The token has gone around ' .. rounds .. ' times.')
            sim.stopSimulation()
            return
        end
        sim.setIntProperty(sim.handle_scene, 'signal.token.' .. next, round)
    end
end
]]

function sysCall_init()
    for number = 1, STATIONS do
        local next = number % STATIONS + 1
        local code = STATION:gsub('%.%.%.', string.format('%d, %d, %d', number, next, ROUNDS), 1)
        local station = sim.createScript(sim.scripttype_simulation, code)
        sim.setObjectAlias(station, 'station' .. number)
    end
end

function sysCall_actuation()
    if sim.getSimulationTime() == 0 then sim.setIntProperty(sim.handle_scene, 'signal.token.1', 1) end
end

function sysCall_afterSimulation()
    local left = 0
    for number = 1, STATIONS do
        if sim.getPropertyInfo(sim.handle_scene, 'signal.token.' .. number) then left = left + 1 end
    end
    print(left .. ' tokens are left.')
end
