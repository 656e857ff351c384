"""Who waits for whom: clients that step, that do not, and locks."""

import threading
import time

from compare import near, same
from raw import WAIT, Peer


def start(peer):
    peer.call("sim.startSimulation")
    deadline = time.monotonic() + 10
    while peer.call("sim.getSimulationState")["ret"][0] == 0 and time.monotonic() < deadline:
        pass


def lock_step(peers, steps):
    """Two clients that step see the same times."""
    times = {}

    def work(peer):
        seen = []
        for _ in range(steps):
            peer.call("sim.step")
            seen.append(peer.time())
        times[peer.uuid] = seen

    threads = [threading.Thread(target=work, args=(peer,)) for peer in peers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(15)
    first, second = (times[peer.uuid] for peer in peers)
    same("both have stepped", (len(first), len(second)), (steps, steps))
    same("in lock step", first, second)
    for index, seen in enumerate(first):
        near("a step at a time", seen, first[0] + 0.05 * index)


def step_before_the_start(peer, other):
    """A step that waits when another client starts the simulation is the first of that run."""
    same("told to wait", peer.ask(func="sim.step"), {"func": WAIT, "args": {}})
    start(other)
    reply = peer.executed()
    while reply.get("func") == WAIT:
        reply = peer.executed()
    same("the step", reply, {"ret": {}})
    near("its time", peer.time(), 0.05)
    other.call("sim.stopSimulation", True)


def waiting(peer):
    """Functions that wait block their client only."""
    before = peer.time()
    left = peer.call("sim.wait", 0.5)["ret"][0]
    near("sim.wait", peer.time(), before + 0.5 + left)
    same("a chunk that steps", peer.call("sim.yield"), {"ret": {}})
    reply = peer.ask(eval="local t = sim.getSimulationTime() for _ = 1, 3 do sim.step() end return sim.getSimulationTime() - t")
    while reply.get("func") == WAIT:
        reply = peer.executed()
    near("three steps in a chunk", reply["ret"][0], 0.15)


def callbacks_hold_up(peer, other):
    """The simulation does not advance while a callback of a client that does not step is pending."""
    same("a callback", peer.ask(func="sim.testCB", args=[1, "f@func", 2, 0]), {"func": "f", "args": [1, 2]})
    before = other.time()
    time.sleep(0.3)
    near("no time passes", other.time(), before)
    same("the other is answered", other.call("string.rep", "ab", 2), {"ret": ["abab"]})
    same("the end", peer.executed(5), {"ret": [5]})
    time.sleep(0.1)
    same("time passes", other.time() > before, True)


def locks(peer, other):
    peer.call("sim.acquireLock")
    before = other.time()
    time.sleep(0.1)
    near("a lock stops the time", other.time(), before)
    peer.call("sim.releaseLock")
    time.sleep(0.1)
    same("its release lets it go on", other.time() > before, True)


def not_stepping(peer):
    """A client that does not step has a time slice of every step it speaks in: it can keep up."""
    before = peer.time()
    for _ in range(20):
        peer.call("string.rep", "a", 1)
    same("not many steps pass meanwhile", peer.time() - before < 20 * 0.05 * 20, True)
    peer.call("sim.setThreadSwitchTiming", 5)
    before = peer.time()
    peer.call("sim.step")
    same("a step without stepping mode", peer.time() > before, True)


def main():
    a, b = Peer("a"), Peer("b")
    a.call("sim.setStepping", True)
    step_before_the_start(a, b)
    for peer in (a, b):
        peer.call("sim.setStepping", True)
    start(a)
    near("no time passes", a.time(), 0)
    lock_step((a, b), 50)
    b.call("sim.setStepping", False)
    same("only one steps now", a.call("sim.step"), {"ret": {}})
    waiting(a)
    b.call("sim.setStepping", True)
    a.call("sim.stopSimulation", True)
    same("the end, although both step", b.call("sim.getSimulationState"), {"ret": [0]})
    start(a)
    callbacks_hold_up(a, b)
    locks(a, b)
    not_stepping(a)
    a.call("sim.stopSimulation", True)
    same("the end", b.call("sim.getSimulationState"), {"ret": [0]})


main()
