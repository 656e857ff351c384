--[[
The WebSocket remote API: lets external programs and web pages call functions of this Lua state.

Loaded as an add-on. A message is a request, {func, args, id} or {eval, id}; the reply is {id, success, ret} or {id, success,
error}, in the encoding of the request: JSON as text, CBOR as binary. All clients share the state. Each request runs in a coroutine of its
own, so that it may wait for a step (sim.wait) while others are served.

    wsRemoteApi.require(name), wsRemoteApi.info(nameOrTable)
    setStepping(enable)    the simulation advances only by
    step()                 one step; the reply is immediate

Parameters (sim.setNamedStringParam, -D): wsRemoteApi.port, wsRemoteApi.autoStart, and wsRemoteApi.verbose, with which requests are logged
(1: their names, 2: in full).
]]

local _, native = ...
local sim = require('sim')
local simWS = require('simWS')
local codecs = require('remote.ws_codecs')
local link = require('remote.link')
local namespaces = require('remote.namespaces')
local load = load -- for expressions of clients, whatever one of them puts in its place
local pack, unpack = table.pack, table.unpack

local MAX_WAITING <const> = 10000 -- requests
local MAX_ARGUMENTS <const> = 100000
local ADVANCING <const> = sim.simulation_advancing

local waiting = {} -- requests that wait for a step, in the order they came
local currentStep = 0
local stepping, go = false, false
local verbose = math.tointeger(tonumber(sim.getNamedStringParam('wsRemoteApi.verbose'))) or 0

local function log(level, ...) sim.addLog(level, string.format(...)) end

local function isRunning() return sim.getSimulationState() & ADVANCING ~= 0 end

---------------------------------------------------------------- requests

-- JSON and CBOR tell a list with null in it by its largest index only.
local function countArguments(args)
    local n = 0
    for key in pairs(args) do
        if math.type(key) == 'integer' and key > n then n = key end
    end
    if n > MAX_ARGUMENTS then error('too many arguments', 0) end
    return n
end

local function find(path)
    local ok, value = pcall(namespaces.find, path)
    return ok and path ~= '' and value or nil
end

local function call(request)
    local func = find(request.func) or error('No such function: ' .. request.func, 0)
    local args = type(request.args) == 'table' and request.args or {}
    return pack(func(unpack(args, 1, countArguments(args))))
end

-- The results; nothing when nothing was asked for.
local function perform(request)
    if type(request.func) == 'string' then return call(request) end
    if request.func ~= nil then error('No such function: ' .. tostring(request.func), 0) end
    if request.eval ~= nil then return pack(assert(load('return ' .. tostring(request.eval), nil, 't'))()) end
end

local function reply(task, ok, outcome)
    if not link.delivers(task.connection) then return end
    local bytes = codecs.reply(task.codec, task.request.id, ok, outcome)
    local sent, reason = pcall(simWS.send, task.server, task.connection, bytes, task.codec.opcode)
    if not sent then log(sim.verbosity_scripterrors, 'cannot reply to %s: %s', task.connection, tostring(reason)) end
end

-- Goes on with a request until it ends or waits for a step.
local function run(task, ...)
    local ok, outcome = coroutine.resume(task.coroutine, ...)
    if coroutine.status(task.coroutine) == 'dead' then return reply(task, ok, outcome) end
    if #waiting >= MAX_WAITING then return reply(task, false, 'too many requests are waiting') end
    task.step = currentStep
    waiting[#waiting + 1] = task
end

-- Requests whose step is over go on.
local function resumeDue()
    link.serveLate()
    if #waiting == 0 then return end
    local before, running = waiting, isRunning()
    waiting = {}
    for _, task in ipairs(before) do
        if running and task.step == currentStep then waiting[#waiting + 1] = task else run(task) end
    end
end

---------------------------------------------------------------- connections

local function logRequest(connection, request)
    local text = verbose > 1 and getAsString(request) or tostring(request.func or request.eval)
    log(sim.verbosity_scriptinfos, 'request from %s: %s', connection, text)
end

local function onMessage(server, connection, data)
    local request, codec = codecs.decode(tostring(data))
    if not request then
        return log(sim.verbosity_scripterrors, 'cannot decode message: no suitable decoder')
    end
    if verbose > 0 then logRequest(connection, request) end
    local function serve(peer)
        local task = {server = server, connection = peer, request = request, codec = codec}
        task.coroutine = coroutine.create(perform)
        run(task, request)
    end
    link.request(serve, connection)
end

local function onClose(_, connection)
    link.forget(connection)
    for i = #waiting, 1, -1 do
        if waiting[i].connection == connection then table.remove(waiting, i) end
    end
end

---------------------------------------------------------------- functions for clients

wsRemoteApi = {}

function wsRemoteApi.require(name) _G[name] = require(name) end

function wsRemoteApi.info(what)
    local value = what
    if type(what) == 'string' then value = find(what) end
    return namespaces.describe(value, native.members, true)
end

function setStepping(enable) stepping, go = enable, false end

function step() go = true end

---------------------------------------------------------------- the add-on

setAutoYield(false)

function sysCall_init()
    sim.setBoolProperty(sim.handle_self, 'restartOnError', true)
    local port = sim.getNamedStringParam('wsRemoteApi.port') or '?'
    log(sim.verbosity_scriptinfos, 'WebSocket Remote API server starting (port=%s)...', port)
    local server = native.start()
    simWS.setMessageHandler(server, onMessage)
    simWS.setCloseHandler(server, onClose)
end

sysCall_nonSimulation, sysCall_suspended = resumeDue, resumeDue

function sysCall_beforeMainScript()
    local skip = stepping and not go
    go = false
    return {doNotRunMainScript = skip}
end

function sysCall_actuation()
    currentStep = currentStep + 1
    resumeDue()
end

function sysCall_afterSimulation()
    stepping, go, currentStep = false, false, 0
    resumeDue()
end
