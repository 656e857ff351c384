"""Compares this crate's robots with those of yourdfpy and pinocchio: frames of links at random positions, masses, inertias.

    cargo build --release -p swanilda-robot-description --example link_poses
    pip install yourdfpy pin
    python compare.py target/release/examples/link_poses FOLDER_OR_FILE...

Prints a line per file and the greatest differences; the exit status is 1 if one is too large, or if a file is not read.
"""

import logging
import math
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio
import yourdfpy

CONFIGURATIONS = 100
MOVING = {"Revolute", "Continuous", "Prismatic"}


class Ours:
    """What the example prints for a file."""

    def __init__(self, program, file):
        lines = self.run(program, file, "").splitlines()
        self.warnings = [line for line in lines if line.startswith("warning")]
        self.joints = [line.split("\t")[1:] for line in lines if line.startswith("joint")]
        self.links = [line.split("\t")[1:] for line in lines if line.startswith("link")]
        self.moving = [name for name, kind, mimics in self.joints if kind in MOVING and mimics == "false"]
        positions = [{name: random.uniform(-3, 3) for name in self.moving} for _ in range(CONFIGURATIONS)]
        text = "".join("\t".join(f"{name}={value!r}" for name, value in row.items()) + "\n" for row in positions)
        rows = [line.split("\t")[1] for line in self.run(program, file, text).splitlines() if line.startswith("poses")]
        self.positions = positions
        self.poses = np.array([[float(word) for word in row.split()] for row in rows]).reshape(len(rows), -1, 7)

    @staticmethod
    def run(program, file, text):
        done = subprocess.run([program, file], input=text, capture_output=True, text=True)
        if done.returncode != 0:
            raise ValueError(done.stderr.strip())
        return done.stdout

    def frames(self, configuration):
        """Link name -> 4x4 matrix."""
        return {link[0]: matrix(pose) for link, pose in zip(self.links, self.poses[configuration])}

    def inertials(self):
        """Link name -> mass, centre of mass, inertia about it in the link's frame."""
        result = {}
        for name, *rest in self.links:
            if rest:
                numbers = [float(word) for word in rest[0].split()]
                rotation = matrix(numbers[1:8])[:3, :3]
                xx, xy, xz, yy, yz, zz = numbers[8:14]
                inertia = rotation @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ rotation.T
                result[name] = numbers[0], np.array(numbers[1:4]), inertia
        return result


def matrix(pose):
    x, y, z, qx, qy, qz, qw = pose
    result = pinocchio.XYZQUATToSE3(np.array([x, y, z, qx, qy, qz, qw]))
    return result.homogeneous


def frame_difference(a, b):
    return float(np.abs(a - b).max())


def against_yourdfpy(ours, file):
    theirs = yourdfpy.URDF.load(str(file), load_meshes=False, build_scene_graph=True, load_collision_meshes=False, build_collision_scene_graph=False)
    if any(joint.mimic and joint.mimic.joint not in theirs.joint_map for joint in theirs.robot.joints):
        raise ValueError("joints mimic one that is not there: it takes them for fixed ones, we let them move")
    largest = 0.0
    base = theirs.base_link
    for number, positions in enumerate(ours.positions):
        theirs.update_cfg({name: positions[name] for name in theirs.actuated_joint_names})
        frames = ours.frames(number)
        start = np.linalg.inv(frames[base])
        for name in theirs.link_map:
            largest = max(largest, frame_difference(start @ frames[name], theirs.get_transform(name, base)))
    return largest


def against_pinocchio(ours, file):
    model = pinocchio.buildModelFromUrdf(str(file), mimic=True)
    data = model.createData()
    largest = 0.0
    for number, positions in enumerate(ours.positions):
        q = pinocchio.neutral(model)
        for name, value in positions.items():
            joint = model.joints[model.getJointId(name)]
            q[joint.idx_q : joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [math.cos(value), math.sin(value)]
        pinocchio.framesForwardKinematics(model, data, q)
        frames = ours.frames(number)
        bodies = [frame for frame in range(model.nframes) if model.frames[frame].type == pinocchio.FrameType.BODY]
        start = np.linalg.inv(frames[model.frames[bodies[0]].name])
        for body in bodies:
            there = data.oMf[bodies[0]].inverse() * data.oMf[body]
            largest = max(largest, frame_difference(start @ frames[model.frames[body].name], there.homogeneous))
    return largest


def masses(ours, file):
    """The greatest difference of mass and inertia to yourdfpy, which keeps them by link."""
    theirs = yourdfpy.URDF.load(str(file), load_meshes=False, build_scene_graph=False)
    largest = 0.0
    for name, (mass, centre, inertia) in ours.inertials().items():
        other = theirs.link_map[name].inertial
        if other is None or other.mass is None:
            continue
        origin = np.eye(4) if other.origin is None else other.origin
        turned = origin[:3, :3] @ other.inertia @ origin[:3, :3].T if other.inertia is not None else np.zeros((3, 3))
        largest = max(largest, abs(mass - other.mass), frame_difference(centre, origin[:3, 3]), frame_difference(inertia, turned))
    return largest


def attempt(compare, ours, file):
    try:
        return compare(ours, file)
    except Exception as error:  # What the other program refuses is not compared.
        return f"refused ({type(error).__name__})"


def main():
    logging.disable(logging.CRITICAL)
    random.seed(1)
    program, *names = sys.argv[1:]
    files = [file for name in names for file in (sorted(Path(name).rglob("*.urdf")) if Path(name).is_dir() else [Path(name)])]
    counts = {"read": 0, "not read": 0, "with warnings": 0}
    results = {"yourdfpy": [], "pinocchio": [], "masses": []}
    for file in files:
        try:
            ours = Ours(program, file)
        except ValueError as error:
            counts["not read"] += 1
            print(f"{file}: NOT READ: {error}")
            continue
        counts["read"] += 1
        counts["with warnings"] += bool(ours.warnings)
        row = {"yourdfpy": attempt(against_yourdfpy, ours, file), "pinocchio": attempt(against_pinocchio, ours, file), "masses": attempt(masses, ours, file)}
        for key, value in row.items():
            results[key].append(value)
        print(f"{file.name}: {len(ours.links)} links, {len(ours.moving)} joints, {len(ours.warnings)} warnings, {row}", flush=True)
    print(counts)
    bad = 0
    for key, limit in (("yourdfpy", 1e-9), ("pinocchio", 1e-9), ("masses", 1e-6)):
        numbers = [value for value in results[key] if not isinstance(value, str)]
        bad += sum(not value <= limit for value in numbers)
        print(f"{key}: {len(numbers)} compared, greatest difference {max(numbers, default=0.0):.3g}, refused {len(results[key]) - len(numbers)}")
    sys.exit(1 if bad or counts["not read"] else 0)


if __name__ == "__main__":
    main()
