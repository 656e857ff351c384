"""How long a robot with meshes takes to read: a UR5 by Swanilda, yourdfpy, trimesh and MuJoCo's compiler.

    python3 -m venv target/venv && target/venv/bin/pip install yourdfpy trimesh pycollada mujoco example-robot-data
    target/venv/bin/python benches/compare/robots.py [BINARY]

Swanilda reads the URDF file, all visual and collision meshes (COLLADA and STL) with their textures, and makes a model of them in a scene; yourdfpy builds its scene of
the visual meshes; trimesh only reads all meshes, each once; MuJoCo compiles the file with the collision meshes (it reads no COLLADA). The best of ROUNDS, in one process each.
"""

import logging
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import trimesh
import yourdfpy

ROUNDS = 10
ROOT = Path(__file__).resolve().parent.parent.parent
SHARE = Path(yourdfpy.__file__).parent.parent / "cmeel.prefix" / "share"
FILE = SHARE / "example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"
LUA = """
sim, simURDF = require 'sim', require 'simURDF'
for _ = 1, %d do
    local before = sim.getSystemTime()
    local _, roots = simURDF.import('%s', 0)
    print(sim.getSystemTime() - before)
    for _, root in ipairs(roots) do sim.removeObjects(sim.getObjectsInTree(root)) end
end
"""


def best(work):
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def swanilda(binary):
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as scene:
        scene.write(LUA % (ROUNDS, FILE))
        scene.flush()
        done = subprocess.run([binary, "run", scene.name, "-q", "--empty", "--no-start", "--loops", "1", "--verbosity", "errors"], capture_output=True, text=True, check=True)
    return min(float(line) for line in done.stdout.split())


def mesh(path):
    return SHARE / path.removeprefix("package://")


def with_trimesh():
    for path in sorted(set(re.findall(r'filename="(package://[^"]+)"', FILE.read_text()))):
        trimesh.load(mesh(path))


def with_mujoco():
    text = re.sub(r"<visual>.*?</visual>", "", FILE.read_text(), flags=re.S)
    text = re.sub(r'filename="([^"]+)"', lambda match: f'filename="{mesh(match[1])}"', text)
    text = text.replace("</robot>", '<mujoco><compiler strippath="false" discardvisual="false"/></mujoco></robot>')
    mujoco.MjModel.from_xml_string(text)


def main():
    logging.disable(logging.CRITICAL)
    binary = sys.argv[1] if len(sys.argv) > 1 else ROOT / "target" / "release" / "swanilda"
    rows = {
        "Swanilda": swanilda(binary),
        "yourdfpy": best(lambda: yourdfpy.URDF.load(str(FILE), filename_handler=lambda fname: str(mesh(fname)))),
        "trimesh, meshes alone": best(with_trimesh),
        "MuJoCo, collision meshes alone": best(with_mujoco),
    }
    for name, seconds in rows.items():
        print(f"| {name} | {seconds * 1000:.0f} ms |")


if __name__ == "__main__":
    main()
