def sysCall_init():
    global sim, simZMQ, simWS
    sim = require('sim')
    simZMQ = require('simZMQ')
    simWS = require('simWS')
    context = simZMQ.ctx_new()
    responder = simZMQ.socket(context, simZMQ.REP)
    simZMQ.bind(responder, 'inproc://python')
    requester = simZMQ.socket(context, simZMQ.REQ)
    simZMQ.connect(requester, 'inproc://python')
    simZMQ.send(requester, b'Hello\0', 0)
    result, data = simZMQ.recv(responder, 0)
    print('request', result, data)
    simZMQ.send(responder, b'World', 0)
    print('reply', simZMQ.recv(requester, 0))
    for socket in (requester, responder):
        simZMQ.close(socket)
    simZMQ.ctx_term(context)
    self.server = simWS.start(0)
    simWS.setOpenHandler(self.server, 'on_open')
    simWS.setMessageHandler(self.server, on_message)
    self.client = simWS.connect('ws://127.0.0.1:%d/' % simWS.getPort(self.server))
    simWS.setOpenHandler(self.client, lambda client, connection: simWS.send(client, connection, 'a word', simWS.opcode.text))


def on_open(server, connection):
    print('open')


def on_message(server, connection, data):
    print('message', data)
    simWS.stop(server)
    sim.quitSimulator()
