--[[
The link to the clients of a remote API, as faults make it (t.faults.loseRequests and others, docs/TESTING.md). Without faults, all passes at once.

A fault is of one kind and has a value: loseRequests, loseReplies, doubleRequests, reorderRequests (a probability), delayRequests (seconds of
the wall clock: simulation time may wait for the client), vanish (clients that have sent something so far are silent from then on).
]]

local sim = require('sim')

local M = { NOBODY = -1 } -- for the reply to a request that came twice

local faults = {} -- lists { number, value } by kind
local active, last = 0, 0 -- how many faults there are, and the number of the last one
local late = {} -- { time, pass }: requests on their way
local seen, gone = {}, {} -- peers

local function occurs(kind)
    for _, fault in ipairs(faults[kind] or {}) do
        if math.random() < fault.value then return true end
    end
    return false
end

local function delay()
    local seconds = 0
    for _, fault in ipairs(faults.delayRequests or {}) do seconds = seconds + fault.value end
    return seconds
end

local function passLater(pass, seconds)
    late[#late + 1] = { time = sim.getSystemTime() + seconds, pass = pass }
end

local held -- a request that waits for the next one

local function releaseHeld()
    local pass = held
    held = nil
    if pass then pass() end
end

local function passInOrder(pass)
    if not held and occurs('reorderRequests') then
        held = pass
        return
    end
    pass()
    releaseHeld()
end

--- A request has come: `serve(peer, request)` is called now, later, twice, or not at all; the second time for nobody.
function M.request(serve, peer, request)
    seen[peer] = true
    if active == 0 and not late[1] then return serve(peer, request) end
    if gone[peer] or occurs('loseRequests') then return end
    local isDouble, seconds = occurs('doubleRequests'), delay()
    local function pass()
        passInOrder(function()
            serve(peer, request)
            if isDouble then serve(M.NOBODY, request) end
        end)
    end
    if seconds > 0 or late[1] then passLater(pass, seconds) else pass() end
end

--- Whether the reply to that client arrives.
function M.delivers(peer) return peer ~= M.NOBODY and (active == 0 or not (gone[peer] or occurs('loseReplies'))) end

--- Serves what was late.
function M.serveLate()
    if not late[1] then return end
    local now, waiting = sim.getSystemTime(), late
    late = {}
    for _, request in ipairs(waiting) do
        if request.time <= now then request.pass() else late[#late + 1] = request end
    end
end

function M.isAwaited() return late[1] ~= nil end

--- A connection has ended.
function M.forget(peer) seen[peer], gone[peer] = nil, nil end

---------------------------------------------------------------- for swanilda.test.faults

--- Begins a fault; returns its number.
function _swanilda_link_begin(kind, value)
    active, last = active + 1, last + 1
    local number = last
    if kind == 'vanish' then
        for peer in pairs(seen) do gone[peer] = number end
    else
        faults[kind] = faults[kind] or {}
        table.insert(faults[kind], { number = number, value = value })
    end
    return number
end

--- Ends a fault.
function _swanilda_link_end(kind, number)
    active = active - 1
    for peer, by in pairs(gone) do
        if by == number then gone[peer] = nil end
    end
    for i, fault in ipairs(faults[kind] or {}) do
        if fault.number == number then return table.remove(faults[kind], i) end
    end
end

return M
