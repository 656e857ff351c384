"""simROS2 and CycloneDDS, with the names and types by which ROS 2 uses DDS.

Topics in both directions, of all sizes and qualities of service; a service and a client with the headers that rmw_cyclonedds puts before requests;
floods and damaged packets. Nothing leaves the loopback: a participant of another interface hears nothing.
"""

import math
import os
import random
import socket
import struct
import sys
import time
from dataclasses import dataclass

DOMAIN = 100 + os.getpid() % 100
INTERFACE = '<NetworkInterface name="lo" multicast="true"/>'
os.environ["CYCLONEDDS_URI"] = (
    f"<CycloneDDS><Domain><General><Interfaces>{INTERFACE}</Interfaces></General></Domain></CycloneDDS>"
)
os.environ["ROS_DOMAIN_ID"] = str(DOMAIN)

from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct  # noqa: E402
from cyclonedds.idl.types import float32, float64, int32, int64, sequence, uint32, uint64  # noqa: E402
from cyclonedds.pub import DataWriter  # noqa: E402
from cyclonedds.sub import DataReader  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402
from simulator import Simulator  # noqa: E402

RELIABLE = Policy.Reliability.Reliable(duration(seconds=10))
DEFAULT = Qos(RELIABLE, Policy.History.KeepAll)
LATCHED = Qos(RELIABLE, Policy.History.KeepLast(10), Policy.Durability.TransientLocal)
SENSOR = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(10))


def named(name):
    package, kind, short = name.split("/")
    return f"{package}::{kind}::dds_::{short}_"


@dataclass
class String(IdlStruct, typename=named("std_msgs/msg/String")):
    data: str


@dataclass
class Int32(IdlStruct, typename=named("std_msgs/msg/Int32")):
    data: int32


@dataclass
class Float64(IdlStruct, typename=named("std_msgs/msg/Float64")):
    data: float64


@dataclass
class Vector3(IdlStruct, typename=named("geometry_msgs/msg/Vector3")):
    x: float64
    y: float64
    z: float64


@dataclass
class Twist(IdlStruct, typename=named("geometry_msgs/msg/Twist")):
    linear: Vector3
    angular: Vector3


@dataclass
class Time(IdlStruct, typename=named("builtin_interfaces/msg/Time")):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, typename=named("std_msgs/msg/Header")):
    stamp: Time
    frame_id: str


@dataclass
class LaserScan(IdlStruct, typename=named("sensor_msgs/msg/LaserScan")):
    header: Header
    angle_min: float32
    angle_max: float32
    angle_increment: float32
    time_increment: float32
    scan_time: float32
    range_min: float32
    range_max: float32
    ranges: sequence[float32]
    intensities: sequence[float32]


@dataclass
class Clock(IdlStruct, typename=named("rosgraph_msgs/msg/Clock")):
    clock: Time


@dataclass
class Quaternion(IdlStruct, typename=named("geometry_msgs/msg/Quaternion")):
    x: float64
    y: float64
    z: float64
    w: float64


@dataclass
class Transform(IdlStruct, typename=named("geometry_msgs/msg/Transform")):
    translation: Vector3
    rotation: Quaternion


@dataclass
class TransformStamped(IdlStruct, typename=named("geometry_msgs/msg/TransformStamped")):
    header: Header
    child_frame_id: str
    transform: Transform


@dataclass
class TFMessage(IdlStruct, typename=named("tf2_msgs/msg/TFMessage")):
    transforms: sequence[TransformStamped]


@dataclass
class JointState(IdlStruct, typename=named("sensor_msgs/msg/JointState")):
    header: Header
    name: sequence[str]
    position: sequence[float64]
    velocity: sequence[float64]
    effort: sequence[float64]


@dataclass
class SetBoolRequest(IdlStruct, typename=named("std_srvs/srv/SetBool_Request")):
    client: uint64
    number: int64
    data: bool


@dataclass
class SetBoolResponse(IdlStruct, typename=named("std_srvs/srv/SetBool_Response")):
    client: uint64
    number: int64
    success: bool
    message: str


@dataclass
class AddRequest(IdlStruct, typename=named("example_interfaces/srv/AddTwoInts_Request")):
    client: uint64
    number: int64
    a: int64
    b: int64


@dataclass
class AddResponse(IdlStruct, typename=named("example_interfaces/srv/AddTwoInts_Response")):
    client: uint64
    number: int64
    sum: int64


PARTICIPANT = DomainParticipant(DOMAIN)


def reader(name, kind, qos=DEFAULT):
    return DataReader(PARTICIPANT, Topic(PARTICIPANT, name, kind), qos=qos)


def writer(name, kind, qos=DEFAULT):
    return DataWriter(PARTICIPANT, Topic(PARTICIPANT, name, kind), qos=qos)


def until(what, ask, limit=20):
    end = time.monotonic() + limit
    while time.monotonic() < end:
        answer = ask()
        if answer:
            return answer
        time.sleep(0.005)
    sys.exit(f"{what}: nothing within {limit} s")


def samples(of):
    return [sample for sample in of.take(N=1000) if hasattr(sample, "__dataclass_fields__")]


def matched(of):
    until("a partner of a writer", of.get_matched_subscriptions)
    # The other side may know of this one a little later.
    time.sleep(0.3)
    return of


def topics():
    back, there = reader("rt/back", String), matched(writer("rt/there", String))
    for size in (0, 3, 1000, 60_000, 70_000, 2_000_000):
        text = "x" + "y" * size
        there.write(String(text))
        got = until(f"a message of {size} bytes", lambda: samples(back))
        assert [sample.data for sample in got] == [text], (size, [len(sample.data) for sample in got])
    for number in range(200):
        there.write(String(f"number {number}"))
    got = []
    until("200 messages", lambda: got.extend(samples(back)) or len(got) == 200)
    assert [sample.data for sample in got] == [f"number {number}" for number in range(200)]


def qualities(simulator):
    latched = reader("rt/latched", String, LATCHED)
    got = []
    until("what was written before", lambda: got.extend(samples(latched)) or len(got) == 2)
    assert [sample.data for sample in got] == ["two", "three"], got
    scan = until("a best-effort message", lambda: samples(reader_of_scans))[-1]
    assert scan.header.frame_id == "laser" and scan.ranges[:2] == [1.0, 2.5], scan
    twists = matched(writer("rt/best_effort", Twist, SENSOR))
    twists.write(Twist(Vector3(1.5, 0, 0), Vector3(0, 0, -0.25)))
    assert simulator.printed("twist ") == "1.5 -0.25"


def services(simulator):
    replies = reader("rr/setReply", SetBoolResponse)
    requests = matched(writer("rq/setRequest", SetBoolRequest))
    for number, data in ((1, True), (2, False)):
        requests.write(SetBoolRequest(77, number, data))
        reply = until("a reply", lambda: samples(replies))[0]
        expected = SetBoolResponse(77, number, not data, f"answered {str(data).lower()}")
        assert reply == expected, reply
    asked, answers = reader("rq/addRequest", AddRequest), writer("rr/addReply", AddResponse)
    matched(writer("rt/call", Int32)).write(Int32(5))
    assert simulator.printed("service ") == "true"
    request = until("a request", lambda: samples(asked))[0]
    assert (request.a, request.b) == (5, 2**40), request
    answers.write(AddResponse(request.client ^ 1, request.number, 3))
    answers.write(AddResponse(request.client, request.number + 1, 4))
    answers.write(AddResponse(request.client, request.number, request.a + request.b))
    assert simulator.printed("sum ") == str(float(5 + 2**40)).replace("e+", "e+"), "the answer to another request"


def floods(simulator):
    block, flood = matched(writer("rt/block", Float64)), matched(writer("rt/flood", Int32))
    block.write(Float64(1.0))
    time.sleep(0.3)
    for number in range(2000):
        flood.write(Int32(number))
    count, newest = simulator.printed("flood ").split()
    # What waited while nothing was read is the newest five; more may have come while they were handled.
    assert int(count) >= 5 and int(newest) <= 1999, (count, newest)
    assert int(count) < 500, f"{count} messages waited"


def bridge():
    """What --ros2-bridge publishes of a tip that a joint has turned by half a radian."""
    clock, poses, joints = BRIDGE
    assert until("the clock", lambda: samples(clock))[-1].clock.nanosec % 50_000_000 == 0
    joint = until("joints", lambda: samples(joints))[-1]
    assert (joint.name, joint.position) == (["Hinge"], [0.5]), joint
    by_name = {pose.child_frame_id: pose for pose in until("poses", lambda: samples(poses))[-1].transforms}
    tip = by_name["Hinge/Tip"]
    place = tip.transform.translation
    assert tip.header.frame_id == "Hinge" and by_name["Hinge"].header.frame_id == "world", by_name
    assert abs(place.x - math.cos(0.5)) < 1e-9 and abs(place.y - math.sin(0.5)) < 1e-9, place


def own_ports(simulator):
    """The addresses and ports of UDP at which the simulator listens."""
    process = simulator.process.pid
    inodes = {os.readlink(f"/proc/{process}/fd/{fd}") for fd in os.listdir(f"/proc/{process}/fd")}
    places = []
    for line in open(f"/proc/{process}/net/udp").readlines()[1:]:
        fields = line.split()
        if f"socket:[{fields[9]}]" in inodes:
            address, port = fields[1].split(":")
            places.append((socket.inet_ntoa(struct.pack("=I", int(address, 16))), int(port, 16)))
    return places


def packets(simulator):
    """Packets that are damaged, too long, or lie about their sizes: the conversation goes on."""
    places = own_ports(simulator)
    assert places and all(address in ("127.0.0.1", "239.255.0.1") for address, _ in places), places
    port = next(port for address, port in places if address == "127.0.0.1")
    attacker = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    choose = random.Random(1)
    head = b"RTPS\2\3\1\x10" + bytes(range(12))
    for _ in range(3000):
        kinds = (0x06, 0x07, 0x08, 0x09, 0x0C, 0x0E, 0x12, 0x13, 0x15, 0x16, 0x42)
        body = b"".join(
            struct.pack("<BBH", choose.choice(kinds), choose.randrange(16), choose.randrange(80)) + choose.randbytes(choose.randrange(80))
            for _ in range(3)
        )
        attacker.sendto(head + body, ("127.0.0.1", port))
    # Announces 4 GB in pieces.
    pieces = struct.pack("<HH8siIIHHI", 0, 28, b"\0\0\0\0\0\0\1\3", 0, 1, 1, 1, 65535, 2**32 - 1) + b"x" * 100
    attacker.sendto(head + struct.pack("<BBH", 0x16, 1, len(pieces)) + pieces, ("127.0.0.1", port))
    topics()


def robot():
    """A participant at another interface, which announces itself as robots of the network do. Returns a function that says what it was sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return None
        address = probe.getsockname()[0]
    base = 7400 + 250 * DOMAIN
    group = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    group.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    group.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
    group.bind(("239.255.0.1", base))
    group.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton("239.255.0.1") + socket.inet_aton(address))
    own = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    own.bind((address, 0))
    own.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(address))
    own.settimeout(0.1)

    def parameter(number, value):
        return struct.pack("<HH", number, len(value)) + value

    prefix = b"\1\x10a real one"
    prefix = prefix[:12].ljust(12, b"!")
    place = struct.pack("<iI", 1, own.getsockname()[1]) + bytes(12) + socket.inet_aton(address)
    described = b"".join((
        b"\0\3\0\0", parameter(0x15, b"\2\3\0\0"), parameter(0x16, b"\1\x10\0\0"), parameter(0x50, prefix + b"\0\0\1\xc1"),
        parameter(0x58, struct.pack("<I", 0xC3F)), parameter(0x32, place), parameter(0x31, place),
        parameter(2, struct.pack("<iI", 10, 0)), b"\1\0\0\0",
    ))  # fmt: skip
    data = struct.pack("<HH", 0, 16) + b"\0\1\0\xc7\0\1\0\xc2" + struct.pack("<iI", 0, 1) + described
    announcement = b"RTPS\2\3\1\x10" + prefix + struct.pack("<BBH", 0x15, 5, len(data)) + data

    def heard():
        got = []
        for _ in range(20):
            own.sendto(announcement, ("239.255.0.1", base))
            try:
                while True:
                    got.append(own.recvfrom(65535))
            except TimeoutError:
                pass
        return got

    return heard


reader_of_scans = reader("rt/scan", LaserScan, SENSOR)
BRIDGE = reader("rt/clock", Clock), reader("rt/tf", TFMessage), reader("rt/joint_states", JointState)
OPTIONS = "--empty", "--realtime", "--ros2-bridge"
with Simulator("tests/interop/ros2_scene.lua", *OPTIONS, command="run") as simulator:
    simulator.printed("ready")
    heard = robot()
    topics()
    qualities(simulator)
    bridge()
    services(simulator)
    floods(simulator)
    packets(simulator)
    if heard:
        assert not heard(), "something was sent to a robot of the network"
