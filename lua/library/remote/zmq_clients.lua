--[[
The clients of the ZeroMQ remote API: identity and pending requests. Whether they block the simulation: zmq_steps.

A client is known by its uuid and has one or more connections. Each of its requests is a task as long as it has no answer:

    peer         the connection that waits for an answer; nil while the client has to send
    owner        the connection of the request
    coroutine    its coroutine
    waits        'step' | 'callback' | nil while it runs or has not begun
    step, asked  what step it waits for the end of, and since when (zmq_steps)
    callback     the name of the function of the client it waits for, since when, and whether that was said (zmq_waits)
]]

local M = {}

local LIFE <const> = 600 -- seconds a silent client is remembered
local MAX_CLIENTS <const> = 10000
local MAX_PER_PEER <const> = 16 -- clients by one connection, which may be a proxy
local MAX_TASKS <const> = 200
local MAX_NAME_LENGTH <const> = 1000

local clients = {} -- in the order they came
local byUuid = {}
local ofPeer = {} -- lists of clients by connection

M.all = clients

local function removeFrom(list, item)
    for i = #list, 1, -1 do
        if list[i] == item then return table.remove(list, i) end
    end
end

-- A connection that names itself anew all the time takes the places of its own names only.
local function makeRoom(peer)
    local known = ofPeer[peer]
    if not known or #known < MAX_PER_PEER then return end
    local oldest
    for _, client in ipairs(known) do
        local isIdle = #client.tasks == 0 and #client.asks == 0 and next(client.peers, next(client.peers)) == nil
        if isIdle and (not oldest or client.seen < oldest.seen) then oldest = client end
    end
    if not oldest then error('too many clients by one connection', 0) end
    M.forget(oldest)
end

local function newClient(request, peer)
    if #request.uuid > MAX_NAME_LENGTH then error('the uuid is too long', 0) end
    makeRoom(peer)
    if #clients >= MAX_CLIENTS then error('too many clients', 0) end
    local client = {
        uuid = request.uuid,
        lang = type(request.lang) == 'string' and request.lang:match('^%w[%w+#]*$') or nil,
        peers = {},
        tasks = {}, -- the innermost last
        asks = {}, -- blocking callbacks, the innermost last
        queue = {}, -- callbacks nobody waits for
        level = 0, -- of stepping
        locks = 0, -- lockedSince: the first of them; isLockNoted: that was said (zmq_waits)
        life = math.tointeger(request.timeout) or LIFE,
    }
    clients[#clients + 1] = client
    byUuid[request.uuid] = client
    return client
end

--- The client a request comes from.
function M.of(request, peer, now)
    local client = byUuid[request.uuid] or newClient(request, peer)
    client.seen = now
    if not client.peers[peer] then
        client.peers[peer] = true
        ofPeer[peer] = ofPeer[peer] or {}
        table.insert(ofPeer[peer], client)
    end
    return client
end

function M.isKnown(client) return byUuid[client.uuid] == client end

function M.forget(client)
    removeFrom(clients, client)
    byUuid[client.uuid] = nil
    for peer in pairs(client.peers) do removeFrom(ofPeer[peer] or {}, client) end
end

--- A connection is gone, and with it what came by it.
function M.forgetPeer(peer)
    for _, client in ipairs(ofPeer[peer] or {}) do
        client.peers[peer] = nil
        for j = #client.tasks, 1, -1 do
            if client.tasks[j].owner == peer then table.remove(client.tasks, j) end
        end
        if not next(client.peers) then M.forget(client) end
    end
    ofPeer[peer] = nil
end

function M.forgetExpired(now)
    for i = #clients, 1, -1 do
        if now - clients[i].seen > clients[i].life then M.forget(clients[i]) end
    end
end

---------------------------------------------------------------- tasks

function M.newTask(client, peer, takeCoroutine)
    if #client.tasks >= MAX_TASKS then error('too many requests without an answer', 0) end
    local task = {peer = peer, owner = peer, coroutine = takeCoroutine()}
    client.tasks[#client.tasks + 1] = task
    return task
end

function M.endTask(client, task) removeFrom(client.tasks, task) end

--- The innermost task whose client waits for an answer.
function M.listening(client)
    for i = #client.tasks, 1, -1 do
        if client.tasks[i].peer then return client.tasks[i] end
    end
end

--- The innermost task that expects the client to speak by that connection.
function M.expecting(client, peer)
    for i = #client.tasks, 1, -1 do
        local task = client.tasks[i]
        if not task.peer and task.owner == peer and task.waits then return task end
    end
end

--- Removes everything by which clients could block the end of the simulation.
function M.release()
    for _, client in ipairs(clients) do client.level, client.locks = 0, 0 end
end

return M
