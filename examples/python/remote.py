"""Drives a simulator with the official client: pip install coppeliasim-zmqremoteapi-client, then run `swanilda serve`."""

from coppeliasim_zmqremoteapi_client import RemoteAPIClient

client = RemoteAPIClient()
sim = client.require("sim")

box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.2, 0.2])
sim.setObjectPosition(box, [0, 0, 1])
sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
sim.setObjectInt32Param(box, sim.shapeintparam_respondable, 1)

sim.setStepping(True)
sim.startSimulation()
while sim.getSimulationTime() < 1:
    sim.step()
    x, y, z = sim.getObjectPosition(box)
    print(f"{sim.getSimulationTime():.2f} s: the box is {z:.3f} m up")
sim.stopSimulation(True)
