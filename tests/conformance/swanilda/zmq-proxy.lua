-- topic: simZMQ
-- as: simulation
-- passes: 300
-- spec: simzmq 4
-- note: a steered proxy in a thread, and a monitor
sim = require 'sim'
local z = require 'simZMQ'
local sleep = require('socket').sleep
local c = z.ctx_new()
local function socket(kind, how, endpoint)
    local s = z.socket(c, kind)
    if z[how](s, 'inproc://' .. endpoint) ~= 0 then error(z.strerror(z.errnum())) end
    return s
end
local front, back = socket(z.ROUTER, 'bind', 'front'), socket(z.DEALER, 'bind', 'back')
local capture, control = socket(z.PUB, 'bind', 'capture'), socket(z.PAIR, 'bind', 'control')
local client, server = socket(z.REQ, 'connect', 'front'), socket(z.REP, 'connect', 'back')
local listener, steer = socket(z.SUB, 'connect', 'capture'), socket(z.PAIR, 'connect', 'control')
z.setsockopt(listener, z.SUBSCRIBE, '')

local function text(socket) return tostring(select(2, z.recv(socket, 0))) end

local done
local proxy = coroutine.create(function()
    sim.setStepping(true)
    done = z.proxy_steerable(front, back, capture, control)
end)
local user = coroutine.create(function()
    sim.setStepping(true)
    for i = 1, 3 do
        z.send(client, 'request ' .. i, 0)
        local request = text(server)
        z.send(server, request .. ' answered', 0)
        print(text(client))
    end
    z.send(steer, 'STATISTICS', 0)
    for _ = 1, 8 do
        local number = ('=I8'):unpack(text(steer))
        print(number, (select(2, z.getsockopt_int(steer, z.RCVMORE))))
    end
    z.send(steer, 'PAUSE', 0)
    sim.step()
    sim.step()
    z.send(client, 'while paused', 0)
    for _ = 1, 10 do sim.step() end
    print(z.recv(server, z.DONTWAIT), z.errnum() == z.EAGAIN)
    z.send(steer, 'JUMP', 0)
    z.send(steer, 'RESUME', 0)
    print(text(server))
    z.send(steer, 'TERMINATE', 0)
    while not done do sim.step() end
    print('proxy', done)
    local copies = 0
    while z.recv(listener, z.DONTWAIT) >= 0 do copies = copies + 1 end
    print('copies', copies)

    local watched = z.socket(c, z.REP)
    print(z.socket_monitor(watched, 'tcp://127.0.0.1:1', z.EVENT_ALL), z.errnum() == z.EPROTONOSUPPORT)
    print(z.socket_monitor(watched, 'inproc://watch', z.EVENT_ALL))
    local events = socket(z.PAIR, 'connect', 'watch')
    z.bind(watched, 'tcp://127.0.0.1:*')
    local event = text(events)
    local number = ('=I2I4'):unpack(event)
    print(number == z.EVENT_LISTENING, #event, text(events):match '^tcp://127.0.0.1:%d+$' ~= nil)
    z.close(watched)
    local seen = {}
    repeat
        number = ('=I2'):unpack(text(events))
        text(events)
        seen[number] = true
    until number == z.EVENT_MONITOR_STOPPED
    print(seen[z.EVENT_CLOSED])
end)

-- A pass takes its time: connections are made meanwhile. Only a machine with other things to do comes to the long ones.
local passes = 0
local function pass()
    passes = passes + 1
    if coroutine.status(user) ~= 'dead' then sleep(passes < 150 and 0.001 or 0.1) end
end

function sysCall_actuation()
    for _, thread in ipairs{proxy, user} do
        if coroutine.status(thread) ~= 'dead' then
            local ok, message = coroutine.resume(thread)
            if not ok then print(message) end
        end
    end
    pass()
end

function sysCall_cleanup() print(coroutine.status(proxy), coroutine.status(user)) end
