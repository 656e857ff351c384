"""Callbacks of the ZeroMQ remote API that cross scripts, and those nobody waits for."""

import threading
import time

from compare import same
from raw import REPEAT, Peer

# A script outside of the add-on, which calls functions of the add-on.
SCRIPT = """
sim = require 'sim'
local server = sim.getScript(sim.scripttype_addon, 'ZMQ remote API server')
function poke(name, ...) return sim.callScriptFunction(name, server, ...) end
"""


def add_script(a):
    script = a.call("sim.createScript", 1, SCRIPT, 0, "lua")["ret"][0]
    a.call("sim.initScript", script)
    return script


def poke(peer, script, *args):
    return peer.ask(func="sim.callScriptFunction", args=["poke", script, *args])


def queued(a, b, script):
    """A function the add-on does not have is one of the clients', and answered when they speak next."""
    same("nothing comes back", poke(b, script, "g", 1), {"ret": [None]})
    same("the caller has it with its next request", b.ask(func="string.rep", args=["x", 1]), {"func": "g", "args": [1]})
    same("the request itself follows", b.executed(), {"ret": ["x"]})
    same("so has the other", a.ask(func="string.rep", args=["ab", 2]), {"func": "g", "args": [1]})
    replies = []
    other = threading.Thread(target=lambda: replies.append(b.ask(func="string.rep", args=["c", 2])))
    other.start()
    other.join(5)
    same("others are put off meanwhile", replies, [{"func": REPEAT, "args": {}}])
    same("calls from within are answered", a.call("string.rep", "n", 2), {"ret": ["nn"]})
    same("then the real answer comes", a.executed("ignored"), {"ret": ["abab"]})
    same("and the other's", b.ask(func="string.rep", args=["c", 2]), {"ret": ["cc"]})


def across_scripts(a, b, script):
    """A callback below a call from script to script."""
    a.ask(eval="function twice(f) return f(21) end function keep(f) kept = f end function useKept() return kept(1, 2) end")
    a.ask(func="keep", args=["f@func"])
    same("the callback", poke(a, script, "useKept"), {"func": "f", "args": [1, 2]})
    same("its result went through both", a.executed(9), {"ret": [9]})
    same("inside pcall", a.ask(eval="return pcall(kept, 3)"), {"func": "f", "args": [3]})
    same("its result", a.executed(1, 2), {"ret": [True, 1, 2]})
    same("a failing function of the add-on", poke(a, script, "error", "no"), {"ret": [None]})
    same("does no harm", a.call("string.rep", "ab", 2), {"ret": ["abab"]})


def of_a_silent_client(a, b, script):
    """A callback into a client that is not asking anything just then waits until it does."""
    replies = []
    thread = threading.Thread(target=lambda: replies.append(poke(b, script, "useKept")))
    thread.start()
    time.sleep(0.2)
    same("its next request gets the callback first", a.ask(func="string.rep", args=["z", 1]), {"func": "f", "args": [1, 2]})
    same("then its answer", a.executed(5), {"ret": ["z"]})
    thread.join(10)
    same("the caller has the result", replies, [{"ret": [5]}])


def nested(a):
    """Callbacks inside callbacks."""
    a.ask(eval="function down(n, f) if n == 0 then return 0 end return 1 + f(n - 1, 'f@func') end")
    depth = 20
    reply = a.ask(func="down", args=[depth, "f@func"])
    for left in range(depth - 1, -1, -1):
        same("one level down", reply, {"func": "f", "args": [left, "f@func"]})
        reply = a.ask(func="down", args=[left, "f@func"])
    same("the bottom", reply, {"ret": [0]})
    for level in range(1, depth + 1):
        reply = a.executed(level - 1)
        same("one level up", reply, {"ret": [level]})
    reply = a.ask(func="string.rep", args=["ab", 2])
    same("nothing is left", reply, {"ret": ["abab"]})


def in_tables(a):
    a.ask(eval="function viaTable(t) return t.f(5), t.list end")
    args = [{"f": "g@func", "list": ["no@function"]}]
    same("a callback in a map", a.ask(func="viaTable", args=args), {"func": "g", "args": [5]})
    same("its result", a.executed([1, 2]), {"ret": [[1, 2], ["no@function"]]})
    long = ["x"] * 40 + ["f@func"]
    same("not beyond 16 entries", a.call("table.unpack", long, 41), {"ret": ["f@func"]})
    a.ask(eval="function pass(t) return t.f(t), t, {own = print} end")
    given = {"f": "g@func", "x": 1}
    same("a callback comes back as it was written", a.ask(func="pass", args=[given]), {"func": "g", "args": [given]})
    reply = a.executed(7)
    same("no other function does", "Cannot encode function" in reply.get("err", ""), True)
    a.ask(eval="function pass(t) return t.f(t), t end")
    a.ask(func="pass", args=[given])
    same("also among results", a.executed(7), {"ret": [7, given]})
    motion = {"pos": [0.0], "targetPos": [1.0], "maxVel": [1.0], "maxAccel": [1.0], "maxJerk": [9.0], "callback": "g@func"}
    reply = a.ask(func="sim.moveToConfig", args=[motion])
    same("the motion's data", (reply["func"], reply["args"][0]["callback"]), ("g", "g@func"))
    reply = a.executed(True)
    while reply.get("func") == "_*wait*_":
        reply = a.executed()
    same("its result", reply["ret"][0]["callback"], "g@func")


def endless(a):
    """Requests inside callbacks have an end."""
    for _ in range(500):
        reply = a.ask(func="sim.testCB", args=[1, "f@func", 2, 1])
        if "err" in reply:
            same("the limit", reply, {"err": "too many requests without an answer"})
            break
    else:
        raise SystemExit("there is no limit")
    a.vanish()


def main():
    a, b = Peer("a"), Peer("b")
    script = add_script(a)
    b.call("string.rep", "b", 1)
    queued(a, b, script)
    across_scripts(a, b, script)
    of_a_silent_client(a, b, script)
    nested(a)
    in_tables(a)
    endless(a)
    same("the other is not concerned", b.call("string.rep", "ab", 2), {"ret": ["abab"]})


main()
