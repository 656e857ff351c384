--[[
The functions and constants of libzmq 4.3.4 without the prefix zmq_.

Failures return -1 and set errnum(). __raiseErrors(true) turns them into errors for the calling script; __noError.name and
__raiseError.name are the two forms of each function. Data may be strings or buffers, results are strings. Options
are bytes: sim.packInt32Table{0} for most.

send, recv, msg_send, msg_recv and poll may block. In a thread the simulation continues meanwhile; elsewhere it is blocked
too, but at most for __timeout seconds (default 60): then send and recv return -1 with EAGAIN, poll 0,
proxies -1, and a warning is logged. Ctrl-c ends a wait with an error. __send, __recv, __msg_send and __msg_recv obey the options SNDTIMEO and RCVTIMEO.
ctx_term gives up after two seconds outside of threads, and at once while there are open sockets: -1 with EINTR; call it again.

Several thousand events of a monitor are queued; further ones are dropped, with one warning.

Of drafts of libzmq nothing is built: ctx_set_ext, ctx_get_ext, join, leave, connect_peer, msg_set_routing_id, msg_routing_id,
msg_set_group and msg_group do nothing.
]]

local _, native = ...
local sim = require 'sim'

local simZMQ = {__checkError = {}, __noError = {}, __raiseError = {}, __timeout = 60}
for name, value in pairs(native) do if math.type(value) then simZMQ[name] = value end end
for name, value in pairs(native.errors()) do simZMQ[name] = value end

local DONTWAIT <const>, POLLIN <const>, POLLOUT <const> = simZMQ.DONTWAIT, simZMQ.POLLIN, simZMQ.POLLOUT
local EAGAIN <const>, EINTR <const>, FOREVER <const> = simZMQ.EAGAIN, simZMQ.EINTR, -1
local errnum, pollNow = native.errnum, native.poll

---------------------------------------------------------------- arguments

-- By type: the value as it is passed on, or nil.
local accept = {}

function accept.int(value)
    if math.type(value) == 'integer' then return value end
    if type(value) ~= 'number' then return nil end
    return math.tointeger(value < 0 and math.ceil(value - 0.1) or math.floor(value + 0.1))
end

function accept.string(value)
    if type(value) == 'string' then return value end
    return isbuffer(value) and tostring(value) or nil
end

accept.buffer = accept.string

local function acceptList(value, element)
    if type(value) ~= 'table' or isbuffer(value) then return nil end
    local list = {}
    for i = 1, #value do
        list[i] = element(value[i])
        if list[i] == nil then return nil end
    end
    return list
end

function accept.strings(value) return acceptList(value, accept.string) end
function accept.ints(value) return acceptList(value, accept.int) end

-- 'string socket, int flags, int max_buf_size?' as a list.
local function parse(text)
    local parameters, required = {}, 0
    for kind, name, optional in text:gmatch '(%a+%[?%]?) ([%w_]+)(%??)' do
        kind = kind:gsub('%[%]', 's')
        parameters[#parameters + 1] = {name = name, kind = kind, accept = accept[kind], optional = optional ~= ''}
        if optional == '' then required = #parameters end
    end
    return parameters, required
end

local function accepted(name, i, parameter, value)
    if value == nil and parameter.optional then return nil end
    local result = parameter.accept(value)
    if result ~= nil then return result end
    error(('in simZMQ.%s: read in arg %d (%s): expected %s'):format(name, i, parameter.name, parameter.kind), 4)
end

-- By name: a function that returns its arguments as the parameters require them. It blames who called its caller.
local checks = {}

local function checker(name, text)
    local parameters, required = parse(text)
    local first, second, third, fourth = table.unpack(parameters)
    return function(...)
        local count = select('#', ...)
        if count < required then error(('in simZMQ.%s: not enough arguments'):format(name), 3) end
        if count > #parameters then error(('in simZMQ.%s: too many arguments'):format(name), 3) end
        local a, b, c, d = ...
        if first then a = accepted(name, 1, first, a) end
        if second then b = accepted(name, 2, second, b) end
        if third then c = accepted(name, 3, third, c) end
        if fourth then d = accepted(name, 4, fourth, d) end
        return a, b, c, d
    end
end

local function define(name, perform)
    local check = checks[name]
    simZMQ[name] = function(...) return perform(check(...)) end
end

-- A function that libzmq alone does not have. The reference reads these declarations.
local function declare(declaration, perform)
    local name, parameters = declaration:match 'simZMQ%.([%w_]+)%((.*)%)'
    checks[name] = checker(name, parameters)
    define(name, perform)
end

for name, parameters in pairs(native.parameters()) do
    checks[name] = checker(name, parameters)
    define(name, native[name])
end

---------------------------------------------------------------- waiting

local function canYield()
    if not getYieldAllowed() then return false end
    local _, isMain = coroutine.running()
    return not isMain
end

-- Yields, or waits here for an event, at most that many milliseconds. Raises an error when the program is about to end.
local function pause(sockets, events, milliseconds)
    if canYield() then return sim.yield() end
    -- An error of the sockets is reported by the next call that uses them.
    pollNow(sockets, events, milliseconds)
end

local function clock(milliseconds) return milliseconds >= 0 and sim.getSystemTime() + milliseconds / 1000 or math.huge end

local function milliseconds(deadline)
    if deadline == math.huge then return FOREVER end
    return math.max(0, math.ceil((deadline - sim.getSystemTime()) * 1000))
end

local hasWarned = false

-- How long to wait for what may take `timeout`: a wait that holds the simulation has an end. And whether this is less than was asked.
local function bounded(timeout)
    local most = math.ceil(math.min(simZMQ.__timeout, 1e6) * 1000)
    if (timeout >= 0 and timeout <= most) or canYield() then return timeout, false end
    return most, true
end

local function warn()
    if hasWarned then return end
    hasWarned = true
    sim.addLog(sim.verbosity_scriptwarnings,
        ('simZMQ gave up waiting after %g s: outside of threads the simulation waits too.'):format(simZMQ.__timeout))
end

-- The native function's error, blamed on who called a function of this module.
local function blame(message) error((message:gsub('^%-?%d+: ', '')), 3) end

-- Tries again until there is a result.
local function persist(attempt, socket, event, timeout, ...)
    local sockets, events, deadline, isCut = {socket}, {event}, nil, false
    while true do
        local ok, result, data = pcall(attempt, ...)
        if not ok then blame(result) end
        if result ~= -1 then
            if data == nil then return result end
            return result, data
        end
        if errnum() ~= EAGAIN then return -1, nil end
        if not deadline then
            timeout, isCut = bounded(timeout)
            deadline = clock(timeout)
        end
        local left = milliseconds(deadline)
        if left == 0 then
            if isCut then warn() end
            return -1, nil
        end
        pause(sockets, events, left)
    end
end

local function optionOf(socket, option)
    local result, value = native.getsockopt(socket, option, 4)
    return result == 0 and ('=i4'):unpack(value) or FOREVER
end

-- A function that can wait for `event`, in two forms: for ever, and as long as an option says.
local function defineWaiting(name, socketAt, flagsAt, event, timeout)
    local check, attempt = checks[name], native[name]
    simZMQ[name] = function(...)
        local flags = select(flagsAt, ...)
        if flags & DONTWAIT ~= 0 then return attempt(check(...)) end
        return persist(attempt, (select(socketAt, ...)), event, FOREVER, check(...))
    end
    simZMQ['__' .. name] = function(...)
        local flags = select(flagsAt, check(...))
        if flags & DONTWAIT ~= 0 then return attempt(check(...)) end
        local socket = select(socketAt, ...)
        return persist(attempt, socket, event, optionOf(socket, timeout), check(...))
    end
end

defineWaiting('send', 1, 3, POLLOUT, simZMQ.SNDTIMEO)
defineWaiting('recv', 1, 2, POLLIN, simZMQ.RCVTIMEO)
defineWaiting('msg_send', 2, 3, POLLOUT, simZMQ.SNDTIMEO)
defineWaiting('msg_recv', 2, 3, POLLIN, simZMQ.RCVTIMEO)

---------------------------------------------------------------- other functions

-- How long the end of a context is waited for, milliseconds: in a thread, where it is tried again, and elsewhere.
local THREAD_TIMEOUT <const>, BLOCKING_TIMEOUT <const> = 10, 2000

--- Ends a context. In a thread the simulation goes on meanwhile.
-- @return result 0, or -1: try again with EINTR
declare('int result = simZMQ.ctx_term(string context)', function(context)
    local timeout = THREAD_TIMEOUT
    while true do
        local waits = canYield()
        local ok, result = pcall(native.ctx_term, context, waits and timeout or BLOCKING_TIMEOUT)
        if not ok then blame(result) end
        if result == 0 or errnum() ~= EINTR or not waits then return result end
        sim.yield()
        timeout = 0
    end
end)

--- The value of a socket option that is an integer.
declare('int result, int option_value = simZMQ.getsockopt_int(string socket, int option_name)', function(socket, option)
    local ok, result, value = pcall(native.getsockopt, socket, option, 4)
    if not ok then blame(result) end
    return result, result == 0 and #value == 4 and ('=i4'):unpack(value) or 0
end)

-- In a thread, sockets are looked at once per loop iteration.
local function pollYielding(sockets, events, timeout)
    local deadline = clock(timeout)
    while true do
        local ok, result, revents = pcall(pollNow, sockets, events, 0)
        if not ok then blame(result) end
        if result ~= 0 or sim.getSystemTime() >= deadline then return result, revents end
        sim.yield()
    end
end

local function poll(sockets, events, timeout)
    timeout = timeout or 0
    if #sockets == 0 and timeout < 0 then timeout = 0 end
    if timeout ~= 0 and canYield() then return pollYielding(sockets, events, timeout) end
    local limit, isCut = bounded(timeout)
    local result, revents = pollNow(sockets, events, limit)
    if result == 0 and isCut then warn() end
    return result, revents
end

define('poll', function(sockets, events, timeout)
    if #sockets ~= #events then error("in simZMQ.poll: 'sockets' and 'events' must have the same length", 2) end
    return poll(sockets, events, timeout)
end)

local proxy = require 'simZMQ.proxy' {native = native, poll = poll, pause = pause, msg_send = simZMQ.msg_send}

local function proxyOf(...)
    local sockets, events = {...}, {}
    for i = 1, #sockets do events[i] = 0 end
    -- Nothing is waited for: this finds out whether all are sockets.
    local ok, message = pcall(pollNow, sockets, events, 0)
    if not ok then blame(message) end
    return proxy(...)
end

--- Passes messages between two sockets until the context ends.
-- @param capture gets a copy of every message; an empty handle for none
declare('int result = simZMQ.proxy(string frontend, string backend, string capture)', proxyOf)
--- The same, with a socket that takes PAUSE, RESUME and TERMINATE.
declare('int result = simZMQ.proxy_steerable(string frontend, string backend, string capture, string control)', proxyOf)

-- Without drafts the original's functions of drafts return what nothing leaves behind.
local function nothing() return 0 end

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.ctx_set_ext(string context, int option_name, buffer option_value)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result, buffer data = simZMQ.ctx_get_ext(string context, int option_name)', function() return 0, nil end)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.join(string socket, string group)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.leave(string socket, string group)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.connect_peer(string socket, string addr)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.msg_set_routing_id(string msg, int routing_id)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.msg_routing_id(string msg)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result = simZMQ.msg_set_group(string msg, string group)', nothing)

--- Without effect: drafts of libzmq are not built.
declare('int result, string group = simZMQ.msg_group(string msg)', function() return 0, '' end)

---------------------------------------------------------------- errors instead of results

local function isNotZero(result) return result ~= 0 end
local function isNegative(result) return result < 0 end

local FAILED = {ctx_new = function(context) return context == '' end}
for name in ([[bind close connect ctx_set ctx_shutdown ctx_term disconnect getsockopt msg_close msg_copy msg_gets msg_get msg_init
    msg_init_size msg_move msg_set unbind]]):gmatch '%S+' do FAILED[name] = isNotZero end
for name in ([[ctx_get msg_recv msg_send poll proxy proxy_steerable recv send setsockopt socket_monitor]]):gmatch '%S+' do
    FAILED[name] = isNegative
end

--- Raises the current error (errnum()).
function simZMQ.__raise(level) error(simZMQ.__noError.strerror(errnum()), (level or 1) + 1) end

for name, failed in pairs(FAILED) do
    simZMQ.__checkError[name] = function(result) if failed(result) then simZMQ.__raise(4) end end
end

local function raising(name, plain)
    local check = simZMQ.__checkError[name]
    if not check then return plain end
    local function pass(...)
        check(...)
        return ...
    end
    return function(...) return pass(plain(...)) end
end

for name, member in pairs(simZMQ) do
    if type(member) == 'function' and not name:find '^__' then
        simZMQ.__noError[name], simZMQ.__raiseError[name] = member, raising(name, member)
    end
end

--- Makes the functions of this script raise what they would return as -1, or return it again.
function simZMQ.__raiseErrors(enable)
    for name, member in pairs(enable and simZMQ.__raiseError or simZMQ.__noError) do simZMQ[name] = member end
end

return simZMQ
