"""A client that stops in the middle of a control word, to be killed there."""

import sys
import time

from raw import REPEAT, WAIT, Peer


def stepping(peer):
    peer.call("sim.setStepping", True)
    if peer.call("sim.getSimulationState")["ret"][0] == 0:
        peer.call("sim.startSimulation")


def wait(peer):
    """Has been told to wait, and does not answer."""
    stepping(peer)
    reply = peer.ask(func="sim.step", args=[])  # the other client does not step
    assert reply["func"] == WAIT, reply


def executed(peer):
    """Has answered and waits."""
    wait(peer)
    peer.send(func="_*executed*_", args=[])


def callback(peer):
    """Is inside of a callback."""
    stepping(peer)
    assert peer.ask(func="sim.testCB", args=[1, "f@func", 2])["func"] == "f"


def blocking(peer):
    """Is inside of a callback everything waits for."""
    peer.ask(eval="function victim(f) return pcall(f) end")
    assert peer.ask(func="victim", args=["f@func"])["func"] == "f"


def repeat(peer):
    """Has been told to ask again."""
    reply = peer.ask(func="string.rep", args=["x", 1])
    assert reply["func"] == REPEAT, reply


def request(peer):
    """Has asked for something that lasts."""
    stepping(peer)
    peer.send(func="sim.step", args=[])


def end(peer):
    """Has said goodbye and does not listen."""
    stepping(peer)
    peer.send(func="_*end*_", args=[])


def lock(peer):
    """Holds a lock."""
    peer.call("sim.acquireLock")


globals()[sys.argv[2]](Peer(f"victim {sys.argv[2]}"))
print("ready", flush=True)
time.sleep(60)
