"""Clients that are killed in the middle of something hold up nobody."""

import pathlib
import subprocess
import sys
import time

from compare import same
from raw import PORT, Peer

VICTIM = pathlib.Path(__file__).with_name("zmq_victim.py")


class Victim:
    def __init__(self, word):
        self.process = subprocess.Popen([sys.executable, VICTIM, str(PORT), word], stdout=subprocess.PIPE)

    def wait_until_ready(self):
        same("the victim is where it is to be", self.process.stdout.readline(), b"ready\n")

    def kill(self):
        self.process.kill()
        self.process.wait()


def steps_on(peer):
    """The simulation goes on with the one client that is left."""
    before = peer.time()
    same("a step", peer.call("sim.step"), {"ret": {}})
    same("it took place", peer.time() > before, True)


def killed_in(word, peer):
    victim = Victim(word)
    victim.wait_until_ready()
    victim.kill()
    if word == "blocking":
        same("an answer after all", peer.call("string.rep", "ab", 2), {"ret": ["abab"]})
    steps_on(peer)


def killed_in_repeat(peer):
    """Somebody is told to ask again only while a callback of another blocks everything."""
    peer.ask(eval="function blocks(f) return pcall(f) end")
    same("the callback", peer.ask(func="blocks", args=["f@func"]), {"func": "f", "args": {}})
    victim = Victim("repeat")
    victim.wait_until_ready()
    victim.kill()
    same("its result", peer.executed(3), {"ret": [True, 3]})
    steps_on(peer)


def main():
    peer = Peer("survivor")
    peer.call("sim.setStepping", True)
    peer.call("sim.startSimulation")
    for word in ("wait", "executed", "callback", "blocking", "request", "end", "lock"):
        killed_in(word, peer)
    killed_in_repeat(peer)
    peer.call("sim.stopSimulation", True)
    same("the end", peer.call("sim.getSimulationState"), {"ret": [0]})


main()
