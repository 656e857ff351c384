"""simROS2 and CycloneDDS by a network that loses datagrams in both directions: a relay between them, which both take for the other.

Reliable topics, messages of a megabyte and services are complete and in order; best-effort topics lose messages, but none has parts of two.
"""

import multiprocessing
import os
import random
import select
import socket
import struct
import sys
import time

DOMAIN = 100 + os.getpid() % 100
LOSS = 0.15
HERE = "127.0.0.1"
BASE = 7410 + 250 * DOMAIN
# The simulator does not look for participants with so high a number, and there is no multicast: only the relay connects the two.
INDEX = 100
THEIRS = [BASE + 2 * INDEX, BASE + 2 * INDEX + 1]


class Relay:
    """Sockets in the place of the simulator and of CycloneDDS. Addresses in what it passes on become those of these sockets.

    A process of its own: CycloneDDS lets no other thread of Python run while it waits.
    """

    def __init__(self):
        self.choose = random.Random(1)
        self.instead_of_simulator = own_socket()
        self.instead_of_theirs = {own_socket(): port for port in THEIRS}
        fork = multiprocessing.get_context("fork")
        self.simulator = fork.Value("i", 0)  # its port
        self.counts = fork.Array("q", 2)  # passed on, lost
        fork.Process(target=self._serve, daemon=True).start()

    @property
    def port(self):
        return self.instead_of_simulator.getsockname()[1]

    def _serve(self):
        own = [self.instead_of_simulator, *self.instead_of_theirs]
        while True:
            for ready in select.select(own, [], [])[0]:
                datagram = ready.recv(65536)
                if self.simulator.value:
                    is_lost = self.choose.random() < LOSS
                    self.counts[is_lost] += 1
                    if not is_lost:
                        self._pass(ready, datagram)

    def _pass(self, arrived, datagram):
        if arrived is self.instead_of_simulator:
            for stand_in, port in self.instead_of_theirs.items():
                datagram = datagram.replace(place(port), place(stand_in.getsockname()[1]))
            arrived.sendto(datagram, (HERE, self.simulator.value))
        else:
            datagram = datagram.replace(place(self.simulator.value), place(self.port))
            arrived.sendto(datagram, (HERE, self.instead_of_theirs[arrived]))


def own_socket():
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8 << 20)
    made.bind((HERE, 0))
    return made


def place(port):
    """An address of IPv4 in the protocol, without its last four bytes."""
    return struct.pack("<iI", 1, port) + bytes(12)


def port_of(process):
    """Where the simulator receives: its socket that is bound to the loopback."""
    inodes = {os.readlink(f"/proc/{process}/fd/{fd}") for fd in os.listdir(f"/proc/{process}/fd")}
    for line in open(f"/proc/{process}/net/udp").readlines()[1:]:
        fields = line.split()
        address, port = fields[1].split(":")
        if f"socket:[{fields[9]}]" in inodes and address == "0100007F":
            return int(port, 16)
    sys.exit("the simulator has no socket")


relay = Relay()
os.environ["DOMAIN"] = str(DOMAIN)
os.environ["CYCLONE_DOMAIN"] = (
    '<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces><AllowMulticast>false</AllowMulticast></General>'
    f'<Discovery><ParticipantIndex>{INDEX}</ParticipantIndex><SPDPInterval>200 ms</SPDPInterval><Peers AddLocalhost="false"><Peer address="{HERE}:{relay.port}"/></Peers></Discovery>'
)

from ros2_types import Client, Policy, Qos, message, reader, samples, until, writer  # noqa: E402
from simulator import Simulator  # noqa: E402

STRING, INT = message("std_msgs/msg/String"), message("std_msgs/msg/Int32")
LOOSE = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(500))


def topics():
    back, there = reader("rt/back", STRING), writer("rt/there", STRING)
    until("partners", lambda: there.get_matched_subscriptions() and back.get_matched_publications())
    # The other side may know of this one a little later, since what is lost is sent again.
    time.sleep(1)
    megabyte = [letter * 1_000_000 for letter in "abc"]
    for texts in ([f"number {number}" for number in range(200)], megabyte):
        for text in texts:
            there.write(STRING(text))
        got = []
        until(f"{len(texts)} messages", lambda: got.extend(sample.data for sample in samples(back)) or len(got) >= len(texts))
        assert got == texts, [text[:20] for text in got]


def services(simulator):
    client = Client("set", "std_srvs/srv/SetBool")
    for number in range(20):
        assert client(data=number % 2 == 0).success == (number % 2 == 1), number
    server, call = Server(), writer("rt/call", INT)
    until("a reader of calls", call.get_matched_subscriptions)
    call.write(INT(20))
    until("the answers", lambda: server.answered() == 20)
    simulator.printed("called")


class Server:
    """Adds two numbers, as a service of rmw_cyclonedds."""

    def __init__(self):
        adder = Client("add", "example_interfaces/srv/AddTwoInts")
        self.response = adder.response
        self.requests, self.replies = reader("rq/addRequest", adder.request), writer("rr/addReply", adder.response)
        self.count = 0

    def answered(self):
        for request in samples(self.requests):
            self.replies.write(self.response(request.client, request.number, request.a + request.b))
            self.count += 1
        return self.count


def best_effort(simulator):
    there, report = writer("rt/loose_there", STRING, LOOSE), writer("rt/report", INT)
    until("partners", lambda: there.get_matched_subscriptions() and report.get_matched_subscriptions())
    time.sleep(1)
    for number in range(300):
        there.write(STRING(chr(65 + number % 26) * 6000))
        time.sleep(0.002)
    report.write(INT(0))
    whole, torn = map(int, simulator.printed("loose ").split())
    assert torn == 0 and 0 < whole < 300, (whole, torn)
    got = []
    until("messages that may be lost", lambda: got.extend(sample.data for sample in samples(reader_of_loose)) or len(got) >= 20)
    assert all(text == text[0] * 100_000 for text in got), "a message has parts of two"


reader_of_loose = reader("rt/loose", STRING, LOOSE)
with Simulator("tests/interop/ros2_lossy_scene.lua", "--empty", "--realtime", command="run") as simulator:
    simulator.printed("ready")
    relay.simulator.value = port_of(simulator.process.pid)
    topics()
    services(simulator)
    best_effort(simulator)
    passed, lost = relay.counts
    assert passed > 1000 and lost > 0.1 * passed, (passed, lost)
