--[[
The ZeroMQ remote API: calls of functions of this Lua state by programs outside.

An add-on is made of this file. All clients share its state, so that what one requires or defines, the others see. Each request runs in a
coroutine of its own (a task): it may wait for a step or call back into its client while other clients are served.

The sockets are native; here are the words of the protocol, and who waits for whom.
]]

local _, native = ...
local sim = require('sim')
local load = load -- for chunks of clients, whatever is taken from their reach
local cbor = require('org.conman.cbor')
local simCBOR = require('simCBOR')
local head = require('org.conman.cbor_c').encode
local create, resume, yield, status = coroutine.create, coroutine.resume, coroutine.yield, coroutine.status
local pack, unpack = table.pack, table.unpack

local MISMATCH <const> = "The client ZeroMQ remote API version does not match CoppeliaSim's version"
local WAIT <const>, EXECUTED <const>, END <const>, NIL <const> = '_*wait*_', '_*executed*_', '_*end*_', '_*NIL*_'
local REPEAT <const> = '_*repeat*_'
local CALLBACK <const> = '^(.*)@func$'
local LIFE <const> = 600 -- seconds a silent client is remembered
local PATIENCE <const> = 0.5 -- seconds a client waits for a step without a word
local SEARCHED <const> = 16 -- entries of a table that are looked through for callbacks
local MOST_ARGUMENTS <const> = 1000
local ADVANCING <const> = sim.simulation_advancing

local clients = {} -- in the order they came
local byUuid = {}
local current -- the client whose request is running
local currentStep = 0
local insideCallback = false -- in a callback that cannot yield: only its client is served

---------------------------------------------------------------- clients

local function newClient(request, now)
    local client = {
        uuid = request.uuid,
        peers = {},
        tasks = {}, -- requests without answer, the innermost last
        level = 0, -- of stepping
        desiredStep = 0,
        locks = 0,
        life = math.tointeger(request.timeout) or LIFE,
        seen = now,
    }
    clients[#clients + 1] = client
    byUuid[request.uuid] = client
    return client
end

local function forget(client)
    for i = #clients, 1, -1 do
        if clients[i] == client then table.remove(clients, i) end
    end
    byUuid[client.uuid] = nil
end

-- A connection is gone. A client may have several.
local function forgetPeer(peer)
    for i = #clients, 1, -1 do
        local client = clients[i]
        if client.peers[peer] then
            client.peers[peer] = nil
            if not next(client.peers) then forget(client) end
        end
    end
end

local function forgetExpired(now)
    for i = #clients, 1, -1 do
        if now - clients[i].seen > clients[i].life then forget(clients[i]) end
    end
end

local function isRunning() return sim.getSimulationState() & ADVANCING ~= 0 end

-- Whether the simulation must not advance because of this client.
local function holdsUp(client)
    local task = client.tasks[#client.tasks]
    if client.locks > 0 then return true end
    if client.level > 0 then return client.desiredStep <= currentStep end
    return task ~= nil and task.waits ~= 'step'
end

local function anyHoldsUp()
    for _, client in ipairs(clients) do
        if holdsUp(client) then return true end
    end
    return false
end

local function anyLock()
    for _, client in ipairs(clients) do
        if client.locks > 0 then return true end
    end
    return false
end

---------------------------------------------------------------- answers

local function answer(task, bytes)
    native.reply(task.peer, bytes)
    task.peer = nil -- the slot is used up until the client speaks again
end

local WAIT_BYTES <const> = cbor.encode({func = WAIT, args = {}})
local EMPTY <const> = cbor.encode({})

local function isArray(t)
    local n = 0
    for _ in pairs(t) do n = n + 1 end
    return n == #t
end

-- The types a function is declared to return; only they tell text from bytes, and an empty list from an empty map.
local function encodeResult(value, declared, first)
    if declared and type(value) == 'table' and not getmetatable(value) then
        return (isArray(value) and cbor.TYPE.ARRAY or cbor.TYPE.MAP)(value)
    end
    if first and type(value) == 'string' then
        if declared == 'string' then return cbor.TYPE.TEXT(value) end
        if declared == 'buffer' then return cbor.TYPE.BIN(value) end
    end
    return cbor.encode(value)
end

local function encodeResults(results, types)
    if results.n == 0 then return '\xa1\x63ret\xa0' end
    local parts = {'\xa1\x63ret', head(0x80, results.n)}
    for i = 1, results.n do parts[i + 2] = encodeResult(results[i], types and types[i], i == 1) end
    return table.concat(parts)
end

local function encodeError(message)
    local text = tostring(message):gsub('\nstack traceback:.*', ''):gsub('\n', '_=NL=_'):gsub('\t', '_=TB=_')
    return cbor.encode({err = text})
end

---------------------------------------------------------------- tasks

local ASK <const> = {} -- yielded by a task that asks its client

-- Goes on with a task until it ends, asks its client or waits for a step.
local function run(client, task, ...)
    local before = current
    current = client
    local outcome = pack(resume(task.coroutine, ...))
    current = before
    if status(task.coroutine) == 'dead' then
        table.remove(client.tasks)
        local ok, bytes = outcome[1], outcome[2]
        return answer(task, ok and bytes or encodeError(bytes))
    end
    if outcome[2] == ASK then
        task.waits = EXECUTED
        return answer(task, outcome[3])
    end
    task.waits, task.step, task.since = 'step', currentStep, sim.getSystemTime()
    if not isRunning() then return answer(task, WAIT_BYTES) end
    if client.level > 0 then client.desiredStep = currentStep + 1 end
end

local function isDue(task) return task.step ~= currentStep or not isRunning() end

-- Tasks whose step is over go on; clients that wait for long are told so, since they may have a time limit.
local function resumeDue(now)
    for _, client in ipairs({unpack(clients)}) do
        local task = client.tasks[#client.tasks]
        if task and task.waits == 'step' and task.peer then
            if isDue(task) then
                task.waits = nil
                run(client, task)
            elseif now - task.since > PATIENCE then
                answer(task, WAIT_BYTES)
            end
        end
    end
end

---------------------------------------------------------------- callbacks into the client

local function encodeCall(name, args)
    local parts = {}
    for i = 1, args.n do parts[i] = cbor.encode(args[i]) end
    local list = args.n == 0 and '\xa0' or head(0x80, args.n) .. table.concat(parts)
    return '\xa2' .. cbor.encode('func') .. cbor.TYPE.TEXT(name) .. cbor.encode('args') .. list
end

local serve -- below

-- A callback where nothing can yield: everything waits for this client.
local function askBlocking(client, bytes)
    local task = client.tasks[#client.tasks]
    answer(task, bytes)
    local outer = insideCallback
    insideCallback, task.waits, task.result = client, 'blocking', nil
    while not task.result and byUuid[client.uuid] == client and not native.closed() do serve(0.05) end
    insideCallback, task.waits = outer, nil
    local result = task.result or pack()
    return unpack(result, 1, result.n)
end

local function callbackOf(client, name)
    return function(...)
        local bytes = encodeCall(name, pack(...))
        local _, isMain = coroutine.running()
        if isMain or not getYieldAllowed() then return askBlocking(client, bytes) end
        return yield(ASK, bytes)
    end
end

local function withCallbacks(client, value, depth)
    if type(value) == 'string' then
        local name = value:match(CALLBACK)
        return name and callbackOf(client, name) or value
    end
    if depth == 0 and type(value) == 'table' and not getmetatable(value) then
        local looked = 0
        for key, entry in pairs(value) do
            looked = looked + 1
            if looked > SEARCHED then break end
            value[key] = withCallbacks(client, entry, 1)
        end
    end
    return value
end

---------------------------------------------------------------- requests

local function lookup(path)
    local value = _G
    for word in path:gmatch('[%w_]+') do
        value = value[word]
        if not value then error('No such function: ' .. path, 0) end
    end
    return value
end

-- The arguments and their number: null at the end of a list is told by the number only.
local function given(request)
    local args = type(request.args) == 'table' and request.args or {}
    local n = math.tointeger(request.argsL) or #args
    return args, math.max(0, math.min(n, MOST_ARGUMENTS))
end

local function arguments(client, request)
    local args, n = given(request)
    for i = 1, n do
        local value = withCallbacks(client, args[i], 0)
        if value == NIL then value = nil end
        args[i] = value
    end
    return args, n
end

local function perform(client, request)
    local func = request.func
    if func and func ~= '' then
        local args, n = arguments(client, request)
        return encodeResults(pack(lookup(func)(unpack(args, 1, n))), native.returns(func))
    end
    if not request.eval then return EMPTY end
    return encodeResults(pack(assert(load(request.eval, nil, 't'))()))
end

local function executed(client, peer, request)
    local task = client.tasks[#client.tasks]
    if not task then return native.reply(peer, encodeError('No such function: ' .. EXECUTED)) end
    task.peer = peer
    local args, n = given(request)
    if task.waits == 'blocking' then
        task.result = pack(unpack(args, 1, n))
    elseif task.waits == EXECUTED then
        task.waits = nil
        run(client, task, unpack(args, 1, n))
    elseif isDue(task) then
        task.waits = nil
        run(client, task)
    end
end

local function handle(peer, request)
    if type(request) ~= 'table' or type(request.uuid) ~= 'string' then
        return native.reply(peer, cbor.encode({success = false, error = MISMATCH}))
    end
    local now = sim.getSystemTime()
    local client = byUuid[request.uuid] or newClient(request, now)
    client.seen, client.peers[peer] = now, true
    if insideCallback and insideCallback ~= client then
        return native.reply(peer, cbor.encode({func = REPEAT, args = {}}))
    end
    if request.func == END then
        forget(client)
        return native.reply(peer, EMPTY)
    end
    if request.func == EXECUTED then return executed(client, peer, request) end
    local task = {peer = peer, coroutine = create(perform)}
    client.tasks[#client.tasks + 1] = task
    run(client, task, client, request)
end

-- Serves what has arrived; waits up to `patience` seconds when nothing has. Tells whether there was anything.
function serve(patience)
    local peer, bytes = native.receive(patience)
    local any = peer ~= nil
    while peer do
        if bytes then
            local ok, request = pcall(simCBOR.decode, bytes)
            handle(peer, ok and request or nil)
        else
            forgetPeer(peer)
        end
        peer, bytes = native.receive(0)
    end
    return any
end

---------------------------------------------------------------- functions for clients

zmqRemoteApi = {}

function zmqRemoteApi.require(name) _G[name:match('^[^-]*')] = require(name) end

-- The table sim is filled name by name when they are used.
local function membersOf(value)
    if value ~= sim then return pairs(value) end
    local members = {}
    for _, name in ipairs(native.members()) do members[name] = sim[name] end
    for name, member in next, sim do members[name] = member end
    return pairs(members)
end

local function describe(value)
    if type(value) ~= 'table' then return value end
    local out = {}
    for name, member in membersOf(value) do
        if member == false then
            -- taken from clients
        elseif type(member) == 'function' then
            out[name] = {func = {}}
        elseif type(member) ~= 'table' then
            out[name] = {const = member}
        elseif not getmetatable(member) then
            out[name] = describe(member)
        end
    end
    return out
end

function zmqRemoteApi.info(name)
    local ok, value = pcall(lookup, name)
    return ok and describe(value) or nil
end

function sim.setStepping(enable)
    local client = current
    local level = client.level
    client.level = enable and level + 1 or math.max(0, level - 1)
    if level == 0 then client.desiredStep = currentStep end
    return level
end

function sim.acquireLock() current.locks = current.locks + 1 end

function sim.releaseLock() current.locks = math.max(0, current.locks - 1) end

local stopSimulation = sim.stopSimulation

function sim.stopSimulation(...)
    for _, client in ipairs(clients) do
        client.level, client.locks, client.desiredStep = 0, 0, currentStep + 10
    end
    return stopSimulation(...)
end

function sim.setThreadAutomaticSwitch() end

function sim.testCB(a, callback, b, times)
    local result
    for _ = 0, times or 99 do result = callback(a, b) end
    return result
end

---------------------------------------------------------------- the add-on

setAutoYield(false)
if not sim.getBoolProperty(sim.handle_app, 'execUnsafeExt') then require('remote.restrict') end

local function serveIdle()
    local now = sim.getSystemTime()
    forgetExpired(now)
    resumeDue(now)
    serve(0)
    while anyLock() and not native.closed() do serve(0.05) end
end

sysCall_nonSimulation, sysCall_suspended = serveIdle, serveIdle

function sysCall_actuation()
    resumeDue(sim.getSystemTime())
    serve(0)
    while anyHoldsUp() and not native.closed() do
        serve(0.05)
        local now = sim.getSystemTime()
        forgetExpired(now)
        resumeDue(now)
    end
    currentStep = currentStep + 1
end

function sysCall_afterSimulation()
    currentStep = 0
    resumeDue(sim.getSystemTime())
end
