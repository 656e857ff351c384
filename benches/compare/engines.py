"""One scene in one engine: `run(scene, watched)` gives (rows, seconds taken); a row is the time and 13 numbers per watched body:
position, quaternion (x, y, z, w), velocity, angular velocity. Without watched bodies only the time counts."""

import math
import os
import time

import mujoco
import numpy as np
import pybullet as p

from lua_scene import run_lua

STEP, SUBSTEPS = 0.005, 10
HERE = os.path.dirname(os.path.abspath(__file__))
# Position servos: newton metres per radian, and per radian per second.
STIFFNESS, DAMPING, FORCE = 500.0, 50.0, 200.0


def samples(scene, advance, row, watched):
    rows, began = [], time.perf_counter()
    for i in range(round(scene["seconds"] / (STEP * SUBSTEPS))):
        advance()
        if watched:
            rows.append([(i + 1) * STEP * SUBSTEPS, *row()])
    return np.array(rows), time.perf_counter() - began


def swanilda(scene, watched):
    lines = run_lua("swanilda.lua", {"SCENE": scene, "WATCHED": watched}, scene["seconds"] + 1)
    rows, took = [], None
    for words in lines:
        if "ROW" in words:
            rows.append([float(x) for x in words[words.index("ROW") + 1:]])
        elif "TOOK" in words:
            took = float(words[-1])
    if took is None:
        raise RuntimeError("the scene did not end")
    return np.array(rows), took


def mjcf(scene):
    numbers = lambda values: " ".join(map(repr, map(float, values)))
    friction = f'friction="{scene["friction"]} 0 0"'
    world, placed, servos, ties = [], {}, [], []
    linked = {it["name"] for it in scene["bodies"] if "joint" in it} | {it.get("parent") for it in scene["bodies"]}

    def element(it, origin):
        at = np.subtract(it["at"], origin)
        # Those of joints collide with what is free, not with each other.
        kind = (2, 1) if it["name"] in linked else (1, 3)
        solid = ' contype="%d" conaffinity="%d"' % (kind if scene["floor"] and not it.get("ghost") else (0, 0))
        text = f'<body name="{it["name"]}" pos="{numbers(at)}">'
        if it.get("joint", {}).get("kind") == "weld":
            pass
        elif "joint" in it:
            joint = it["joint"]
            text += (f'<joint name="j_{it["name"]}" type="hinge" pos="{numbers(np.subtract(joint["at"], it["at"]))}" '
                     f'axis="{numbers(joint["axis"])}"/>')
        else:
            text += f'<freejoint name="j_{it["name"]}"/>'
        half = np.multiply(it["size"], 0.5)
        form, turned = "sphere" if it.get("round") else "box", ""
        if it.get("wheel"):
            form, turned, half = "cylinder", ' euler="90 0 0"', half[:2]
        text += f'<geom type="{form}"{turned} size="{numbers(half)}" mass="{it["mass"]}" {friction}{solid}/>'
        text += "".join(element(child, it["at"]) for child in scene["bodies"] if child.get("parent") == it["name"])
        if "target" in it:
            servos.append(f'<position joint="j_{it["name"]}" kp="{STIFFNESS}" kv="{DAMPING}" forcerange="-{FORCE} {FORCE}"/>')
        if "drive" in it:
            servos.append(f'<velocity joint="j_{it["name"]}" kv="{DAMPING}" forcerange="-{FORCE} {FORCE}"/>')
        placed[it["name"]] = it
        return text + "</body>"

    if scene["floor"]:
        world.append(f'<geom type="plane" size="50 50 1" conaffinity="3" {friction}/>')
    world += [element(it, (0, 0, 0)) for it in scene["bodies"] if not it.get("parent")]
    for first, second, at in scene["ties"]:
        anchor = numbers(np.subtract(at, placed[first]["at"]))
        ties.append(f'<connect body1="{first}" body2="{second}" anchor="{anchor}"/>')
    # A damper this stiff wants the implicit integrator at such a step.
    integrator = "implicitfast" if servos else "Euler"
    return (f'<mujoco><option timestep="{STEP}" integrator="{integrator}" gravity="{numbers(scene["gravity"])}"/><size memory="200M"/>'
            f'<worldbody>{"".join(world)}</worldbody><equality>{"".join(ties)}</equality>'
            f'<actuator>{"".join(servos)}</actuator></mujoco>')


def in_mujoco(scene, watched):
    model = mujoco.MjModel.from_xml_string(mjcf(scene))
    data = mujoco.MjData(model)
    for it in scene["bodies"]:
        if it.get("joint", {}).get("kind") == "weld":
            continue
        start = model.joint("j_" + it["name"]).dofadr[0]
        if "joint" in it:
            data.qvel[start] = np.dot(it.get("spin", (0, 0, 0)), it["joint"]["axis"])
        else:
            data.qvel[start:start + 6] = [*it.get("velocity", (0, 0, 0)), *it.get("spin", (0, 0, 0))]
    data.ctrl[:] = [goal for it in scene["bodies"] for goal in [it.get("target", it.get("drive"))] if goal is not None]
    bodies = [model.body(name).id for name in watched]
    speed = np.zeros(6)

    def row():
        mujoco.mj_forward(model, data)
        values = []
        for body in bodies:
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, speed, 0)
            w, x, y, z = data.xquat[body]
            values += [*data.xpos[body], x, y, z, w, *speed[3:], *speed[:3]]
        return values

    return samples(scene, lambda: mujoco.mj_step(model, data, SUBSTEPS), row, watched)


def bullet_form(scene, it):
    """The collision shape of a body; -1 for one that collides with nothing."""
    if not scene["floor"] or it.get("ghost"):
        return -1
    if it.get("round"):
        return p.createCollisionShape(p.GEOM_SPHERE, radius=it["size"][0] / 2)
    if it.get("wheel"):
        return p.createCollisionShape(p.GEOM_CYLINDER, radius=it["size"][0] / 2, height=it["size"][1],
                                      collisionFrameOrientation=[math.sqrt(0.5), 0, 0, math.sqrt(0.5)])
    return p.createCollisionShape(p.GEOM_BOX, halfExtents=np.multiply(it["size"], 0.5))


def inertia(it):
    a, b, c = np.square(it["size"]) * it["mass"] / 12
    if it.get("wheel"):
        return [b + 0.75 * a, 1.5 * a, b + 0.75 * a]
    return [2 * b * 0.6] * 3 if it.get("round") else [b + c, a + c, a + b]


def bullet_tree(scene, root, links):
    """A free body, or a fixed base for None, with the links that hang on it; gives the places of the bodies."""
    index = {it["name"]: i for i, it in enumerate(links)}
    origin = {it["name"]: it["joint"]["at"] for it in links}
    zero, none, n = [0, 0, 0], [0, 0, 0, 1], len(links)
    base = {"baseMass": 0, "basePosition": zero}
    if root:
        base = {"baseMass": root["mass"], "basePosition": root["at"], "baseCollisionShapeIndex": bullet_form(scene, root)}
    kinds = {"hinge": p.JOINT_REVOLUTE, "weld": p.JOINT_FIXED}
    # A link's frame is its joint; the base's is its centre.
    where = lambda it: origin.get(it["parent"], base["basePosition"])
    body = p.createMultiBody(
        linkMasses=[it["mass"] for it in links], linkCollisionShapeIndices=[bullet_form(scene, it) for it in links],
        linkVisualShapeIndices=[-1] * n, linkOrientations=[none] * n, linkInertialFrameOrientations=[none] * n,
        linkPositions=[np.subtract(it["joint"]["at"], where(it)).tolist() for it in links],
        linkInertialFramePositions=[np.subtract(it["at"], it["joint"]["at"]).tolist() for it in links],
        linkParentIndices=[index.get(it["parent"], -1) + 1 for it in links],
        linkJointTypes=[kinds[it["joint"]["kind"]] for it in links], linkJointAxis=[it["joint"]["axis"] for it in links], **base)
    if root:
        p.changeDynamics(body, -1, localInertiaDiagonal=inertia(root))
        p.resetBaseVelocity(body, root.get("velocity", zero), root.get("spin", zero))
    for i, it in enumerate(links):
        p.changeDynamics(body, i, localInertiaDiagonal=inertia(it))
        if it["joint"]["kind"] == "weld":
            continue
        p.resetJointState(body, i, 0, np.dot(it.get("spin", zero), it["joint"]["axis"]))
        if "target" in it:
            p.setJointMotorControl2(body, i, p.POSITION_CONTROL, targetPosition=it["target"], force=FORCE)
        elif "drive" in it:
            p.setJointMotorControl2(body, i, p.VELOCITY_CONTROL, targetVelocity=it["drive"], force=FORCE)
        else:
            p.setJointMotorControl2(body, i, p.VELOCITY_CONTROL, force=0)
    return ({root["name"]: (body, -1)} if root else {}) | {it["name"]: (body, i) for i, it in enumerate(links)}


def trees(scene):
    """Every body that hangs on nothing, or None for the world, and what hangs on it."""
    bodies = {it["name"]: it for it in scene["bodies"]}

    def top(it):
        while it.get("parent"):
            it = bodies[it["parent"]]
        return it["name"]

    for name in dict.fromkeys(map(top, scene["bodies"])):
        members = [it for it in scene["bodies"] if top(it) == name]
        root = members[0] if "joint" not in members[0] else None
        yield root, members[1:] if root else members


def bullet_world(scene):
    p.resetSimulation()
    p.setTimeStep(STEP)
    p.setGravity(*scene["gravity"])
    places = {}
    if scene["floor"]:
        places["floor"] = (p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE)), -1)
    for root, links in trees(scene):
        places |= bullet_tree(scene, root, links)
    where = {it["name"]: it["at"] for it in scene["bodies"]}
    for first, second, at in scene["ties"]:
        (a, i), (b, j) = places[first], places[second]
        p.createConstraint(a, i, b, j, p.JOINT_POINT2POINT, [0, 0, 0], np.subtract(at, where[first]),
                           np.subtract(at, where[second]))
    for body, i in places.values():
        p.changeDynamics(body, i, lateralFriction=scene["friction"] ** 0.5, restitution=0, linearDamping=0, angularDamping=0,
                         jointDamping=0, maxJointVelocity=1000)
    return places


def in_pybullet(scene, watched):
    p.connect(p.DIRECT)
    places = bullet_world(scene)

    def row():
        values = []
        for body, i in (places[name] for name in watched):
            if i < 0:
                pose, speed = p.getBasePositionAndOrientation(body), p.getBaseVelocity(body)
            else:
                state = p.getLinkState(body, i, computeLinkVelocity=1, computeForwardKinematics=1)
                pose, speed = state[:2], state[6:8]
            values += [*pose[0], *pose[1], *speed[0], *speed[1]]
        return values

    def advance():
        for _ in range(SUBSTEPS):
            p.stepSimulation()

    try:
        return samples(scene, advance, row, watched)
    finally:
        p.disconnect()


ENGINES = {"Swanilda": swanilda, "MuJoCo": in_mujoco, "PyBullet": in_pybullet}
