"""Distances and collisions of two meshes, and of a mesh and a box, by FCL: the rows of crates/proximity/benches.

    python3 -m venv target/venv && target/venv/bin/pip install numpy python-fcl
    target/venv/bin/python benches/compare/queries.py

prints the median time of a call, which includes about 3 us of Python. Meshes and poses are those of the bench. FCL has no rays.
"""

import math
import statistics
import time

import fcl
import numpy as np

from bumpy_ball import ball, tree


def direction(i):
    z = 1 - 2 * (i * 617 % 1000 + 0.5) / 1000
    angle, radius = 2.399963229728653 * i, math.sqrt(1 - z * z)
    return np.array([radius * math.cos(angle), radius * math.sin(angle), z])


def turned(i, distance):
    axis, angle = direction(i + 77), float(i)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return fcl.Transform(rotation, direction(i) * distance)


def median(call, poses):
    times = []
    for pose in poses:
        begin = time.perf_counter()
        call(pose)
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def rows(name, triangles):
    model = tree(*ball(triangles))
    fixed = fcl.CollisionObject(model, fcl.Transform())
    box = fcl.Box(0.1, 0.1, 0.1)

    def distance(geometry):
        return lambda pose: fcl.distance(fixed, fcl.CollisionObject(geometry, pose), fcl.DistanceRequest(), fcl.DistanceResult())

    def collide(pose):
        return fcl.collide(fixed, fcl.CollisionObject(model, pose), fcl.CollisionRequest(), fcl.CollisionResult())

    apart = lambda least: [turned(i, least + 0.15 + 0.5 * i / 1000) for i in range(0, 1000, 10)]
    yield f"{name}/distance to box", median(distance(box), apart(0.6))
    yield f"{name}/distance to mesh", median(distance(model), apart(1.0))
    for kind, gap in [("near miss", 1.02), ("overlap", 0.6)]:
        yield f"{name}/collision, {kind}", median(collide, [turned(i, gap) for i in range(0, 1000, 10)])


for name, triangles in [("20k", 20_000), ("200k", 200_000)]:
    for row, seconds in rows(name, triangles):
        print(f"{row:40} {seconds * 1e6:12.1f} us", flush=True)
