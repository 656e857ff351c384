"""The server starts anew while clients wait, and the whole program at the same port. Arguments: port, path of swanilda."""

import json
import socket
import subprocess
import sys
import threading
import time

from compare import same
from raw import PORT, Peer

AGAIN = "the remote API server has ended or is starting anew."


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def serve(port):
    """Another program."""
    command = [sys.argv[2], "serve", f"--remote-api={port}", "--json", "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    for line in process.stdout:
        if json.loads(line)["type"] == "listening":
            return process
    sys.exit("the server did not start")


def end(process):
    process.kill()
    process.wait()


def the_server(a, b):
    """sim.restartServer: a new Lua state behind the same connections."""
    for peer in (a, b):
        peer.call("sim.setStepping", True)
    a.call("sim.startSimulation")
    a.ask(eval="defined = 1")
    replies = []
    waiting = threading.Thread(target=lambda: replies.append(a.call("sim.step")))
    waiting.start()
    time.sleep(0.3)  # until it waits
    same("the request itself", b.call("sim.restartServer"), {"ret": {}})
    waiting.join(10)
    same("who waited is told", replies, [{"err": AGAIN}])
    same("a new state", a.ask(eval="return defined"), {"ret": [None]})
    same("nobody steps any more", a.call("sim.setStepping", True), {"ret": [0]})
    a.call("sim.stopSimulation", True)


def the_program():
    """A new program at a port whose clients are still there."""
    port = free_port()
    first = serve(port)
    client = Peer("constant", port)
    same("the first", client.call("string.rep", "a", 2), {"ret": ["aa"]})
    end(first)
    second = serve(port)
    same("the second, by the same socket", client.call("string.rep", "b", 2), {"ret": ["bb"]})
    end(second)
    client.send(func="string.rep", args=["early", 1])
    third = serve(port)
    same("asked before it was there", client.listen(), {"ret": ["early"]})
    third.terminate()
    same("its end", third.wait(10), 143)


def main():
    a, b = Peer("a"), Peer("b")
    the_server(a, b)
    the_program()


main()
