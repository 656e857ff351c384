"""Remote calls beside an echo server in Python, which takes turns with Swanilda: one client, sixteen, and messages of 1 MB.

    python3 -m venv target/venv && target/venv/bin/pip install pyzmq cbor2
    cargo build --release && target/venv/bin/python benches/remote_peers.py [ROUNDS]

SWANILDA names another binary. Both servers get the same requests from the same clients, which send bytes made before and decode nothing. The echo server answers with
what it got; for an image it has an answer of the same length as Swanilda's. Best of ROUNDS.
"""

import multiprocessing
import os
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import cbor2
import zmq

CALLS, CLIENTS, LARGE = 5000, 16, 50
BINARY = os.environ.get("SWANILDA", str(Path(__file__).parent / "../target/release/swanilda"))
ECHO = """
import sys, zmq
server = zmq.Context().socket(zmq.REP)
server.bind(f'tcp://127.0.0.1:{sys.argv[1]}')
image = bytes(int(sys.argv[2]))
while True:
    request = server.recv()
    server.send(image if request == b'image' else request)
"""
SENSOR = """
local sensor = sim.createVisionSensor(1, {577, 577, 0, 0}, {0.1, 10, 1, 0.1, 0, 0, 0, 0, 0, 0, 0})
sim.handleVisionSensor(sensor)
return sensor
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Client:
    """A REQ socket."""

    def __init__(self, port):
        self.socket = zmq.Context.instance().socket(zmq.REQ)
        self.socket.connect(f"tcp://127.0.0.1:{port}")

    def ask(self, request):
        self.socket.send(request)
        return self.socket.recv()


def call(func, *args):
    return cbor2.dumps({"func": func, "args": list(args), "uuid": "1", "ver": 2, "lang": "python"})


def result(reply):
    found = cbor2.loads(reply)
    if "ret" not in found:
        sys.exit(f"the server refuses a request: {found}")
    return found["ret"]


def seconds_of_one(client, request, count):
    begun = time.perf_counter()
    for _ in range(count):
        client.ask(request)
    return (time.perf_counter() - begun) / count


def be_client(port, request, count, barrier):
    """One of many processes."""
    client = Client(port)
    client.ask(request)
    for _ in range(2):
        barrier.wait()
    for _ in range(count):
        client.ask(request)
    barrier.wait()


def seconds_of_many(port, request, count):
    context = multiprocessing.get_context("spawn")
    barrier = context.Barrier(CLIENTS + 1)
    clients = [context.Process(target=be_client, args=(port, request, count // CLIENTS, barrier)) for _ in range(CLIENTS)]
    for client in clients:
        client.start()
    barrier.wait()
    begun = time.perf_counter()
    for _ in range(2):
        barrier.wait()
    seconds = (time.perf_counter() - begun) / count
    for client in clients:
        client.join()
    return seconds


def measured(port, requests):
    """Seconds of each kind of request."""
    client, (small, text, image) = Client(port), requests
    return {
        "a call": seconds_of_one(client, small, CALLS),
        f"a call, {CLIENTS} clients": seconds_of_many(port, small, CALLS),
        "a text of 1 MB as an argument": seconds_of_one(client, text, LARGE),
        "an image of 1 MB": seconds_of_one(client, image, LARGE),
    }


@contextmanager
def running(*command):
    """A process for as long as it is needed."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.kill()
        process.wait()


def main(rounds):
    ours, theirs = free_port(), free_port()
    with running(BINARY, "serve", "--quiet", f"--remote-api={ours}"):
        first = Client(ours)
        result(first.ask(call("zmqRemoteApi.require", "sim")))
        sensor = result(first.ask(cbor2.dumps({"eval": SENSOR, "uuid": "1", "ver": 2, "lang": "python"})))[0]
        requests = (call("sim.getObjectPosition", sensor, -1), call("sim.setStringSignal", "text", "x" * (1 << 20)), call("sim.getVisionSensorImg", sensor))
        answers = [first.ask(request) for request in requests]
        for answer in answers:
            result(answer)
        with running(sys.executable, "-c", ECHO, str(theirs), str(len(answers[2]))):
            peers = {"Swanilda": (ours, requests), "echo": (theirs, (*requests[:2], b"image"))}
            found = {name: [] for name in peers}
            for _ in range(rounds):
                for name, (port, sent) in peers.items():
                    found[name].append(measured(port, sent))
    print("| what | Swanilda, us | echo in Python, us | times as fast |\n|---|---|---|---|")
    for what in found["echo"][0]:
        mine, other = (1e6 * min(one[what] for one in found[name]) for name in ("Swanilda", "echo"))
        print(f"| {what} | {mine:.0f} | {other:.0f} | {other / mine:.2f} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
