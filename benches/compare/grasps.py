"""Hands that hold: the grasps of grasp_scenes.py in Swanilda, MuJoCo (twice) and PyBullet.

    python3 -m venv target/venv && target/venv/bin/pip install mujoco pybullet numpy
    cargo build --release && target/venv/bin/python benches/compare/grasps.py

writes the table into docs/PHYSICS.md. SWANILDA names another binary. Options: `--only hand=parallel,form=box,mass=0.1` (any of hand, form, mesh, mass, moving,
factor; prints what each engine does and leaves the table alone), `--engines Swanilda,elliptic`, `--keep FILE` (results are added to the file, and what is
there is not run again). JOBS grasps at a time, 1 without it.
"""

import argparse
import json
import os
import platform
import sys
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from itertools import product

import numpy as np

from engines import SUBSTEPS
from grasp_engines import ENGINES
from grasp_scenes import FORMS, HANDS, MASSES, STEP, case

# An object that moved farther than this in the hand is lost: half of a pad. In the hold of two seconds what slides by 4 % of its weight is gone.
LOST = 0.01
# What is held with the critical force in excess does not move farther.
HELD = 0.001
FACTORS = (0.96, 1.04)
ASKED = ("hand", "form", "mesh", "mass", "moving", "factor")


def grasps():
    every = product(HANDS, FORMS, (False, True), MASSES, (False, True), (None, *FACTORS))
    return [dict(zip(ASKED, values)) for values in every]


def result(asked):
    """Of one grasp in one engine: largest way in the hand and creep in the hold in metres, peak in m/s2, seconds per sub-step."""
    engine, what = asked
    made = case(**what)
    rows, peak, took = ENGINES[engine](made)
    places, start, held = rows[:, 1:], made["start"] // SUBSTEPS, len(made["path"]) // SUBSTEPS
    ways = np.linalg.norm(places[start - 1:] - places[start - 1], axis=1)
    creep = np.linalg.norm(places[-1] - places[held - 1])
    way = float(ways.max()) if np.isfinite(places).all() else float("inf")
    return {**what, "engine": engine, "way": way, "creep": float(creep), "peak": peak, "took": took}


def selected(only):
    """Whether a grasp is what `--only` asks for."""
    words = dict(word.split("=") for word in only.split(",")) if only else {}
    return lambda what: all(str(what[key]) == value for key, value in words.items())


def title(what):
    return f"{what['hand']}, {'moving' if what['moving'] else 'fixed'}"


def count(values):
    values = list(values)
    return f"{sum(values)} of {len(values)}"


def cells(results):
    """Columns of a row of the table for one engine."""
    moved = [r for r in results if r["factor"] is None]
    kept = [r for r in moved if r["way"] < LOST]
    weak, strong = ([r for r in results if r["factor"] == factor] for factor in FACTORS)
    most = lambda key, digits: f"{max(r[key] for r in kept):.{digits}g}" if kept else ""
    creep = f"{1e3 * max(r['creep'] for r in kept):.1g}" if kept else ""
    took = f"{np.median([r['took'] for r in moved]) * 1e6:.0f}" if moved else ""
    return [count(r["way"] < LOST for r in moved), creep, most("peak", 2), count(r["way"] > LOST for r in weak), count(r["way"] < HELD for r in strong), took]


def table(results, engines):
    head = ["", "| hand, base | engine | kept | creep, mm/min | peak, m/s2 | slips at 0.96 | holds at 1.04 | us per sub-step |", "|---|---|---|---|---|---|---|---|"]
    def lines(group_of):
        for group in dict.fromkeys(map(group_of, results)):
            for engine in engines:
                own = [r for r in results if group_of(r) == group and r["engine"] == engine]
                yield f"| {group} | {engine} | " + " | ".join(cells(own)) + " |"
    out = head + list(lines(title))
    out += [""] + [head[1].replace("hand, base", "object"), head[2]] + list(lines(lambda r: r["form"] + (", mesh" if r["mesh"] else "")))
    versions = ", ".join(f"{package} {version(package)}" for package in ("mujoco", "pybullet"))
    return "\n".join(out + ["", f"{versions}, Python {platform.python_version()}, {os.cpu_count()} processors, sub-steps of {STEP * 1e3:g} ms.", ""])


def write(text):
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/PHYSICS.md")
    with open(path) as file:
        head, _, tail = file.read().split("<!-- grasps -->")
    with open(path, "w") as file:
        file.write(f"{head}<!-- grasps -->\n{text}\n<!-- grasps -->{tail}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="")
    parser.add_argument("--engines", default=",".join(ENGINES).replace("MuJoCo, elliptic", "elliptic"))
    parser.add_argument("--keep")
    options = parser.parse_args()
    engines = [{"elliptic": "MuJoCo, elliptic"}.get(name, name) for name in options.engines.split(",")]
    asked = [(engine, what) for what in filter(selected(options.only), grasps()) for engine in engines]
    known = kept(options.keep)
    missing = [one for one in asked if key(*one) not in known]
    with ProcessPoolExecutor(int(os.environ.get("JOBS", 1))) as pool:
        for one, done in zip(missing, pool.map(result, missing)):
            known[key(*one)] = done
            report(done, options.keep)
    text = table([known[key(*one)] for one in asked], engines)
    print(text) if options.only else write(text)


def key(engine, what):
    return (engine, *what.values())


def kept(path):
    """Results of runs before, by grasp and engine."""
    if not path or not os.path.exists(path):
        return {}
    with open(path) as file:
        known = [json.loads(line) for line in file]
    return {key(one["engine"], {name: one[name] for name in ASKED}): one for one in known}


def report(done, path):
    shown = {name: f"{value:.3g}" if isinstance(value, float) else value for name, value in done.items()}
    print(*(f"{name}={value}" for name, value in shown.items()), file=sys.stderr, flush=True)
    if path:
        with open(path, "a") as file:
            file.write(json.dumps(done) + "\n")


if __name__ == "__main__":
    main()
