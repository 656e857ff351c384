"""Environments for gymnasium."""

import pathlib

import pytest

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from recorded import exported, needs_command  # noqa: E402

from swanilda import gym  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"


def make(**changes):
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
        **changes,
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


@needs_command
def test_chosen_episodes_are_recorded(tmp_path):
    env = make(record=gym.Recordings(tmp_path / "episodes", every=2))

    def run(**options):
        observations = [env.reset(seed=3, **options)[0].tolist()]
        for _ in range(30):
            observations.append(env.step([0.0])[0].tolist())
        return observations

    first = run()
    assert run() == first and run(options={"record": tmp_path / "third.swr"}) == first
    # The third was chosen too, and has the file that was given for it.
    assert [path.name for path in (tmp_path / "episodes").iterdir()] == ["world-0-episode-0.swr"]
    recorded = [exported(path) for path in (tmp_path / "episodes" / "world-0-episode-0.swr", tmp_path / "third.swr")]
    assert recorded[0][:2] == recorded[1][:2] and recorded[0][0][:3] == pytest.approx([0, 0.05, 0.1])
    env.close()
