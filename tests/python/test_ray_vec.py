"""Worlds on a local Ray of two workers, of which one is killed."""

import pathlib
import sys

import pytest

ray = pytest.importorskip("ray")
pytest.importorskip("gymnasium")

import numpy  # noqa: E402

from swanilda import gym, ray_vec, vec  # noqa: E402

SCENE = str(pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua")


def make(count, **changes):
    return vec.make(
        SCENE,
        count,
        observations=[gym.joint_position("/Slider"), gym.joint_velocity("/Slider"), gym.joint_position("/Hinge")],
        actions=[gym.target_velocity("/Slider", 3)],
        reward="1 - o[1]",
        max_steps=20,
        prepare="sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}",
        begin="sim.setJointTargetVelocity(sim.getObject('/Slider'), 0.2 * math.random() - 0.1)",
        infos={"time": gym.lua("sim.getSimulationTime()")},
        threads=1,
        **changes,
    )


@pytest.fixture(scope="module")
def cluster():
    # Workers do not find this module.
    ray.cloudpickle.register_pickle_by_value(sys.modules[__name__])
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, ignore_reinit_error=True)
    yield
    ray.shutdown()


def steps(envs, count=30):
    seen = [envs.reset(seed=5)[0]]
    for number in range(count):
        action = 0.1 * numpy.arange(envs.num_envs).reshape(-1, 1) * (-1) ** number
        *results, infos = envs.step(action)
        seen += [*results, infos["time"]]
    return seen


def test_worlds_are_the_same_as_in_one_process(cluster, tmp_path):
    spread = ray_vec.Workers(make, workers=2, worlds=3)
    assert spread.action_space.shape == (6, 1)
    for one, other in zip(steps(spread), steps(make(6))):
        assert (one == other).all()
    spread.reset(options={"record": {4: tmp_path / "fifth.swr"}})
    for _ in range(20):
        spread.step(numpy.zeros((6, 1)))
    # Complete, with its index.
    assert (tmp_path / "fifth.swr").read_bytes().endswith(b"SWINDEX1")
    spread.close()


def test_a_lost_worker_is_replaced(cluster):
    envs = ray_vec.Workers(make, workers=2, worlds=2, timeout=60)
    envs.reset(seed=1)
    zeros = numpy.zeros((4, 1))
    *_, infos = envs.step(zeros)
    assert "error" not in infos
    ray.kill(envs._workers[1])
    observations, rewards, terminated, truncated, infos = envs.step(zeros)
    assert list(truncated) == [False, False, True, True] and not terminated.any() and envs.losses == 1
    assert list(infos["_error"]) == [False, False, True, True] and infos["error"][2] == "the worker was lost"
    assert rewards[0] != 0 and rewards[2] == 0 and list(infos["time"]) == pytest.approx([0.1, 0.1, 0, 0])
    *_, truncated, infos = envs.step(zeros)
    assert not truncated.any() and list(infos["time"]) == pytest.approx([0.15, 0.15, 0.05, 0.05])
    envs.close()


def test_a_failing_world_has_its_number(cluster):
    def fails(count):
        return vec.make(SCENE, count, [], [gym.lua("if x > 2 then error('too fast') end", -3, 3)], "0", threads=1)

    envs = ray_vec.Workers(fails, workers=2, worlds=2)
    envs.reset(seed=1)
    with pytest.raises(vec.WorldError, match="world 3: .*too fast"):
        envs.step([[0], [0], [0], [2.5]])
    envs.close()
