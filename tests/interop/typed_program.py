"""A program for mypy and pyright: they find what is wrong in the lines that say so, and nothing else."""

import numpy as np

import swanilda
from swanilda.compat import RemoteAPIClient

with swanilda.Simulator("scene.ttt", seed=1) as s:
    sim = s.require("sim")
    floor = sim.getObject("/Floor")
    sim.getObjectPositon(floor)  # wrong
    sim.setObjectPosition(floor, "x")  # wrong
    sim.setObjectPosition("x", [0, 0, 1])  # wrong
    simIK = s.require("simIK")
    simIK.foo()  # wrong
    mode: int = sim.jointmode_dynamic
    mode = sim.jointmode_dynmic  # wrong
    position: list[float] = sim.getObjectPosition(floor)
    position = sim.getObject("/Floor")  # wrong
    collides: int = sim.checkDistance(floor, floor)[0]
    sim.setObjectPosition(floor, np.zeros(3))
    sim.setObjectPosition(floor, (0, 0, 1))
    height: int = s.image().shape[0]
    s.image(resolution="large")  # wrong
    s.script("/Floor").anything(1)
    s.add_script("x = 1").call("f", 2)
    s.stepp()  # wrong
    for handle, path, kind in s.objects():
        sim.setObjectAlias(handle, path + str(kind))
    s.view().url.upper()

client = RemoteAPIClient(simulator=swanilda.Simulator())
client.require("sim").anything()
client.step(1, 2)  # wrong
