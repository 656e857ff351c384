#!/usr/bin/env python3
"""How time grows with the number of objects, names, scripts or points: `benches/growth.py [CASE ...]` after `cargo build --release`.

The cases are those of growth.lua. Each runs in a process of its own with 1 250, 2 500, ... up to LARGEST (20 000) of whatever it is about, three
times; the least processor time counts, so that a busy machine does little harm. Columns: seconds with the largest number, the exponent of
the growth (slope of a line through the logarithms, by least squares), and the memory that what was measured took, per piece. SWANILDA names
another command. A case that takes longer than PATIENCE seconds is not tried with larger numbers.
"""

import math
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
BINARY = os.environ.get("SWANILDA", str(HERE / "../target/release/swanilda"))
LARGEST = int(os.environ.get("LARGEST", "20000"))
SIZES = [LARGEST // 2**power for power in (4, 3, 2, 1, 0)]
REPETITIONS = 3
PATIENCE = 20.0


def run(**values):
    command = [BINARY, "run", str(HERE / "growth.lua"), "--empty", "--quiet", "--no-start", "--loops", "1000"]
    for name, value in values.items():
        command += ["-D", f"{name}={value}"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if result.returncode != 0 or not result.stdout:
        raise RuntimeError((result.stdout + result.stderr)[-500:])
    return result.stdout.split()


def measure(case, size):
    """Seconds and kilobytes."""
    runs = []
    while len(runs) < REPETITIONS and (not runs or runs[-1][0] < PATIENCE / REPETITIONS):
        seconds, kilobytes = run(case=case, n=size)
        runs.append((float(seconds), int(kilobytes)))
    return min(runs)


def exponent(rows):
    """Of a power of the size that fits the seconds best."""
    points = [(math.log(size), math.log(seconds)) for size, seconds, _ in rows]
    middle_x, middle_y = (sum(axis) / len(points) for axis in zip(*points))
    spread = sum((x - middle_x) ** 2 for x, _ in points)
    return sum((x - middle_x) * (y - middle_y) for x, y in points) / spread if spread else math.nan


def grow(case):
    rows = []
    for size in SIZES:
        seconds, kilobytes = measure(case, size)
        rows.append((size, max(seconds, 1e-6), kilobytes))
        if seconds > PATIENCE:
            break
    return rows


def main():
    cases = sys.argv[1:] or sorted(run(list=1))
    print("| case | number | seconds | exponent | kB each |\n|---|---|---|---|---|")
    for case in cases:
        try:
            rows = grow(case)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            print(f"| {case} | | | | {error} |", flush=True)
            continue
        size, seconds, kilobytes = rows[-1]
        print(f"| {case} | {size} | {seconds:.4g} | {exponent(rows):.2f} | {kilobytes / size:.2g} |", flush=True)


if __name__ == "__main__":
    main()
