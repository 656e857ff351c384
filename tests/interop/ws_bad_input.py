"""What ill-behaved peers of simWS do: it goes on, and keeps nothing of them."""

import base64
import socket
import struct
import time

from compare import same
from simulator import Simulator
from websockets.sync.client import connect
from ws_peer import Control, eventually

HANDSHAKE = (
    "GET / HTTP/1.1\r\nHost: h\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + base64.b64encode(b"0123456789abcdef").decode() + "\r\n\r\n"
).encode()


def raw(port, data=b""):
    peer = socket.create_connection(("127.0.0.1", port), 10)
    peer.sendall(data)
    return peer


def opened(port):
    """A socket behind a handshake."""
    peer = raw(port, HANDSHAKE)
    answer = b""
    while not answer.endswith(b"\r\n\r\n"):
        answer += peer.recv(1)
    same("a handshake", answer.split(b" ")[1], b"101")
    return peer


def rest(peer):
    """What it says until it ends."""
    data = b""
    try:
        while chunk := peer.recv(4096):
            data += chunk
    except ConnectionResetError:
        pass
    return data


def frame(opcode, payload, final=True, masked=True):
    head = bytes([opcode | (0x80 if final else 0)])
    mask = 0x80 if masked else 0
    if len(payload) < 126:
        head += bytes([mask | len(payload)])
    else:
        head += bytes([mask | 127]) + struct.pack(">Q", len(payload))
    return head + (bytes(4) if masked else b"") + payload


def handshakes(port):
    for data, status in (
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"400"),
        (b"nonsense\r\n\r\n", b"400"),
        (HANDSHAKE.replace(b"13", b"12"), b"400"),
        (HANDSHAKE.replace(b"Sec-WebSocket-Key", b"X"), b"400"),
        (HANDSHAKE.replace(b"GET", b"POST"), b"400"),
        (HANDSHAKE.replace(b"HTTP/1.1", b"HTTP/1.0"), b"400"),
        (b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 20_000, b"431"),
        (b"GET /" + b"a" * 100_000, b"431"),
        (b"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n", b"413"),
        (b"POST / HTTP/1.1\r\nContent-Length: 32000001\r\n\r\n", b"413"),
        (b"POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", b"400"),
        (b"POST / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n", b"501"),
        (b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n0\r\n\r\n", b"400"),
        (b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nno length\r\n", b"400"),
        (b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n", b"413"),
        (b"GET / HTTP/1.1\r\n\r\n", b"404"),
    ):
        same(data[:60], rest(raw(port, data)).split(b" ")[1:2], [status])


def frames(port):
    for data, code in (
        (frame(3, b""), 1002),  # no such opcode
        (frame(1, b"\xff"), 1007),  # no text
        (frame(1, b"a", masked=False), 1002),
        (frame(0, b"a"), 1002),  # continues nothing
        (frame(9, b"a", final=False), 1002),  # a control frame in parts
        (frame(9, bytes(126)), 1002),  # a large control frame
        (frame(0x41, b"a"), 1002),  # a reserved bit
        (b"\x82\xff" + struct.pack(">Q", 1 << 63) + bytes(4), 1009),
        (b"\x82\xff" + struct.pack(">Q", 32_000_001) + bytes(4), 1009),
    ):
        peer = opened(port)
        peer.sendall(data)
        farewell = rest(peer)
        same(data[:10], (farewell[0], struct.unpack(">H", farewell[2:4])[0]), (0x88, code))


def deaths(port):
    """Peers that go at every point."""
    whole = HANDSHAKE + frame(1, b"hi") + frame(2, bytes(100_000)) + frame(8, b"")
    for cut in list(range(0, len(HANDSHAKE) + 20, 7)) + [len(HANDSHAKE) + 5000, len(whole) - 3, len(whole)]:
        peer = raw(port, whole[:cut])
        if cut % 2:  # with a reset
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        peer.close()


def silence(port):
    """One that says nothing is put out after five seconds; one that is open may be silent."""
    quiet, half, open_one = raw(port), raw(port, HANDSHAKE[:30]), opened(port)
    begun = time.monotonic()
    same("half a handshake", rest(half).split(b" ")[1:2], [b"408"])
    rest(quiet)
    same("not at once", time.monotonic() - begun > 2, True)
    open_one.sendall(frame(9, b"x"))
    same("a ping", open_one.recv(10), b"\x8a\x01x")


def slow_readers(control):
    """One that does not read: sending ends with an error, and others go on."""
    port = control.server("simWS.setOpenHandler(S, function(_, c) last = c end)")
    peer = opened(port)
    eventually(lambda: control("return last ~= nil"), "true")
    error = control("local data = ('x'):rep(10000000) for i = 1, 20 do simWS.send(S, last, data, 2) end")
    same("too much", "bytes are waiting to be sent" in error, True)
    peer.close()
    control("last = nil")


def floods(control):
    """More than fits while the script is busy: all of it arrives."""
    port = control.server("got = 0; simWS.setMessageHandler(S, function(_, _, data) got = got + #tostring(data) end)")
    with connect(f"ws://127.0.0.1:{port}") as client:
        for _ in range(20_000):
            client.send(b"12345")
        eventually(lambda: control("return got"), "100000")
        for _ in range(5):
            client.send(bytes(20_000_000))
        eventually(lambda: control("return got"), "100100000")


def crowd(control):
    port = control.server("n = 0; simWS.setMessageHandler(S, function(s, c, d) simWS.send(s, c, d) end)")
    clients = [connect(f"ws://127.0.0.1:{port}") for _ in range(100)]
    for i, client in enumerate(clients):
        client.send(str(i))
    same("everyone is answered", [client.recv(10) for client in clients], [str(i) for i in range(100)])
    control("simWS.stop(S)")
    for client in clients:
        client.socket.close()


def other_addresses():
    """Servers of scripts listen where --bind says, and nowhere else."""
    with Simulator("scenes/ws_echo.lua", "--no-remote-api", "-D", "port=0", "--bind", "127.0.0.2") as sim:
        port = int(sim.printed("ws://127.0.0.1:").strip("/"))
        with connect(f"ws://127.0.0.2:{port}") as client:
            client.send("hi")
            same("an echo", client.recv(10), "hi")
        try:
            raw(port)
            same("another address", "there", "refused")
        except ConnectionRefusedError:
            pass


def main():
    other_addresses()
    with Control() as control:
        control("return 0")
        before = control.sim.sockets()
        port = control.server("simWS.setMessageHandler(S, 'echo')")
        for check in (handshakes, frames, deaths, silence):
            check(port)
        slow_readers(control)
        floods(control)
        crowd(control)
        control("for i = 1, 50 do local c = simWS.connect('ws://127.0.0.1:1') if i % 2 == 0 then simWS.disconnect(c) end end")
        control("if S then pcall(simWS.stop, S) end")
        eventually(control.sim.sockets, before)
        same("still there", control("return 1 + 1"), "2")
        same("the end", control.sim.end(), 143)


main()
