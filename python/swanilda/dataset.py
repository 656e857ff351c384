"""What worlds have gone through as tables of Arrow, for learning from data.

    from swanilda import dataset

    table = dataset.record(envs, policy, steps=1000)
    dataset.write(table, 'rows.parquet')
    shown = dataset.demonstrate(simulator, observations, actions)

`swanilda.lerobot` writes such tables as datasets of LeRobot. Needs pyarrow (`pip install pyarrow`).
"""

from __future__ import annotations

import json
import os
import struct
import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy
import pyarrow
import pyarrow.parquet
from gymnasium.vector import AutoresetMode

from ._demonstrations import Demonstration
from .gym import Quantity
from .vec import Camera, VectorEnv

if TYPE_CHECKING:
    from ._simulator import Simulator

__all__ = ["demonstrate", "record", "write"]


def record(
    envs: VectorEnv, policy: Callable[[Any], Any], steps: int, seed: int | None = None, pictures: bool = False
) -> pyarrow.Table:
    """Lets the worlds act as `policy(observations)` says, for so many steps; a row for each action of each world.

    Columns: world, episode (of that world, from 0), step (in the episode, from 0); observation, action, next_observation; reward, terminated,
    truncated; those of infos; and with `pictures` what each camera saw before the action, as PNG files, otherwise worlds with cameras have only
    their `state` here. Rows are ordered by world, episode and step. The metadata have the names of the numbers, and the seconds of an action.
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
        seen = _pictures(observations, ~over) if pictures else {}
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
        parts.append({name: values[acted].copy() for name, values in (rows | own).items()} | seen)
        episode, step = _count(mode, episode, step, over, done)
        over = done if mode == AutoresetMode.NEXT_STEP else over
    table = _table({name: numpy.concatenate([part[name] for part in parts]) for name in parts[0]}, envs.names, envs.action_duration)
    return table.sort_by([("world", "ascending"), ("episode", "ascending"), ("step", "ascending")])


def demonstrate(
    simulator: Simulator,
    observations: Sequence[Quantity],
    actions: Sequence[Quantity],
    *,
    episodes: int = 1,
    max_steps: int = 0,
    steps_per_action: int = 1,
    reward: Callable[[Any, Any], Any] | None = None,
    terminated: Callable[[Any], Any] | None = None,
    cameras: Mapping[str, Camera] | None = None,
    speed: float | None = None,
) -> pyarrow.Table:
    """Lets the scene act by itself, and notes what it does: the columns of `record`, of world 0.

    Scripts of the scene drive it, or a person in the viewer (`simulator.view()`) with windows, properties and the line for Lua. actions: what is
    read as the actions that act in a step: the targets of motors, as environments declare them, or any other quantity that can be read.
    The simulation is started for each episode, and an episode ends where it is stopped by a script or a page (terminated), where
    `terminated(observation)` is true, and after `max_steps` actions (truncated), 0: never. reward(observation, action), with the observation
    after the action. speed: beside the wall clock, 1 for persons; None: as fast as possible. Ctrl-c ends it: what was noted is returned.
    """
    demonstration = Demonstration(simulator, observations, actions, steps_per_action, cameras or {}, speed)
    rows: list[dict[str, Any]] = []
    try:
        for episode in range(episodes):
            for row in demonstration.episode(max_steps, terminated):
                given = 0.0 if reward is None else float(reward(row["next_observation"], row["action"]))
                rows.append({"world": 0, "episode": episode, **row, "reward": given})
    except KeyboardInterrupt:
        if rows and not rows[-1]["terminated"]:
            rows[-1]["truncated"] = True
    if not rows:
        raise ValueError("nothing was demonstrated: the simulation ended before its first action")
    columns = {name: numpy.array([row[name] for row in rows]) for name in rows[0] if name not in demonstration.cameras}
    pictures = {name: _files(row[name] for row in rows) for name in demonstration.cameras}
    return _table(columns | pictures, demonstration.names, demonstration.action_duration)


def write(table: pyarrow.Table, path: str | os.PathLike[str]) -> None:
    """Writes a table as a Parquet file."""
    pyarrow.parquet.write_table(table, path)


def _count(mode: AutoresetMode, episode: Any, step: Any, over: Any, done: Any) -> tuple[Any, Any]:
    """The numbers of the next action: its episode, and its step there."""
    begun = over if mode == AutoresetMode.NEXT_STEP else done
    return episode + begun, numpy.where(begun, 0, step + 1)


def _numbers(observations: Any) -> Any:
    return observations["state"] if isinstance(observations, dict) else observations


def _pictures(observations: Any, worlds: Any) -> dict[str, Any]:
    if not isinstance(observations, dict):
        raise ValueError("the worlds have no cameras: pictures=True needs some")
    return {name: _files(pictures[worlds]) for name, pictures in observations.items() if name != "state"}


def _files(pictures: Iterable[Any]) -> Any:
    return numpy.array([_png(picture) for picture in pictures], object)


def _png(picture: Any) -> bytes:
    """The file of a picture (height, width, 3) of bytes (W3C, "Portable Network Graphics Specification", 8 bits, true colour, no filters)."""
    height, width, _ = picture.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = numpy.pad(picture.reshape(height, 3 * width), ((0, 0), (1, 0)))
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b"")


def _table(columns: Mapping[str, Any], names: Mapping[str, Sequence[str]], action_duration: float) -> pyarrow.Table:
    facts = json.dumps({**names, "action_duration": action_duration})
    return pyarrow.table({name: _column(values) for name, values in columns.items()}).replace_schema_metadata({"swanilda": facts})


def _column(values: Any) -> Any:
    """A column of numbers or files, or of lists of as many numbers each."""
    if values.dtype == object:
        return pyarrow.array(values, pyarrow.binary())
    if values.ndim == 1:
        return pyarrow.array(values)
    return pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(values.ravel()), values.shape[1])
