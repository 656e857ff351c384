"""Programs as the manual of the remote client has them: on the official client against a server, and in-process."""

import importlib
import os
import time

import pytest

PORT = os.environ.get("SWANILDA_PORT")


@pytest.fixture(params=["in-process", "remote"])
def client(request):
    if request.param == "remote":
        if not PORT:
            pytest.skip("no server was started for the official client")
        module = importlib.import_module("coppeliasim_zmqremoteapi_client")
        client = module.RemoteAPIClient(port=int(PORT))
    else:
        import swanilda
        from swanilda.compat import RemoteAPIClient

        client = RemoteAPIClient(simulator=swanilda.Simulator())
    yield client
    sim = client.require("sim")
    sim.stopSimulation()
    while sim.getSimulationState() != sim.simulation_stopped:
        time.sleep(0.01)


def test_stepping(client):
    sim = client.require("sim")
    sim.setStepping(True)
    sim.startSimulation()
    times = []
    while (t := sim.getSimulationTime()) < 0.475:
        times.append(t)
        sim.step()
    sim.stopSimulation()
    assert times == pytest.approx([0.05 * i for i in range(10)])


def test_without_stepping(client):
    sim = client.require("sim")
    sim.startSimulation()
    while sim.getSimulationTime() < 0.3:
        pass
    assert sim.getSimulationState() & sim.simulation_advancing


def test_objects(client):
    sim = client.require("sim")
    dummy = sim.createDummy(0.1)
    sim.setObjectPosition(dummy, [1, 2, 3])
    assert sim.getObjectPosition(dummy, sim.handle_world) == [1, 2, 3]
    position, euler = sim.getObjectPosition(dummy), sim.getObjectOrientation(dummy)
    assert len(position) == len(euler) == 3
    sim.removeObjects([dummy])
    with pytest.raises(Exception, match="does not exist"):
        sim.getObjectPosition(dummy)


def test_images(client):
    numpy = pytest.importorskip("numpy")
    sim = client.require("sim")
    sensor = sim.createVisionSensor(1 | 2, [32, 16, 0, 0], [0.01, 10, 1, 0.1, 0, 0, 0, 0, 0, 0, 0])
    sim.handleVisionSensor(sensor)
    image, (width, height) = sim.getVisionSensorImg(sensor)
    assert numpy.frombuffer(image, dtype=numpy.uint8).reshape(height, width, 3).shape == (16, 32, 3)
    sim.removeObjects([sensor])


def test_callbacks(client):
    sim = client.require("sim")
    sim.setStepping(True)
    seen = []

    def callback(position, velocity, acceleration):  # without the data that nobody gave, as from CoppeliaSim
        seen.append(position[0])

    sim.startSimulation()
    sim.moveToConfig(-1, [0.0], [0.0], [0.0], [1.0], [1.0], [10.0], [0.1], [0.0], callback)
    assert seen[-1] == pytest.approx(0.1)


def test_scripts_and_signals(client):
    sim = client.require("sim")
    script = sim.createScript(sim.scripttype_customization, "function answer(x) return x, {a = x} end")
    sim.initScript(script)
    assert sim.callScriptFunction("answer", script, 42) == (42, {"a": 42})
    assert sim.getScriptFunctions(script).answer("x") == ("x", {"a": "x"})
    sim.setStringProperty(sim.handle_scene, "signal.test", "value")
    assert sim.getStringProperty(sim.handle_scene, "signal.test") == "value"
    sim.removeObjects([script])


def test_other_modules(client):
    assert client.require("simZMQ").z85_encode("\1\2\3\4") == "0rJua"
