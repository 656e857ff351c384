#!/usr/bin/env python3
"""Real robots, imported and let go: `benches/robots.py [BINARY]` after `cargo build --release`, writes the table in docs/COMPATIBILITY.md.

    pip install numpy yourdfpy pybullet example-robot-data

For each URDF file of ROBOTS:

- kinematics: joints, links and force sensors of the scene against yourdfpy, at random positions of all joints; largest difference of their frames;
- masses: mass, centre of mass and inertia of each link that has them, against the file as yourdfpy reads it; largest difference;
- held: five seconds under gravity in position control, with its base fixed: how far the farthest joint is from its target at the end;
- on the floor: the same with a free base, on the floor of the default scene: speed of the fastest link in all this time.
"""

import logging
import random
import re
import subprocess
import sys
import tempfile
from io import BytesIO
from pathlib import Path

import numpy as np
import yourdfpy

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "COMPATIBILITY.md"
MARK = "<!-- robots -->\n"
CONFIGURATIONS = 100
# A robot that holds: rad or m. One that falls over is fast, fingertips of humanoids most of all, but not faster than this: m/s.
HELD, EXPLODED = 0.01, 50.0
# Of a link with less, all importers make something else.
NO_INERTIA = 1e-15
SHAPE, JOINT, FORCE_SENSOR = 0, 1, 12
SITE = Path(yourdfpy.__file__).parent.parent
EXAMPLES = "cmeel.prefix/share/example-robot-data/robots/"
ROBOTS = {
    "UR3": EXAMPLES + "ur_description/urdf/ur3_robot.urdf",
    "UR5": EXAMPLES + "ur_description/urdf/ur5_robot.urdf",
    "UR10": EXAMPLES + "ur_description/urdf/ur10_robot.urdf",
    "Panda": EXAMPLES + "panda_description/urdf/panda.urdf",
    "KUKA iiwa": "pybullet_data/kuka_iiwa/model.urdf",
    "xArm 6": "pybullet_data/xarm/xarm6_robot.urdf",
    "Kinova": EXAMPLES + "kinova_description/robots/kinova.urdf",
    "SO-101": EXAMPLES + "so_arm_description/urdf/so101.urdf",
    "Allegro hand": EXAMPLES + "allegro_hand_description/urdf/allegro_right_hand.urdf",
    "TIAGo": EXAMPLES + "tiago_description/robots/tiago.urdf",
    "TIAGo without hand": EXAMPLES + "tiago_description/robots/tiago_no_hand.urdf",
    "TALOS": EXAMPLES + "talos_data/robots/talos_reduced.urdf",
    "ANYmal B": EXAMPLES + "anymal_b_simple_description/robots/anymal.urdf",
    "ANYmal B with Kinova": EXAMPLES + "anymal_b_simple_description/robots/anymal-kinova.urdf",
    "ANYmal C": EXAMPLES + "anymal_c_simple_description/urdf/anymal.urdf",
    "Unitree A1": EXAMPLES + "a1_description/urdf/a1.urdf",
    "Unitree Go1": EXAMPLES + "go1_description/urdf/go1.urdf",
    "Unitree Go2": EXAMPLES + "go2_description/urdf/go2.urdf",
    "Unitree B1": EXAMPLES + "b1_description/urdf/b1.urdf",
    "Unitree G1": EXAMPLES + "g1_description/urdf/g1_29dof_rev_1_0.urdf",
    "Unitree Laikago": "pybullet_data/laikago/laikago.urdf",
    "Mini Cheetah": "pybullet_data/mini_cheetah/mini_cheetah.urdf",
    "HyQ": EXAMPLES + "hyq_description/robots/hyq_no_sensors.urdf",
    "Solo 12": EXAMPLES + "solo_description/robots/solo12.urdf",
    "iCub": EXAMPLES + "icub_description/robots/icub_reduced.urdf",
    "Romeo": EXAMPLES + "romeo_description/urdf/romeo_small.urdf",
    "Husky": "pybullet_data/husky/husky.urdf",
    "R2D2": "pybullet_data/r2d2.urdf",
}


def alias(name):
    return re.sub(r"[^A-Za-z0-9_]", "_", name)


def run(binary, file, *options):
    command = [binary, "run", ROOT / "benches" / "robots.lua", "-q", "--verbosity", "errors", "-D", f"file={file}", *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=590)
    if done.returncode != 0:
        raise RuntimeError((done.stderr or done.stdout).strip()[-300:])
    return [line.split("\t") for line in done.stdout.splitlines()]


def matrix(numbers):
    x, y, z, qx, qy, qz, qw = numbers
    result = np.eye(4)
    result[:3, :3] = [
        [1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qz * qw), 2 * (qx * qz + qy * qw)],
        [2 * (qx * qy + qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qx * qw)],
        [2 * (qx * qz - qy * qw), 2 * (qy * qz + qx * qw), 1 - 2 * (qx * qx + qy * qy)],
    ]
    result[:3, 3] = x, y, z
    return result


def configurations(robot):
    """Random positions within the limits; joints that mimic others do."""
    rows = []
    for _ in range(CONFIGURATIONS):
        row = {}
        for joint in robot.robot.joints:
            if joint.type in ("revolute", "continuous", "prismatic"):
                low, high = -3.0, 3.0
                if joint.type != "continuous" and joint.limit is not None and joint.limit.lower is not None and joint.limit.upper is not None:
                    low, high = max(low, joint.limit.lower), min(high, joint.limit.upper)
                row[joint.name] = random.uniform(low, high)
        for joint in robot.robot.joints:
            if joint.mimic is not None and joint.name in row:
                row[joint.name] = joint.mimic.multiplier * row[joint.mimic.joint] + joint.mimic.offset
        rows.append(row)
    return rows


class Kinematics:
    def __init__(self, binary, file, robot):
        self.robot, self.rows = robot, configurations(robot)
        with tempfile.NamedTemporaryFile("w", suffix=".lua") as positions:
            tables = (", ".join(f"{alias(name)} = {value!r}" for name, value in row.items()) for row in self.rows)
            positions.write("return {" + ",\n".join("{" + table + "}" for table in tables) + "}")
            positions.flush()
            lines = run(binary, file, "--no-start", "-D", f"positions={positions.name}")
        self.masses = {line[1]: [float(word) for word in line[2].split()] for line in lines if line[0] == "mass"}
        self.poses = [{} for _ in self.rows]
        for line in lines:
            if line[0] == "pose":
                self.poses[int(line[1]) - 1][int(line[2]), line[3]] = matrix([float(word) for word in line[4].split()])
        self.offsets = {}

    def difference(self):
        return max(self.difference_at(number) for number in range(len(self.rows)))

    def difference_at(self, number):
        row, poses, worst = self.rows[number], self.poses[number], 0.0
        self.robot.update_cfg({name: row[name] for name in self.robot.actuated_joint_names})
        base = self.robot.base_link
        for joint in self.robot.robot.joints:
            kind = FORCE_SENSOR if joint.type == "fixed" else JOINT
            found = poses.get((kind, alias(joint.name)))
            if found is None:
                continue
            origin = np.eye(4) if joint.origin is None else joint.origin
            frame = self.robot.get_transform(joint.parent, base) @ origin
            axis = np.array([1.0, 0, 0]) if joint.axis is None else np.asarray(joint.axis, dtype=float)
            if kind == JOINT:
                worst = max(worst, np.abs(found[:3, 2] - frame[:3, :3] @ axis / np.linalg.norm(axis)).max())
            else:
                worst = max(worst, np.abs(found[:3, :3] - frame[:3, :3]).max())
            worst = max(worst, np.abs(found[:3, 3] - frame[:3, 3]).max())
        for link in self.robot.link_map:
            for suffix in ("respondable", "visual"):
                found = poses.get((SHAPE, f"{alias(link)}_{suffix}"))
                if found is not None:
                    # Where in the link the shape is, is a matter of the import; it has to be the same always.
                    offset = np.linalg.inv(self.robot.get_transform(link, base)) @ found
                    worst = max(worst, np.abs(offset - self.offsets.setdefault((link, suffix), offset)).max())
        return worst

    def mass_difference(self):
        worst, compared = 0.0, 0
        for name, link in self.robot.link_map.items():
            found, theirs = self.masses.get(f"{alias(name)}_respondable"), link.inertial
            if found is None or theirs is None or not theirs.mass or theirs.inertia is None or np.abs(theirs.inertia).max() < NO_INERTIA:
                continue
            offset = self.offsets[name, "respondable"]
            origin = np.eye(4) if theirs.origin is None else theirs.origin
            centre = offset[:3, :3] @ found[10:13] + offset[:3, 3]
            inertia = offset[:3, :3] @ np.reshape(found[1:10], (3, 3)) @ offset[:3, :3].T
            expected = origin[:3, :3] @ theirs.inertia @ origin[:3, :3].T
            worst = max(worst, abs(found[0] - theirs.mass), np.abs(centre - origin[:3, 3]).max(), np.abs(inertia - expected).max())
            compared += 1
        return worst, compared


def held(binary, file):
    """The joint that is farthest from its target: how far, its name, its force and the largest one that it may have."""
    lines = run(binary, file, "--empty", "--time", "5", "-D", "base=fixed")
    joints = [(abs(float(line[2])), line[1], float(line[3]), float(line[4])) for line in lines if line[0] == "joint"]
    return max(joints, default=(0.0, "", 0.0, 0.0))


def free(binary, file):
    return next(float(line[2]) for line in run(binary, file, "--time", "5", "-D", "base=free") if line[0] == "end")


def independent(file):
    # What only ROS can expand is zero to us, and an error to yourdfpy.
    text = re.sub(rb'"\$\(optenv [^"]*"', b'"0 0 0"', file.read_bytes())
    return yourdfpy.URDF.load(BytesIO(text), load_meshes=False, build_collision_scene_graph=False, load_collision_meshes=False)


def row(binary, name, file):
    robot = independent(file)
    kinematics = Kinematics(binary, file, robot)
    apart, (heavier, links) = kinematics.difference(), kinematics.mass_difference()
    error, joint, force, limit = held(binary, file)
    speed = free(binary, file)
    weak = f": `{joint}`, {abs(force):.3g} of {limit:.3g}" if error > HELD else ""
    is_right = apart <= 1e-9 and heavier <= 1e-6 and error <= HELD and speed <= EXPLODED
    text = f"| {name} | {len(robot.actuated_joint_names)} | {apart:.0e} | {links} | {heavier:.0e} | {error:.0e}{weak} | {speed:.2g} |"
    return is_right, text


def main():
    logging.disable(logging.CRITICAL)
    random.seed(1)
    binary = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "target" / "release" / "swanilda").absolute()
    chosen = sys.argv[2:] or list(ROBOTS)
    rows, wrong = [], []
    for name in chosen:
        is_right, text = row(binary, name, SITE / ROBOTS[name])
        rows.append(text)
        print(text, flush=True)
        if not is_right:
            wrong.append(name)
    if chosen == list(ROBOTS):
        write(rows)
    if wrong:
        sys.exit(f"not as expected: {', '.join(wrong)}")


def write(rows):
    head = ["| robot | joints | frames | links with mass | masses | held | on the floor |", "|---|---|---|---|---|---|---|"]
    before, _, after = PAGE.read_text().split(MARK)
    PAGE.write_text(before + MARK + "\n".join(head + rows) + "\n" + MARK + after)


if __name__ == "__main__":
    main()
