"""Environments for gymnasium."""

import pathlib

import pytest

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from swanilda import gym  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"


def make():
    return gym.SceneEnv(
        SCENE,
        observations=[gym.joint_position("/Slider"), gym.joint_velocity("/Slider"), gym.joint_position("/Hinge")],
        actions=[gym.target_velocity("/Slider", 3)],
        reward=lambda observation, action: 1.0,
        terminated=lambda observation: abs(observation[2]) > 0.5,
        max_steps=30,
        prepare=lambda sim: sim.removeObjects([sim.getObject(path) for path in ("/Controller", "/Script")]),
        begin=lambda sim, rng: sim.setJointTargetVelocity(sim.getObject("/Slider"), rng.uniform(-0.1, 0.1)),
        render_mode="rgb_array",
        resolution=[32, 24],
    )


def test_gymnasium_accepts_it():
    check_env(make(), skip_render_check=True)


def test_episodes_end_and_repeat():
    env = make()
    rewards = []
    for _ in range(2):
        env.reset(seed=3)
        total = done = 0
        while not done:
            _, reward, terminated, truncated, _ = env.step([0.0])
            total, done = total + reward, terminated or truncated
        rewards.append(total)
    assert rewards[0] == rewards[1] and 1 < rewards[0] <= 30
    assert env.render().shape == (24, 32, 3)
    env.close()


@pytest.mark.parametrize("processes", [False, True])
def test_several_at_once(processes):
    envs = gym.vector(make, 2, processes)
    observations, _ = envs.reset(seed=1)
    assert observations.shape == (2, 3)
    observations, rewards, *_ = envs.step(envs.action_space.sample())
    assert observations.shape == (2, 3) and list(rewards) == [1, 1]
    envs.close()
