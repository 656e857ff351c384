"""Worlds of `swanilda.vec` for stable-baselines3.

    from stable_baselines3 import PPO
    from swanilda import sb3, vec

    envs = sb3.Worlds(vec.make('pendulum.lua', 16, ..., autoreset='SameStep'))
    PPO('MlpPolicy', envs).learn(100_000)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy
from gymnasium.vector import AutoresetMode

from .vec import VectorEnv

try:
    from stable_baselines3.common.vec_env import VecEnv
except ImportError as error:
    raise ImportError("swanilda.sb3 needs stable-baselines3: pip install stable-baselines3") from error


class Worlds(VecEnv):
    """Worlds whose episodes begin again in the same step, as stable-baselines3 wants it."""

    def __init__(self, envs: VectorEnv) -> None:
        if envs.metadata["autoreset_mode"] != AutoresetMode.SAME_STEP:
            raise ValueError("stable-baselines3 needs worlds that were made with autoreset='SameStep'")
        self.envs, self._actions, self._seed = envs, None, None
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)
        self.render_mode = envs.render_mode

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """The seed of the next reset: world k gets seed + k."""
        self._seed = seed
        return [None if seed is None else seed + world for world in range(self.num_envs)]

    def reset(self) -> Any:
        observations, _ = self.envs.reset(seed=self._seed)
        self._seed = None
        return observations

    def step_async(self, actions: Any) -> None:
        self._actions = actions

    def step_wait(self) -> tuple[Any, Any, Any, list[dict[str, Any]]]:
        observations, rewards, terminated, truncated, infos = self.envs.step(self._actions)
        done = terminated | truncated
        names = [name for name in infos if not name.startswith("_") and name not in ("final_obs", "final_info")]
        each = [{name: infos[name][world] for name in names} for world in range(self.num_envs)]
        for world in numpy.flatnonzero(done):
            each[world]["terminal_observation"] = infos["final_obs"][world]
            each[world]["TimeLimit.truncated"] = bool(truncated[world] and not terminated[world])
        return observations, rewards, done, each

    def get_images(self) -> Sequence[Any]:
        return self.envs.render() or []

    def close(self) -> None:
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute of the environment, which all worlds share, once for each world."""
        return [getattr(self.envs, attr_name)] * len(self._worlds(indices))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise AttributeError(f"worlds have no attributes of their own: '{attr_name}' cannot be set")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        raise AttributeError(f"worlds have no methods of their own: '{method_name}' cannot be called")

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        return [False] * len(self._worlds(indices))

    def _worlds(self, indices: int | Iterable[int] | None) -> list[int]:
        return list(self._get_indices(indices))
