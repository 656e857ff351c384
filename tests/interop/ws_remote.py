"""The WebSocket remote API as its specification has it, case by case."""

import json
import math
import random
import sys
import time
import urllib.error
import urllib.request

import cbor2
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from compare import near, same
from simulator import LIMIT, Simulator
from ws_peer import eventually


class Client:
    """One connection; requests are JSON unless they are bytes."""

    def __init__(self, port):
        self.socket = connect(f"ws://127.0.0.1:{port}/any/path", max_size=None)

    def exchange(self, message):
        self.socket.send(message)
        return self.socket.recv(LIMIT)

    def ask(self, **request):
        return json.loads(self.exchange(json.dumps(request)))

    def ask_cbor(self, **request):
        return cbor2.loads(self.exchange(cbor2.dumps(request)))

    def call(self, func, *args):
        reply = self.ask(func=func, args=list(args))
        if not reply["success"]:
            sys.exit(f"{func}: {reply['error']}")
        return reply["ret"]

    def time(self):
        return self.call("sim.getSimulationTime")[0]


def codecs(client):
    request = {"func": "string.rep", "args": ["ab", 2], "id": "7"}
    expected = {"id": "7", "success": True, "ret": ["abab"]}
    reply = client.exchange(json.dumps(request))
    same("JSON", (type(reply), json.loads(reply)), (str, expected))
    reply = client.exchange(cbor2.dumps({**request, "id": 7}))
    same("CBOR", (type(reply), cbor2.loads(reply)), (bytes, {**expected, "id": 7}))
    reply = client.exchange(json.dumps(request).encode())
    same("JSON as bytes", (type(reply), json.loads(reply)), (str, expected))
    # The head of a map is no UTF-8 by itself; with a tag before it, it is.
    reply = client.exchange(bytes.fromhex("c6a162696407").decode())
    same("CBOR as text", (type(reply), cbor2.loads(reply)), (bytes, {"id": 7, "success": True}))
    client.socket.send(b"\xff\xff")
    same("after garbage", client.call("string.rep", "a", 1), ["a"])


def replies(client):
    same("an unknown function", client.ask(func="nope.x"), {"success": False, "error": "No such function: nope.x"})
    same("no path", client.ask(func="math.pi.x")["error"], "No such function: math.pi.x")
    same("no name", client.ask(func="")["error"], "No such function: ")
    same("an expression", client.ask(eval="1+1"), {"success": True, "ret": [2]})
    same("no expression", client.ask(eval="1+")["success"], False)
    same("nothing", client.ask(id=1), {"id": 1, "success": True})
    same("an error", client.ask(func="error", args=["boom", 0]), {"success": False, "error": "boom"})
    same("no result", client.ask(eval="nil"), {"success": True, "ret": []})
    same("no result in CBOR", client.exchange(cbor2.dumps({"eval": "nil"})).endswith(b"\x63ret\xa0"), True)
    same("nil within", client.ask(eval="1, nil, 3, nil")["ret"], [1, None, 3])
    same("nil within, in CBOR", client.ask_cbor(eval="1, nil, 3, nil")["ret"], [1, None, 3])
    same("null within", client.ask(func="select", args=["#", 1, None, 3])["ret"], [3])
    numbers = client.exchange('{"eval": "1, 1.0, 0/0"}')
    same("numbers", '"ret":[1,1.0,null]' in numbers, True)
    kinds = client.exchange('{"func": "math.type", "args": [1.0]}')
    same("a float", json.loads(kinds)["ret"], ["float"])
    for id in (0, -1.5, "", [1, "a"], {"a": {"b": False}}, False):
        same("any id", client.ask(id=id), {"id": id, "success": True})
        same("any id in CBOR", client.ask_cbor(id=id), {"id": id, "success": True})


def unencodable(client):
    for expression in ("print", "{print}", "(function() local t = {} t.t = t return t end)()", "'\\xff'"):
        reply = client.ask(eval=expression, id=3)
        same(expression, (reply["success"], reply["id"], type(reply["error"])), (False, 3, str))
    same("a function in CBOR", client.ask_cbor(eval="print")["success"], False)
    same("bytes in CBOR", client.ask_cbor(eval="'\\xff'")["ret"], [b"\xff"])
    same("an error of bytes", client.ask(func="error", args=["\x7f", 0])["error"], "\x7f")
    same("an error that is no text", client.ask(eval="error({})")["success"], False)


def namespaces(client):
    known = client.call("wsRemoteApi.info", "math")[0]
    near("a constant", known["pi"]["const"], math.pi)
    same("a function", list(known["sin"]), ["func"])
    same("by value", "sin" in client.ask(eval="wsRemoteApi.info(math)")["ret"][0], True)
    same("nothing known", client.call("wsRemoteApi.info", "nope"), [])
    sim = client.call("wsRemoteApi.info", "sim")[0]
    same("sim", (list(sim["getObject"]), sim["handle_scene"]["const"]), (["func"], -12))
    client.call("wsRemoteApi.require", "matrix-2")
    same("the full name", client.ask(eval="_G['matrix-2'] ~= nil")["ret"], [True])
    same("no module", client.ask(func="wsRemoteApi.require", args=["nosuch"])["success"], False)


def stepping(client, other):
    client.call("setStepping", True)
    client.call("sim.startSimulation")
    time.sleep(0.3)
    same("time stands still", client.time(), 0)
    for step in (1, 2, 3):
        client.call("step")
        eventually(lambda: round(client.time(), 9), round(0.05 * step, 9))
    time.sleep(0.1)
    near("no further", other.time(), 0.15)
    client.socket.send(json.dumps({"func": "sim.step", "id": "waits"}))
    same("others are served", other.call("string.rep", "a", 1), ["a"])
    other.call("step")
    same("a request that waits for a step", json.loads(client.socket.recv(LIMIT)), {"id": "waits", "success": True, "ret": []})
    client.call("sim.stopSimulation")
    eventually(lambda: client.call("sim.getSimulationState"), [0])
    client.call("sim.startSimulation")
    eventually(lambda: client.time() > 1, True)
    before = client.time()
    left = client.call("sim.wait", 0.2)[0]
    same("a request that waits", client.time() >= before + 0.2 + left - 1e-9, True)
    client.call("sim.stopSimulation")
    eventually(lambda: client.call("sim.getSimulationState"), [0])


def strangers(port):
    """Pages from elsewhere are refused; those of this machine, and what is no page, are not."""
    for origin in ("http://example.org", "null"):
        try:
            connect(f"ws://127.0.0.1:{port}/", origin=origin)
            same(f"a page of {origin}", "let in", "refused")
        except InvalidStatus as error:
            same(f"a page of {origin}", error.response.status_code, 403)
    connect(f"ws://127.0.0.1:{port}/", origin="http://localhost:8000").close()


def two_clients(a, b):
    for name, client in (("a", a), ("b", b)):
        client.socket.send(json.dumps({"func": "tostring", "args": [name], "id": 1}))
    same("each its own", [json.loads(c.socket.recv(LIMIT))["ret"] for c in (a, b)], [["a"], ["b"]])
    many = [json.dumps({"func": "tostring", "args": [i], "id": i}) for i in range(1000)]
    for request in many:
        a.socket.send(request)
    same("in order", [json.loads(a.socket.recv(LIMIT))["id"] for _ in many], list(range(1000)))


def departures(port, other):
    """Clients that go with a request under way."""
    other.call("setStepping", True)
    other.call("sim.startSimulation")
    for _ in range(20):
        client = Client(port)
        client.socket.send(json.dumps({"func": "sim.wait", "args": [1000]}))
        client.socket.socket.close()
    other.call("setStepping", False)
    eventually(lambda: other.time() > 0.2, True)
    other.call("sim.stopSimulation")


def oversized(port, other):
    client = Client(port)
    client.socket.send(b"{" + bytes(32_000_000))
    try:
        client.socket.recv(LIMIT)
        same("an oversized message", "answered", "refused")
    except Exception as error:
        same("an oversized message", error.rcvd.code, 1009)
    same("a large message", other.call("string.len", "x" * 30_000_000), [30_000_000])


def garbage(client):
    """Requests with bytes changed or missing; what is still a request is answered."""
    chance = random.Random(1)
    for good in (b'{"func": "tostring", "args": [1, "a", null], "id": {"a": [1.5, true]}}', cbor2.dumps({"func": "tostring", "args": [1, "a"], "id": 7})):
        for _ in range(500):
            bad = bytearray(good[: chance.randrange(len(good) + 1)])
            for _ in range(chance.randrange(4)):
                if bad:
                    bad[chance.randrange(len(bad))] = chance.randrange(256)
            client.socket.send(bytes(bad))
    client.socket.send(json.dumps({"id": "the end of it"}))
    while client.socket.recv(LIMIT) != '{"id":"the end of it","success":true}':
        pass


def page(port):
    try:
        urllib.request.urlopen(f"http://127.0.0.1:{port}/", None, LIMIT)
        same("a page", "there", "not there")
    except urllib.error.HTTPError as error:
        same("a page", error.status, 404)


def fence():
    """--no-unsafe: no files outside of the scene's folder, no programs, but expressions."""
    with Simulator("--no-remote-api", "--ws-remote-api=0", "--no-unsafe") as sim:
        client = Client(sim.port("WebSocket"))
        same("files", "--allow-read" in client.ask(eval="select(2, io.open('/etc/passwd'))")["ret"][0], True)
        same("programs", "--allow-run" in client.ask(func="os.execute", args=["true"])["error"], True)
        same("code", client.ask(eval="load('return 3')()")["ret"], [3])
        same("an expression", client.ask(eval="1 + 1")["ret"], [2])


def main():
    fence()
    with Simulator("--no-remote-api", "--ws-remote-api=0") as sim:
        port = sim.port("WebSocket")
        a, b = Client(port), Client(port)
        codecs(a)
        sim.logged("cannot decode message: no suitable decoder")
        same("the port", a.call("sim.getNamedStringParam", "wsRemoteApi.port"), [str(port)])
        replies(a)
        unencodable(a)
        namespaces(a)
        stepping(a, b)
        two_clients(a, b)
        strangers(port)
        departures(port, b)
        garbage(a)
        oversized(port, b)
        page(port)
        same("still there", b.call("string.rep", "ab", 2), ["abab"])
        same("the end", sim.end(), 143)


main()
