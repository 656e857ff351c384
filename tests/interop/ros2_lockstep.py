"""Lock step: nodes of CycloneDDS answer each step after a random time, under load, and every run ends in the same state (`--ros2-lockstep`)."""

import multiprocessing
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time

from ros2_types import announce, make, message, reader, samples, writer

RUNS, SECONDS = 10, 2
SCENE = pathlib.Path(__file__).parent / "ros2_lockstep_scene.lua"
TOPICS = "--ros2-lockstep", "/command", "--ros2-lockstep", "/trim"

places = reader("rt/place", message("geometry_msgs/msg/PointStamped"))
commands = writer("rt/command", message("geometry_msgs/msg/TwistStamped"))
trims = writer("rt/trim", message("std_msgs/msg/Float64"))
announced = announce("/lab/driver", [commands, trims])
is_over = threading.Event()
is_silent = threading.Event()


def answer(place, choose):
    """Two answers in either order, each later than the step."""
    x = place.point.x
    twist = make(message("geometry_msgs/msg/Twist"), linear=make(message("geometry_msgs/msg/Vector3"), x=2.0 * (1.0 - x)))
    sent = [
        lambda: commands.write(make(message("geometry_msgs/msg/TwistStamped"), header=place.header, twist=twist)),
        lambda: trims.write(message("std_msgs/msg/Float64")(0.1 * x)),
    ]
    choose.shuffle(sent)
    for send in sent:
        time.sleep(choose.random() * 0.004)
        send()


def node():
    choose = random.Random()
    while not is_over.is_set():
        for place in samples(places):
            if not is_silent.is_set():
                answer(place, choose)
        time.sleep(0.0005)


def burn(stop):
    while not stop.is_set():
        sum(range(1000))


def run(*options):
    line = [sys.argv[1], "run", SCENE, "--empty", "--time", str(SECONDS), "--hash", *options]
    return subprocess.run(line, capture_output=True, text=True, timeout=120)


def result(finished):
    assert finished.returncode == 0, finished.stderr
    lines = (finished.stdout + finished.stderr).splitlines()
    return [line for line in lines if "commands" in line or "hash" in line.lower()]


def runs_are_equal():
    stop = multiprocessing.Event()
    load = [multiprocessing.Process(target=burn, args=(stop,), daemon=True) for _ in range(2)]
    for process in load:
        process.start()
    results = [result(run(*TOPICS)) for _ in range(RUNS)]
    stop.set()
    assert len(results[0]) == 2 and results.count(results[0]) == RUNS, results
    # As many commands as steps, and the cart has come near its goal.
    assert float(results[0][0].split()[0]) > 0.9, results[0]


def a_node_stands_for_all_it_publishes():
    expected = result(run(*TOPICS))
    assert result(run("--ros2-lockstep", "/lab/driver")) == expected


def a_capture_needs_no_nodes():
    with tempfile.TemporaryDirectory() as folder:
        capture = f"{folder}/run.swc"
        expected = result(run(*TOPICS, "--capture", capture))
        is_silent.set()
        replay = subprocess.run([sys.argv[1], "replay", capture], capture_output=True, text=True, timeout=120)
        is_silent.clear()
        assert replay.returncode == 0 and expected[0] in replay.stdout, replay.stderr


def silence_is_named():
    is_silent.set()
    finished = run(*TOPICS, "--ros2-lockstep-timeout", "0.5")
    text = finished.stdout + finished.stderr
    assert finished.returncode != 0 and "lock step: /command, /trim has not answered the step at 0" in text, text
    finished = run("--ros2-lockstep", "/nobody", "--ros2-lockstep-timeout", "0.5")
    text = finished.stdout + finished.stderr
    assert finished.returncode != 0 and "no node publishes /nobody, or no script subscribes to it" in text, text
    finished = run("--ros2-lockstep", "a b")
    assert finished.returncode == 2 and "the name of a topic or a node is needed" in finished.stderr, finished.stderr


thread = threading.Thread(target=node, daemon=True)
thread.start()
runs_are_equal()
a_node_stands_for_all_it_publishes()
a_capture_needs_no_nodes()
silence_is_named()
is_over.set()
thread.join()
