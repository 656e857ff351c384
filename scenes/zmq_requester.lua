-- Hello world by ZeroMQ: this scene asks, another program answers.
--
--     swanilda run scenes/zmq_responder.lua          # in one terminal
--     swanilda run scenes/zmq_requester.lua          # in another
--
-- The answer may come from anywhere. In Python:
--
--     import zmq
--     socket = zmq.Context().socket(zmq.REP)
--     socket.bind('tcp://127.0.0.1:5555')
--     while True:
--         print(socket.recv())
--         socket.send(b'World')
--
-- Another address: -D endpoint=tcp://192.168.0.7:5555

sim = require 'sim'
simZMQ = require 'simZMQ'

local REQUESTS = 10

-- In a thread: who waits for the answer does not hold up the simulation.
function sysCall_thread()
    simZMQ.__raiseErrors(true)
    local endpoint = sim.getNamedStringParam('endpoint') or 'tcp://127.0.0.1:5555'
    local context = simZMQ.ctx_new()
    local socket = simZMQ.socket(context, simZMQ.REQ)
    -- Connecting never waits; whoever is to answer may start later.
    simZMQ.connect(socket, endpoint)
    for i = 1, REQUESTS do
        simZMQ.send(socket, 'Hello ' .. i, 0)
        local _, answer = simZMQ.recv(socket, 0)
        print(string.format('t = %.2f s   request %d: %s', sim.getSimulationTime(), i, answer))
    end
    simZMQ.close(socket)
    simZMQ.ctx_term(context)
    sim.stopSimulation()
end
