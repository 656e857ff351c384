--[[
Says in the log which client of the ZeroMQ remote API everything waits for, when that takes long: once for each call back and each lock.

A client that steps and takes its time is no reason: it computes what to do next.
]]

local sim = require('sim')
local clients = require('remote.zmq_clients')
local steps = require('remote.zmq_steps')

local NOTE_AFTER <const> = 1 -- seconds
local SHORTEST_ADDRESS <const> = 8 -- digits by which the Python client tells functions of one name apart

local M = {}

local function title(client, peer)
    return ('client %s (%sconnection %s)'):format(client.uuid, client.lang and client.lang .. ', ' or '', peer or '?')
end

local function withoutAddress(name)
    local plain, digits = name:match('^(.+)_(%x+)$')
    return plain and #digits >= SHORTEST_ADDRESS and plain or name
end

local CALL <const> = "waiting for %s: its function '%s' was called back %.0f s ago and has not answered. If it has raised an error there, "
    .. 'everything goes on when the program ends its connection'
local LOCK <const> = 'waiting for %s: it has held a lock for %.0f s (sim.acquireLock); everything goes on with sim.releaseLock, or when the '
    .. 'program ends its connection'

local function warn(text, ...) sim.addLog(sim.verbosity_scriptwarnings, text:format(...)) end

local function noteCall(client, call, peer, now)
    if call.isNoted or now - call.since < NOTE_AFTER then return end
    call.isNoted = true
    warn(CALL, title(client, peer), withoutAddress(call.callback), now - call.since)
end

local function noteLock(client, now)
    if client.locks == 0 or client.isLockNoted or now - client.lockedSince < NOTE_AFTER then return end
    client.isLockNoted = true
    warn(LOCK, title(client, next(client.peers)), now - client.lockedSince)
end

--- To be called from time to time while the simulation or everything waits.
function M.note(now)
    for _, client in ipairs(clients.all) do
        local ask, task = client.asks[#client.asks], client.tasks[#client.tasks]
        if ask then noteCall(client, ask, ask.peer, now) end
        if task and task.waits == 'callback' and steps.holdsUp(client) then noteCall(client, task, task.owner, now) end
        noteLock(client, now)
    end
end

return M
