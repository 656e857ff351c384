"""The ZeroMQ remote API byte by byte, where the protocol promises bytes."""

import threading
import time

import cbor2

from compare import near, same
from raw import WAIT, Peer

VERSION = "The client ZeroMQ remote API version does not match CoppeliaSim's version"

DEFINITIONS = r"""
function nothing() end
function nilOnly() return nil end
function one() return 1.0 end
function empty() return {} end
function holes() return {1, nil, 3} end
function boom() error('a\nb\tc', 0) end
function unencodable() return print end
function types(...)
    local words = {}
    for i = 1, select('#', ...) do
        local value = select(i, ...)
        words[i] = isbuffer(value) and 'buffer' or math.type(value) or type(value)
    end
    return #words, table.concat(words, ' ')
end
"""


def requests(a):
    same("a call", a.call("string.rep", "ab", 2), {"ret": ["abab"]})
    same("an unknown function", a.call("sim.nosuch"), {"err": "No such function: sim.nosuch"})
    same("no identity", Peer(None).ask(func="string.rep", args=["a", 1]), {"success": False, "error": VERSION})
    same("a chunk", a.ask(eval='return 1+1, "x"'), {"ret": [2, "x"]})
    same("no chunk", list(a.ask(eval="1+1")), ["err"])
    same("an empty request", a.bytes().hex(), "a0")
    same("an end", a.bytes(func="_*end*_", args=[]).hex(), "a0")
    a.ask(eval=DEFINITIONS)


def values(a):
    same("no result", a.bytes(func="nothing", args=[]).hex(), "a163726574a0")
    same("nil", a.bytes(func="nilOnly", args=[]).hex(), "a16372657481f6")
    same("a float", a.bytes(func="one", args=[]).hex(), "a16372657481f93c00")
    same("an empty table", a.bytes(func="empty", args=[]).hex(), "a16372657481a0")
    same("a declared empty table", a.call("sim.getObjectSel"), {"ret": [[]]})
    same("a table with a hole", a.call("holes")["ret"][0][0], 1)
    same("an error", a.call("boom"), {"err": "a_=NL=_b_=TB=_c"})
    same("a function as result", list(a.call("unencodable")), ["err"])
    args = [None, 1, 1.0, "a", b"b", [], {}, [1, None, 3], True, None]
    words = "nil integer float string buffer table table table boolean nil"
    same("arguments", a.ask(func="types", args=args, argsL=10), {"ret": [10, words]})
    same("the word for nil", a.ask(func="types", args=[1, "_*NIL*_", 2]), {"ret": [3, "integer nil integer"]})


def namespaces(a):
    same("a constant", a.ask(func="zmqRemoteApi.info", args=["_VERSION"]), {"ret": ["Lua 5.4"]})
    same("nothing known", a.bytes(func="zmqRemoteApi.info", args=["nope"]).hex(), "a16372657481f6")
    same("no module", list(a.ask(func="zmqRemoteApi.require", args=["nosuchmodule"])), ["err"])
    known = a.ask(func="zmqRemoteApi.info", args=["sim"])["ret"][0]
    same("a function of sim", known["getObject"], {"func": {}})
    same("a constant of sim", known["handle_scene"], {"const": -12})


def callbacks(a):
    same("a callback", a.ask(func="sim.testCB", args=[1, "f@func", 2, 1]), {"func": "f", "args": [1, 2]})
    same("a call in between", a.call("string.rep", "ab", 2), {"ret": ["abab"]})
    same("the next callback", a.executed(7), {"func": "f", "args": [1, 2]})
    same("its result", a.executed(8), {"ret": [8]})
    same("one more", a.ask(func="sim.testCB", args=[1, "f@func", 2, 0]), {"func": "f", "args": [1, 2]})
    same("several results", a.executed(7, "x", None), {"ret": [7, "x", None]})
    a.ask(func="sim.testCB", args=[1, "f@func", 2, 0])
    same("no result", a.executed(), {"ret": {}})
    same("nothing pending", a.executed(), {"err": "No such function: _*executed*_"})
    same("a step of nothing", a.ask(func="sim.step", args=[]), {"func": WAIT, "args": {}})
    same("its end", a.executed(), {"ret": {}})


def stepping(a, b):
    same("the level before", a.call("sim.setStepping", True), {"ret": [0]})
    a.call("sim.startSimulation")
    time.sleep(0.1)
    near("no time passes", a.time(), 0)
    for step in (1, 2, 3):
        same("a step", a.call("sim.step"), {"ret": {}})
        near("one step", a.time(), 0.05 * step)
    levels = [b.call("sim.setStepping", enable)["ret"][0] for enable in (True, True, False)]
    same("levels", levels, [0, 1, 2])
    done = []
    thread = threading.Thread(target=lambda: done.append(a.call("sim.step")))
    thread.start()
    time.sleep(0.7)
    same("one of two is not enough", done, [])
    near("time stands still", b.time(), 0.15)
    b.call("sim.step")
    thread.join(10)
    same("both have stepped", done, [{"ret": {}}])
    near("one step for both", b.time(), 0.2)


def departures(a, b):
    a.vanish()
    same("a step after the other has gone", b.call("sim.step"), {"ret": {}})
    b.call("sim.stopSimulation")
    while b.call("sim.getSimulationState")["ret"][0] != 0:
        time.sleep(0.01)


def garbage():
    for request in (b"", b"\xff\xff", b"\x9b\xff\xff\xff\xff\xff\xff\xff\xff", b"\x01", bytes(1 << 20)):
        same("garbage", cbor2.loads(Peer("g").exchange(request))["success"], False)


def main():
    a, b = Peer("a"), Peer("b")
    requests(a)
    values(a)
    namespaces(a)
    callbacks(a)
    stepping(a, b)
    departures(a, b)
    garbage()
    same("still there", b.call("string.rep", "ab", 2), {"ret": ["abab"]})


main()
