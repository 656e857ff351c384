"""Worlds for stable-baselines3, which needs torch: where both are installed."""

import pathlib

import pytest

stable_baselines3 = pytest.importorskip("stable_baselines3")

import numpy  # noqa: E402

from swanilda import gym, sb3, vec  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"


def make(**changes):
    arguments = {
        "observations": [gym.joint_position("/Slider", 4), gym.joint_velocity("/Slider"), gym.joint_position("/Hinge"), gym.joint_velocity("/Hinge")],
        "actions": [gym.target_velocity("/Slider", 1)],
        "reward": "1",
        "terminated": "math.abs(o[3]) > 0.2 or math.abs(o[1]) > 1.5",
        "max_steps": 100,
        "prepare": "sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}",
        "begin": "sim.setJointTargetVelocity(sim.getObject('/Slider'), 0.4 * math.random() - 0.2)",
        "autoreset": "SameStep",
    }
    return vec.make(SCENE, 8, **arguments | changes)


def test_ppo_learns_to_balance():
    envs = sb3.Worlds(make())
    model = stable_baselines3.PPO("MlpPolicy", envs, n_steps=128, batch_size=256, seed=1, gamma=0.98, device="cpu")

    def length():
        observations, steps, alive = envs.reset(), numpy.zeros(8), numpy.ones(8, bool)
        for _ in range(100):
            observations, _, done, _ = envs.step(model.predict(observations, deterministic=True)[0])
            steps += alive
            alive &= ~done
        return steps.mean()

    before = length()
    model.learn(40_000)
    assert length() > max(60, 2 * before)


def test_the_end_of_an_episode_has_its_last_observation():
    envs = sb3.Worlds(make(max_steps=3, terminated=None))
    envs.seed(1)
    first = envs.reset()
    for _ in range(3):
        observations, rewards, done, infos = envs.step(numpy.ones((8, 1)))
    assert done.all() and (rewards == 1).all() and (observations[:, 0] == first[:, 0]).all()
    assert all(info["TimeLimit.truncated"] and info["terminal_observation"][0] > 0.01 for info in infos)


def test_other_worlds_are_refused():
    with pytest.raises(ValueError, match="SameStep"):
        sb3.Worlds(make(autoreset="NextStep"))
