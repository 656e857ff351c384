"""Worlds for RLlib, which needs torch: where both are installed."""

import pathlib
import sys

import pytest

pytest.importorskip("torch", reason="RLlib needs torch, whose wheels bring gigabytes of CUDA")
ray = pytest.importorskip("ray")
pytest.importorskip("ray.rllib", reason="ray is installed without RLlib")

import numpy  # noqa: E402
from ray.rllib.algorithms.ppo import PPOConfig  # noqa: E402

from swanilda import gym, rllib, vec  # noqa: E402

SCENE = str(pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua")
WORLDS = 4


def make(count, **changes):
    arguments = {
        "observations": [gym.joint_position("/Slider", 4), gym.joint_velocity("/Slider"), gym.joint_position("/Hinge"), gym.joint_velocity("/Hinge")],
        "actions": [gym.target_velocity("/Slider", 1)],
        "reward": "1",
        "terminated": "math.abs(o[3]) > 0.2",
        "max_steps": 50,
        "prepare": "sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}",
        "begin": "sim.setJointTargetVelocity(sim.getObject('/Slider'), 0.4 * math.random() - 0.2)",
        "threads": 1,
        "on_error": "truncate",
    }
    return vec.make(SCENE, count, **arguments | changes)


@pytest.fixture(scope="module")
def cluster():
    # Workers do not find this module.
    ray.cloudpickle.register_pickle_by_value(sys.modules[__name__])
    ray.init(num_cpus=3, include_dashboard=False, log_to_driver=False, ignore_reinit_error=True)
    yield
    ray.shutdown()


def algorithm(seed=3):
    config = rllib.environment(PPOConfig(), make, WORLDS).env_runners(num_env_runners=2, rollout_fragment_length=50)
    config.training(train_batch_size_per_learner=2 * WORLDS * 50, minibatch_size=100, num_epochs=2, model={"fcnet_hiddens": [16]})
    config.fault_tolerance(restart_failed_env_runners=True).debugging(seed=seed)
    return config.build_algo()


def outcome(result):
    return {name: result["env_runners"][name] for name in ("episode_return_mean", "num_env_steps_sampled", "num_episodes")}


def test_training_repeats_with_the_seed(cluster):
    def train(seed):
        learner = algorithm(seed)
        results = [outcome(learner.train()) for _ in range(2)]
        weights = learner.get_module().state_dict()
        learner.stop()
        return results, {name: values.numpy().tolist() for name, values in weights.items()}

    first, weights = train(3)
    assert first[0]["num_env_steps_sampled"] >= 2 * WORLDS * 50 and first[0]["num_episodes"] > 0
    assert train(3) == (first, weights)
    assert train(4)[1] != weights


def test_training_goes_on_without_a_killed_runner(cluster):
    learner = algorithm()
    learner.train()
    group = learner.env_runner_group
    assert group.num_healthy_remote_workers() == 2
    ray.kill(group._worker_manager.actors()[1], no_restart=False)
    assert all(outcome(learner.train())["num_env_steps_sampled"] > 0 for _ in range(3))
    learner.stop()


def test_worlds_of_runners_have_seeds_of_their_own():
    def begun(seed):
        envs = rllib._OwnSeeds(make(2, infos={"drawn": gym.lua("math.random()")}))
        return envs.reset(seed=seed)[1]["drawn"].tolist()

    assert len({*begun(1), *begun(2), *begun(3)}) == 6 and begun(2) == begun(2)


def test_other_worlds_are_refused():
    with pytest.raises(ValueError, match="NextStep"):
        rllib._checked(make(1, autoreset="SameStep"))
    assert numpy.isfinite(rllib._checked(make(1)).reset(seed=1)[0]).all()
