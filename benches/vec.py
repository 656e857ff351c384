"""Many worlds: environment steps per second, linear speed-up, reset and memory, beside mujoco.rollout with the same MJCF and sub-steps.

    python3 -m pip install '.[gym]' mujoco && python3 benches/vec.py

Actions are drawn beforehand. Each figure is the best of several runs; threads: one, and as many as there are processors.
"""

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


def main():
    for name, make, steps in (("pendulum, 10 ms", pendulum, 300), ("arm of 7 joints, 10 ms", arm, 200), ("half cheetah, 50 ms", cheetah, 100)):
        for threads in sorted({1, THREADS}):
            rates = rate(make, 64, threads, steps)
            print(f"{name}, 64 worlds, {threads} threads: {rates[0]:.0f} steps/s; a reset takes {rates[1]:.0f} us; {rates[2] / 1e6:.2f} MB a world", flush=True)
    try:
        for threads in sorted({1, THREADS}):
            print(f"half cheetah, mujoco.rollout, {threads} threads: {rollout(64, threads, 100):.0f} steps/s", flush=True)
    except ImportError:
        print("mujoco is not installed")


if __name__ == "__main__":
    main()
