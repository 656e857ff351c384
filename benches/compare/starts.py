"""How long robots with meshes take to start and to step, and small scenes to start again: Swanilda and MuJoCo.

    python3 -m venv target/venv && target/venv/bin/pip install mujoco example-robot-data
    cargo build --release && target/venv/bin/python benches/compare/starts.py

SWANILDA names another binary. Each number is the best of ROUNDS processes, which take turns with MuJoCo.

- *first*, *second*: from the start of the simulation until its second step has ended, in a process whose cache folder is empty, and in one that finds the convex pieces
  of the meshes there. *again*: the second start in one process. MuJoCo: to compile the file, which it does not keep, and two steps.
- *rest*, *moves*: a step of 50 ms, of ten sub-steps of 5 ms, with motors that hold the joints, and that move them by 0.8 rad at up to 2 rad/s.
- *restart*: to start, make a step and stop, which takes some more; in MuJoCo `mj_resetData` and as many steps. *start and stop*: without the steps.
- *falling*: a step of 31 bodies that are not convex and so fast that they are swept; MuJoCo has nothing like it.
"""

import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np

from lua_scene import lua

ROUNDS, STEPS = 3, 100
WAY, SPEED = 0.4, 2.0
HERE = Path(__file__).parent
SHARE = Path(mujoco.__file__).parent.parent / "cmeel.prefix" / "share"
ROBOTS = SHARE / "example-robot-data/robots"
FILES = {
    "Panda": "panda_description/urdf/panda.urdf",
    "xArm 7": "xarm_description/urdf/xarm7.urdf",
    "TIAGo": "tiago_description/robots/tiago.urdf",
    "Unitree G1": "g1_description/urdf/g1_29dof_rev_1_0.urdf",
}
CHAIN = """<mujoco><option timestep="0.005"/><worldbody>{}</worldbody></mujoco>"""
LINK = """<body pos="0 0 0.3"><joint axis="0 1 0" pos="0 0 -0.15"/><geom type="box" size="0.025 0.025 0.15" contype="0" conaffinity="0"/>{}</body>"""


def swanilda(scene, cache, **variables):
    """The numbers that a scene of this folder prints, by their names."""
    binary = os.environ.get("SWANILDA", str(HERE / "../../target/release/swanilda"))
    code = "".join(f"{name} = {lua(value)}\n" for name, value in variables.items())
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as file:
        file.write(code + (HERE / scene).read_text())
        file.flush()
        command = [binary, "run", file.name, "--empty", "--no-start", "--loops", "1000000", "--quiet", "--verbosity", "errors", "--cache-dir", cache]
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=900)
    found = {}
    for name, number in (line.split() for line in done.stdout.splitlines()):
        found.setdefault(name, []).append(float(number))
    return found


def compiled(file):
    """A robot in MuJoCo with its collision meshes and a motor at each joint; None where MuJoCo cannot read it."""
    text = re.sub(r"<visual>.*?</visual>", "", file.read_text(), flags=re.S)
    text = re.sub(r'filename="package://([^"]+)"', lambda match: f'filename="{SHARE / match[1]}"', text)
    text = text.replace("</robot>", '<mujoco><compiler strippath="false" discardvisual="false"/></mujoco></robot>')
    spec = mujoco.MjSpec.from_string(text)
    for joint in spec.joints:
        motor = spec.add_actuator(target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.set_to_position(kp=100, kv=10)
    model = spec.compile()
    model.opt.timestep = 0.005
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    return model


def seconds_of(model, data, control):
    """Of a step of 50 ms."""
    start = time.perf_counter()
    for _ in range(STEPS):
        control()
        mujoco.mj_step(model, data, nstep=10)
    return (time.perf_counter() - start) / STEPS


def theirs(file):
    start = time.perf_counter()
    model = compiled(file)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=20)
    found = {"START": [time.perf_counter() - start]}
    home = np.zeros(model.nu)

    def move():
        data.ctrl[:] = home + WAY * np.sin(SPEED / WAY * data.time)

    return found | {"REST": [seconds_of(model, data, lambda: None)], "MOVES": [seconds_of(model, data, move)]}


def their_restart(links, steps, rounds=2000):
    text = ""
    for _ in range(links):
        text = LINK.format(text)
    model = mujoco.MjModel.from_xml_string(CHAIN.format(text))
    data = mujoco.MjData(model)
    start = time.perf_counter()
    for _ in range(rounds):
        mujoco.mj_resetData(model, data)
        mujoco.mj_step(model, data, nstep=10 * steps)
    return (time.perf_counter() - start) / rounds


def restart(links, cache):
    """Seconds of both to start, step and stop, and without the steps."""
    found = swanilda("restarts.lua", cache, LINKS=links, ROUNDS=300)
    steps = int(found["STEPS"][0])
    ours, theirs = found["RESTART"][0], their_restart(links, steps)
    return (ours, theirs), (ours - steps * found["STEP"][0], their_restart(links, 0))


def row(name, what, ours, peer):
    there = "-" if peer is None else f"{1000 * peer:.3f}"
    print(f"| {name} | {what} | {1000 * ours:.3f} | {there} |", flush=True)


def robot(name, file):
    rounds = []
    for _ in range(ROUNDS):
        with tempfile.TemporaryDirectory() as cache:
            first = swanilda("starts.lua", cache, FILE=str(file), ROUNDS=1)
            second = swanilda("starts.lua", cache, FILE=str(file), ROUNDS=2)
        try:
            peer = theirs(file)
        except ValueError:  # meshes of a kind that MuJoCo does not read
            peer = {}
        rounds.append((first["START"][0], second["START"][0], second["START"][1], second["REST"][1], second["MOVES"][1], peer))
    for at, (what, key) in enumerate({"first": "START", "second": "START", "again": "START", "rest": "REST", "moves": "MOVES"}.items()):
        peers = [found[5][key][0] for found in rounds if key in found[5]]
        row(name, what, min(found[at] for found in rounds), min(peers, default=None))


def main():
    print("| scene | what | Swanilda, ms | MuJoCo, ms |\n|---|---|---|---|")
    for name, file in FILES.items():
        robot(name, ROBOTS / file)
    with tempfile.TemporaryDirectory() as cache:
        for name, links in {"pendulum": 1, "chain of 7": 7}.items():
            rounds = [restart(links, cache) for _ in range(ROUNDS)]
            row(name, "restart", *map(min, zip(*(whole for whole, _ in rounds))))
            row(name, "start and stop", *map(min, zip(*(bare for _, bare in rounds))))
        mesh = ROBOTS / "panda_description/meshes/collision/link3.stl"
        row("31 bodies", "falling", min(swanilda("falling.lua", cache, FILE=str(mesh))["FALLS"][0] for _ in range(ROUNDS)), None)


if __name__ == "__main__":
    main()
