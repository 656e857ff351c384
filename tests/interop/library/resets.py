"""A thousand resets as a benchmark makes them: a model is loaded and removed, the simulation starts, steps with pictures and stops.
The memory of the process does not grow.

Usage: resets.py TABLE FOLDER
"""

import pathlib
import sys

import sim41

TABLE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
RESETS, WARM_UP = 1000, 200


def resident():
    """MiB of memory."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 2**20


def model(sim):
    """A box with a joint and a camera, saved as a model."""
    box = sim.CreatePureShape(0, 8, [0.1, 0.1, 0.1], 1.0, None)
    sim.SetObjectPosition(box, -1, [0.0, 0.0, 0.2])
    joint = sim.CreateJoint(10, 5, 0, [0.1, 0.02], None, None)
    camera = sim.CreateVisionSensor(1 | 2, [16, 16, 0, 0], [0.01, 5.0, 1.0, 0.1] + [0.0] * 7, None)
    sim.SetObjectName(camera, "Task_camera")
    for child in (joint, camera):
        sim.SetObjectParent(child, box, 1)
    sim.SetModelProperty(box, 0)
    sim.SetObjectName(box, "Task")
    path = str(FOLDER / "task.ttm")
    sim.SaveModel(box, path)
    sim.RemoveModel(box)
    return path


def reset(sim, path, values, counts):
    task = sim.LoadModel(path)
    camera = sim.GetObjectHandle("Task_camera")
    state = sim.GetConfigurationTree(task)
    sim.StartSimulation()
    for _ in range(3):
        sim.ExtStep(1)
        sim.HandleVisionSensor(camera, values, counts)
        for address in (values[0], counts[0], sim.GetVisionSensorImage(camera), sim.GetVisionSensorDepthBuffer(camera)):
            assert sim.lib.simReleaseBuffer(address) == 1
    sim.stop()
    sim.SetConfigurationTree(state)
    sim.ReleaseBuffer(state)
    sim.RemoveModel(task)


def main():
    sim = sim41.Sim(*sim41.compiled(TABLE, FOLDER)).launch()
    path, values, counts = model(sim), sim.pointer(), sim.pointer()
    sim.SetStringParameter(121, "none")
    before = 0
    for number in range(RESETS):
        reset(sim, path, values, counts)
        if number == WARM_UP:
            before = resident()
    grown = resident() - before
    assert grown < 8, f"{grown:.1f} MiB more after {RESETS - WARM_UP} resets"
    sim.shut_down()
    print("ok")


main()
