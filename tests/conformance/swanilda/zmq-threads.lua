-- topic: simZMQ
-- as: simulation
-- passes: 40
-- spec: simzmq 3, simzmq 8
-- note: who waits in a thread lets the simulation go on; messages between threads and scripts
sim = require 'sim'
local z = require 'simZMQ'
local sleep = require('socket').sleep
local shared = z.ctx_singleton()

-- What the threads say, in their order: which of two waits ends first depends on the clock.
local lines = {}
local finished = 0

local function thread(name, f)
    local own = {}
    lines[#lines + 1] = own
    local function say(...)
        local words = table.pack(...)
        for i = 1, words.n do words[i] = tostring(words[i]) end
        own[#own + 1] = name .. ': ' .. table.concat(words, ', ')
    end
    local t = coroutine.create(function()
        sim.setStepping(true)
        f(say)
        say('done')
        finished = finished + 1
    end)
    return function()
        if coroutine.status(t) == 'dead' then return end
        local ok, message = coroutine.resume(t)
        if not ok then say(message) end
    end
end

local waiting = true
local threads = {
    thread('server', function(say)
        local rep = z.socket(shared, z.REP)
        z.bind(rep, 'inproc://sum')
        for _ = 1, 3 do
            local _, request = z.recv(rep, 0)
            z.send(rep, 'got ' .. tostring(request), 0)
        end
        waiting = false
        z.close(rep)
    end),
    thread('client', function(say)
        local req = z.socket(shared, z.REQ)
        z.connect(req, 'inproc://sum')
        for i = 1, 3 do
            local before = sim.getSimulationTime()
            sim.wait(0.1)
            say(z.send(req, 'request ' .. i, 0))
            local _, reply = z.recv(req, 0)
            say(tostring(reply), sim.getSimulationTime() - before > 0.09)
        end
        z.close(req)
    end),
    thread('poller', function(say)
        local pull = z.socket(shared, z.PULL)
        z.bind(pull, 'inproc://nothing')
        local count, ready = z.poll({pull}, {z.POLLIN}, 1)
        say('poll', count, ready[1])
        z.setsockopt(pull, z.RCVTIMEO, sim.packInt32Table{1})
        say('with a limit', z.__recv(pull, 0), z.errnum() == z.EAGAIN)
        z.close(pull)
        local own = z.ctx_new()
        local push = z.socket(own, z.PUSH)
        closing = push
        say('end', z.ctx_term(own) == 0)
    end),
    thread('closer', function(say)
        while not closing do sim.step() end
        say(z.close(closing))
    end),
    thread('forever', function() z.recv(z.socket(shared, z.PULL), 0) end),
    thread('and ever', function() z.poll({z.socket(shared, z.PULL)}, {z.POLLIN}, -1) end),
}

-- A pass takes longer than the limits of the waits above. Only a machine with other things to do comes to the long ones.
local passes = 0
local function pass()
    passes = passes + 1
    if finished < 4 then sleep(passes < 25 and 0.002 or 0.5) end
end

function sysCall_actuation()
    pass()
    for _, resume in ipairs(threads) do resume() end
end

function sysCall_cleanup()
    for i = 1, #lines - 2 do print(table.concat(lines[i], '\n')) end
    print('time has passed', sim.getSimulationTime() > 1, waiting)
end
