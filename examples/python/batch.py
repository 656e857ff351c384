"""Reads the positions of many objects at every step, in one round trip a step instead of a hundred."""

import math

from coppeliasim_zmqremoteapi_client import RemoteAPIClient
from swanilda_batch import Batch

client = RemoteAPIClient()
sim = client.require("sim")

with Batch(client) as batch:
    made = [batch.sim.createDummy(0.05) for _ in range(100)]
dummies = [result.value for result in made]

sim.setStepping(True)
sim.startSimulation()
for step in range(20):
    with Batch(client) as batch:
        for index, dummy in enumerate(dummies):
            batch.sim.setObjectPosition(dummy, [index / 10, 0, math.sin(step / 5 + index / 10)])
        batch.sim.step()
        time = batch.sim.getSimulationTime()
        positions = [batch.sim.getObjectPosition(dummy) for dummy in dummies]
    highest = max(position.value[2] for position in positions)
    print(f"{time.value:.2f} s: the highest of {len(positions)} is {highest:.3f} m up")
sim.stopSimulation(True)
