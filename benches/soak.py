"""Eight clients for ten minutes: does the memory of the server stay?

    python3 benches/soak.py target/release/swanilda [SECONDS]     # needs pyzmq and cbor2

Two clients step, the others call functions, are called back, send large arguments, or leave and come back. Each line tells the
seconds that have passed, the requests so far, and the resident memory in kB.
"""

import json
import pathlib
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
    while True:
        client.call("sim.getSimulationTime")
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
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 600
    server, port = serve(sys.argv[1])
    clients = [Client(port, f"soak {number}") for number in range(CLIENTS)]
    begun = time.monotonic()
    clients[0].call("sim.startSimulation")
    threads = [
        threading.Thread(target=work, args=(client, role, begun + seconds)) for client, role in zip(clients, ROLES)
    ]
    for thread in threads:
        thread.start()
    for _ in range(SAMPLES):
        time.sleep(seconds / SAMPLES)
        requests = sum(client.requests for client in clients)
        print(f"{time.monotonic() - begun:.0f} s, {requests} requests, {resident(server)} kB", flush=True)
    for thread in threads:
        thread.join()
    server.terminate()
    sys.exit(server.wait(10))


main()
