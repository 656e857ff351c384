"""Faults of the link between the ZeroMQ remote API and its clients, which link_faults.lua begins and ends, as the clients notice them."""

import sys
import time
from contextlib import contextmanager
from pathlib import Path

from raw import Peer

FOLDER = Path(sys.argv[2])
LIMIT = 30  # seconds
SILENCE = 300  # milliseconds after which no answer is expected any more


def until(condition):
    end = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < end, "it takes too long"
        time.sleep(0.005)


@contextmanager
def fault(words):
    """That fault occurs meanwhile. Nothing is noted before."""
    control = Peer("control")
    control.call("clear")
    request = FOLDER / "request"
    request.write_text(words)
    request.rename(FOLDER / "fault")
    until((FOLDER / "active").exists)
    yield
    (FOLDER / "fault").unlink()
    until(lambda: not (FOLDER / "active").exists())


def noted():
    return Peer("control").call("note", "")["ret"][0]


def send(peer, letter):
    peer.send(func="note", args=[letter], argsL=1)


def is_silent(peer):
    return peer.socket.poll(SILENCE) == 0


def reply(peer):
    return peer.listen()["ret"]


control = Peer("control")
control.ask(eval="noted = '' function note(letter) noted = noted .. letter return noted end function clear() noted = '' end")
control.call("sim.startSimulation")

a, b = Peer("a"), Peer("b")
with fault("loseRequests"):
    send(a, "a")
    assert is_silent(a)
assert noted() == "", "a request that is lost is not served"

with fault("loseReplies 1"):
    send(b, "b")
    assert is_silent(b)
assert noted() == "b", "it is served, but its client does not learn of it"
a, b = Peer("a"), Peer("b")

with fault("doubleRequests"):
    send(a, "a")
    assert reply(a) == ["a"]
assert noted() == "aa"
send(a, "b")
assert reply(a) == ["aab"], "nothing is left of the second reply"

with fault("reorderRequests"):
    send(a, "a")
    assert is_silent(a)
    send(b, "b")
    assert sorted([reply(b), reply(a)]) == [["b"], ["ba"]]

with fault("delayRequests 0.25"):
    begun = time.monotonic()
    send(a, "a")
    assert reply(a) == ["a"]
    assert time.monotonic() - begun >= 0.25

with fault("vanish"):
    send(a, "a")
    assert is_silent(a)
    c = Peer("c")
    send(c, "c")
    assert reply(c) == ["c"], "who comes later is served"
assert noted() == "c"
send(b, "b")
assert reply(b) == ["cb"], "afterwards all are"
