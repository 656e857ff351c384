"""A bare REQ socket that speaks the ZeroMQ remote API."""

import sys

import cbor2
import zmq

PORT = int(sys.argv[1])
CONTEXT = zmq.Context()
WAIT = "_*wait*_"
REPEAT = "_*repeat*_"


class Peer:
    """One client; without uuid when that is None."""

    def __init__(self, uuid, port=PORT):
        self.uuid = uuid
        self.socket = CONTEXT.socket(zmq.REQ)
        self.socket.setsockopt(zmq.RCVTIMEO, 10_000)
        self.socket.setsockopt(zmq.LINGER, 0)
        self.socket.connect(f"tcp://127.0.0.1:{port}")

    def bytes(self, **request):
        """The reply as it is."""
        if self.uuid is not None:
            request.setdefault("uuid", self.uuid)
        return self.exchange(cbor2.dumps(request))

    def send(self, **request):
        """Sends a request and does not wait for the reply."""
        self.socket.send(cbor2.dumps({"uuid": self.uuid, **request}))

    def listen(self):
        return cbor2.loads(self.socket.recv())

    def exchange(self, request):
        self.socket.send(request)
        return self.socket.recv()

    def ask(self, **request):
        """The reply decoded."""
        return cbor2.loads(self.bytes(**request))

    def call(self, func, *args):
        """Calls a function, however long it takes."""
        reply = self.ask(func=func, args=list(args), argsL=len(args))
        while reply.get("func") == WAIT:
            reply = self.executed()
        return reply

    def executed(self, *results):
        return self.ask(func="_*executed*_", args=list(results), argsL=len(results))

    def time(self):
        return self.call("sim.getSimulationTime")["ret"][0]

    def vanish(self):
        self.socket.close(0)
