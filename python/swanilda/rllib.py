"""Worlds of `swanilda.vec` for the environment runners of RLlib.

    from ray.rllib.algorithms.ppo import PPOConfig
    from swanilda import rllib, vec

    def make(count):
        return vec.make('pendulum.lua', count, ..., threads=1, on_error='truncate')

    config = rllib.environment(PPOConfig(), make, worlds=16).env_runners(num_env_runners=4)
    config.fault_tolerance(restart_failed_env_runners=True)

Needs `ray[rllib]` and torch, and the package and the scene on each machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import gymnasium
import numpy
from gymnasium.vector import AutoresetMode

from .vec import VectorEnv

try:
    from ray.rllib.algorithms.algorithm_config import AlgorithmConfig
    from ray.tune.registry import register_env
except ImportError as error:
    raise ImportError("swanilda.rllib needs RLlib and torch: pip install 'ray[rllib]' torch") from error

__all__ = ["environment"]


def environment(config: AlgorithmConfig, make: Callable[..., VectorEnv], worlds: int, name: str = "swanilda", **arguments: Any) -> AlgorithmConfig:
    """The configuration of an algorithm, whose environment runners have `worlds` worlds each.

    make(count, **arguments) makes those of one, with autoreset='NextStep'; name: what RLlib calls the environment. With `config.debugging(seed=s)`
    each world of each runner has episodes of its own, which follow from s.
    """

    def create(context: dict[str, Any]) -> gymnasium.vector.VectorEnv[Any, Any, Any]:
        return _OwnSeeds(_checked(make(context.get("num_envs", worlds), **arguments)))

    register_env(name, create)
    vectorized = gymnasium.VectorizeMode.VECTOR_ENTRY_POINT
    return config.environment(name).env_runners(num_envs_per_env_runner=worlds, gym_env_vectorize_mode=vectorized)


def _checked(envs: VectorEnv) -> VectorEnv:
    if envs.metadata["autoreset_mode"] != AutoresetMode.NEXT_STEP:
        raise ValueError("RLlib needs worlds that were made with autoreset='NextStep'")
    return envs


class _OwnSeeds(gymnasium.vector.VectorWrapper):
    """Worlds of one runner of several: runners get seeds that follow each other, and their worlds have no seed in common."""

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        if isinstance(seed, (int, numpy.integer)):
            seed = [int(seed) * self.num_envs + world for world in range(self.num_envs)]
        return self.env.reset(seed=seed, options=options)  # type: ignore[arg-type]
