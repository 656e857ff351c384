"""The scenes that say hello: each with pyzmq, and both with each other; and the ends of waits."""

import signal
import socket
import tempfile
import time

import zmq
from compare import same
from simulator import LIMIT, Simulator

REQUESTER, RESPONDER = "scenes/zmq_requester.lua", "scenes/zmq_responder.lua"
ANY = "endpoint=tcp://127.0.0.1:*"


def limited(peer):
    peer.setsockopt(zmq.LINGER, 0)
    peer.setsockopt(zmq.RCVTIMEO, LIMIT * 1000)
    return peer


def responder_and_python(context):
    with Simulator("-D", ANY, RESPONDER, command="run") as simulator:
        peer = limited(context.socket(zmq.REQ))
        peer.connect(simulator.printed("answering at "))
        for i in range(3):
            peer.send_string(f"Hello {i}")
            same("an answer", peer.recv(), b"World")
            same("asked", simulator.printed("asked: "), f"Hello {i}")
        peer.close()
        same("SIGTERM", simulator.end(), 143)


def requester_and_python(context):
    peer = limited(context.socket(zmq.REP))
    port = peer.bind_to_random_port("tcp://127.0.0.1")
    with Simulator("-D", f"endpoint=tcp://127.0.0.1:{port}", REQUESTER, command="run") as simulator:
        for i in range(1, 11):
            same("asks", peer.recv_string(), f"Hello {i}")
            peer.send(b"World")
        same("the scene ends by itself", simulator.process.wait(LIMIT), 0)
    peer.close()


def both():
    with Simulator("-D", ANY, RESPONDER, command="run") as responder:
        endpoint = responder.printed("answering at ")
        with Simulator("-D", f"endpoint={endpoint}", REQUESTER, command="run") as requester:
            requester.line(lambda line: "request 10: World" in line.get("text", ""), "the last answer")
            same("the requester ends", requester.process.wait(LIMIT), 0)


def nobody_answers():
    """The peer never comes, or goes in the middle: the scene can be ended."""
    with socket.create_server(("127.0.0.1", 0)) as silent:
        endpoint = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        with Simulator("-D", f"endpoint={endpoint}", REQUESTER, command="run") as simulator:
            time.sleep(0.2)
            same("SIGTERM while it waits in a thread", simulator.end(), 143)


def blocking_outside_of_threads(tmp):
    with open(tmp, "w") as scene:
        scene.write(
            "sim = require 'sim' z = require 'simZMQ'\n"
            "function sysCall_init() print('waiting') local s = z.socket(z.ctx_new(), z.REP)\n"
            "z.bind(s, 'tcp://127.0.0.1:*') z.recv(s, 0) end\n"
        )
    with Simulator(tmp, command="run") as simulator:
        simulator.printed("waiting")
        simulator.process.send_signal(signal.SIGTERM)
        same("SIGTERM ends the wait", simulator.process.wait(LIMIT) in (1, 143), True)


def a_monitor_nobody_reads(tmp):
    """Thousands of events, a second monitor, a close: nothing waits for a reader."""
    with open(tmp, "w") as scene:
        scene.write(
            "sim = require 'sim' z = require 'simZMQ'\n"
            "local s = z.socket(z.ctx_new(), z.REP)\n"
            "z.socket_monitor(s, 'inproc://watch', z.EVENT_ALL) z.bind(s, 'tcp://127.0.0.1:*')\n"
            "local _, e = z.getsockopt(s, z.LAST_ENDPOINT, 256) print(('bound %s'):format(e))\n"
            "local passes = 0\n"
            "function sysCall_nonSimulation() z.recv(s, z.DONTWAIT)\n"
            "passes = passes + 1 if passes % 100 == 0 then print 'alive' end end\n"
        )
    with Simulator("--no-remote-api", "--empty", tmp) as simulator:
        address, port = simulator.printed("bound tcp://").rstrip("\0").split(":")
        for _ in range(5000):
            socket.create_connection((address, int(port)), LIMIT).close()
        simulator.logged("events of a ZeroMQ monitor were lost")
        simulator.printed("alive")
        same("SIGTERM", simulator.end(), 143)


def main():
    context = zmq.Context()
    responder_and_python(context)
    requester_and_python(context)
    both()
    nobody_answers()
    with tempfile.TemporaryDirectory() as folder:
        blocking_outside_of_threads(folder + "/waits.lua")
        a_monitor_nobody_reads(folder + "/monitored.lua")
    context.destroy(0)


main()
