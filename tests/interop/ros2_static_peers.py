"""Discovery without multicast: one side names the address of the other, as ROS_STATIC_PEERS and CycloneDDS's Peers do.

127.0.0.1 and 127.0.0.2 stand for two machines: CycloneDDS is at one of them, the simulator at the other.
"""

import os
import subprocess
import sys
import time

DOMAIN = os.environ.setdefault("DOMAIN", str(100 + os.getpid() % 100))
SCENE = "tests/interop/ros2_scene.lua"
# The simulator does not try so many participants on its own machine, should both be one.
INDEX = 25


def settings(peers):
    general = '<Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces><AllowMulticast>false</AllowMulticast>'
    return f"<General>{general}</General><Discovery><ParticipantIndex>{INDEX}</ParticipantIndex><SPDPInterval>200 ms</SPDPInterval>{peers}</Discovery>"


def ours(*options, **environment):
    from simulator import Simulator

    for name in ("ROS_STATIC_PEERS", "ROS_AUTOMATIC_DISCOVERY_RANGE"):
        os.environ.pop(name, None)
    os.environ.update(environment)
    return Simulator(SCENE, "--empty", "--realtime", *options, command="run")


def echo(peer):
    back, there, string = peer.reader("rt/back", peer.message("std_msgs/msg/String")), None, peer.message("std_msgs/msg/String")
    there = peer.writer("rt/there", string)
    peer.until("a partner", lambda: there.get_matched_subscriptions() and back.get_matched_publications())
    # The other side may know of this one a little later.
    time.sleep(0.3)
    for size in (3, 200_000):
        there.write(string("y" * size))
        got = peer.until(f"a message of {size} bytes", lambda: peer.samples(back))
        assert [len(sample.data) for sample in got] == [size], (size, got)


def is_found(peer, seconds):
    there = peer.writer("rt/there", peer.message("std_msgs/msg/String"))
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if there.get_matched_subscriptions():
            return True
        time.sleep(0.05)
    return False


def asked():
    """The simulator names the other; unless its discovery is off."""
    os.environ["CYCLONE_DOMAIN"] = settings("")
    import ros2_types as peer

    network = "--ros-network=127.0.0.2"
    with ours(network, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", ROS_STATIC_PEERS="127.0.0.1") as simulator:
        simulator.printed("ready")
        echo(peer)
    with ours(network, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF", ROS_STATIC_PEERS="127.0.0.1") as simulator:
        simulator.printed("ready")
        assert not is_found(peer, 2), "a node whose discovery is off was found"
    # Also without a network, where all addresses of the loopback may be named.
    with ours(ROS_STATIC_PEERS="192.0.2.7; 127.0.0.2;localhost") as simulator:
        simulator.logged("'192.0.2.7' of ROS_STATIC_PEERS is outside of this machine (--ros-network allows that)")
        simulator.printed("ready")
        echo(peer)


def asks():
    """CycloneDDS names the simulator."""
    os.environ["CYCLONE_DOMAIN"] = settings('<Peers AddLocalhost="false"><Peer address="127.0.0.2"/></Peers>')
    import ros2_types as peer

    with ours("--ros-network=127.0.0.2", ROS_AUTOMATIC_DISCOVERY_RANGE="localhost") as simulator:
        simulator.printed("ready")
        echo(peer)


if sys.argv[2:]:
    {"asked": asked, "asks": asks}[sys.argv[2]]()
else:
    for part in ("asked", "asks"):
        subprocess.run([sys.executable, __file__, sys.argv[1], part], check=True, timeout=90)
