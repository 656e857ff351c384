"""Worlds of `swanilda.vec` on the workers of a Ray cluster, as one vector environment.

    from swanilda import ray_vec, vec

    def make(count):
        return vec.make('scene.lua', count, ...)

    envs = ray_vec.Workers(make, workers=4, worlds=64)

A world has the same bytes wherever it is. A worker that is lost is replaced, and its episodes are truncated. Needs ray, gymnasium and
numpy, and the package and the scene on each machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy
import ray
from gymnasium.vector.utils import batch_space

from .vec import VectorEnv, WorldError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Workers"]


@ray.remote(max_restarts=0)
class _Worker:
    """Some of the worlds."""

    def __init__(self, make: Callable[[int], VectorEnv], count: int) -> None:
        self.envs = make(count)

    def describe(self) -> tuple[Any, Any, dict[str, Any]]:
        return self.envs.single_observation_space, self.envs.single_action_space, self.envs.metadata

    def reset(self, seed: list[int], options: dict[str, Any] | None) -> tuple[Any, dict[str, Any]]:
        return self.envs.reset(seed=seed, options=options)

    def step(self, actions: Any) -> tuple[Any, ...]:
        return self.envs.step(actions)


class Workers(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """`workers` actors of Ray with `worlds` worlds each; `make(count)` makes those of one.

    timeout: seconds that a worker may take for a step before it counts as lost. Worlds are numbered through: world k's episodes follow from
    `seed + k`, or from reset's. Worlds of a replaced worker get other seeds, which follow from theirs and the number of losses.
    """

    def __init__(
        self,
        make: Callable[[int], VectorEnv],
        workers: int,
        worlds: int,
        cluster: str | None = None,
        timeout: float = 600.0,
        seed: int = 0,
    ) -> None:
        if not ray.is_initialized():
            ray.init(address=cluster, log_to_driver=False, include_dashboard=False)
        self._make, self._worlds, self._timeout = make, worlds, timeout
        self._workers = [self._worker() for _ in range(workers)]
        self.num_envs, self.losses = workers * worlds, 0
        self._seeds = [seed + world for world in range(self.num_envs)]
        self.single_observation_space, self.single_action_space, self.metadata = self._get(self._workers[0].describe.remote())
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def _worker(self) -> Any:
        return _Worker.remote(self._make, self._worlds)

    def _get(self, result: Any) -> Any:
        return ray.get(result, timeout=self._timeout)

    def _own(self, worker: int) -> slice:
        """The worlds of a worker."""
        return slice(worker * self._worlds, (worker + 1) * self._worlds)

    def reset(self, *, seed: int | Sequence[int] | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins episodes in all worlds, or in those of `options['reset_mask']`.

        `options['record']`: numbers of worlds and files, on the workers' machines, for the recordings of the episodes that begin.
        """
        if seed is not None:
            self._seeds = [seed + world for world in range(self.num_envs)] if isinstance(seed, (int, numpy.integer)) else list(seed)
        options = options or {}
        mask = options.get("reset_mask")
        results = self._all(
            lambda worker, own: worker.reset.remote(
                self._seeds[own] if seed is not None or mask is None else [None] * self._worlds,
                _options_of(options, own),
            )
        )
        observations, infos = zip(*(result or self._begin(worker) for worker, result in enumerate(results)))
        # The next reset without a seed begins other episodes.
        self._seeds = [_next(each) for each in self._seeds]
        return _joined(observations), _joined(infos)

    def step(self, actions: ArrayLike) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        given = numpy.asarray(actions)
        results = self._all(lambda worker, own: worker.step.remote(given[own]))
        parts = [result or self._lost_step(worker) for worker, result in enumerate(results)]
        observations, rewards, terminated, truncated, infos = zip(*parts)
        return (*map(_joined, (observations, rewards, terminated, truncated)), _joined(infos))

    def _all(self, call: Callable[[Any, slice], Any]) -> list[Any]:
        """The results of all workers; None for one that is lost."""
        pending = [call(worker, self._own(at)) for at, worker in enumerate(self._workers)]
        return [self._result(at, result) for at, result in enumerate(pending)]

    def _result(self, worker: int, result: Any) -> Any:
        try:
            return self._get(result)
        except ray.exceptions.RayTaskError as error:
            if isinstance(error.cause, WorldError):
                first = worker * self._worlds
                raise WorldError([(first + world, reason) for world, reason in error.cause.failures]) from None
            raise
        except (ray.exceptions.RayActorError, ray.exceptions.ObjectLostError, ray.exceptions.GetTimeoutError):
            ray.kill(self._workers[worker])
            self._workers[worker] = self._worker()
            self.losses += 1
            return None

    def _begin(self, worker: int) -> tuple[Any, dict[str, Any]]:
        """The first observations of a worker that has replaced another one."""
        own = self._own(worker)
        self._seeds[own] = [_next(seed) for seed in self._seeds[own]]
        return self._get(self._workers[worker].reset.remote(self._seeds[own], None))

    def _lost_step(self, worker: int) -> tuple[Any, ...]:
        """The step of worlds that were lost: their episodes are truncated, and others have begun."""
        observations, infos = self._begin(worker)
        no, yes = numpy.zeros(self._worlds, bool), numpy.ones(self._worlds, bool)
        infos = infos | {"error": numpy.full(self._worlds, "the worker was lost", object), "_error": yes}
        return observations, numpy.zeros(self._worlds), no, yes, infos

    def close_extras(self, **kwargs: Any) -> None:
        for worker in self._workers:
            ray.kill(worker)


def _options_of(options: dict[str, Any], own: slice) -> dict[str, Any]:
    """Those for a worker, whose worlds have numbers from 0."""
    mask, named = options.get("reset_mask"), options.get("record") or {}
    record = {world - own.start: path for world, path in named.items() if own.start <= world < own.stop}
    return {"record": record} if mask is None else {"record": record, "reset_mask": mask[own]}


def _next(seed: int) -> int:
    """Another seed that follows from one (a step of a linear congruential generator, Numerical Recipes)."""
    return (1664525 * int(seed) + 1013904223) % 2**32


def _joined(parts: Sequence[Any]) -> Any:
    """What the workers return, one after the other; what only some have in infos is None, 0 or false elsewhere."""
    if not isinstance(parts[0], dict):
        return numpy.concatenate(parts)
    names = dict.fromkeys(name for part in parts for name in part)
    count = max((len(value) for part in parts for value in part.values() if not isinstance(value, dict)), default=0)

    def part_of(part: dict[str, Any], name: str) -> Any:
        like = next(other[name] for other in parts if name in other)
        if isinstance(like, dict):
            return part.get(name, {})
        return part[name] if name in part else numpy.full((count, *like.shape[1:]), None if like.dtype == object else 0, like.dtype)

    return {name: _joined([part_of(part, name) for part in parts]) for name in names}
