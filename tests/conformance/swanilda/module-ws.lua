-- topic: modules
-- as: customization
-- passes: 0
-- loops: 6000
-- note: a WebSocket server and its client in one script: handlers by name and by value, what is wrong, the end
sim = require 'sim'
simWS = require 'simWS'

local function say(...) print((table.concat({...}, ' '):gsub('%x+:simWS', 'N:simWS'))) end

function opened(server, connection) say('server opened', server, connection) end

function received(server, connection, data)
    say('server received', isbuffer(data) and 'a buffer:' or type(data), tostring(data))
    simWS.send(server, connection, data, simWS.opcode.binary)
end

function closed(server, connection)
    say('server closed', select(2, pcall(simWS.send, server, connection, 'x')))
    sim.quitSimulator()
end

local function converse(client, connection)
    say('client opened', client, connection)
    say(select(2, pcall(simWS.send, client, connection, 'x', 3)))
    say(select(2, pcall(simWS.send, client, connection, '\xff')))
    simWS.send(client, connection, 'hello')
end

local function connect()
    local client = simWS.connect(('ws://127.0.0.1:%d/'):format(simWS.getPort(server)))
    simWS.setOpenHandler(client, converse)
    simWS.setMessageHandler(client, function(_, _, data)
        say('client received', tostring(data))
        simWS.disconnect(client)
    end)
end

function sysCall_init()
    for _, call in ipairs{
        function() simWS.start(70000) end,
        function() simWS.send('1:simWS.Server', '2:simWS.Connection', 'x') end,
        function() simWS.connect('wss://localhost:9') end,
        function() simWS.connect('::') end,
        function() simWS.setMessageHandler('x') end,
    } do say(select(2, pcall(call))) end
    server = simWS.start(0)
    simWS.setOpenHandler(server, 'opened')
    simWS.setMessageHandler(server, 'received@lua')
    simWS.setCloseHandler(server, 'closed')
    -- The log of the connection that fails has the time.
    sim.setInt32Param(sim.intparam_verbosity, sim.verbosity_errors)
    local nobody = simWS.connect('ws://127.0.0.1:1/')
    simWS.setFailHandler(nobody, function(client, connection)
        say('client failed', client, connection)
        connect()
    end)
end

local socket = require 'socket'
-- What comes from the network has half a minute: who receives the last of it ends the run.
function sysCall_nonSimulation() socket.sleep(0.005) end
