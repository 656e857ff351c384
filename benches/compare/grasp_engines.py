"""A case of grasp_scenes.py in one engine: `run(case)` gives rows of the time and the object's place in the palm, its largest acceleration beyond the palm's
(m/s2, between the lift and the hold), and the seconds per sub-step while it is held."""

import math
import os
import tempfile
import time

import mujoco
import numpy as np
import pybullet as p

from engines import SUBSTEPS
from lua_scene import run_lua

CLOSING_SPEED, BASE_FORCE = 0.05, 1e4
# Of MuJoCo's servos, per metre or radian; its driving finger is slowed by a damper, since a velocity servo with a bound swings at such a step.
BASE_STIFFNESS, BASE_DAMPING, ROTOR, DRIVER_DAMPING = 1e6, 2e4, 100, 5


def swanilda(case):
    rows, told = [], {}
    for words in run_lua("grasps.lua", {"CASE": case}, 1000):
        if "ROW" in words:
            rows.append([float(x) for x in words[words.index("ROW") + 1:]])
        elif "TOOK" in words or "PEAK" in words:
            told[words[-2]] = float(words[-1])
    if len(told) < 2:
        raise RuntimeError("the scene did not end")
    return np.array(rows), told["PEAK"], told["TOOK"]


class Held:
    """What the engines of Python have in common: `command` sets what sub-step k of the path asks for, `advance` makes some sub-steps."""

    def __init__(self, case):
        self.case, self.path, self.rows, self.peak, self.before = case, np.array(case["path"]), [], 0.0, np.zeros(3)
        self.velocities = np.diff(self.path, axis=0, prepend=0) / case["step"]
        self.accelerations = np.diff(self.velocities, axis=0, prepend=0) / case["step"]

    def force(self, k):
        """Of the driving finger."""
        return self.case["fingers"][0]["force"] * self.case["squeeze"][k]

    def measure(self, k):
        now = np.array(self.velocity())
        if k >= self.case["start"]:
            self.peak = max(self.peak, np.linalg.norm((now - self.before) / self.case["step"] - self.case["accelerations"][k]))
        self.before = now

    def row(self, steps):
        at, axes = self.place()
        self.rows.append([steps * self.case["step"], *(axes.T @ at)])

    def run(self):
        count = len(self.path)
        for k in range(count):
            self.command(k)
            self.advance(1)
            self.measure(k)
            if (k + 1) % SUBSTEPS == 0:
                self.row(k + 1)
        began, more = time.perf_counter(), round(self.case["hold"] / self.case["step"])
        for k in range(0, more, SUBSTEPS):
            self.advance(SUBSTEPS)
            self.row(count + k + SUBSTEPS)
        return np.array(self.rows), self.peak, (time.perf_counter() - began) / more


AXES = ("1 0 0", "0 1 0", "0 0 1", "1 0 0", "0 1 0")


def numbers(values):
    return " ".join(repr(float(x)) for x in values)


def turned(yaw):
    return f'quat="{math.cos(yaw / 2)!r} 0 0 {math.sin(yaw / 2)!r}"'


def mjcf(case, option):
    friction, assets = f'friction="{case["friction"]} 0.005 0.0001"', []

    def geom(part, number):
        at = f'pos="{numbers(part["at"])}" {turned(part["yaw"])} contype="1" conaffinity="3" {friction}'
        if part["kind"] == "mesh":
            points, faces = np.ravel(part["vertices"]), np.ravel(part["faces"])
            assets.append(f'<mesh name="m{number}" vertex="{numbers(points)}" face="{" ".join(map(str, faces))}" inertia="convex"/>')
            # The compiler moves a mesh to its centre, and the geom back.
            return f'<geom type="mesh" mesh="m{number}" {at}/>'
        size, kind = part["size"], {"box": "box", "ball": "sphere", "cylinder": "cylinder"}[part["kind"]]
        half = {"box": np.multiply(size, 0.5), "ball": [size[0] / 2], "cylinder": [size[0] / 2, size[2] / 2]}[part["kind"]]
        return f'<geom type="{kind}" size="{numbers(half)}" {at}/>'

    def finger(it, number):
        slide = ""
        if it["drives"]:
            drivers.append(f'<motor joint="driver{number}"/>')
            slide = f'<joint name="driver{number}" type="slide" axis="{numbers(it["inward"])}" damping="{DRIVER_DAMPING}"/>'
        return (f'<body pos="{numbers(it["at"])}">{slide}<geom type="box" size="{numbers(np.multiply(case["pad"], 0.5))}" {turned(it["yaw"])} '
                f'mass="{case["pad_mass"]}" contype="2" conaffinity="1" {friction}/></body>')

    def carrier(i, inner):
        """A link of the base; what a servo's force has to accelerate is told beforehand."""
        kind = "slide" if i < 3 else "hinge"
        servos.append(f'<position joint="j{i}" kp="{BASE_STIFFNESS}"/><velocity joint="j{i}" kv="{BASE_DAMPING}"/><motor joint="j{i}" gear="{ROTOR}"/>')
        return (f'<body name="b{i}"><inertial pos="0 0 0.1" mass="1" diaginertia="6e-4 6e-4 6e-4"/>'
                f'<joint name="j{i}" type="{kind}" axis="{AXES[i]}" armature="{ROTOR}"/>{inner}</body>')

    servos, drivers = [], []
    hand = "".join(finger(it, number) for number, it in enumerate(case["fingers"]))
    for i in reversed(range(5 if case["moving"] else 0)):
        hand = carrier(i, hand)
    things = case["object"]
    solid = "".join(geom(part, number) for number, part in enumerate(things["parts"]))
    body = f'<body name="object"><freejoint/><inertial pos="0 0 0" mass="{things["mass"]}" diaginertia="{numbers(things["inertia"])}"/>{solid}</body>'
    table = f'<geom type="box" size="0.5 0.5 0.05" pos="0 0 {case["table"] - 0.05}" contype="2" conaffinity="1" {friction}/>' if case["table"] else ""
    return (f'<mujoco><option timestep="{case["step"]}" integrator="implicitfast" {option}/><asset>{"".join(assets)}</asset>'
            f'<worldbody>{table}{hand}{body}</worldbody><actuator>{"".join(reversed(servos))}{"".join(drivers)}</actuator></mujoco>')


class InMujoco(Held):
    def __init__(self, case, option):
        super().__init__(case)
        self.model = mujoco.MjModel.from_xml_string(mjcf(case, option))
        self.data = mujoco.MjData(self.model)
        self.object, self.palm = self.model.body("object").id, self.model.body("b4").id if case["moving"] else 0

    def command(self, k):
        self.model.opt.gravity[:] = self.case["gravity"][k]
        self.data.ctrl[:] = self.force(k)
        if self.case["moving"]:
            # A spring acts on where the base is before the sub-step.
            self.data.ctrl[0:15:3], self.data.ctrl[1:15:3], self.data.ctrl[2:15:3] = self.path[max(k - 1, 0)], self.velocities[k], self.accelerations[k]

    def advance(self, steps):
        mujoco.mj_step(self.model, self.data, steps)

    def velocity(self):
        return self.data.qvel[-6:-3]

    def place(self):
        mujoco.mj_kinematics(self.model, self.data)
        return self.data.xpos[self.object] - self.data.xpos[self.palm], self.data.xmat[self.palm].reshape(3, 3)


def bullet_form(parts, folder):
    if parts[0]["kind"] == "mesh":
        return p.createCollisionShape(p.GEOM_MESH, fileName=wavefront(parts, folder))
    if len(parts) > 1:
        turns = [p.getQuaternionFromEuler([0, 0, part["yaw"]]) for part in parts]
        return p.createCollisionShapeArray(shapeTypes=[p.GEOM_BOX] * len(parts), halfExtents=[np.multiply(part["size"], 0.5).tolist() for part in parts],
                                           collisionFramePositions=[part["at"] for part in parts], collisionFrameOrientations=turns)
    size = parts[0]["size"]
    if parts[0]["kind"] == "ball":
        return p.createCollisionShape(p.GEOM_SPHERE, radius=size[0] / 2)
    if parts[0]["kind"] == "cylinder":
        return p.createCollisionShape(p.GEOM_CYLINDER, radius=size[0] / 2, height=size[2])
    return p.createCollisionShape(p.GEOM_BOX, halfExtents=np.multiply(size, 0.5))


def wavefront(parts, folder):
    """A file of an object for each part: PyBullet makes a convex hull of each."""
    lines, first = [], 1
    for number, part in enumerate(parts):
        cosine, sine = math.cos(part["yaw"]), math.sin(part["yaw"])
        lines.append(f"o part{number}")
        for x, y, z in part["vertices"]:
            at = np.add(part["at"], [cosine * x - sine * y, sine * x + cosine * y, z])
            lines.append(f"v {numbers(at)}")
        lines += ["f " + " ".join(str(first + i) for i in face) for face in part["faces"]]
        first += len(part["vertices"])
    path = os.path.join(folder, "object.obj")
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
    return path


class InBullet(Held):
    def __init__(self, case, folder):
        super().__init__(case)
        p.resetSimulation()
        p.setTimeStep(case["step"])
        self.carriers = 5 if case["moving"] else 0
        self.object = p.createMultiBody(case["object"]["mass"], bullet_form(case["object"]["parts"], folder))
        p.changeDynamics(self.object, -1, localInertiaDiagonal=case["object"]["inertia"])
        bodies = [(self.object, -1)]
        if case["table"]:
            flat = p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.5, 0.5, 0.05])
            bodies.append((p.createMultiBody(0, flat, basePosition=[0, 0, case["table"] - 0.05]), -1))
        self.hand = self.make_hand()
        fingers = range(self.carriers, self.carriers + len(case["fingers"]))
        bodies += [(self.hand, link) for link in fingers]
        for body, link in bodies + [(self.hand, link) for link in range(-1, self.carriers)]:
            p.changeDynamics(body, link, lateralFriction=case["friction"] ** 0.5, restitution=0, linearDamping=0, angularDamping=0, jointDamping=0,
                             maxJointVelocity=1000)
            if body == self.hand:
                p.setCollisionFilterGroupMask(body, link, 2, 1)
        for link, it in zip(fingers, case["fingers"]):
            if not it["drives"]:
                p.setJointMotorControl2(self.hand, link, p.POSITION_CONTROL, targetPosition=0, force=it["force"])

    def make_hand(self):
        fingers, carriers = self.case["fingers"], self.carriers
        count, none = carriers + len(fingers), [0, 0, 0, 1]
        pad = p.createCollisionShape(p.GEOM_BOX, halfExtents=np.multiply(self.case["pad"], 0.5))
        slide, hinge = p.JOINT_PRISMATIC, p.JOINT_REVOLUTE
        # A link's frame is turned with its pad, so the slide is against its x axis.
        hand = p.createMultiBody(
            0, linkMasses=[1] * carriers + [self.case["pad_mass"]] * len(fingers), linkCollisionShapeIndices=[-1] * carriers + [pad] * len(fingers),
            linkVisualShapeIndices=[-1] * count, linkPositions=[[0, 0, 0]] * carriers + [it["at"] for it in fingers],
            linkOrientations=[none] * carriers + [p.getQuaternionFromEuler([0, 0, it["yaw"]]) for it in fingers],
            linkInertialFramePositions=[[0, 0, 0]] * count, linkInertialFrameOrientations=[none] * count,
            linkParentIndices=list(range(carriers)) + [carriers] * len(fingers), linkJointTypes=[slide, slide, slide, hinge, hinge][:carriers] + [slide] * len(fingers),
            linkJointAxis=[[float(x) for x in axis.split()] for axis in AXES[:carriers]] + [[-1, 0, 0]] * len(fingers))
        for link in range(carriers):
            p.changeDynamics(hand, link, localInertiaDiagonal=[6e-4] * 3)
        return hand

    def command(self, k):
        p.setGravity(*self.case["gravity"][k])
        for link, it in enumerate(self.case["fingers"], self.carriers):
            if it["drives"]:
                p.setJointMotorControl2(self.hand, link, p.VELOCITY_CONTROL, targetVelocity=CLOSING_SPEED, force=self.force(k))
        for link in range(self.carriers):
            p.setJointMotorControl2(self.hand, link, p.POSITION_CONTROL, targetPosition=self.path[k, link], targetVelocity=self.velocities[k, link],
                                    force=BASE_FORCE)

    def advance(self, steps):
        for _ in range(steps):
            p.stepSimulation()

    def velocity(self):
        return p.getBaseVelocity(self.object)[0]

    def place(self):
        at = np.array(p.getBasePositionAndOrientation(self.object)[0])
        if not self.carriers:
            return at, np.eye(3)
        state = p.getLinkState(self.hand, self.carriers - 1, computeForwardKinematics=1)
        return at - state[4], np.array(p.getMatrixFromQuaternion(state[5])).reshape(3, 3)


def in_pybullet(case):
    p.connect(p.DIRECT)
    try:
        with tempfile.TemporaryDirectory() as folder:
            return InBullet(case, folder).run()
    finally:
        p.disconnect()


ENGINES = {
    "Swanilda": swanilda,
    "MuJoCo": lambda case: InMujoco(case, "").run(),
    "MuJoCo, elliptic": lambda case: InMujoco(case, 'cone="elliptic" impratio="10"').run(),
    "PyBullet": in_pybullet,
}
