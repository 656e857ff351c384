"""The scenes of scenes.py in Swanilda, MuJoCo and PyBullet: end states, energy and speed.

    python3 -m venv target/venv && target/venv/bin/pip install -r benches/compare/requirements.txt
    cargo build --release && target/venv/bin/python benches/compare/compare.py

writes the table into docs/PHYSICS.md and the pictures into docs/physics. SWANILDA names another binary.
"""

import os
import platform
import re
from importlib.metadata import version

import matplotlib
import numpy as np

from engines import ENGINES, HERE, STEP
from scenes import G, SCENES, SLOPE

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "swanilda", "font.size": 9})
from matplotlib import pyplot  # noqa: E402

DOCS = os.path.join(HERE, "../../docs")
COLORS = {"Swanilda": "#c2410c", "MuJoCo": "#2563eb", "PyBullet": "#16a34a"}
# How often the speed is measured; the best counts, since other programs only slow down.
ROUNDS = 3
WATCH_ALL = ("pendulum", "double pendulum", "gyroscope", "four-bar", "chain of 30")
FEET = "58 kg on feet of 5, 1, 0.3 and 0.1 kg"
PICTURED = 300


def body(rows, index):
    """Position, quaternion, velocity, angular velocity of a watched body over time."""
    part = rows[:, 1 + 13 * index:14 + 13 * index]
    return part[:, :3], part[:, 3:7], part[:, 7:10], part[:, 10:]


def own_axes(q, v):
    """Vectors of the world in the axes of a body (quaternion x, y, z, w)."""
    u, w = -q[:, :3], q[:, 3:]
    return v + 2 * np.cross(u, np.cross(u, v) + w * v)


def energy(scene, rows):
    gravity, total = np.array(scene["gravity"]), np.zeros(len(rows))
    for i, it in enumerate(scene["bodies"]):
        x, q, v, w = body(rows, i)
        a, b, c = np.square(it["size"]) * it["mass"] / 12
        turning = (own_axes(q, w) ** 2) @ [b + c, a + c, a + b]
        total += (it["mass"] * (v ** 2).sum(axis=1) + turning) / 2 - it["mass"] * x @ gravity
    return total


def drift(scene, rows):
    """Largest change of the energy, in parts of the largest kinetic energy (of the first one without gravity)."""
    now = energy(scene, rows)
    kinetic = energy({**scene, "gravity": (0, 0, 0)}, rows)
    return np.abs(now - now[0]).max() / (kinetic.max() if any(scene["gravity"]) else now[0])


def pendulum_angle(times):
    """Of the rod below the level, by Runge and Kutta with small steps."""
    length, width = SCENES["pendulum"]["bodies"][0]["size"][:2]
    k = G * length / 2 / ((length ** 2 + width ** 2) / 12 + length ** 2 / 4)
    f = lambda y: np.array([y[1], k * np.cos(y[0])])
    y, t, h, angles = np.zeros(2), 0.0, 5e-4, []
    for end in times:
        while t < end - h / 2:
            a = f(y)
            b = f(y + h / 2 * a)
            c = f(y + h / 2 * b)
            y, t = y + h / 6 * (a + 2 * b + 2 * c + f(y + h * c)), t + h
        angles.append(y[0])
    return np.array(angles)


def angle_of(rows):
    x = body(rows, 0)[0]
    return np.arctan2(2 - x[:, 2], x[:, 0])


def height_of_top(rows):
    return body(rows, 9)[0][:, 2]


def first_joint(rows):
    q = body(rows, 0)[1]
    return 2 * np.arctan2(q[:, 2], q[:, 3])


def end_states(results):
    """Lines: scene, quantity, theory, and what it is by engine."""
    each = lambda name, f: {engine: f(rows) for engine, rows in results[name].items()}
    late = pendulum_angle(results["pendulum"]["Swanilda"][:200, 0])
    slide = G * (np.sin(SLOPE) - 0.5 * np.cos(SLOPE)) * 2
    lines = [
        ("pendulum", "angle, largest error in 10 s, rad", 0.0,
         each("pendulum", lambda rows: np.abs(np.unwrap(angle_of(rows[:200])) - late).max())),
        ("box on a slope", "distance after 2 s, m", slide, each("box on a slope", lambda rows: body(rows, 0)[0][-1, 0])),
        ("tower of ten boxes", "height of the top box after 60 s, m", 0.95,
         each("tower of ten boxes", lambda rows: height_of_top(rows)[-1])),
        ("tower of ten boxes", "its lateral displacement, m", 0.0,
         each("tower of ten boxes", lambda rows: np.hypot(*body(rows, 9)[0][-1, :2]))),
        ("arm of seven joints", "first joint after 4 s, rad", 0.3,
         each("arm of seven joints", lambda rows: first_joint(rows)[-1])),
        ("gyroscope", "angular momentum, change in 60 s", 0.0, each("gyroscope", momentum_change)),
        ("quadruped", "way in 10 s, m", 0.0, each("quadruped", lambda rows: np.hypot(*(body(rows, 0)[0][-1, :2])))),
        ("humanoid", "largest tilt of the torso in 10 s, rad", 0.0, each("humanoid", lambda rows: tilt(rows, 1).max())),
    ]
    for i, foot in enumerate(it for it in SCENES[FEET]["bodies"] if "foot" in it["name"]):
        lines.append(("58 kg on a foot", f"a foot of {foot['mass']:g} kg sinks by, mm", 0.0,
                      each(FEET, lambda rows, i=i: 20 - 1e3 * body(rows, 2 * i + 1)[0][-1, 2])))
    energies = [(name, "energy, largest change", 0.0, each(name, lambda rows, name=name: drift(SCENES[name], rows)))
                for name in WATCH_ALL]
    return lines + energies


def tilt(rows, index):
    """Angle of the z axis of a body to the vertical."""
    q = body(rows, index)[1]
    return np.arccos(np.clip(1 - 2 * (q[:, 0] ** 2 + q[:, 1] ** 2), -1, 1))


def momentum_change(rows):
    _, q, _, w = body(rows, 0)
    a, b, c = np.square(SCENES["gyroscope"]["bodies"][0]["size"]) / 12
    own = own_axes(q, w) * [b + c, a + c, a + b]
    back = own_axes(q * [-1, -1, -1, 1], own)
    return np.linalg.norm(back - back[0], axis=1).max() / np.linalg.norm(back[0])


def speeds():
    best = {name: dict.fromkeys(ENGINES, 0.0) for name in SCENES}
    for name, scene in SCENES.items():
        for _ in range(ROUNDS):
            for engine, run in ENGINES.items():
                seconds = min(scene["seconds"], 2 if len(scene["bodies"]) > 50 else 10)
                _, took = run({**scene, "seconds": seconds}, [])
                best[name][engine] = max(best[name][engine], seconds / STEP / took)
    return best


def table(results, best):
    out = ["", "| scene | quantity | theory | " + " | ".join(ENGINES) + " |", "|---|---|---|" + "---|" * len(ENGINES)]
    for name, what, theory, values in end_states(results):
        digits = 4 if theory else 2
        out.append(f"| {name} | {what} | {theory:.4g} | " + " | ".join(f"{values[e]:.{digits}g}" for e in ENGINES) + " |")
    for name, values in best.items():
        out.append(f"| {name} | sub-steps/s | | " + " | ".join(f"{values[e]:,.0f}" for e in ENGINES) + " |")
    versions = ", ".join(f"{package} {version(package)}" for package in ("mujoco", "pybullet"))
    out += ["", f"{versions}, Python {platform.python_version()}, {os.cpu_count()} x {processor()}; "
            f"best of {ROUNDS} runs; {os.getloadavg()[1]:.1f} programs running meanwhile, this one among them.", ""]
    return "\n".join(out)


def processor():
    with open("/proc/cpuinfo") as file:
        found = re.search(r"model name\s*: (.*)", file.read())
    return found.group(1) if found else platform.machine()


def picture(file, title, ylabel, curves, theory=None):
    figure, axes = pyplot.subplots(figsize=(6.4, 2.8), layout="constrained")
    if theory is not None:
        axes.plot(*theory, color="black", linewidth=3, alpha=0.25, label="theory")
    for engine, (t, y) in curves.items():
        every = max(1, len(t) // PICTURED)
        ours = engine == "Swanilda"  # dashed and on top, so that equal curves can be told apart
        axes.plot(t[::every], y[::every], color=COLORS[engine], linewidth=1.2, label=engine,
                  linestyle="--" if ours else "-", zorder=3 if ours else 2)
    axes.set(title=title, xlabel="time, s", ylabel=ylabel)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=4, fontsize=8)
    figure.savefig(os.path.join(DOCS, "physics", file), metadata={"Date": None})
    pyplot.close(figure)


def pictures(results):
    os.makedirs(os.path.join(DOCS, "physics"), exist_ok=True)
    curves = lambda name, f: {e: (rows[:, 0], f(rows)) for e, rows in results[name].items()}
    share = lambda name: lambda rows: (energy(SCENES[name], rows) - energy(SCENES[name], rows)[0])
    t = results["pendulum"]["Swanilda"][:100, 0]
    first = {e: (t, np.degrees(np.unwrap(angle_of(rows[:100])))) for e, rows in results["pendulum"].items()}
    picture("pendulum.svg", "A rod released level", "angle, deg", first, (t, np.degrees(pendulum_angle(t))))
    picture("pendulum_energy.svg", "Pendulum: change of the energy", "J", curves("pendulum", share("pendulum")))
    picture("double_pendulum_energy.svg", "Double pendulum: change of the energy", "J",
            curves("double pendulum", share("double pendulum")))
    picture("gyroscope_energy.svg", "A box that tumbles freely: change of the energy", "J",
            curves("gyroscope", share("gyroscope")))
    picture("tower.svg", "Tower of ten boxes: height of the top one", "m", curves("tower of ten boxes", height_of_top))
    steps = np.arange(0, 1.0001, STEP)
    arm = {e: (rows[:20, 0], first_joint(rows[:20])) for e, rows in results["arm of seven joints"].items()}
    picture("servo.svg", "Arm of seven joints: step response of the first", "rad", arm,
            (steps, 0.3 * (1 - 0.9 ** np.round(steps / STEP))))


def main():
    def watched(name):
        return [it["name"] for it in SCENES[name]["bodies"]] if len(SCENES[name]["bodies"]) <= 50 else []
    results = {name: {engine: run(scene, watched(name))[0] for engine, run in ENGINES.items()}
               for name, scene in SCENES.items() if watched(name)}
    pictures(results)
    page = os.path.join(DOCS, "PHYSICS.md")
    with open(page) as file:
        text = file.read()
    head, rest = text.split("<!-- engines -->")
    tail = rest.split("<!-- end of engines -->")[1]
    with open(page, "w") as file:
        file.write(f"{head}<!-- engines -->\n{table(results, speeds())}\n<!-- end of engines -->{tail}")


if __name__ == "__main__":
    main()
