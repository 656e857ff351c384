--[[
The ZeroMQ remote API: lets external programs call functions of this Lua state.

Loaded as an add-on. All clients share its state: definitions and modules of one are visible to the others. Each request runs in a
coroutine (a task), which serves others after it: it may wait for a step or call back into its client while other clients are served.

    swanilda.batch(calls, stopAtError)    several requests ({func, args, argsL} or {eval}) in one; returns a list of their replies,
                                          {ret} or {err} each

The sockets are native; this file implements the protocol and the scheduling of clients. Parameters (sim.setNamedStringParam, -D):
zmqRemoteApi.rpcPort, zmqRemoteApi.autoStart, and zmqRemoteApi.verbose, with which requests are logged (1: their names, 2: in full).
]]

local _, native = ...
local sim = require('sim')
local load = load -- for chunks of clients, whatever one of them puts in its place
local answers = require('remote.zmq_answers')
local link = require('remote.link')
local clients = require('remote.zmq_clients')
local steps = require('remote.zmq_steps')
local waits = require('remote.zmq_waits')
local namespaces = require('remote.namespaces')
local requests = require('remote.zmq_arguments')
local given = requests.given
local decode = require('simCBOR').decode
local resume, yield, setAutoYield = coroutine.resume, coroutine.yield, setAutoYield -- whatever a client puts in their place
local pack, unpack = table.pack, table.unpack

local EXECUTED <const>, END <const> = '_*executed*_', '_*end*_'
local ANSWER_TIMEOUT <const> = 0.5 -- seconds after which a client that waits is told to wait on or to repeat
local IDLE_TIMEOUT <const> = 0.002 -- seconds without a request after which an idle simulator goes on
local POLL_TIMEOUT <const> = 0.05 -- the same while a client holds it up
local LATE_TIMEOUT <const> = 0.001 -- the same while requests are late
local MAX_QUEUED <const> = 1000 -- callbacks nobody waits for, by client
local MAX_HELD <const> = 1000 -- requests put off
local MAX_PER_WINDOW <const> = 10000 -- requests served in one window
local MAX_IDLE <const> = 16 -- coroutines kept for further requests

local current -- the client whose request is running
local asking -- the client whose blocking callback everything waits for
local held = {} -- requests of others meanwhile
local restarting = false
local windows = {idle = 0.05, running = 0.002} -- seconds requests are served at a time; running: for each client that does not step
local served, servedCount = {}, 0 -- clients in the present window that do not step
local verbose = math.tointeger(tonumber(sim.getNamedStringParam('zmqRemoteApi.verbose'))) or 0

local function mustLeave() return restarting or native.closed() end

---------------------------------------------------------------- tasks

local function reply(peer, bytes)
    if link.delivers(peer) then native.reply(peer, bytes) end
end

local function answer(task, bytes)
    if not task.peer then return end -- its client is gone
    reply(task.peer, bytes)
    task.peer = nil
end

local ASK <const> = {} -- yielded by a task that asks its client
local DONE <const> = {} -- yielded by a task that has ended, with the answer
local idle = {} -- coroutines without a task
local perform, deliverQueue -- below

local function serveTasks(client, request)
    while true do
        setAutoYield(1) -- a client may have allowed it
        client, request = yield(DONE, perform(client, request))
    end
end

local function takeCoroutine() return table.remove(idle) or coroutine.create(serveTasks) end

local function awaitStep(client, task)
    steps.await(client, task, sim.getSystemTime())
    if client.queue[1] then deliverQueue(client) end
    if not steps.isRunning() then answer(task, answers.WAIT) end
end

-- Goes on with a task until it ends, asks its client or waits for a step.
local function run(client, task, ...)
    local before = current
    current, task.waits = client, nil
    local ok, what, bytes, callback = resume(task.coroutine, ...)
    current = before
    if not ok or what == DONE then
        clients.endTask(client, task)
        if ok and #idle < MAX_IDLE then idle[#idle + 1] = task.coroutine end
        return answer(task, ok and bytes or answers.failure(what))
    end
    if what ~= ASK then return awaitStep(client, task) end
    task.waits, task.callback, task.since, task.isNoted = 'callback', callback, sim.getSystemTime(), nil
    answer(task, bytes)
end

local function resumeClient(client, now)
    if client.queue[1] and clients.listening(client) then deliverQueue(client) end
    local i = 1
    while client.tasks[i] do
        local task = client.tasks[i]
        if task.waits == 'step' and task.peer then
            if steps.isDue(task, now) then
                run(client, task)
            elseif now - task.since > ANSWER_TIMEOUT then
                answer(task, answers.WAIT)
            end
        end
        if client.tasks[i] == task then i = i + 1 end
    end
end

-- Tasks whose step is over go on; clients that wait for long are told so, since they may have a time limit.
local function resumeDue()
    local now = sim.getSystemTime()
    local i = 1
    while clients.all[i] do
        local client = clients.all[i]
        if #client.tasks > 0 then resumeClient(client, now) end
        if clients.all[i] == client then i = i + 1 end
    end
end

---------------------------------------------------------------- callbacks into the client

local serveAsked -- below

-- Sends the innermost blocking callback as soon as the client listens.
local function sendAsk(client)
    local ask = client.asks[#client.asks]
    local task = clients.listening(client)
    if ask and not ask.task and task then
        ask.task, ask.peer = task, task.peer
        answer(task, ask.bytes)
    end
end

local function canAnswer(client, ask)
    return clients.isKnown(client) and (not ask.peer or client.peers[ask.peer])
end

-- A callback where nothing can yield: everything waits for this client, until it speaks next if it is not listening.
local function askBlocking(client, callback, bytes)
    local outer, ask = asking, {callback = callback, since = sim.getSystemTime(), bytes = bytes, postponed = {}}
    client.asks[#client.asks + 1] = ask
    asking = client
    sendAsk(client)
    while not ask.results and canAnswer(client, ask) and not mustLeave() do serveAsked() end
    asking = outer
    table.remove(client.asks)
    for _, start in ipairs(ask.postponed) do start() end
    local results = ask.results or {n = 0}
    return unpack(results, 1, results.n)
end

local function callbackOf(client, name)
    local function callback(...)
        local bytes = answers.call(name, pack(...))
        local _, isMain = coroutine.running()
        if isMain or not getYieldAllowed() then return askBlocking(client, name, bytes) end
        return yield(ASK, bytes, name)
    end
    answers.names[callback] = name .. '@func'
    return callback
end

function deliverQueue(client)
    if client.delivering then return end
    client.delivering = true
    while client.queue[1] and clients.isKnown(client) and not mustLeave() do
        local first = table.remove(client.queue, 1)
        askBlocking(client, first.callback, first.bytes)
    end
    client.delivering = false
end

---------------------------------------------------------------- requests

local function lookup(path)
    local value = namespaces.find(path)
    if not value then error('No such function: ' .. path, 0) end
    return value
end

-- As direct requests these count for the client; within Lua code they mean what they mean everywhere.
local LOCKS <const> = {
    ['sim.acquireLock'] = function()
        if current.locks == 0 then current.lockedSince, current.isLockNoted = sim.getSystemTime(), nil end
        current.locks = current.locks + 1
    end,
    ['sim.releaseLock'] = function() current.locks = math.max(0, current.locks - 1) end,
}

local STEPS <const> = {['sim.step'] = true, ['sim.yield'] = true, ['sim.switchThread'] = true}

function perform(client, request)
    local func = request.func
    client.asksForStep = STEPS[func or '']
    if func and func ~= '' then
        local args, n = requests.arguments(client, request, callbackOf)
        local code = LOCKS[func] or lookup(func)
        return answers.results(pack(code(unpack(args, 1, n))), answers.typesOf(func, native.returns))
    end
    if not request.eval then return answers.EMPTY end
    return answers.results(pack(assert(load(request.eval, nil, 't'))()))
end

local function executed(client, peer, request)
    local ask = client.asks[#client.asks]
    if ask and ask.task and ask.peer == peer then
        ask.task.peer = peer
        local args, n = given(request)
        ask.results = pack(unpack(args, 1, n))
        return
    end
    local task = clients.expecting(client, peer)
    if not task then return reply(peer, answers.failure('No such function: ' .. EXECUTED)) end
    task.peer = peer
    if task.waits == 'callback' then
        local args, n = given(request)
        run(client, task, unpack(args, 1, n))
    else
        task.since = sim.getSystemTime()
        if steps.isDue(task, task.since) then run(client, task) end
    end
end

local function start(client, peer, request)
    local task = clients.newTask(client, peer, takeCoroutine)
    local ask = client.asks[#client.asks]
    if ask and not ask.task then
        ask.postponed[#ask.postponed + 1] = function() run(client, task, client, request) end
        return sendAsk(client)
    end
    if client.queue[1] then deliverQueue(client) end
    run(client, task, client, request)
end

local function handle(peer, request)
    local client = clients.of(request, peer, sim.getSystemTime())
    if asking and asking ~= client then
        if #held >= MAX_HELD then return reply(peer, answers.REPEAT) end
        held[#held + 1] = {peer = peer, request = request, since = client.seen}
        return
    end
    if client.level == 0 and not served[client] then served[client], servedCount = true, servedCount + 1 end
    if request.func == END then
        clients.forget(client)
        return reply(peer, answers.EMPTY)
    end
    if request.func == EXECUTED then return executed(client, peer, request) end
    start(client, peer, request)
end

local function logRequest(peer, request)
    local text = tostring(request.func or request.eval)
    if verbose > 1 then text = getAsString(request) end
    sim.addLog(sim.verbosity_scriptinfos, ('request from connection %d: %s'):format(peer, text))
end

local function handleSafely(peer, request)
    local ok, message = xpcall(handle, tostring, peer, request)
    if not ok then reply(peer, answers.failure(message)) end
    if peer == link.NOBODY then clients.forgetPeer(peer) end
end

local function receive(peer, bytes)
    local ok, request = xpcall(decode, tostring, bytes)
    if not ok or type(request) ~= 'table' or type(request.uuid) ~= 'string' then
        return reply(peer, answers.MISMATCH)
    end
    if verbose > 0 then logRequest(peer, request) end
    link.request(handleSafely, peer, request)
end

-- A connection is gone, and with it what it has sent.
local function forgetPeer(peer)
    clients.forgetPeer(peer)
    link.forget(peer)
    for i = #held, 1, -1 do
        if held[i].peer == peer then table.remove(held, i) end
    end
end

-- The next of what has arrived; waits up to `timeout` seconds. Tells whether there was anything.
local function serveOne(timeout)
    if held[1] and not asking then
        local first = table.remove(held, 1)
        handleSafely(first.peer, first.request)
        return true
    end
    link.serveLate()
    local peer, bytes = native.receive(link.isAwaited() and math.min(timeout, LATE_TIMEOUT) or timeout)
    if not peer then return false end
    if bytes then receive(peer, bytes) else forgetPeer(peer) end
    return true
end

-- While everything waits for one client, the others wait a little, then they have to repeat their request.
function serveAsked()
    serveOne(POLL_TIMEOUT)
    local now = sim.getSystemTime()
    while held[1] and now - held[1].since > ANSWER_TIMEOUT do reply(table.remove(held, 1).peer, answers.REPEAT) end
    clients.forgetExpired(now)
    waits.note(now)
end

---------------------------------------------------------------- functions for clients

namespaces.install(native.members)

require('remote.zmq_functions')({
    current = function() return current end,
    perform = function(call) return perform(current, call) end,
    restart = function() restarting = true end,
    setWindow = function(seconds) windows[steps.isRunning() and 'running' or 'idle'] = seconds end,
})

---------------------------------------------------------------- the add-on

setAutoYield(false)

function sysCall_init()
    sim.setBoolProperty(sim.handle_self, 'restartOnError', true)
    local port = sim.getNamedStringParam('zmqRemoteApi.rpcPort') or '?'
    sim.addLog(sim.verbosity_scriptinfos, ('ZeroMQ Remote API server starting (rpcPort=%s)...'):format(port))
end

-- An error in a function of one client must not end the add-on of all.
local function callLocally(f, ...)
    local results = pack(xpcall(f, tostring, ...))
    if not results[1] then return sim.addLog(sim.verbosity_scripterrors, tostring(results[2])) end
    return unpack(results, 2, results.n)
end

-- A function of this state, or one that clients may have.
function sysCall_ext(name, ...)
    local f = namespaces.find(name)
    if f then return callLocally(f, ...) end
    local call = {callback = name, bytes = answers.call(name, pack(...))}
    for _, client in ipairs(clients.all) do
        if #client.queue >= MAX_QUEUED then table.remove(client.queue, 1) end
        client.queue[#client.queue + 1] = call
    end
end

-- Serves what has arrived, and what comes after it while the window is open and it is not quiet for long.
local function serveWindow(kind, quiet)
    served, servedCount = {}, 0
    if not serveOne(0) then return end
    local begun, state, count = sim.getSystemTime(), sim.getSimulationState(), 1
    while count < MAX_PER_WINDOW and not mustLeave() and not native.others() and sim.getSimulationState() == state do
        local window = windows[kind] * (kind == 'running' and servedCount or 1)
        local left = begun + window - sim.getSystemTime()
        if kind == 'running' and steps.allAwaitStep(served) then left = 0 end
        if left < 0 and servedCount > 0 or not serveOne(math.max(0, math.min(left, quiet))) then return end
        count = count + 1
    end
end

-- Serves requests as long as clients hold something up.
local function serveWhile(isHeldUp)
    while isHeldUp() and not mustLeave() do
        serveOne(POLL_TIMEOUT)
        local now = sim.getSystemTime()
        clients.forgetExpired(now)
        resumeDue()
        waits.note(now)
    end
end

local function serveIdle()
    clients.forgetExpired(sim.getSystemTime())
    resumeDue()
    serveWindow('idle', IDLE_TIMEOUT)
    serveWhile(steps.anyLock)
    if restarting then return {cmd = 'restart'} end
end

sysCall_nonSimulation, sysCall_suspended = serveIdle, serveIdle

function sysCall_actuation()
    resumeDue()
    serveWindow('running', POLL_TIMEOUT)
    serveWhile(steps.anyHoldsUp)
    steps.pass()
    if restarting then return {cmd = 'restart'} end
end

-- Between two steps in real-time mode.
function sysCall_realTimeIdle() serveWindow('running', IDLE_TIMEOUT) end

function sysCall_afterSimulation() resumeDue() end

-- Nobody is left without an answer.
function sysCall_cleanup()
    local gone = answers.failure('the remote API server has ended or is starting anew.')
    for _, client in ipairs(clients.all) do
        for _, task in ipairs(client.tasks) do answer(task, gone) end
    end
    for _, request in ipairs(held) do reply(request.peer, gone) end
end
