"""Many clients, large messages, many connections, and such as never speak properly. Arguments: port, process id of the server."""

import os
import pathlib
import socket
import struct
import sys
import threading
import time

import cbor2

from compare import same
from raw import PORT, Peer

PROCESS = pathlib.Path("/proc", sys.argv[2])
GREETING = b"\xff" + bytes(8) + b"\x7f\x03\0NULL" + bytes(48)
READY = b"\x04\x19\x05READY\x0bSocket-Type\0\0\0\x03REQ"
PINGED = b"\x04\x09\x04PING\0\x01hi"


def connect(*parts):
    """A connection that has sent these bytes."""
    connection = socket.create_connection(("127.0.0.1", PORT), 10)
    connection.sendall(b"".join(parts))
    return connection


def read(connection, size):
    data = b""
    while len(data) < size:
        part = connection.recv(size - len(data))
        if not part:
            sys.exit(f"the server closed the connection after {data!r}")
        data += part
    return data


def frame(content):
    return b"\x01\0\0" + bytes([len(content)]) + content


def is_closed(connection):
    """Whether the server has closed the connection, after whatever it said before."""
    try:
        while connection.recv(1000):
            pass
    except ConnectionError:
        pass
    return True


def twenty_clients():
    failed = []

    def work(number):
        peer = Peer(f"crowd {number}")
        for _ in range(100):
            if peer.call("string.rep", str(number), 2) != {"ret": [str(number) * 2]}:
                failed.append(number)
        peer.call("_*end*_")

    threads = [threading.Thread(target=work, args=(number,)) for number in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(15)
    same("clients whose answers were wrong", failed, [])
    same("clients still waiting", any(thread.is_alive() for thread in threads), False)


def large_messages(peer):
    text = "x" * (1 << 20)
    same("a megabyte of text", peer.call("string.upper", text), {"ret": [text.upper()]})
    numbers = [index / 2 for index in range(100_000)]
    peer.ask(eval="function echo(...) return ... end")
    same("many numbers", peer.call("echo", numbers), {"ret": [numbers]})
    same("a megabyte of bytes", peer.call("echo", bytes(1 << 20)), {"ret": [bytes(1 << 20)]})


def improper(peer):
    """Connections that get no further, while others are served."""
    request = frame(cbor2.dumps({"uuid": "g", "func": "string.rep", "args": ["a", 1]}))
    halves = [connect()] + [connect(GREETING[:size]) for size in (1, 10, 12, 63, 64)]
    halves += [connect(GREETING, READY[:7]), connect(GREETING, READY, request[:9]), connect(GREETING, READY, b"\x02\0\0")]
    same("others meanwhile", peer.call("string.rep", "ab", 2), {"ret": ["abab"]})
    wrong = [
        b"GET / HTTP/1.1\r\n\r\n",
        os.urandom(200).replace(b"\xff", b"\0"),
        GREETING[:20] + b"CURVE" + GREETING[25:],
        GREETING + READY.replace(b"REQ", b"SUB"),
        GREETING + READY + b"\x02" + struct.pack(">Q", 1 << 62),
        GREETING + READY + b"\x02" + struct.pack(">Q", 1 << 40),
        GREETING + READY + b"\xff\xff\xff",
        GREETING + READY + b"\x01\0" * 100,
    ]
    for index, garbage in enumerate(wrong):
        same(f"garbage {index} is turned away", is_closed(connect(garbage)), True)
    ignored = connect(GREETING, READY, b"\0\x03abc", b"\x01\x01a\0\x01b", PINGED, request)
    same("what is no request is ignored", read(ignored, 91 + 9)[91:], b"\x04\x07\x04PONGhi")
    for connection in [*halves, ignored]:
        connection.close()


def greedy(peer):
    """Connections that send many requests at once do not hold up the others, and what they have sent goes with them."""
    slow = cbor2.dumps({"uuid": "greedy", "eval": "for _ = 1, 1e5 do end"})
    crowd = [connect(GREETING, READY, frame(slow) * 2000) for _ in range(20)]
    begun = time.monotonic()
    same("a request among them", peer.call("string.rep", "ab", 2), {"ret": ["abab"]})
    same("it waits for one of each at most", time.monotonic() - begun < 3, True)
    for connection in crowd:
        connection.close()
    peer.call("string.rep", "ab", 2)
    begun = time.monotonic()
    same("a request after them", peer.call("string.rep", "ab", 2), {"ret": ["abab"]})
    same("it waits for nobody", time.monotonic() - begun < 1, True)


def many_names(peer):
    """A connection that calls itself something else all the time takes no places of others."""
    for number in range(11_000):
        peer.uuid = f"name {number}"
        same("an answer", peer.ask(eval="return 1"), {"ret": [1]})
    same("another client", Peer("newcomer").call("string.rep", "ab", 2), {"ret": ["abab"]})


def come_and_go(count):
    request = frame(cbor2.dumps({"uuid": "brief", "func": "string.rep", "args": ["a", 1]}))
    for index in range(count):
        if index % 3 == 0:
            connect().close()
        elif index % 3 == 1:
            connect(GREETING).close()
        else:
            connection = connect(GREETING, READY, request)
            read(connection, 91 + 4 + 8)
            connection.close()


def resident():
    """Kilobytes of memory."""
    return int((PROCESS / "statm").read_text().split()[1]) * 4


def open_files():
    return len(list((PROCESS / "fd").iterdir()))


def nothing_is_left(peer):
    come_and_go(1000)
    peer.call("string.rep", "a", 1)
    before = resident(), open_files()
    come_and_go(10_000)
    peer.call("string.rep", "a", 1)
    same("files are closed", open_files() <= before[1] + 5, True)
    grown = resident() - before[0]
    same(f"memory stays ({grown} kB)", grown < 4096, True)


def main():
    peer = Peer("crowd")
    twenty_clients()
    large_messages(peer)
    improper(peer)
    greedy(peer)
    many_names(Peer("many"))
    if PROCESS.exists():
        nothing_is_left(peer)
    same("still there", peer.call("string.rep", "ab", 2), {"ret": ["abab"]})


main()
