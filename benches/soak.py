"""Friendly and hostile clients for ten minutes: does the memory of the server stay, and are the friendly ones served in time?

    python3 benches/soak.py target/release/swanilda [SECONDS]     # needs pyzmq and cbor2

Of the eight friendly clients two step, the others call functions, are called back, send large arguments, or leave and come back. The hostile
ones send thousands of requests and leave without reading the replies, send garbage, break off in the middle of a frame, stay silent after
the greeting, or use a new identifier for every request. Each line has the seconds that have passed, the requests of the friendly
clients, the longest time a call of `sim.getSimulationTime` took since the line before, and the resident memory of the server.
"""

import json
import pathlib
import random
import socket
import subprocess
import sys
import threading
import time

import cbor2
import zmq

CLIENTS = 8
SAMPLES = 20
CONTEXT = zmq.Context()


class Client:
    def __init__(self, port, name):
        self.port, self.name, self.requests = port, name, 0
        self.connect()

    def connect(self):
        self.socket = CONTEXT.socket(zmq.REQ)
        self.socket.setsockopt(zmq.LINGER, 0)
        self.socket.setsockopt(zmq.RCVTIMEO, 10_000)
        self.socket.connect(f"tcp://127.0.0.1:{self.port}")

    def exchange(self, func, *args):
        self.requests += 1
        request = {"func": func, "args": list(args), "argsL": len(args), "uuid": self.name}
        self.socket.send(cbor2.dumps(request))
        return cbor2.loads(self.socket.recv())

    def call(self, func, *args):
        """Calls a function; callbacks give back their first argument."""
        reply = self.exchange(func, *args)
        while "func" in reply:
            own = reply["func"] not in ("_*wait*_", "_*repeat*_")
            reply = self.exchange("_*executed*_", *(reply["args"][:1] if own else []))
        if "err" in reply:
            raise RuntimeError(reply["err"])
        return reply["ret"]


def step(client):
    client.call("sim.setStepping", True)
    while True:
        client.call("sim.step")
        yield


def read(client):
    global longest
    while True:
        begun = time.monotonic()
        client.call("sim.getSimulationTime")
        longest = max(longest, time.monotonic() - begun)
        yield


def build(client):
    while True:
        dummy = client.call("sim.createDummy", 0.1)[0]
        client.call("sim.setObjectPosition", dummy, [1, 2, 3])
        client.call("sim.writeCustomStringData", dummy, "tag", b"\0" * 100)
        client.call("sim.removeObjects", [dummy])
        yield


def call_back(client):
    while True:
        client.call("sim.testCB", 1, "f@func", 2, 3)
        yield


def send_much(client):
    while True:
        client.call("string.upper", "x" * 100_000)
        yield


def come_and_go(client):
    while True:
        client.call("string.rep", "ab", 2)
        client.socket.close(0)
        client.connect()
        yield


ROLES = [step, step, read, read, build, call_back, send_much, come_and_go]


GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00NULL" + bytes(16) + b"\x00" + bytes(31)
READY = b"\x04\x19\x05READY\x0bSocket-Type\0\0\0\x03REQ"


def flood(port):
    """2000 requests, of which no reply is read."""
    peer = CONTEXT.socket(zmq.DEALER)
    peer.setsockopt(zmq.LINGER, 100)
    peer.connect(f"tcp://127.0.0.1:{port}")
    request = cbor2.dumps({"func": "sim.getObjects", "args": [], "argsL": 0, "uuid": "flood"})
    for _ in range(2000):
        try:
            peer.send_multipart([b"", request], zmq.NOBLOCK)
        except zmq.Again:
            break
    peer.close()


def send_garbage(port):
    with socket.create_connection(("127.0.0.1", port)) as peer:
        peer.sendall(random.randbytes(random.randrange(5000)))


def break_off(port):
    """A message of 1 GB that ends after a few bytes."""
    with socket.create_connection(("127.0.0.1", port)) as peer:
        peer.sendall(GREETING + READY + b"\x02" + (1 << 30).to_bytes(8, "big") + b"begins")


silent = []


def stay_silent(port):
    silent.append(socket.create_connection(("127.0.0.1", port)))
    silent[-1].sendall(GREETING + READY)
    if len(silent) > 200:
        silent.pop(0).close()


def change_names(port):
    client = Client(port, "name")
    for number in range(200):
        client.name = f"name {number} {random.random()}"
        client.call("sim.getSimulationTime")
    client.socket.close(0)


HOSTILE = [flood, send_garbage, break_off, stay_silent, change_names]


def attack(hostile, port, end):
    while time.monotonic() < end:
        try:
            hostile(port)
        except (OSError, zmq.ZMQError):
            pass  # refused: that is what it deserves
        time.sleep(0.05)


longest = 0.0


def work(client, role, end):
    for _ in role(client):
        if time.monotonic() > end:
            break
    client.exchange("_*end*_")


def serve(binary):
    command = [binary, "serve", "--remote-api=0", "--json", "--quiet"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    for line in server.stdout:
        told = json.loads(line)
        if told["type"] == "listening":
            threading.Thread(target=server.stdout.read, daemon=True).start()
            return server, told["port"]
    sys.exit("the server did not start")


def resident(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS"))


def main():
    global longest
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 600
    server, port = serve(sys.argv[1])
    clients = [Client(port, f"soak {number}") for number in range(CLIENTS)]
    begun = time.monotonic()
    clients[0].call("sim.startSimulation")
    end = begun + seconds
    threads = [threading.Thread(target=work, args=(client, role, end)) for client, role in zip(clients, ROLES)]
    threads += [threading.Thread(target=attack, args=(hostile, port, end)) for hostile in HOSTILE]
    for thread in threads:
        thread.start()
    for _ in range(SAMPLES):
        time.sleep(seconds / SAMPLES)
        requests, waited, longest = sum(client.requests for client in clients), 1000 * longest, 0.0
        passed = time.monotonic() - begun
        print(f"{passed:.0f} s, {requests} requests, longest {waited:.0f} ms, {resident(server)} kB", flush=True)
    for thread in threads:
        thread.join()
    if server.poll() is not None:
        sys.exit(f"the server ended with {server.returncode}")
    server.terminate()
    sys.exit(server.wait(10))


main()
