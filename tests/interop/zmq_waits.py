"""The log says whom everything waits for. Arguments: port, path of swanilda."""

import json
import subprocess
import sys
import threading

from compare import same
from raw import Peer

LIMIT = 60  # seconds


class Server:
    """Another program, whose log is read."""

    def __init__(self):
        command = [sys.argv[2], "serve", "--remote-api=0", "--json"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.guard = threading.Timer(LIMIT, self.process.kill)
        self.guard.start()

    def line(self, matches):
        """The next line that is wanted."""
        for text in self.process.stdout:
            line = json.loads(text)
            if matches(line):
                return line
        sys.exit("the server said nothing of the kind")

    def warning(self):
        return self.line(lambda line: line.get("level") == "warning")["text"]

    def end(self):
        self.process.kill()
        self.process.wait()
        self.guard.cancel()


def has(text, *words):
    for word in words:
        same(f"{word} in {text}", word in text, True)


def callback(server, port):
    """A client whose function has raised an error calls something else, or nothing."""
    peer = Peer("erring", port)
    peer.ask(func="sim.startSimulation", lang="python")
    same("called back", peer.ask(func="sim.testCB", args=[1, "bad_7f0123456789@func", 2, 0])["func"], "bad_7f0123456789")
    has(server.warning(), "client erring", "python", "function 'bad'")
    peer.vanish()


def blocking_callback(server, port):
    """The same where nothing can yield."""
    peer = Peer("blocking", port)
    peer.ask(eval="function twice(f) return table.concat{pcall(f)} end", lang="odd\nwords")
    same("called back", peer.ask(func="twice", args=["worse@func"])["func"], "worse")
    text = server.warning()
    has(text, "client blocking (connection", "function 'worse'")
    peer.vanish()


def lock(server, port):
    peer = Peer("locking", port)
    peer.call("sim.acquireLock")
    has(server.warning(), "client locking", "lock")
    peer.call("sim.releaseLock")


def main():
    server = Server()
    port = server.line(lambda line: line["type"] == "listening")["port"]
    try:
        callback(server, port)
        blocking_callback(server, port)
        lock(server, port)
    finally:
        server.end()


main()
