--[[
Functions that are specific to ZeroMQ clients, or behave differently for them.

Returns a function that defines them in its Lua state; `server` knows the calling client.
]]

local sim = require('sim')
local answers = require('remote.zmq_answers')
local clients = require('remote.zmq_clients')

local MAX_CALLS <const> = 10000 -- of a batch
local FOR_EVER <const> = 999999999

local function checkBatch(calls)
    if type(calls) ~= 'table' or #calls > MAX_CALLS then error('swanilda.batch: a list of up to 10000 calls is needed', 3) end
    for i, call in ipairs(calls) do
        if type(call) ~= 'table' then error(('swanilda.batch: call %d is no map'):format(i), 3) end
    end
end

local function installBatch(server)
    swanilda = {}

    function swanilda.batch(calls, stopAtError)
        checkBatch(calls)
        local parts = {}
        for i, call in ipairs(calls) do
            local ok, bytes = xpcall(server.perform, answers.failure, call) -- unlike pcall, it lets a call wait for a step
            parts[i] = bytes
            if not ok and stopAtError then break end
        end
        return answers.list(parts)
    end
end

local function installStepping(server)
    local setStepping, stopSimulation = sim.setStepping, sim.stopSimulation

    function sim.setStepping(enable)
        local client = server.current()
        if not client then return setStepping(enable) end
        local level = client.level
        client.level = enable and level + 1 or math.max(0, level - 1)
        return level
    end

    function sim.stopSimulation(...)
        clients.release()
        return stopSimulation(...)
    end

    function sim.setThreadAutomaticSwitch() end

    function sim.setThreadSwitchTiming(milliseconds)
        local window = tonumber(milliseconds) or 0
        server.setWindow(window > 0 and window / 1000 or FOR_EVER)
    end
end

local function atLeastNil(...)
    if select('#', ...) == 0 then return nil end
    return ...
end

local function installScriptFunctions()
    local callScriptFunction, readCustomDataBlock = sim.callScriptFunction, sim.readCustomDataBlock

    function sim.callScriptFunction(...) return atLeastNil(callScriptFunction(...)) end

    function sim.readCustomDataBlock(...) return readCustomDataBlock(...) or '' end

    function sim.testCB(a, callback, b, times)
        for _ = 1, times or 99 do callback(a, b) end
        return callback(a, b)
    end
end

return function(server)
    installBatch(server)
    installStepping(server)
    installScriptFunctions()
    sim.restartServer = server.restart
end
