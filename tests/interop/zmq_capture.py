"""Two official clients that step, while the run is captured: each moves an object to random places."""

import random
import sys
import threading

from coppeliasim_zmqremoteapi_client import RemoteAPIClient

STEPS = 25


def work(port, seen):
    client = RemoteAPIClient(port=port)
    sim = client.require('sim')
    sim.setStepping(True)
    dummy = sim.createDummy(0.01)
    sim.startSimulation()
    for _ in range(STEPS):
        sim.setObjectPosition(dummy, [random.random(), random.random(), sim.getSystemTime()])
        sim.step()
    seen.append(sim.getSimulationTime())
    sim.stopSimulation()


def main():
    seen = []
    threads = [threading.Thread(target=work, args=(int(sys.argv[1]), seen)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    if len(seen) != 2:
        raise SystemExit(f'{len(seen)} of 2 clients have stepped')


main()
