--[[
Steps of the simulation that clients of the ZeroMQ remote API wait for, and clients that the simulation waits for.

A step is counted when nobody holds it up any more. The count never goes back, so that a request that waits is due at every step after it, in
whatever run. Whether a client has asked for the present step is read from its requests: nothing about it is kept twice. So a request may come
before the start, in a pause, or while the simulation stops, and counts for the step that comes.
]]

local sim = require('sim')
local clients = require('remote.zmq_clients')

local M = {}

local ADVANCING <const> = sim.simulation_advancing
local START_TIMEOUT <const> = 0.02 -- seconds for which a step waits for a start that another client is about to ask for

local count = 0

function M.isRunning() return sim.getSimulationState() & ADVANCING ~= 0 end

--- The step that was prepared now takes place.
function M.pass() count = count + 1 end

--- The task waits for the end of the present step.
function M.await(client, task, now)
    task.waits, task.step, task.asked, task.since = 'step', count, now, now
    task.mayAwaitStart, client.asksForStep = client.asksForStep and client.level > 0, nil
end

--- Whether the step is over that a task waits for. There is none while the simulation stands.
function M.isDue(task, now)
    if task.step ~= count then return true end
    return not M.isRunning() and not (task.mayAwaitStart and now - task.asked < START_TIMEOUT)
end

local function hasAskedForStep(client)
    for _, task in ipairs(client.tasks) do
        if task.waits == 'step' and task.step == count then return true end
    end
    return false
end

--- Whether the present step has to wait for a client.
function M.holdsUp(client)
    if client.locks > 0 then return true end
    if client.level > 0 then return not hasAskedForStep(client) end
    local task = client.tasks[#client.tasks]
    return task ~= nil and task.waits ~= 'step'
end

--- Whether the present step has to wait.
function M.anyHoldsUp()
    for _, client in ipairs(clients.all) do
        if M.holdsUp(client) then return true end
    end
    return false
end

--- Whether all of a set can do nothing before the next step.
function M.allAwaitStep(set)
    for client in pairs(set) do
        local task = client.tasks[#client.tasks]
        if not task or task.waits ~= 'step' or not task.peer then return false end
    end
    return true
end

--- Whether anything has to wait, even a simulation that stands.
function M.anyLock()
    for _, client in ipairs(clients.all) do
        if client.locks > 0 then return true end
    end
    return false
end

return M
