"""Threads of a program, and programs side by side: calls from a thread without a simulator are errors and no crash; a thread beside
the simulator's may step while nothing runs; eight processes at once compute the same.

Usage: threads.py TABLE FOLDER
"""

import subprocess
import sys
import threading

import sim41

TABLE, FOLDER = sys.argv[1], sys.argv[2]


def in_thread(work):
    """What a function returns in a thread of its own."""
    results = []
    thread = threading.Thread(target=lambda: results.append(work()))
    thread.start()
    thread.join(60)
    assert results, "the thread has failed"
    return results[0]


def wrong_threads(sim):
    text = in_thread(lambda: (sim.lib.simGetSimulationState(), sim.last_error()))
    assert text[0] == -1 and "belongs to the thread" in text[1], text
    assert in_thread(lambda: sim.lib.simExtStep(0)) == 1
    sim.StartSimulation()
    sim.step(2)
    assert in_thread(lambda: sim.lib.simExtStep(0)) == -1
    assert in_thread(lambda: sim.lib.simExtGetExitRequest()) == 0
    assert in_thread(lambda: sim.lib.simExtSimThreadDestroy()) == -1
    assert in_thread(lambda: sim.lib.simExtSimThreadInit()) == -1
    again = in_thread(lambda: (sim.lib.simExtLaunchUIThread(sim.ffi.NULL, 0, sim.ffi.NULL, sim.ffi.NULL), sim.last_error()))
    assert again[0] == -1 and "is running" in again[1], again
    sim.stop()


def scene_that_is_not_there(sim):
    """The start fails with the reason, and the next one works."""
    try:
        sim.launch("/none/scene.ttt")
    except sim41.Failed as failed:
        assert "/none/scene.ttt" in str(failed), failed
    else:
        raise AssertionError("a scene that is not there was opened")
    sim.ExtPostExitRequest()
    sim.thread.join(60)
    assert not sim.thread.is_alive()


def fall(sim):
    """Where a box is after a second, and a random number of the sandbox."""
    box = sim.CreatePureShape(0, 8, [0.1, 0.1, 0.1], 1.0, None)
    sim.SetObjectPosition(box, -1, [0.0, 0.0, 1.0])
    sim.SetObjectOrientation(box, -1, [0.3, 0.2, 0.1])
    sim.StartSimulation()
    sim.step(20)
    values = sim.floats(3)
    sim.GetObjectPosition(box, -1, values)
    return list(values)


def processes():
    command = [sys.executable, __file__, TABLE, FOLDER, "one"]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(8)]
    texts = {process.communicate(timeout=300)[0] for process in running}
    assert all(process.returncode == 0 for process in running)
    assert len(texts) == 1 and texts.pop().startswith("["), texts


def main():
    sim = sim41.Sim(*sim41.compiled(TABLE, FOLDER))
    if "one" in sys.argv:
        print(fall(sim.launch()))
        return sim.shut_down()
    scene_that_is_not_there(sim)
    sim.launch()
    wrong_threads(sim)
    sim.shut_down()
    processes()
    print("ok")


main()
