-- The handler of the ZeroMQ remote API without sockets: ask(bytes) gives the answers to a request.

sim = require 'sim'
load = function() return nil, 'no chunks here: they may run for ever' end

local loader, native = package.searchers[2]('remote.zmq')
local pending, answers
local leaves = false
local server = {returns = native.returns, members = native.members}

function server.receive()
    if leaves then
        leaves = false
        return 1
    end
    local request = pending
    pending = nil
    if request then return 1, request end
end

function server.reply(_, bytes) answers[#answers + 1] = bytes end

function server.closed() return pending == nil end -- nobody waits for what will not come

function server.others() return false end

loader('remote.zmq', server)
local serve = sysCall_nonSimulation
sysCall_nonSimulation, sysCall_suspended, sysCall_actuation, sysCall_ext = nil
for _, name in ipairs{'quit', 'exit', 'quitSimulator', 'os', 'io'} do _G[name] = nil end
sim.quitSimulator = false

-- Whatever the request is, there is one answer at most, and it is CBOR.
function ask(bytes)
    pending, answers = bytes, {}
    serve()
    assert(#answers <= 1, 'more than one answer')
    if answers[1] then require('simCBOR').decode(answers[1]) end
    return answers[1]
end

-- The connection ends, with all its clients.
function leave()
    leaves, answers = true, {}
    serve()
end
