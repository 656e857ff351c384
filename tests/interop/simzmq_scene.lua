-- A socket of each type for simzmq_module.py, each served by a thread of its own. Prints `TYPE endpoint`.

sim = require 'sim'
local z = require 'simZMQ'
local context = z.ctx_new()
local threads = {}

local function endpoint(socket) return (tostring(select(2, z.getsockopt(socket, z.LAST_ENDPOINT, 256))):gsub('%z', '')) end

local function opened(name)
    local socket = z.socket(context, z[name])
    if z.bind(socket, 'tcp://127.0.0.1:*') ~= 0 then error(z.strerror(z.errnum())) end
    return socket
end

local function tell(name, socket) print(name .. ' ' .. endpoint(socket)) end

-- All parts of a message.
local function receive(socket)
    local parts = {}
    repeat
        local result, data = z.recv(socket, 0)
        if result < 0 then error(z.strerror(z.errnum())) end
        parts[#parts + 1] = tostring(data)
    until select(2, z.getsockopt_int(socket, z.RCVMORE)) == 0
    return parts
end

local function send(socket, parts)
    for i, part in ipairs(parts) do
        if z.send(socket, part, i < #parts and z.SNDMORE or 0) < 0 then error(z.strerror(z.errnum())) end
    end
end

local function start(name, f)
    local socket = opened(name)
    tell(name, socket)
    threads[#threads + 1] = coroutine.create(function()
        sim.setStepping(true)
        while true do f(socket) end
    end)
end

local function echo(socket) send(socket, receive(socket)) end

local function printEach(name)
    return function(socket) print(name .. ' got ' .. table.concat(receive(socket), '|')) end
end

function sysCall_init()
    start('REP', echo)
    start('PAIR', echo)
    start('DEALER', echo)
    start('ROUTER', echo) -- the first part says to whom
    start('STREAM', function(socket)
        local parts = receive(socket)
        if parts[2] ~= '' then send(socket, parts) end -- empty ones tell of connections
    end)
    start('PULL', printEach 'PULL')
    start('PUSH', function(socket) send(socket, {'work', ''}) end)
    start('PUB', function(socket)
        send(socket, {'topic', '\0\1'})
        send(socket, {'other', 'x'})
        sim.step()
    end)
    local subscriber = opened 'SUB'
    z.setsockopt(subscriber, z.SUBSCRIBE, 'wanted')
    tell('SUB', subscriber)
    local printSub = printEach 'SUB'
    threads[#threads + 1] = coroutine.create(function() while true do printSub(subscriber) end end)
    start('XPUB', function(socket) send(socket, {receive(socket)[1]:sub(2) .. '!'}) end) -- to whoever subscribes
    start('XSUB', function(socket)
        send(socket, {'\1new'})
        print('XSUB got ' .. table.concat(receive(socket), '|'))
    end)
    start('REQ', function(socket)
        send(socket, {'question', 'of two parts'})
        print('REQ got ' .. table.concat(receive(socket), '|'))
    end)
    local watched = opened 'REP'
    z.socket_monitor(watched, 'inproc://watch', z.EVENT_ACCEPTED | z.EVENT_DISCONNECTED)
    local events = z.socket(context, z.PAIR)
    z.connect(events, 'inproc://watch')
    tell('MONITORED', watched)
    threads[#threads + 1] = coroutine.create(function()
        while true do print(('MONITOR %d'):format((('=I2'):unpack(receive(events)[1])))) end
    end)
    print 'READY'
end

local function resume()
    for i, thread in ipairs(threads) do
        local ok, message = coroutine.resume(thread)
        if not ok then
            print('FAILED ' .. message)
            threads[i] = coroutine.create(function() while true do coroutine.yield() end end)
        end
    end
end

sysCall_nonSimulation, sysCall_actuation = resume, resume

-- A context of its own for each round, none of them closed by the script.
function leave(rounds)
    local own = sim.createScript(sim.scripttype_customization, [[
        sim = require 'sim'
        local z = require 'simZMQ'
        function open()
            local c = z.ctx_new()
            for _, kind in ipairs{z.PUB, z.PUSH, z.ROUTER} do
                local s = z.socket(c, kind)
                z.bind(s, 'tcp://127.0.0.1:*')
                z.connect(z.socket(c, z.DEALER), 'tcp://127.0.0.1:9')
                z.send(s, 'to nobody', z.DONTWAIT)
            end
        end
    ]])
    sim.initScript(own)
    sim.callScriptFunction('open', own)
    sim.removeObjects{own}
end

local command = z.socket(z.ctx_singleton(), z.REP)
z.bind(command, 'tcp://127.0.0.1:*')
tell('COMMAND', command)
threads[#threads + 1] = coroutine.create(function()
    while true do
        for _ = 1, tonumber(receive(command)[1]) do leave() end
        send(command, {'left'})
    end
end)
