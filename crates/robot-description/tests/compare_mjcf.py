"""Compares this crate's models with those of MuJoCo: frames of bodies at random positions of all joints, masses, inertias.

    cargo build --release -p swanilda-robot-description --example link_poses
    pip install mujoco
    python compare_mjcf.py target/release/examples/link_poses FOLDER_OR_FILE...

Prints a line per file and the greatest differences; the exit status is 1 if one is too large, or if a file that MuJoCo reads is not read.
"""

import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np

CONFIGURATIONS = 100
MOVING = {"Revolute", "Continuous", "Prismatic", "Spherical"}


def run(program, file, text):
    done = subprocess.run([program, file], input=text, capture_output=True, text=True)
    if done.returncode != 0:
        raise ValueError(done.stderr.strip())
    return [line.split("\t") for line in done.stdout.splitlines()]


class Comparison:
    def __init__(self, program, file, model):
        self.model, self.random = model, np.random.default_rng(1)
        lines = run(program, file, "")
        self.warnings = sum(line[0] == "warning" for line in lines)
        names = [line[1] for line in lines if line[0] == "line"]
        # Links without a line are between the joints of a body; the first one is the world. Bodies are in the same order.
        self.bodies = [0] + [index for index, line in enumerate(line for line in lines if line[0] == "line") if line[2] != "0"]
        self.links = [line[1:] for line in lines if line[0] == "link"]
        assert len(names) == len(self.links)
        if len(self.bodies) != model.nbody:
            raise ValueError(f"{len(self.bodies)} bodies instead of {model.nbody}")
        self.joints = [line[1] for line in lines if line[0] == "joint" and line[2] in MOVING]
        self.theirs = [joint for joint in range(model.njnt) if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE]
        if len(self.joints) != len(self.theirs):
            raise ValueError(f"{len(self.joints)} joints instead of {len(self.theirs)}")
        if len(set(self.joints)) != len(self.joints):
            raise ValueError("joints of the same name")
        self.program, self.file = program, file

    def frames(self):
        model, data = self.model, mujoco.MjData(self.model)
        rows, text = [], []
        for _ in range(CONFIGURATIONS):
            q, pairs = model.qpos0.copy(), []
            for name, joint in zip(self.joints, self.theirs):
                at = model.jnt_qposadr[joint]
                if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_BALL:
                    w, x, y, z = quaternion = self.random.normal(size=4)
                    q[at : at + 4] = quaternion / np.linalg.norm(quaternion)
                    pairs.append(f"{name}={x!r},{y!r},{z!r},{w!r}".replace("np.float64(", "").replace(")", ""))
                else:
                    q[at] = self.random.uniform(-3, 3)
                    pairs.append(f"{name}={float(q[at])!r}")
            rows.append(q)
            text.append("\t".join(pairs) + "\n")
        lines = [line for line in run(self.program, self.file, "".join(text)) if line[0] == "poses"]
        largest = 0.0
        for q, line in zip(rows, lines, strict=True):
            data.qpos[:] = q
            mujoco.mj_kinematics(model, data)
            ours = np.array([float(word) for word in line[1].split()]).reshape(-1, 7)[self.bodies]
            largest = max(largest, np.abs(ours[:, :3] - data.xpos).max())
            quaternions = ours[:, [6, 3, 4, 5]]
            signs = np.sign((quaternions * data.xquat).sum(axis=1))[:, None]
            largest = max(largest, np.abs(quaternions * signs - data.xquat).max())
        return largest

    def masses(self):
        """The greatest difference of mass, centre and inertia in the frame of the body; of bodies of more than 1 kg, as a part of the mass."""
        largest = 0.0
        for body, link in enumerate(self.bodies):
            name, *rest = self.links[link]
            mass = self.model.body_mass[body]
            if not rest:
                largest = max(largest, mass if body else 0.0)
                continue
            numbers = [float(word) for word in rest[0].split()]
            xx, xy, xz, yy, yz, zz = numbers[8:14]
            ours = turned(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), np.array(numbers[4:8])[[3, 0, 1, 2]])
            theirs = turned(np.diag(self.model.body_inertia[body]), self.model.body_iquat[body])
            scale = max(1.0, mass)
            worst = max(abs(numbers[0] - mass), np.abs(numbers[1:4] - self.model.body_ipos[body]).max(), np.abs(ours - theirs).max()) / scale
            if worst > 1e-6:
                print(f"    {name}: {worst:.3g}; {numbers[0]:.6g} kg, there {mass:.6g}")
            largest = max(largest, worst)
        return largest


def turned(inertia, quaternion):
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, quaternion)
    rotation = rotation.reshape(3, 3)
    return rotation @ inertia @ rotation.T


def main():
    program, *names = sys.argv[1:]
    files = [file for name in names for file in (sorted(Path(name).rglob("*.xml")) if Path(name).is_dir() else [Path(name)])]
    files = [file for file in files if b"<mujoco" in file.read_bytes()]
    refused = bad = 0
    frames, masses = [], []
    for file in files:
        try:
            model = mujoco.MjModel.from_xml_path(str(file))
        except ValueError as error:
            refused += 1
            print(f"{file}: MuJoCo refuses it: {str(error).splitlines()[0]}")
            continue
        try:
            comparison = Comparison(program, str(file), model)
            apart, heavier = comparison.frames(), comparison.masses()
        except ValueError as error:
            bad += 1
            print(f"{file}: {error}")
            continue
        frames.append(apart)
        masses.append(heavier)
        bad += apart > 1e-9 or heavier > 1e-6
        print(f"{file.parent.name}/{file.name}: {model.nbody} bodies, {model.njnt} joints, {comparison.warnings} warnings, frames {apart:.2g}, masses {heavier:.2g}")
    print(f"{len(frames)} compared, frames {max(frames, default=0):.3g}, masses {max(masses, default=0):.3g}; MuJoCo refuses {refused}; {bad} not as expected")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
