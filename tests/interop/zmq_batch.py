"""Several calls in one request: bare, and by the helper of the examples."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples" / "python"))

from coppeliasim_zmqremoteapi_client import RemoteAPIClient  # noqa: E402
from swanilda_batch import Batch, CallError  # noqa: E402

from compare import near, same  # noqa: E402
from raw import Peer  # noqa: E402


def bare(peer):
    calls = [
        {"func": "string.rep", "args": ["ab", 2]},
        {"func": "sim.nosuch", "args": []},
        {"func": "sim.getObjectSel", "args": []},
        {"eval": "return 1, nil, 3"},
        {},
    ]
    answers = [{"ret": ["abab"]}, {"err": "No such function: sim.nosuch"}, {"ret": [[]]}, {"ret": [1, None, 3]}, {}]
    same("answers", peer.call("swanilda.batch", calls), {"ret": [answers]})
    same("up to the first error", peer.call("swanilda.batch", calls, True), {"ret": [answers[:2]]})
    same("nothing", peer.bytes(func="swanilda.batch", args=[[]]).hex(), "a1637265748180")
    for wrong in (None, 5, [5], [{}] * 10001):
        same("no calls", list(peer.call("swanilda.batch", wrong)), ["err"])
    nested = [{"func": "swanilda.batch", "args": [calls[:1]]}]
    same("a batch in a batch", peer.call("swanilda.batch", nested), {"ret": [[{"ret": [[answers[0]]]}]]})
    called = [{"func": "sim.testCB", "args": [1, "f@func", 2, 0]}]
    same("a callback", peer.ask(func="swanilda.batch", args=[called]), {"func": "f", "args": [1, 2]})
    same("its end", peer.executed(7), {"ret": [[{"ret": [7]}]]})


def helper(client):
    sim = client.require("sim")
    with Batch(client) as batch:
        floor = batch.sim.getObject("/Floor")
        nobody = batch.sim.getObject("/nobody")
        dummy = batch.sim.createDummy(0.1)
        nothing = batch.sim.addLog(sim.verbosity_debug, "nothing")
    same("a value", floor.value, sim.getObject("/Floor"))
    same("no value", nothing.value, None)
    try:
        same("an error", nobody.value, "an exception")
    except CallError as error:
        same("its text", "\n" in str(error), False)
    sim.setStepping(True)
    sim.startSimulation()
    with Batch(client) as batch:
        before = batch.sim.getSimulationTime()
        batch.sim.setObjectPosition(dummy.value, [1, 2, 3])
        batch.sim.step()
        after = batch.sim.getSimulationTime()
        position = batch.sim.getObjectPosition(dummy.value)
    near("a step in a batch", after.value - before.value, 0.05)
    same("what was set before", position.value, [1, 2, 3])
    batch = Batch(client, stop_at_error=True)
    batch.call("error", "no")
    late = batch.call("string.rep", "a", 1)
    batch.run()
    try:
        same("a call after an error", late.value, "an exception")
    except CallError as error:
        same("not called", str(error), "string.rep: not called")
    sim.stopSimulation(True)


bare(Peer("bare"))
helper(RemoteAPIClient(port=int(sys.argv[1])))
