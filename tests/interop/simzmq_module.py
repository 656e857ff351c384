"""simZMQ against pyzmq: every type of socket, messages of several parts, peers that go, bytes that are no ZeroMQ."""

import contextlib
import os
import pathlib
import random
import socket
import time

import zmq
from compare import same
from simulator import LIMIT, Simulator

SCENE = str(pathlib.Path(__file__).with_name("simzmq_scene.lua"))


class Peers:
    def __init__(self, simulator):
        self.simulator = simulator
        self.context = zmq.Context()
        self.endpoints = {}
        names = "REP PAIR DEALER ROUTER STREAM PULL PUSH PUB SUB XPUB XSUB REQ MONITORED COMMAND".split()
        for name in names:
            self.endpoints[name] = simulator.printed(name + " ")

    @contextlib.contextmanager
    def connected(self, kind, name, **options):
        peer = self.context.socket(kind)
        peer.setsockopt(zmq.LINGER, 0)
        peer.setsockopt(zmq.RCVTIMEO, LIMIT * 1000)
        peer.setsockopt(zmq.SNDTIMEO, LIMIT * 1000)
        for option, value in options.items():
            peer.setsockopt(getattr(zmq, option), value)
        peer.connect(self.endpoints[name])
        yield peer
        peer.close()


def echoes(peers):
    for kind, name in ((zmq.REQ, "REP"), (zmq.PAIR, "PAIR"), (zmq.REQ, "ROUTER"), (zmq.DEALER, "ROUTER")):
        with peers.connected(kind, name) as peer:
            for message in ([b"one"], [b"", b"\0\xff", b"x" * 100_000], [b""]):
                peer.send_multipart(message)
                same(f"{name} answers", peer.recv_multipart(), message)
    with peers.connected(zmq.ROUTER, "DEALER", PROBE_ROUTER=1) as router:
        # The DEALER echoes the empty message of the probe, which tells its name.
        name, *_ = router.recv_multipart()
        router.send_multipart([name, b"a", b"b"])
        same("DEALER answers", router.recv_multipart(), [name, b"a", b"b"])


def pipelines(peers):
    with peers.connected(zmq.PUSH, "PULL") as peer:
        peer.send_multipart([b"a", b"b"])
        same("PULL", peers.simulator.printed("PULL got "), "a|b")
    with peers.connected(zmq.PULL, "PUSH") as peer:
        same("PUSH", [peer.recv_multipart() for _ in range(3)], [[b"work", b""]] * 3)
    with peers.connected(zmq.REP, "REQ") as peer:
        same("REQ asks", peer.recv_multipart(), [b"question", b"of two parts"])
        peer.send(b"answer")
        same("REQ", peers.simulator.printed("REQ got "), "answer")


def publishers(peers):
    with peers.connected(zmq.SUB, "PUB", SUBSCRIBE=b"topic") as peer:
        same("PUB", [peer.recv_multipart() for _ in range(2)], [[b"topic", b"\0\1"]] * 2)
    with peers.connected(zmq.SUB, "XPUB", SUBSCRIBE=b"mine") as peer:
        same("XPUB", peer.recv(), b"mine!")
    with peers.connected(zmq.XPUB, "SUB") as peer:
        same("SUB subscribes", peer.recv(), b"\1wanted")
        peer.send_multipart([b"unwanted", b"1"])
        peer.send_multipart([b"wanted", b"2"])
        same("SUB", peers.simulator.printed("SUB got "), "wanted|2")
    with peers.connected(zmq.XPUB, "XSUB") as peer:
        # Whoever connects later is told of subscriptions all the same.
        same("XSUB subscribes", peer.recv(), b"\1new")
        peer.send(b"news")
        same("XSUB", peers.simulator.printed("XSUB got "), "news")


def streams(peers):
    address, port = peers.endpoints["STREAM"].removeprefix("tcp://").split(":")
    with socket.create_connection((address, int(port)), LIMIT) as plain:
        plain.sendall(b"no ZeroMQ")
        same("STREAM", plain.recv(100), b"no ZeroMQ")


def monitors(peers):
    with peers.connected(zmq.REQ, "MONITORED"):
        same("accepted", peers.simulator.printed("MONITOR "), str(int(zmq.EVENT_ACCEPTED)))
    same("disconnected", peers.simulator.printed("MONITOR "), str(int(zmq.EVENT_DISCONNECTED)))


def bad_bytes(peers):
    """Peers that speak no ZMTP, or break off: the sockets go on with the others."""
    chance = random.Random(4)
    for name in ("REP", "ROUTER", "PULL", "SUB", "XPUB"):
        address, port = peers.endpoints[name].removeprefix("tcp://").split(":")
        greeting = b"\xff" + bytes(8) + b"\x7f\3\0NULL" + bytes(48)
        for data in (
            b"GET / HTTP/1.1\r\n\r\n",
            b"\xff" * 100,
            greeting[:20],
            greeting + b"\x02\xff\xff\xff\xff\xff\xff\xff\xff" + b"x" * 100,  # a frame of 2^64 bytes
            greeting + b"\x04\xff" + b"x" * 300,
            # libzmq's own REP waits for ever for the rest of what looks like a half message of ZMTP 1.0.
            *([] if name == "REP" else [chance.randbytes(1000)]),
        ):
            with socket.create_connection((address, int(port)), LIMIT) as peer, contextlib.suppress(OSError):
                peer.sendall(data)
    echoes(peers)


def leaks(peers):
    """What scripts and peers leave behind is gone: nothing keeps a file open."""
    with peers.connected(zmq.REQ, "COMMAND") as command:

        def leave(rounds):
            command.send_string(str(rounds))
            same("left", command.recv(), b"left")

        leave(1)
        before = peers.simulator.sockets()
        leave(10)
        for _ in range(20):
            with peers.connected(zmq.DEALER, "ROUTER") as peer:
                peer.send(b"and gone")
        # The last connections may come and go a little later.
        end = time.monotonic() + LIMIT
        while (now := peers.simulator.sockets()) > before and time.monotonic() < end:
            time.sleep(0.05)
        same("no more files are open", now <= before, True)


def main():
    with Simulator("--no-remote-api", "--empty", SCENE) as simulator:
        peers = Peers(simulator)
        for check in (echoes, pipelines, publishers, streams, monitors, bad_bytes):
            check(peers)
        if os.path.isdir("/proc/self/fd"):
            leaks(peers)
        peers.context.destroy(0)
        same("a clean end, with all sockets open", simulator.end(), 143)


main()
