"""simWS as its specification has it, case by case."""

import urllib.error
import urllib.request

import websockets
from websockets.sync.client import connect

from compare import same
from simulator import Simulator
from ws_peer import Control, eventually


def echoes(control):
    port = control.server("simWS.setMessageHandler(S, 'echo')")
    with connect(f"ws://127.0.0.1:{port}") as client:
        client.send("hi")
        same("text", client.recv(10), "hi")
        client.send(b"\x00\x01\xff")
        error = control.sim.logged("External call to simCallScriptFunction failed ('echo')")
        same("an answer that is no text", "invalid payload" in error, True)
        control("simWS.setMessageHandler(S, 'echoBinary@lua')")
        client.send(b"\x00\x01\xff")
        same("bytes", client.recv(10), b"\x00\x01\xff")
        client.ping().wait(10)
        control("simWS.setMessageHandler(S, 'nosuch.function')")
        client.send("x")
        control.sim.logged("('nosuch.function')")
        control("simWS.setMessageHandler(S, echo)")
        client.send(["frag", "ments"])
        same("fragments", client.recv(10), "fragments")


def errors(control):
    control.server("")
    for code, expected in (
        ("simWS.send(S, '1:simWS.Connection', 'x', 3)", "in simWS.send: invalid opcode: 3"),
        ("simWS.send('bad:simWS.Server', 'y', 'x')", "in simWS.send: invalid object handle"),
        ("simWS.send(S, 'y', 'x')", "in simWS.send: invalid object handle"),
        ("simWS.send(S, 'fffff:simWS.Connection', 'x')", "in simWS.send: invalid object handle"),
        ("simWS.stop('1:simWS.Client')", "in simWS.stop: invalid object handle"),
        ("simWS.disconnect(S)", "in simWS.disconnect: invalid object handle"),
        ("simWS.start(-1)", "in simWS.start: invalid port: -1"),
        ("simWS.start(simWS.getPort(S))", "Underlying Transport Error"),
        ("simWS.connect('wss://localhost:9')", "in simWS.connect: Could not create connection"),
        ("simWS.connect('::')", "in simWS.connect: Could not create connection"),
        ("simWS.setMessageHandler(S)", "in simWS.setMessageHandler: the function requires more arguments."),
        ("simWS.setMessageHandler(S, {})", "in simWS.setMessageHandler: argument 2 is not a string"),
        ("simWS.stop(S); simWS.setOpenHandler(S, 'f')", "in simWS.setOpenHandler: invalid object handle"),
    ):
        result = control(code)
        same(code, result.startswith("error: ") and expected in result or result, True)


def handlers(control):
    port = control.server("for _, on in ipairs{'Open', 'Fail', 'Close', 'Message'} do simWS['set'..on..'Handler'](S, note(on)) end")
    with connect(f"ws://127.0.0.1:{port}") as client:
        client.send("hi")
        eventually(lambda: control("return #calls"), "2")
    eventually(lambda: control("return #calls"), "3")
    calls = [call.split() for call in control("return table.concat(calls, '\\n')").split("\n")]
    same("what is called", [call[0] for call in calls], ["Open", "Message", "Close"])
    server, connection = calls[0][1:]
    same("handles", [call[1:3] for call in calls], [[server, connection]] * 3)
    same("their form", [server.split(":")[1], connection.split(":")[1]], ["simWS.Server", "simWS.Connection"])
    same("data", calls[1][3], "hi")
    error = control(f"simWS.send(S, '{connection}', 'x')")
    same("a connection that is gone", "connection_hdl weak_ptr expired" in error, True)


def pages(control):
    port = control.server("simWS.setHTTPHandler(S, function(...) asked = {...}; asked[4] = type(asked[4]) .. tostring(asked[4]); return answer() end)")

    def get(path, answer, body=None):
        control(f"function answer() {answer} end")
        try:
            reply = urllib.request.urlopen(f"http://127.0.0.1:{port}{path}", body, 10)
        except urllib.error.HTTPError as error:
            reply = error
        return reply.status, reply.read(), reply.headers["Content-Type"]

    script = "application/javascript; charset=UTF-8"
    same("a page", get("/a.js?x=1", "return 200, '1'"), (200, b"1", script))
    same("what was asked for", control("return asked[3] .. ' ' .. asked[4]"), "/a.js?x=1 table")
    same("a body", get("/", "return 200, asked[4]", b"x" * 100_000), (200, b"table" + b"x" * 100_000, "text/html; charset=UTF-8"))
    chunks = (part for part in (b"in ", b"x" * 100_000, b" chunks"))
    same("a body in chunks", get("/", "return 200, asked[4]", chunks)[1], b"tablein " + b"x" * 100_000 + b" chunks")
    same("bytes", get("/a.png", "return 200, tobuffer('\\0\\xff')"), (200, b"\x00\xff", "image/png"))
    same("not found", get("/a", "return 404, ''"), (404, b"", "application/octet-stream"))
    same("without data", get("/a", "return 404")[:2], (500, b""))
    same("with nil", get("/a", "return 404, nil")[:2], (500, b""))
    same("without status", get("/a", "return nil, 'x'")[:2], (404, b"x"))
    same("an error", get("/a", "error('boom')")[:2], (500, b""))
    control.sim.logged("boom")
    control.server("")
    port = control("return simWS.getPort(S)")
    same("no handler", get("/", "")[:2], (404, b""))


def clients(control):
    control("calls = {}; C = simWS.connect('ws://127.0.0.1:1'); simWS.setFailHandler(C, note('Fail')); simWS.setOpenHandler(C, note('Open'))")
    eventually(lambda: control("return #calls"), "1")
    same("nobody there", control("return calls[1] == table.concat({'Fail', C, calls[1]:match('%S+$')}, ' ')"), "true")
    port = control.server("simWS.setMessageHandler(S, 'echo')")
    code = (
        f"C = simWS.connect('ws://127.0.0.1:{port}/any/path?x'); "
        "simWS.setOpenHandler(C, function(client, connection) simWS.send(client, connection, client) end); "
        "simWS.setMessageHandler(C, function(client, connection, data) got = tostring(data) == client end); "
        "simWS.setCloseHandler(C, note('Close'))"
    )
    control("calls = {}; " + code)
    eventually(lambda: control("return got"), "true")
    control("simWS.stop(S)")
    eventually(lambda: control("return #calls"), "1")
    control("simWS.disconnect(C)")
    same("after the end", "invalid object handle" in control("simWS.disconnect(C)"), True)


def other_scripts(control):
    control.server("simWS.setHTTPHandler(S, 'where'); function where() return 200, 'A' end")
    port = control("return simWS.getPort(S)")
    control(
        """local code = [[simWS = require 'simWS'
        function where() return 200, 'B' end
        function byName(server) simWS.setHTTPHandler(server, 'where') end
        function byValue(server) simWS.setHTTPHandler(server, where) end
        function sysCall_ext(name, ...)
            if name == 'where' then return 200, 'B by sysCall_ext' end
            if name == 'own' then own = simWS.start(0); simWS.setHTTPHandler(own, 'where'); return simWS.getPort(own) end
            return _G[name](...)
        end]]
        other = sim.createScript(sim.scripttype_customization, code, 0, 'lua')
        sim.initScript(other)"""
    )

    def get(port=port):
        return urllib.request.urlopen(f"http://127.0.0.1:{port}/", None, 10).read()

    control("sim.callScriptFunction('byName', other, S)")
    same("a name is looked up in the script that has the server", get(), b"A")
    control("sim.callScriptFunction('byValue', other, S)")
    same("a function is where it was made", get(), b"B")
    own = control("return sim.callScriptFunction('own', other)")
    same("sysCall_ext", get(own), b"B by sysCall_ext")
    control("sim.removeObjects({other})")
    try:
        get(own)
        same("the server of a script that has ended", "there", "gone")
    except urllib.error.URLError:
        pass
    try:
        get()
        same("a handler of a script that has ended", "there", "gone")
    except urllib.error.HTTPError as error:
        same("a handler of a script that has ended", error.status, 500)


def batches(control):
    control.server(
        "order = {}; simWS.setMessageHandler(S, function(_, _, data) order[#order + 1] = passes .. ':' .. tostring(data) end);"
        "simWS.setOpenHandler(S, function() local till = os.clock() + 0.3; while os.clock() < till do end end)"
    )
    with connect(f"ws://127.0.0.1:{control('return simWS.getPort(S)')}") as client:
        for word in ("a", "b", "c"):
            client.send(word)
        eventually(lambda: control("return #order"), "3")
    order = [entry.split(":") for entry in control("return table.concat(order, ' ')").split()]
    same("in order", [entry[1] for entry in order], ["a", "b", "c"])
    same("in one pass", len({entry[0] for entry in order}), 1)


def sub_protocols(control):
    port = control.server("")
    with connect(f"ws://127.0.0.1:{port}", subprotocols=["a", "b"]) as client:
        same("any sub-protocol", client.subprotocol, "a")
    control("simWS.stop(S)")
    try:
        connect(f"ws://127.0.0.1:{port}", open_timeout=10)
        same("a server that is stopped", "there", "gone")
    except (OSError, websockets.WebSocketException):
        pass


def echo_scene():
    """The example."""
    with Simulator("scenes/ws_echo.lua", "--no-remote-api", "-D", "port=0") as sim:
        with connect("ws" + sim.printed("ws")) as client:
            for message in ("hi", b"\x00\xff"):
                client.send(message)
                same("an echo", client.recv(10), message)
        sim.printed("bye ")


def main():
    echo_scene()
    with Control() as control:
        for case in (echoes, errors, handlers, pages, clients, other_scripts, batches, sub_protocols):
            case(control)
        same("the end", control.sim.end(), 143)


main()
