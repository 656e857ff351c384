"""Many worlds: environment steps per second, linear speed-up, reset and memory, beside mujoco.rollout and EnvPool with the same MJCF and
sub-steps; and pictures per second beside MuJoCo's renderer.

    python3 -m pip install '.[gym]' mujoco envpool && MUJOCO_GL=osmesa python3 benches/vec.py [worlds] [pictures]

Actions are drawn beforehand. Each figure is the best of several runs; threads: one, and as many as there are processors.
"""

import math
import os
import pathlib
import sys
import time

import numpy

from swanilda import vec
from swanilda.gym import joint_position, joint_velocity, target_position, target_velocity

ROOT = pathlib.Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "examples/python"))
import train_cheetah  # noqa: E402

THREADS = len(os.sched_getaffinity(0))
RUNS = 3
# Cameras around the robot: pixels of a side, metres from it and above the ground, radians.
SIDE, EYE, HEIGHT = 128, 3.0, 0.5
ANGLES = [0.5 * math.pi * quarter for quarter in range(4)]
# A frame whose z axis points along a horizontal direction and whose y axis points up.
LOOK_ALONG = """
local function lookAlong(z)
    local length = math.sqrt(z[1] ^ 2 + z[2] ^ 2)
    local a, b = z[1] / length, z[2] / length
    return {-b, 0, a, 0, a, 0, b, 0, 0, 1, 0, 0}
end
"""


def pendulum(worlds, threads):
    return vec.make(
        ROOT / "scenes/inverted_pendulum.lua",
        worlds,
        observations=[joint_position("/Slider"), joint_velocity("/Slider"), joint_position("/Hinge"), joint_velocity("/Hinge")],
        actions=[target_velocity("/Slider", 3)],
        reward=lambda o, a: 1.0,
        prepare="sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}; sim.setFloatParam(sim.floatparam_simulation_time_step, 0.01)",
        max_steps=1000,
        threads=threads,
    )


def arm(worlds, threads):
    prepare = """
        for _, script in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_script)) do sim.removeObjects{script} end
        sim.setFloatParam(sim.floatparam_simulation_time_step, 0.01)
    """
    joints = [f"/J{number}" for number in range(1, 8)]
    return vec.make(
        ROOT / "scenes/arm_7dof.lua",
        worlds,
        observations=[*map(joint_position, joints), *map(joint_velocity, joints)],
        actions=[target_position(joint, 1) for joint in joints],
        reward=lambda o, a: -abs(o).sum(axis=1),
        prepare=prepare,
        max_steps=1000,
        threads=threads,
    )


def cheetah(worlds, threads):
    return train_cheetah.make(worlds, threads=threads)


def memory():
    """Bytes of this process that are in memory."""
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def rate(make, worlds, threads, steps):
    """Environment steps per second, microseconds of a reset, and bytes of a further world."""
    make(1, 1).close()
    before = memory()
    envs = make(worlds, threads)
    bytes_of_one = (memory() - before) / worlds
    rng = numpy.random.default_rng(1)
    space = envs.single_action_space
    actions = rng.uniform(space.low, space.high, (steps, worlds, *space.shape)) * 0.3
    times, resets = [], []
    for _ in range(RUNS):
        envs.reset(seed=1)
        began = time.perf_counter()
        for action in actions:
            envs.step(action)
        times.append(time.perf_counter() - began)
        began = time.perf_counter()
        envs.reset(seed=1)
        resets.append(time.perf_counter() - began)
    envs.close()
    return worlds * steps / min(times), 1e6 * min(resets) * threads / worlds, bytes_of_one


def rollout(worlds, threads, steps):
    """Steps of five sub-steps per second by mujoco.rollout."""
    import mujoco
    from mujoco import rollout

    model = mujoco.MjModel.from_xml_path(str(train_cheetah.FILE))
    rng = numpy.random.default_rng(1)
    control = numpy.repeat(rng.uniform(-0.3, 0.3, (worlds, steps, model.nu)), 5, axis=1)
    datas = [mujoco.MjData(model) for _ in range(threads)]
    size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    state = numpy.zeros(size)
    mujoco.mj_getState(model, datas[0], state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    times = []
    with rollout.Rollout(nthread=threads) as roll:
        for _ in range(RUNS):
            began = time.perf_counter()
            roll.rollout(model, datas, numpy.tile(state, (worlds, 1)), control)
            times.append(time.perf_counter() - began)
    return worlds * steps / min(times)


def envpool_rate(worlds, threads, steps):
    """Steps of five sub-steps per second by EnvPool's half cheetah."""
    import envpool

    envs = envpool.make("HalfCheetah-v4", env_type="gymnasium", num_envs=worlds, num_threads=threads, seed=1)
    actions = numpy.random.default_rng(1).uniform(-0.3, 0.3, (steps, worlds, 6))
    times = []
    for _ in range(RUNS):
        envs.reset()
        began = time.perf_counter()
        for action in actions:
            envs.step(action)
        times.append(time.perf_counter() - began)
    envs.close()
    return worlds * steps / min(times)


def picture_rate(worlds, steps):
    """Pictures per second of four cameras in each world, with the steps between them."""
    sensors = "\n".join(
        f"""local sensor = sim.createVisionSensor(2, {{{SIDE}, {SIDE}, 0, 0}}, {{0.01, 20, math.rad(45), 0.1, 0, 0, 0, 0, 0, 0, 0}})
        sim.setObjectAlias(sensor, 'eye{number}')
        sim.setObjectPosition(sensor, {{{EYE * math.cos(angle)}, {EYE * math.sin(angle)}, {HEIGHT}}})
        local z = {{{-EYE * math.cos(angle)}, {-EYE * math.sin(angle)}, 0}}
        sim.setObjectOrientation(sensor, sim.getEulerAnglesFromMatrix(lookAlong(z)))"""
        for number, angle in enumerate(ANGLES)
    )
    cameras = {f"eye{number}": vec.Camera(f"/eye{number}") for number in range(len(ANGLES))}
    envs = train_cheetah.make(worlds, threads=THREADS, cameras=cameras, prepare=LOOK_ALONG + sensors)
    actions = numpy.zeros((worlds, *envs.single_action_space.shape))
    times = []
    for _ in range(RUNS):
        observations, _ = envs.reset(seed=1)
        began = time.perf_counter()
        for _ in range(steps):
            observations, *_ = envs.step(actions)
        times.append(time.perf_counter() - began)
    assert all(observations[name].std() > 1 for name in cameras), "the cameras see nothing"
    save_pictures("swanilda", [observations[name][0] for name in cameras])
    envs.close()
    return len(ANGLES) * worlds * steps / min(times)


def mujoco_picture_rate(worlds, steps):
    """The same by MuJoCo's renderer, one context for all worlds, without shadows and reflections."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(train_cheetah.FILE))
    datas = [mujoco.MjData(model) for _ in range(worlds)]
    cameras = [mujoco.MjvCamera() for _ in ANGLES]
    for camera, angle in zip(cameras, ANGLES):
        camera.type, camera.distance, camera.azimuth, camera.elevation = mujoco.mjtCamera.mjCAMERA_FREE, EYE, math.degrees(angle) + 180, 0
        camera.lookat[:] = 0, 0, HEIGHT
    times, last = [], []
    with mujoco.Renderer(model, SIDE, SIDE) as renderer:
        for flag in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION):
            renderer.scene.flags[flag] = 0
        for _ in range(RUNS):
            for data in datas:
                mujoco.mj_resetData(model, data)
            began = time.perf_counter()
            for _ in range(steps):
                for data in datas:
                    mujoco.mj_step(model, data, nstep=5)
                    last = [draw(renderer, data, camera) for camera in cameras]
            times.append(time.perf_counter() - began)
    save_pictures("mujoco", last)
    return len(ANGLES) * worlds * steps / min(times)


def draw(renderer, data, camera):
    renderer.update_scene(data, camera)
    return renderer.render()


def save_pictures(name, pictures):
    """Writes them beside each other where VEC_PICTURES names a folder, to see that both have drawn the same."""
    folder = os.environ.get("VEC_PICTURES")
    if folder:
        row = numpy.concatenate(pictures, axis=1)
        pathlib.Path(folder, f"{name}.ppm").write_bytes(b"P6 %d %d 255\n" % (row.shape[1], row.shape[0]) + row.tobytes())


def pictures():
    worlds, steps = 256, 5
    print(f"4 cameras of {SIDE}x{SIDE} in {worlds} worlds, {THREADS} threads: {picture_rate(worlds, steps):.0f} pictures/s", flush=True)
    try:
        print(f"the same, mujoco.Renderer: {mujoco_picture_rate(worlds, steps):.0f} pictures/s", flush=True)
    except ImportError:
        print("mujoco is not installed")


def main():
    chosen = sys.argv[1:] or ["worlds", "pictures"]
    if "worlds" in chosen:
        steps_of_worlds()
    if "pictures" in chosen:
        pictures()


def steps_of_worlds():
    for name, make, steps in (("pendulum, 10 ms", pendulum, 300), ("arm of 7 joints, 10 ms", arm, 200), ("half cheetah, 50 ms", cheetah, 100)):
        for threads in sorted({1, THREADS}):
            rates = rate(make, 64, threads, steps)
            print(f"{name}, 64 worlds, {threads} threads: {rates[0]:.0f} steps/s; a reset takes {rates[1]:.0f} us; {rates[2] / 1e6:.2f} MB a world", flush=True)
    try:
        for threads in sorted({1, THREADS}):
            print(f"half cheetah, mujoco.rollout, {threads} threads: {rollout(64, threads, 100):.0f} steps/s", flush=True)
    except ImportError:
        print("mujoco is not installed")
    try:
        for threads in sorted({1, THREADS}):
            print(f"half cheetah, EnvPool, {threads} threads: {envpool_rate(64, threads, 100):.0f} steps/s", flush=True)
    except ImportError:
        print("envpool is not installed")


if __name__ == "__main__":
    main()
