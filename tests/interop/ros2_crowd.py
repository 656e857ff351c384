"""Fifty topics in both directions, peers that come late, that leave and come again, and a simulator that is started again beside them."""

import os
import subprocess
import sys
import time

from ros2_types import DOMAIN, LATCHED, LIMIT, message, reader, samples, until, writer
from simulator import Simulator

COUNT, MESSAGES = 50, 8  # less than the depth of ten that subscriptions have
INT = message("std_msgs/msg/Int32")
SCENE = "tests/interop/ros2_crowd_scene.lua"


class Peer:
    def __init__(self):
        self.back = [reader(f"rt/back_{i}", INT) for i in range(1, COUNT + 1)]
        self.there = [writer(f"rt/there_{i}", INT) for i in range(1, COUNT + 1)]

    def matched(self):
        until("all partners", lambda: all(one.get_matched_subscriptions() for one in self.there) and all(one.get_matched_publications() for one in self.back))
        # The other side may know of this one a little later.
        time.sleep(0.3)

    def exchange(self):
        """Each topic brings its messages back, in order and once."""
        for number in range(MESSAGES):
            for one in self.there:
                one.write(INT(100 * number))
        got = [[] for _ in self.back]

        def is_complete():
            for numbers, one in zip(got, self.back):
                numbers.extend(sample.data for sample in samples(one))
            return all(len(numbers) >= MESSAGES for numbers in got)

        until("all messages", is_complete)
        for i, numbers in enumerate(got, 1):
            assert numbers == [100 * number + i for number in range(MESSAGES)], (i, numbers)


def run_is(expected):
    """Who comes late gets what was published before."""
    listener = reader("rt/run", message("std_msgs/msg/String"), LATCHED)
    until(f"run {expected}", lambda: expected in [sample.data for sample in samples(listener)])


def another(run):
    """A peer of its own process, which goes with all it has."""
    line = [sys.executable, __file__, run, "peer"]
    subprocess.run(line, check=True, timeout=3 * LIMIT, env=os.environ | {"DOMAIN": str(DOMAIN)})


if sys.argv[-1] == "peer":
    Peer().matched()
    run_is(sys.argv[-2])
    sys.exit()

peer = Peer()
for run in ("first", "second"):
    with Simulator(SCENE, "--empty", "--realtime", "-D", f"run={run}", command="run"):
        peer.matched()
        peer.exchange()
        run_is(run)
        for _ in range(2):
            another(run)
        peer.exchange()
