"""The official Python client, with the CBOR library it asks for or with the newer one."""

import sys

if sys.argv[2] == "cbor":
    sys.modules["cbor2"] = None  # the client takes the older one when this cannot be imported

from coppeliasim_zmqremoteapi_client import RemoteAPIClient  # noqa: E402

from compare import near, same  # noqa: E402

client = RemoteAPIClient(port=int(sys.argv[1]))
sim = client.require("sim")

floor = sim.getObject("/Floor")
same("an alias", sim.getObjectAlias(floor), "Floor")
dummy = sim.createDummy(0.1)
sim.setObjectPosition(dummy, [1, 2.5, -3])
same("a position", sim.getObjectPosition(dummy), [1, 2.5, -3])
sim.setInt32Signal("answer", 42)
same("a signal", sim.getInt32Signal("answer"), 42)
same("no signal", sim.getInt32Signal("question"), None)
sim.writeCustomStringData(dummy, "tag", b"\x00\xff")
same("bytes", sim.readCustomStringData(dummy, "tag"), b"\x00\xff")

calls = []


def callback(a, b):
    calls.append((a, b, sim.getObjectAlias(floor)))
    return a + b


same("a callback", sim.testCB(1, callback, 2, 2), 3)
same("calls from within it", calls, [(1, 2, "Floor")] * 3)
same("a callback with several results", sim.testCB(1, lambda a, b: [b, "x", a], 2, 0), (2, "x", 1))

try:
    sim.getObject("/nobody")
    sys.exit("an unknown path is no error")
except Exception as error:
    same("one line", "\n" in str(error), False)

sim.setStepping(True)
sim.startSimulation()
while sim.getSimulationTime() < 0.5 - 1e-9:
    sim.step()
near("time", sim.getSimulationTime(), 0.5)
left = sim.wait(0.2)
near("time after a wait", sim.getSimulationTime(), 0.7 + left)
sim.stopSimulation()
while sim.getSimulationState() != sim.simulation_stopped:
    sim.step()

script = sim.createScript(sim.scripttype_customization, "function double(x) return 2 * x end", 0, "lua")
sim.initScript(script)
same("a function of a script", sim.callScriptFunction("double", script, 21), 42)
