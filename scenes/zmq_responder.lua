-- Hello world by ZeroMQ: this scene answers what others ask, until ctrl-c.
--
--     swanilda run scenes/zmq_responder.lua
--
-- Ask it with scenes/zmq_requester.lua, or from Python:
--
--     import zmq
--     socket = zmq.Context().socket(zmq.REQ)
--     socket.connect('tcp://127.0.0.1:5555')
--     socket.send(b'Hello')
--     print(socket.recv())
--
-- Another address: -D endpoint=tcp://127.0.0.1:6666

sim = require 'sim'
simZMQ = require 'simZMQ'

function sysCall_thread()
    simZMQ.__raiseErrors(true)
    local context = simZMQ.ctx_new()
    local socket = simZMQ.socket(context, simZMQ.REP)
    simZMQ.bind(socket, sim.getNamedStringParam('endpoint') or 'tcp://127.0.0.1:5555')
    local _, endpoint = simZMQ.getsockopt(socket, simZMQ.LAST_ENDPOINT, 256)
    print('answering at ' .. endpoint:gsub('%z', ''))
    while true do
        local _, request = simZMQ.recv(socket, 0)
        print('asked: ' .. request)
        simZMQ.send(socket, 'World', 0)
    end
end
