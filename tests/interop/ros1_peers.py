"""simROS and rospy, with the master of ROS 1, all on the loopback; the master's port is one that the system chooses.

Topics in both directions, latched ones, floods, images, transforms; services in both directions; parameters; types that do not fit; damaged connections;
what the master knows after the end; a simulator without a master.
"""

import logging
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

import rosmaster.master

MASTER = rosmaster.master.Master(port=0)
MASTER.start()
while not MASTER.uri:
    time.sleep(0.01)
PORT = int(MASTER.uri.rstrip("/").rsplit(":", 1)[1])
os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{PORT}"
os.environ["ROS_IP"] = "127.0.0.1"
os.environ["ROS_LOG_DIR"] = os.environ.get("TMPDIR", "/tmp") + "/swanilda-ros1-log"

import rospy  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402
from sensor_msgs.msg import CompressedImage, Image, LaserScan  # noqa: E402
from simulator import LIMIT, Simulator  # noqa: E402
from std_msgs.msg import Float64, Int32, Int64, String, UInt8MultiArray  # noqa: E402
from std_srvs.srv import SetBool, SetBoolResponse  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402

SCENE = "tests/interop/ros1_scene.lua"
RUN = ["--empty", "--quiet", "--realtime", "--time", "1000"]


def until(what, ask):
    end = time.monotonic() + LIMIT
    while time.monotonic() < end:
        answer = ask()
        if answer:
            return answer
        time.sleep(0.01)
    sys.exit(f"{what}: not in time")


class Reader:
    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=1000)

    def wait(self, count, what):
        until(what, lambda: len(self.messages) >= count)
        return self.messages


def equal(got, wanted, what):
    if got != wanted:
        sys.exit(f"{what}: {got!r} instead of {wanted!r}")


def topics(simulator, command):
    back, latched, scans = Reader("/back", String), Reader("/latched", Int64), Reader("/scan", LaserScan)
    there = rospy.Publisher("/there", String, queue_size=100)
    until("a connection to /there", there.get_num_connections)
    until("a connection of /back", back.subscriber.get_num_connections)
    texts = ["a", "é \n'\"", "x" * 3_000_000]
    for text in texts:
        there.publish(text)
    equal([m.data for m in back.wait(3, "echoes")], texts, "echoes")
    equal(latched.wait(1, "the latched message")[0].data, 3, "the last message of a latched topic")
    scan = scans.wait(2, "scans")[-1]
    equal((scan.header.frame_id, list(scan.ranges[:2])), ("laser", [1.0, 2.5]), "a scan")
    equal(round(scan.header.stamp.to_sec(), 3), round(scan.ranges[2], 3), "a time stamp")
    equal(Reader("/bytes", UInt8MultiArray).wait(1, "bytes")[0].data, b"\x00\x01\xff", "bytes")
    flood = rospy.Publisher("/flood", Int32, queue_size=1000)
    until("a connection to /flood", flood.get_num_connections)
    command.publish("block")
    time.sleep(0.3)
    for number in range(500):
        flood.publish(number)
    equal(simulator.printed("flood "), "5 499", "the newest of a flood")


def images(simulator):
    image = Reader("/image", Image).wait(1, "an image")[0]
    size = (image.width, image.height, image.step, image.encoding, image.header.frame_id)
    equal((size, image.data), ((2, 3, 6, "rgb8", "camera"), b"defghi789abc123456"), "an image")
    picture = rospy.Publisher("/picture", Image, queue_size=1)
    until("a connection to /picture", picture.get_num_connections)
    picture.publish(Image(width=1, height=2, step=3, encoding="bgr8", data=b"\x01\x02\x03\x04\x05\x06"))
    equal(simulator.printed("picture"), ", 6, 6, 1, 2", "a picture")
    compressed = Reader("/image/compressed", CompressedImage).wait(1, "a compressed image")[0]
    equal((compressed.format, compressed.header.frame_id), ("rgb8; png compressed bgr8", "camera"), "a compressed image")
    picture = rospy.Publisher("/picture_again/compressed", CompressedImage, queue_size=1)
    until("a connection to /picture_again", picture.get_num_connections)
    picture.publish(CompressedImage(format=compressed.format, data=compressed.data))
    equal(simulator.printed("again"), ", 123456789abcdefghi, 2, 3", "the compressed image, which has come back")


def services(simulator, command):
    rospy.wait_for_service("/set", LIMIT)
    proxy = rospy.ServiceProxy("/set", SetBool, persistent=True)
    equal([(a.success, a.message) for a in map(proxy, (True, False))], [(False, "answered true"), (True, "answered false")], "answers")
    proxy.close()
    server = rospy.Service("/ask", SetBool, lambda request: SetBoolResponse(True, f"asked {request.data}"))
    command.publish("call")
    equal(simulator.printed("sum "), "asked True", "an answer")
    server.shutdown()
    command.publish("no_service")
    simulator.printed("failed ")


def parameters(simulator, command):
    for name, value in (("/number", 42), ("/text", "a <text>"), ("/truth", True)):
        rospy.set_param(name, value)
    command.publish("parameters")
    equal(simulator.printed("parameters"), ", true 42, true 42.0, true a <text>, true true", "parameters")
    equal(simulator.printed("wrong"), ", false 7, false else, false", "parameters that are none")
    equal(simulator.printed("found"), ", true /sim_ros_interface/gain, false ", "a search")
    equal(rospy.get_param("/own"), {"truth": True, "integer": -3, "text": "a <b> & c"}, "parameters of the simulator")
    equal(rospy.get_param("/sim_ros_interface/gain"), 0.1, "a private parameter")
    until("a deleted parameter", lambda: not rospy.has_param("/number"))


def transforms(command):
    reader = Reader("/tf", TFMessage)
    end = time.monotonic() + LIMIT
    while not reader.messages and time.monotonic() < end:
        command.publish("transforms")
        time.sleep(0.2)
    message = reader.wait(2, "transforms")[0]
    first = message.transforms[0]
    got = (first.header.stamp.to_sec(), first.header.frame_id, first.child_frame_id, first.transform.translation.y)
    equal(got, (12.25, "world", "base", 2.0), "a transform")


def wrong_type(simulator):
    publisher = rospy.Publisher("/wrong_type", Float64, queue_size=1)
    simulator.logged("/wrong_type")
    publisher.unregister()


def slave(simulator):
    """What tools ask a node, and what nobody should say to one."""
    code, _, uri = MASTER.handler.lookupNode("/test", "/sim_ros_interface")
    equal(code, 1, "the node's address")
    node = xmlrpc.client.ServerProxy(uri)
    equal(node.getPid("/test")[2], simulator.process.pid, "the process")
    equal(["/scan", "sensor_msgs/LaserScan"] in node.getPublications("/test")[2], True, "publications")
    equal(["/there", "std_msgs/String"] in node.getSubscriptions("/test")[2], True, "subscriptions")
    equal(node.getBusInfo("/test")[0], 1, "connections")
    equal(node.shutdown("/test", "please")[0], 0, "a request to end")
    equal(node.requestTopic("/test", "/nothing", [["TCPROS"]])[0], 0, "a topic that is none")
    protocol, host, port = node.requestTopic("/test", "/scan", [["TCPROS"]])[2]
    equal((protocol, host), ("TCPROS", "127.0.0.1"), "the place of a topic")
    try:
        node.nonsense()
        sys.exit("an unknown method has an answer")
    except xmlrpc.client.Fault:
        pass
    api = int(uri.rstrip("/").rsplit(":", 1)[1])
    head = struct.pack("<I", 1 << 31)
    rude = [(port, b"x"), (port, head), (port, b"\xff" * 100), (port, struct.pack("<II", 4, 9)), (port, b""),
            (api, b"GET / HTTP/1.1\r\n\r\n"), (api, b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n"), (api, b"\x00" * 20000),
            (api, b"POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\n<a>")]
    for where, data in rude * 20:
        with socket.create_connection(("127.0.0.1", where)) as connection:
            connection.sendall(data)
    equal(node.getPid("/test")[2], simulator.process.pid, "the process after rude connections")


def leave(simulator, command):
    command.publish("leave")
    equal(simulator.printed("left "), "false", "a publisher that has ended")
    until("the end of /back", lambda: "/back" not in published())
    equal(MASTER.handler.lookupService("/test", "/set")[0], -1, "a service that has ended")


def published():
    publishers = MASTER.handler.getSystemState("/test")[2][0]
    return [topic for topic, nodes in publishers if "/sim_ros_interface" in nodes]


def with_rospy():
    with Simulator(*RUN, SCENE, command="run") as simulator:
        equal(simulator.printed("own "), "answered true", "a service of one's own")
        simulator.printed("ready")
        command = rospy.Publisher("/command", String, queue_size=10)
        until("a connection to /command", command.get_num_connections)
        topics(simulator, command)
        images(simulator)
        services(simulator, command)
        parameters(simulator, command)
        transforms(command)
        wrong_type(simulator)
        slave(simulator)
        command.publish("fail")
        simulator.logged("on purpose")
        leave(simulator, command)
        simulator.end()
    until("the end of all topics", lambda: not published())


def simulated_time():
    rospy.set_param("/use_sim_time", True)
    clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
    clock.publish(rospy.Time(1234, 500_000_000))
    with Simulator(*RUN, SCENE, command="run") as simulator:
        simulator.printed("ready")
        command = rospy.Publisher("/command", String, queue_size=10)
        until("a connection to /command", command.get_num_connections)
        for _ in range(50):
            command.publish("time")
            if simulator.printed("time ") == "1234.5":
                return
            time.sleep(0.05)
        sys.exit("simulated time does not arrive")


def without_master():
    """The call returns with an error, whether nobody listens or somebody does not answer."""
    silent = socket.create_server(("127.0.0.1", 0))
    free = socket.create_server(("127.0.0.1", 0))
    closed_port = free.getsockname()[1]
    free.close()
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as scene:
        scene.write("""simROS = require 'simROS'
            local made, topic = pcall(simROS.advertise, '/a', 'std_msgs/String') print(made, topic)
            if made then simROS.publish(topic, {data = 'x'}) print(simROS.getParamInt('n', 4), 'goes on') end""")
        scene.flush()

        def said(uri, *options):
            command = [sys.argv[1], "run", "--empty", "--steps", "1", "--quiet", *options, scene.name]
            environment = dict(os.environ, ROS_MASTER_URI=uri)
            result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=3 * LIMIT)
            return result.stdout + result.stderr

        for port in (silent.getsockname()[1], closed_port):
            begun = time.monotonic()
            text = said(f"http://127.0.0.1:{port}", "--ros-needs-master")
            if f"ROS: no ROS master at http://127.0.0.1:{port}: " not in text or time.monotonic() - begun > 8:
                sys.exit(f"without a master: {text}")
        text = said(f"http://127.0.0.1:{closed_port}")
        if "goes on" not in text or text.count("no ROS master at") != 1:
            sys.exit(f"alone: {text}")
        text = said("http://192.0.2.1:11311", "--ros-needs-master")
        if "192.0.2.1 is outside of this machine (--ros-network allows that)" not in text:
            sys.exit(f"a master elsewhere: {text}")
    silent.close()


without_master()
rospy.init_node("peer", disable_signals=True, disable_rosout=True)
# Without the warning that a type does not fit, which is meant.
logging.disable(logging.WARNING)
with_rospy()
simulated_time()
MASTER.stop()
os._exit(0)
