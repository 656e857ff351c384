"""Motion planning by simOMPL and by the Python bindings of OMPL: an arm among ten obstacles, a rod through a window.

    python3 -m venv target/venv && target/venv/bin/pip install numpy ompl python-fcl
    cargo build --release && target/venv/bin/python benches/compare/planning.py [queries of each task]

Both have the same meshes, queries, state spaces, resolution (0.01) and algorithms with their default parameters. OMPL asks FCL (python-fcl: a call for each link, all
obstacles in one tree) whether a state is valid. Times are processor time without setup. Every path of ours is checked by FCL, which shares nothing
with it, at all states at which its motions were checked. SWANILDA names another binary.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
import time

import fcl
import numpy as np
from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

from bumpy_ball import ball, tree
from kinematics import ur5

HERE = os.path.dirname(os.path.abspath(__file__))
PLANNERS = ["RRTConnect", "RRT", "PRM"]
SECONDS, RESOLUTION = 20.0, 0.01


def link(begin, end, radius):
    """A bumpy ellipsoid from one point to another."""
    axis = np.asarray(end, float) - begin
    length = np.linalg.norm(axis)
    z = axis / length
    x = np.cross([0.0, 1.0, 0.0] if abs(z[1]) < 0.9 else [1.0, 0.0, 0.0], z)
    x /= np.linalg.norm(x)
    vertices, faces = ball(1000, [2 * radius, 2 * radius, length + radius])
    return vertices @ np.array([x, np.cross(z, x), z]) + (np.asarray(begin) + end) / 2, faces


def box(low, high):
    corners = np.array([[(low, high)[i >> a & 1][a] for a in range(3)] for i in range(8)], float)
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
    return corners, np.array(faces)


def merged(meshes):
    offsets = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    return np.concatenate([m[0] for m in meshes]), np.concatenate([m[1] + o for m, o in zip(meshes, offsets)])


def collision_object(mesh):
    return fcl.CollisionObject(tree(*mesh), fcl.Transform())


class Task:
    """Links (in the frames of the bodies), obstacles, and what FCL says of a state."""

    def __init__(self, name, links, obstacles):
        self.name, self.links, self.obstacles = name, links, obstacles
        self.bodies, self.still = [collision_object(mesh) for mesh in links], collision_object(merged(obstacles))
        self.request = fcl.CollisionRequest()
        self.checks, self.checking = 0, 0.0

    def is_valid(self, state):
        begin = time.perf_counter()
        free = self.is_free(state)
        self.checks, self.checking = self.checks + 1, self.checking + time.perf_counter() - begin
        return free

    def is_free(self, state):
        for body, (rotation, translation) in zip(self.bodies, self.poses(state)):
            body.setTransform(fcl.Transform(rotation, translation))
            if fcl.collide(body, self.still, self.request, fcl.CollisionResult()):
                return False
        return True

    def draw_queries(self, count, random):
        queries = []
        while len(queries) < count:
            pair = [self.draw(random), self.draw(random)]
            blocked = any(not self.is_free(self.between(*pair, t)) for t in np.linspace(0, 1, 50))
            if blocked and all(self.is_free(state) for state in pair):
                queries.append(pair)
        return queries


class ArmTask(Task):
    def __init__(self):
        self.arm = ur5()
        steps = self.arm.before[1:] + [self.arm.to_tip]
        links = []
        for step in steps:
            end = step[:3, 3] if np.linalg.norm(step[:3, 3]) > 0.01 else np.array([0, 0, 0.05])
            links.append(link(np.zeros(3), end, 0.04))
        # On a spiral around the arm.
        obstacles = []
        for i in range(10):
            angle, radius, height = 2.4 * i, 0.45 + 0.05 * (i % 5), 0.1 + 0.08 * i
            vertices, faces = ball(1000, 0.22)
            obstacles.append((vertices + [radius * math.cos(angle), radius * math.sin(angle), height], faces))
        super().__init__("arm among ten obstacles", links, obstacles)

    def frames(self, state):
        pose, frames = np.eye(4), []
        for before, q in zip(self.arm.before, state):
            c, s = math.cos(q), math.sin(q)
            pose = pose @ before @ np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
            frames.append(pose)
        return frames

    def poses(self, state):
        return [(frame[:3, :3], frame[:3, 3]) for frame in self.frames(state)]

    def draw(self, random):
        return [float(q) for q in random.uniform(-math.pi, math.pi, 6)]

    def between(self, a, b, t):
        return [x + t * (y - x) for x, y in zip(a, b)]

    def distance(self, a, b):
        return float(np.abs(np.subtract(a, b)).sum())

    def space(self):
        space = ob.CompoundStateSpace()
        for _ in range(6):
            joint = ob.RealVectorStateSpace(1)
            joint.setBounds(-math.pi, math.pi)
            space.addSubspace(joint, 1.0)
        return space

    def read(self, state):
        return [state[i][0] for i in range(6)]

    def write(self, state, numbers):
        for i, number in enumerate(numbers):
            state[i][0] = number

    def in_lua(self):
        zero = self.frames([0.0] * 6)
        robot = [(v @ f[:3, :3].T + f[:3, 3], faces) for (v, faces), f in zip(self.links, zero)]
        return {"robot": robot, "joints": [before[:3].ravel().tolist() for before in self.arm.before]}


class RodTask(Task):
    """A rod, 0.8 long along its y axis, that must turn to pass a window of 0.4 in a wall at x = 0."""

    def __init__(self):
        rod = link(np.array([0, -0.36, 0]), np.array([0, 0.36, 0]), 0.04)
        h, t, w = 0.2, 0.05, 2.0
        wall = [box([-t, -w, -w], [t, -h, w]), box([-t, h, -w], [t, w, w]), box([-t, -h, -w], [t, h, -h]), box([-t, -h, h], [t, h, w])]
        super().__init__("rod through a window", [rod], wall)

    def poses(self, state):
        x, y, z, w = np.array(state[3:]) / np.linalg.norm(state[3:])
        rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        return [(rotation, np.array(state[:3]))]

    def draw(self, random):
        turn = random.normal(size=4)
        return [float(x) for x in random.uniform(-1, 1, 3)] + [float(x) for x in turn / np.linalg.norm(turn)]

    def draw_queries(self, count, random):
        queries = []
        while len(queries) < count:
            pair = [self.draw(random), self.draw(random)]
            if pair[0][0] < -0.3 and pair[1][0] > 0.3 and all(self.is_free(state) for state in pair):
                queries.append(pair)
        return queries

    def distance(self, a, b):
        turn = abs(sum(p * q for p, q in zip(a[3:], b[3:])))
        return math.dist(a[:3], b[:3]) + math.acos(min(1.0, turn))

    def space(self):
        space, bounds = ob.SE3StateSpace(), ob.RealVectorBounds(3)
        bounds.setLow(-1)
        bounds.setHigh(1)
        space.setBounds(bounds)
        return space

    def read(self, state):
        turn = state.rotation()
        return [state.getX(), state.getY(), state.getZ(), turn.x, turn.y, turn.z, turn.w]

    def write(self, state, numbers):
        state.setXYZ(*numbers[:3])
        turn = state.rotation()
        turn.x, turn.y, turn.z, turn.w = numbers[3:]

    def in_lua(self):
        return {"robot": self.links, "low": [-1.0] * 3, "high": [1.0] * 3}


class Row:
    """What one planner of one library has found."""

    def __init__(self):
        self.solve, self.simplify, self.first, self.short, self.wrong, self.checks, self.checking = [], [], [], [], 0, 0, 0.0

    def print(self, name, asked):
        middle = lambda values, factor=1: f"{np.median(values) * factor:.3g}" if values else "-"
        mean = f"{np.mean(self.solve) * 1e3:.3g}" if self.solve else "-"
        print(f"| {name} | {len(self.first)}/{asked} | {middle(self.solve, 1e3)} ({mean}) | {middle(self.first)} | "
              f"{middle(self.simplify, 1e3)} | {middle(self.short)} |", flush=True)


def of_ompl(task, planner, queries):
    row = Row()
    for query in queries:
        setup = og.SimpleSetup(task.space())
        setup.setStateValidityChecker(lambda state: task.is_valid(task.read(state)))
        information = setup.getSpaceInformation()
        information.setStateValidityCheckingResolution(RESOLUTION)
        ends = [setup.getStateSpace().allocState() for _ in query]
        for state, numbers in zip(ends, query):
            task.write(state, numbers)
        setup.setStartAndGoalStates(*ends)
        setup.setPlanner(getattr(og, planner)(information))
        setup.setup()
        task.checks, task.checking, begin = 0, 0.0, time.process_time()
        setup.solve(SECONDS)
        row.solve.append(time.process_time() - begin)
        row.checks, row.checking = row.checks + task.checks, row.checking + task.checking
        if setup.haveExactSolutionPath():
            row.first.append(setup.getSolutionPath().length())
            begin = time.process_time()
            setup.simplifySolution()
            row.simplify.append(time.process_time() - begin)
            row.short.append(setup.getSolutionPath().length())
    return row


def lua(value):
    if isinstance(value, dict):
        return "{" + ",".join(f"{key}={lua(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "{" + ",".join(map(lua, value)) + "}"
    return json.dumps(value)


def of_swanilda(task, queries, states):
    flat = lambda mesh: {"vertices": mesh[0].ravel().tolist(), "triangles": mesh[1].ravel().tolist()}
    table = task.in_lua() | {"queries": queries, "states": states, "planners": PLANNERS, "time": SECONDS}
    table |= {"robot": list(map(flat, table["robot"])), "obstacles": list(map(flat, task.obstacles))}
    binary = os.environ.get("SWANILDA", os.path.join(HERE, "../../target/release/swanilda"))
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(HERE, "planning.lua")) as source:
        path = os.path.join(folder, "task.lua")
        with open(path, "w") as file:
            file.write(f"TASK = {lua(table)}\n" + source.read())
        result = subprocess.run([binary, "run", path, "--empty", "--time", "0.05"], capture_output=True, text=True, timeout=3000)
    if result.returncode:
        raise RuntimeError(result.stdout[-2000:] + result.stderr[-2000:])
    return rows_of(result.stdout, task, states)


def rows_of(output, task, states):
    rows, paths, same = {planner: Row() for planner in PLANNERS}, [], 0
    for words in map(str.split, output.splitlines()):
        # Before the first word of ours stands what the log puts in front.
        found = next((i for i, word in enumerate(words) if word in ("VALID", "FOUND", "FAILED", "PATH")), None)
        if found is None:
            continue
        kind, rest = words[found], words[found + 1:]
        if kind == "VALID":
            same += (rest[1] == "true") == task.is_free(states[int(rest[0]) - 1])
            continue
        if kind != "PATH":
            row, paths = rows[rest[0]], []
            row.solve.append(float(rest[2]))
            row.simplify += [float(rest[3])] if kind == "FOUND" else []
            continue
        numbers, width = [float(number) for number in rest], len(states[0])
        paths.append([numbers[i:i + width] for i in range(0, len(numbers), width)])
        if len(paths) == 3:
            length = lambda path: sum(map(task.distance, path, path[1:]))
            row.first.append(length(paths[0]))
            row.short.append(length(paths[1]))
            row.wrong += sum(not task.is_free(state) for state in paths[2])
    return rows, same


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    ou.setLogLevel(ou.LogLevel.LOG_NONE)
    for task in (ArmTask(), RodTask()):
        random = np.random.default_rng(2024)
        queries = task.draw_queries(count, random)
        states = [task.draw(random) for _ in range(500)]
        ours, same = of_swanilda(task, queries, states)
        print(f"\n{task.name}: {same} of {len(states)} random states valid in both or in neither\n")
        print("| planner | found | solve, ms: median (mean) | length | simplify, ms | length |\n|---|---|---|---|---|---|")
        for planner in PLANNERS:
            ours[planner].print(f"simOMPL, {planner}", count)
            assert ours[planner].wrong == 0, "FCL finds a collision on a path"
            row = of_ompl(task, planner, queries)
            row.print(f"OMPL, {planner}", count)
            each = row.checking / max(1, row.checks) * 1e6
            print(f"<!-- {row.checks / count:.0f} checks of {each:.0f} us (wall time) -->", flush=True)


if __name__ == "__main__":
    main()
