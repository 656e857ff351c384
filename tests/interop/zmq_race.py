"""Two clients that step: one says where a box is to go, the other one lets it move. The first one comes too late."""

import math
import sys
import threading
import time

from coppeliasim_zmqremoteapi_client import RemoteAPIClient

STEPS = 20
PORT = int(sys.argv[1])


def plan():
    sim = RemoteAPIClient(port=PORT).require('sim')
    # The error of the scene has paused the simulation then.
    while sim.getSimulationState() != sim.simulation_paused:
        time.sleep(0.01)
    sim.setStepping(True)
    sim.startSimulation()
    for _ in range(STEPS):
        sim.setFloatSignal('goal', math.sin(sim.getSimulationTime()))
        sim.step()
    sim.setStepping(False)
    sim.stopSimulation()


def move():
    sim = RemoteAPIClient(port=PORT).require('sim')
    sim.setStepping(True)
    sim.startSimulation()
    for step in range(STEPS):
        if step == 3:
            sim.setInt32Signal('move', 1)
        sim.step()
    sim.setStepping(False)


def main():
    threads = [threading.Thread(target=work) for work in (plan, move)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        if thread.is_alive():
            raise SystemExit('a client does not end')


main()
