"""Messages per second of simWS, and calls per second of the WebSocket remote API.

    cargo build --release
    python3 benches/web_sockets.py target/release/swanilda

The peer is a bare socket that knows what to expect: it costs next to nothing. Messages go `WINDOW` at a time, or one by one. The peers share
the machine's cores with the simulator.
"""

import json
import pathlib
import socket
import statistics
import subprocess
import sys
import time

SCENE = pathlib.Path(__file__).parents[1] / "scenes/ws_echo.lua"
WINDOW = 256
SECONDS = 2
RUNS = 5
HANDSHAKE = (
    b"GET / HTTP/1.1\r\nHost: h\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n\r\n"
)


def frame(text):
    """A short text as a client sends it, with a mask of zeros."""
    return bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text.encode()


class Peer:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), 10)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.sendall(HANDSHAKE)
        while not self.socket.recv(4096).endswith(b"\r\n\r\n"):
            pass

    def exchange(self, messages, size):
        """Sends something and reads as many bytes."""
        self.socket.sendall(messages)
        while size > 0:
            size -= len(self.socket.recv(min(size, 1 << 16)))

    def rate(self, message, reply, window):
        """Round trips per second, the median of some runs."""
        messages, size = frame(message) * window, (2 + len(reply)) * window
        self.exchange(messages, size)
        return statistics.median(self._run(messages, size) * window for _ in range(RUNS))

    def _run(self, messages, size):
        begun, count = time.perf_counter(), 0
        while (elapsed := time.perf_counter() - begun) < SECONDS:
            self.exchange(messages, size)
            count += 1
        return count / elapsed


class Simulator:
    def __init__(self, *args):
        self.process = subprocess.Popen([sys.argv[1], *args, "--json"], stdout=subprocess.PIPE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def line(self, matches):
        return next(line for line in map(json.loads, self.process.stdout) if matches(line))


def echoes():
    for command, what in (("run", "while it simulates"), ("serve", "while it is idle")):
        with Simulator(command, str(SCENE), "-D", "port=0") as sim:
            told = sim.line(lambda line: line["type"] == "print" and line["text"].startswith("ws:"))
            peer = Peer(int(told["text"].split(":")[2].strip("/")))
            for window in (1, WINDOW):
                print(f"simWS echoes/s {what}, {window} at a time: {peer.rate('hello', 'hello', window):.0f}")


def calls():
    request, reply = '{"id":1,"func":"sim.getSimulationTime"}', '{"id":1,"success":true,"ret":[0.0]}'
    with Simulator("serve", "--no-remote-api", "--ws-remote-api=0") as sim:
        peer = Peer(sim.line(lambda line: line["type"] == "listening")["port"])
        for window in (1, WINDOW):
            print(f"WebSocket remote API calls/s, {window} at a time: {peer.rate(request, reply, window):.0f}")


echoes()
calls()
