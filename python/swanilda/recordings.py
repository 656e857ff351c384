"""Which episodes of environments are recorded, as files that `swanilda view` plays."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy

Episodes = list[tuple[int, "str | os.PathLike[str]", bool]]


@dataclass(frozen=True)
class Recordings:
    """Episodes that are recorded: of `worlds`, by their numbers, the first one and each `every`th after it.

    folder: where files such as `world-0-episode-50.swr` go; it is made if it is not there. images: with what vision sensors see.
    """

    folder: str | os.PathLike[str] = "episodes"
    worlds: Sequence[int] = (0,)
    every: int = 1
    images: bool = False


class Recorder:
    """Counts the episodes of worlds, and chooses those that are recorded."""

    def __init__(self, recordings: Recordings | None, count: int) -> None:
        self._recordings = recordings or Recordings(worlds=())
        self._episodes, self._chosen = numpy.zeros(count, int), numpy.zeros(count, bool)
        if self._recordings.every < 1:
            raise ValueError(f"every is a number of episodes from 1, not {self._recordings.every}")
        for world in self._recordings.worlds:
            self._chosen[self._checked(world)] = True
        if recordings:
            pathlib.Path(recordings.folder).mkdir(parents=True, exist_ok=True)

    def chosen(self, worlds: Sequence[int], named: Mapping[int, str | os.PathLike[str]] | None = None) -> Episodes:
        """The next episodes of worlds: those that are recorded with the paths of their files, among them those `named` for this time."""
        named = dict(named or {})
        if unknown := sorted(self._checked(world) for world in named if world not in worlds):
            raise ValueError(f"no episode begins in world {unknown[0]}, which is to be recorded")
        for world in worlds:
            if self._chosen[world] and self._episodes[world] % self._recordings.every == 0:
                named.setdefault(world, self._path(world))
        return [(world, path, self._recordings.images) for world, path in named.items()]

    def count(self, worlds: Sequence[int]) -> None:
        """Notes that the next episodes of worlds have begun."""
        self._episodes[list(worlds)] += 1

    def _path(self, world: int) -> pathlib.Path:
        return pathlib.Path(self._recordings.folder, f"world-{world}-episode-{self._episodes[world]}.swr")

    def _checked(self, world: int) -> int:
        if not 0 <= world < len(self._episodes):
            raise ValueError(f"there is no world {world}: they are 0 to {len(self._episodes) - 1}")
        return world
