"""The official asyncio client: several requests of one client at a time."""

import asyncio
import sys

from coppeliasim_zmqremoteapi_client.asyncio import RemoteAPIClient

from compare import same


async def at_once(sim, floor):
    aliases = await asyncio.gather(*(sim.getObjectAlias(floor) for _ in range(20)))
    same("twenty at once", aliases, ["Floor"] * 20)


async def waits(sim):
    """Requests that wait for steps do not disturb each other."""
    await sim.setStepping(True)
    await sim.startSimulation()
    while await sim.getSimulationState() == sim.simulation_stopped:
        await sim.step()
    await sim.setStepping(False)
    before = await sim.getSimulationTime()
    await asyncio.gather(sim.wait(0.3), sim.wait(0.5), sim.wait(0.1))
    same("time passed", await sim.getSimulationTime() >= before + 0.5 - 1e-9, True)


async def callbacks(sim):
    seen = []

    def callback(a, b):
        seen.append((a, b))
        return a + b

    same("a callback", await sim.testCB(1, callback, 2, 1), 3)
    same("a callback with several results", await sim.testCB(1, lambda a, b: [b, "x", a], 2, 0), (2, "x", 1))
    same("its calls", seen, [(1, 2)] * 2)


async def main():
    async with RemoteAPIClient(port=int(sys.argv[1])) as client:
        sim = await client.require("sim")
        floor = await sim.getObject("/Floor")
        await at_once(sim, floor)
        await callbacks(sim)
        await waits(sim)
        await sim.stopSimulation(True)
        same("stopped", await sim.getSimulationState(), 0)


asyncio.run(main())
