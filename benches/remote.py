"""Calls per second of CoppeliaSim's official client: stopped, running, stepping, and `sim.step()`.

    swanilda serve --remote-api=23000 &
    python3 benches/remote.py 23000     # needs coppeliasim-zmqremoteapi-client
"""

import sys
import time

from coppeliasim_zmqremoteapi_client import RemoteAPIClient

CALLS = 20_000


def measure(name, call):
    durations = []
    begun = time.perf_counter()
    for _ in range(CALLS):
        start = time.perf_counter()
        call()
        durations.append(time.perf_counter() - start)
    rate = CALLS / (time.perf_counter() - begun)
    durations.sort()
    median, p99 = (durations[CALLS * percent // 100] * 1e6 for percent in (50, 99))
    print(f"{name}: {rate:.0f}/s, median {median:.0f} us, p99 {p99:.0f} us")


sim = RemoteAPIClient(port=int(sys.argv[1])).require("sim")
floor = sim.getObject("/Floor")


def read():
    sim.getObjectPosition(floor)


measure("stopped", read)
sim.startSimulation()
measure("running", read)
sim.stopSimulation(True)
sim.setStepping(True)
sim.startSimulation()
measure("stepping", read)
measure("sim.step()", sim.step)
sim.stopSimulation(True)
