"""What worlds have gone through as tables of Arrow, for learning from data.

    from swanilda import dataset

    table = dataset.record(envs, policy, steps=1000)
    dataset.write(table, 'demonstrations.parquet')

Needs pyarrow (`pip install pyarrow`).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet
from gymnasium.vector import AutoresetMode

from .vec import VectorEnv

__all__ = ["record", "write"]


def record(envs: VectorEnv, policy: Callable[[Any], Any], steps: int, seed: int | None = None) -> pyarrow.Table:
    """Lets the worlds act as `policy(observations)` says, for so many steps; a row for each action of each world.

    Columns: world, episode (of that world, from 0), step (in the episode, from 0); observation, action, next_observation; reward, terminated,
    truncated; and those of infos. Observations are numbers: worlds with cameras have only their `state` here. Rows are ordered by world,
    episode and step.
    """
    mode = envs.metadata["autoreset_mode"]
    if mode == AutoresetMode.DISABLED:
        raise ValueError("the worlds need an autoreset mode: NextStep or SameStep")
    observations, _ = envs.reset(seed=seed)
    count = envs.num_envs
    episode, step, over = numpy.zeros(count, int), numpy.zeros(count, int), numpy.zeros(count, bool)
    parts: list[dict[str, Any]] = []
    for _ in range(steps):
        actions = numpy.asarray(policy(observations), float)
        before = _numbers(observations)
        observations, rewards, terminated, truncated, infos = envs.step(actions)
        after = _numbers(observations).copy()
        done = terminated | truncated
        for world in numpy.flatnonzero(done) if mode == AutoresetMode.SAME_STEP else ():
            after[world] = _numbers(infos["final_obs"][world])
        # Where an episode has begun, the action was not used.
        acted = ~over
        rows = {"world": numpy.arange(count), "episode": episode, "step": step, "observation": before, "action": actions}
        rows |= {"next_observation": after, "reward": rewards, "terminated": terminated, "truncated": truncated}
        own = {name: values for name, values in infos.items() if f"_{name}" in infos and getattr(values, "dtype", object) != object}
        parts.append({name: values[acted].copy() for name, values in (rows | own).items()})
        episode, step = _count(mode, episode, step, over, done)
        over = done if mode == AutoresetMode.NEXT_STEP else over
    table = pyarrow.table({name: _column(numpy.concatenate([part[name] for part in parts])) for name in parts[0]})
    return table.sort_by([("world", "ascending"), ("episode", "ascending"), ("step", "ascending")])


def write(table: pyarrow.Table, path: str | os.PathLike[str]) -> None:
    """Writes a table as a Parquet file."""
    pyarrow.parquet.write_table(table, path)


def _count(mode: AutoresetMode, episode: Any, step: Any, over: Any, done: Any) -> tuple[Any, Any]:
    """The numbers of the next action: its episode, and its step there."""
    begun = over if mode == AutoresetMode.NEXT_STEP else done
    return episode + begun, numpy.where(begun, 0, step + 1)


def _numbers(observations: Any) -> Any:
    return observations["state"] if isinstance(observations, dict) else observations


def _column(values: Any) -> Any:
    """A column of numbers, or of lists of as many numbers each."""
    if values.ndim == 1:
        return pyarrow.array(values)
    return pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(values.ravel()), values.shape[1])
