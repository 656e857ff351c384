"""Many worlds of one scene that step together: a vector environment for gymnasium.

    from swanilda import vec
    from swanilda.gym import joint_position, joint_velocity, target_velocity

    envs = vec.make(
        'pendulum.lua', 64,
        observations=[joint_position('/Slider', 4), joint_velocity('/Slider'), joint_position('/Hinge')],
        actions=[target_velocity('/Slider', 3)],
        reward='1', terminated='math.abs(o[3]) > 0.2', max_steps=200,
        randomize=[vec.mass('/Pole', 0.8, 1.2)],
    )

Each world is a simulator of its own, with its scripts, on one of as many threads as there are processors. Python's lock is free while
they step, and they write into arrays of numpy. Needs gymnasium and numpy (`pip install swanilda[gym]`).
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from . import _swanilda
from .gym import Quantity, box, names_of
from .recordings import Recorder
from .recordings import Recordings as Recordings

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class WorldError(RuntimeError):
    """Worlds have failed: `failures` has their numbers and the reasons. The others have gone on."""

    def __init__(self, failures: Sequence[tuple[int, str]]) -> None:
        self.failures = list(failures)
        super().__init__("\n".join(f"world {world}: {reason}" for world, reason in failures))

    def __reduce__(self) -> tuple[Any, ...]:
        return WorldError, (self.failures,)


@dataclass(frozen=True)
class Variation:
    """Something that is drawn anew for each episode, between two bounds. Make it with the functions below."""

    target: tuple[str, list[str]]
    low: ArrayLike
    high: ArrayLike
    scale: str = "absolute"
    distribution: str = "uniform"

    def declared(self) -> tuple[Any, ...]:
        bounds = (numpy.atleast_1d(numpy.asarray(bound, float)).tolist() for bound in (self.low, self.high))
        return (self.target, *bounds, self.scale, self.distribution)


def mass(path: str, low: float, high: float, distribution: str = "uniform") -> Variation:
    """Factors of the mass and inertia of a shape."""
    return Variation(("mass", [path]), low, high, "factor", distribution)


def friction(path: str, low: float, high: float, distribution: str = "uniform") -> Variation:
    """Factors of the friction of a shape."""
    return Variation(("friction", [path]), low, high, "factor", distribution)


def displacement(path: str, low: ArrayLike, high: ArrayLike) -> Variation:
    """Added to the position of an object in its parent's frame, metres: three numbers."""
    return Variation(("position", [path]), low, high, "offset")


def rotation(path: str, low: ArrayLike, high: ArrayLike) -> Variation:
    """Added to the orientation of an object in its parent's frame, Euler angles in radians: three numbers."""
    return Variation(("orientation", [path]), low, high, "offset")


def varied_property(
    path: str, name: str, low: ArrayLike, high: ArrayLike, scale: str = "absolute", distribution: str = "uniform"
) -> Variation:
    """A property of an object, such as a gain or the colour of a light; `scale`: absolute, offset or factor."""
    return Variation(("property", [path, name]), low, high, scale, distribution)


def action_delay(low: int, high: int) -> Variation:
    """Actions act so many steps later: a whole number from `low` to `high`."""
    return Variation(("action_delay", []), low, high + 1 - 1e-9)


def varied_lua(statement: str, low: float, high: float, distribution: str = "uniform") -> Variation:
    """A Lua statement at the beginning of each episode, in which the number is `x`."""
    return Variation(("lua", [statement]), low, high, "absolute", distribution)


@dataclass(frozen=True)
class Camera:
    """Pictures of a camera or vision sensor after each step, as uint8 (height, width, 3), the highest row first."""

    path: str
    resolution: tuple[int, int] | None = None


class VectorEnv(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """`num_envs` worlds of a scene; see `make`."""

    def __init__(
        self,
        scene: str | os.PathLike[str],
        num_envs: int,
        observations: Sequence[Quantity],
        actions: Sequence[Quantity],
        reward: str | Callable[[NDArray[numpy.float64], NDArray[numpy.float64]], Any],
        terminated: str | Callable[[NDArray[numpy.float64]], Any] | None = None,
        max_steps: int = 1000,
        steps_per_action: int = 1,
        cameras: Mapping[str, Camera] | None = None,
        infos: Mapping[str, Quantity] | None = None,
        randomize: Sequence[Variation] = (),
        prepare: str | None = None,
        begin: str | None = None,
        threads: int | None = None,
        seed: int = 0,
        autoreset: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        reset_by: str = "auto",
        on_error: str = "raise",
        record: Recordings | None = None,
        render_mode: str | None = None,
        camera: str | None = None,
        resolution: tuple[int, int] = (320, 240),
        kind: str = "customization",
        time_step: float | None = None,
        **options: Any,
    ) -> None:
        if on_error not in ("raise", "truncate"):
            raise ValueError(f"on_error is raise or truncate, not '{on_error}'")
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is rgb_array or None, not '{render_mode}'")
        self.num_envs, self.render_mode, self.on_error = num_envs, render_mode, on_error
        self._mode, self._recorder = AutoresetMode(autoreset), Recorder(record, num_envs)
        self._recorded: list[int] = []
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": 20, "autoreset_mode": self._mode}
        self._reward, self._terminated = reward, terminated
        cameras, infos = dict(cameras or {}), dict(infos or {})
        views = [(each.path, each.resolution and list(each.resolution), True) for each in cameras.values()]
        self._drawn = None
        if render_mode and camera:
            self._drawn = len(views)
            views.append((camera, list(resolution), False))
        declared = {
            "scene": scene,
            "kind": kind,
            "time_step": time_step,
            "observations": [quantity.declared for quantity in observations],
            "actions": [quantity.declared for quantity in actions],
            "infos": [quantity.declared for quantity in infos.values()],
            "cameras": views,
            "reward": reward if isinstance(reward, str) else None,
            "terminated": terminated if isinstance(terminated, str) else None,
            "prepare": prepare,
            "begin": begin,
            "max_steps": max_steps,
            "steps_per_action": steps_per_action,
            "variations": [variation.declared() for variation in randomize],
            "reset_by": reset_by,
        }
        self._vector = _swanilda.Vector(declared, num_envs, threads or len(os.sched_getaffinity(0)), seed=seed, **options)
        self._arrays = {name: numpy.asarray(self._vector.array(name)) for name in _ARRAYS}
        self._images = [numpy.asarray(self._vector.array("images", at)) for at in range(len(views))]
        self._cameras, self._infos = list(cameras), self._parts(infos, self._vector.infos)
        self.names = {"observation": names_of(observations, self._vector.observations), "action": names_of(actions, [1] * len(actions))}
        self._over: NDArray[numpy.bool_] = numpy.zeros(num_envs, bool)
        self.single_action_space = box(actions, [1] * len(actions), numpy.float32)
        self.single_observation_space = self._space(box(observations, self._vector.observations, numpy.float64))
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)

    def _space(self, numbers: gymnasium.spaces.Box) -> gymnasium.spaces.Space[Any]:
        """Without cameras numbers, otherwise a dictionary of them, as `state`, and of pictures."""
        if not self._cameras:
            return numbers
        pictures = {
            name: gymnasium.spaces.Box(0, 255, images.shape[1:], numpy.uint8) for name, images in zip(self._cameras, self._images)
        }
        return gymnasium.spaces.Dict({"state": numbers, **pictures})

    @staticmethod
    def _parts(infos: Mapping[str, Quantity], widths: Sequence[int]) -> list[tuple[str, slice | int]]:
        """Where each info lies in its row."""
        ends = numpy.cumsum([0, *widths]).tolist()
        return [
            (name, start if width == 1 else slice(start, start + width)) for name, start, width in zip(infos, ends, widths)
        ]

    @property
    def resets_by_snapshot(self) -> bool:
        """Whether episodes begin with a snapshot, or with a start of the simulation."""
        return self._vector.has_snapshot

    @property
    def action_duration(self) -> float:
        """Simulated seconds of an action."""
        return self._vector.action_duration

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins episodes in all worlds, or in those of `options['reset_mask']`. From the seed s world k gets s + k.

        `options['record']`: numbers of worlds and files for the recordings of the episodes that begin.
        """
        seeds = [seed + world for world in range(self.num_envs)] if isinstance(seed, (int, numpy.integer)) else seed
        seeds = list(seeds) if seeds is not None else [None] * self.num_envs
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} worlds")
        options = options or {}
        mask = options.get("reset_mask")
        which = range(self.num_envs) if mask is None else numpy.flatnonzero(mask).tolist()
        if unwritable := self._record(which, options.get("record")):
            raise WorldError(unwritable)
        chosen = ((world, seeds[world]) for world in which)
        failures = self._run(self._vector.begin, [(world, None if each is None else int(each) % 2**32) for world, each in chosen])
        self._recorder.count(which)
        self._over[list(which)] = False
        self._end_failed(failures, numpy.zeros(self.num_envs, bool))
        return self._observe(), self._info()

    def step(self, actions: ArrayLike) -> tuple[Any, NDArray[numpy.float64], NDArray[numpy.bool_], NDArray[numpy.bool_], dict[str, Any]]:
        given = numpy.asarray(actions, float)
        if given.shape != self._arrays["actions"].shape:
            raise ValueError(f"actions have the shape {given.shape}; it is {self._arrays['actions'].shape} for these worlds")
        self._arrays["actions"][...] = given
        began = self._over.copy() if self._mode == AutoresetMode.NEXT_STEP else numpy.zeros(self.num_envs, bool)
        self._arrays["resets"][...] = began
        beginning = numpy.flatnonzero(began).tolist()
        _warn(self._record(beginning))
        failures = self._run(self._vector.step)
        self._recorder.count(beginning)
        rewards, terminated, truncated = self._scores(given, began)
        self._over = terminated | truncated
        _warn(self._finish_recordings(failures))
        self._end_failed(failures, truncated)
        infos = self._info()
        self._note_errors(failures, infos)
        if self._mode == AutoresetMode.SAME_STEP and self._over.any():
            self._begin_again(infos)
        return self._observe(), rewards, terminated, truncated, infos

    def _run(self, work: Callable[..., list[tuple[int, str]]], *args: Any) -> list[tuple[int, str]]:
        """The failures of what worlds do. Those that ctrl-c interrupts begin another episode in their next step."""
        try:
            return work(*args)
        except KeyboardInterrupt:
            self._over = self._arrays["failed"] | self._arrays["terminated"] | self._arrays["truncated"]
            raise

    def _record(self, worlds: Sequence[int], named: Mapping[int, str | os.PathLike[str]] | None = None) -> list[tuple[int, str]]:
        """Opens the files of episodes that begin and are recorded; those that cannot be written."""
        episodes = self._recorder.chosen(worlds, named)
        self._recorded = [world for world in self._recorded if world not in worlds] + [world for world, _, _ in episodes]
        return self._vector.record(episodes) if episodes else []

    def _finish_recordings(self, failures: Sequence[tuple[int, str]]) -> list[tuple[int, str]]:
        """Completes the recordings of episodes that are over; the files that could not be written."""
        failed = [world for world, _ in failures]
        over = [world for world in self._recorded if self._over[world] or world in failed]
        self._recorded = [world for world in self._recorded if world not in over]
        return self._vector.finish_recordings(over) if over else []

    def _scores(
        self, actions: NDArray[numpy.float64], began: NDArray[numpy.bool_]
    ) -> tuple[NDArray[numpy.float64], NDArray[numpy.bool_], NDArray[numpy.bool_]]:
        """Rewards and ends, by Lua or by functions of all worlds at once."""
        observed, terminated = self._arrays["observations"], self._arrays["terminated"].copy()
        rewards = self._arrays["rewards"].copy()
        if callable(self._reward):
            rewards = numpy.broadcast_to(numpy.asarray(self._reward(observed, actions), float), self.num_envs).copy()
        if callable(self._terminated):
            terminated |= numpy.asarray(self._terminated(observed), bool)
        rewards[began], terminated[began] = 0.0, False
        failed = self._arrays["failed"]
        rewards[failed], terminated[failed] = 0.0, False
        return rewards, terminated, self._arrays["truncated"] & ~failed

    def _end_failed(self, failures: Sequence[tuple[int, str]], truncated: NDArray[numpy.bool_]) -> None:
        """What follows from failures: their episodes are over."""
        if not failures:
            return
        for world, _ in failures:
            self._over[world] = truncated[world] = True
        if self.on_error == "raise":
            raise WorldError(failures)
        _warn(failures)

    def _note_errors(self, failures: Sequence[tuple[int, str]], infos: dict[str, Any]) -> None:
        if failures:
            infos["error"], infos["_error"] = numpy.full(self.num_envs, None, object), numpy.zeros(self.num_envs, bool)
            for world, reason in failures:
                infos["error"][world], infos["_error"][world] = reason, True

    def _begin_again(self, infos: dict[str, Any]) -> None:
        """Episodes that are over begin again in the same step; their last observations go to `infos`."""
        last, final = self._observe(), numpy.full(self.num_envs, None, object)
        for world in numpy.flatnonzero(self._over):
            final[world] = {name: part[world] for name, part in last.items()} if isinstance(last, dict) else last[world]
        infos["final_obs"], infos["_final_obs"] = final, self._over.copy()
        infos["final_info"], infos["_final_info"] = self._info(), self._over.copy()
        over = numpy.flatnonzero(self._over).tolist()
        _warn(self._record(over))
        failures = self._run(self._vector.begin, [(world, None) for world in over])
        self._recorder.count(over)
        self._over[:] = False
        self._end_failed(failures, numpy.zeros(self.num_envs, bool))

    def _observe(self) -> Any:
        numbers = self._arrays["observations"].copy()
        if not self._cameras:
            return numbers
        return {"state": numbers, **{name: images.copy() for name, images in zip(self._cameras, self._images)}}

    def _info(self) -> dict[str, Any]:
        infos = {name: self._arrays["infos"][:, part].copy() for name, part in self._infos}
        return infos | {f"_{name}": numpy.ones(self.num_envs, bool) for name in infos}

    def render(self) -> tuple[NDArray[numpy.uint8], ...] | None:
        """A picture of each world, by the camera that was given."""
        if self._drawn is None:
            return None
        failures = self._vector.draw(self._drawn)
        if failures:
            raise WorldError(failures)
        return tuple(self._images[self._drawn].copy())

    def close_extras(self, **kwargs: Any) -> None:
        # The worlds end with the object, on their threads; arrays that somebody still has stay.
        self.__dict__.pop("_vector", None)


def _warn(failures: Sequence[tuple[int, str]]) -> None:
    if failures:
        warnings.warn(str(WorldError(failures)), RuntimeWarning, stacklevel=4)


_ARRAYS = ("actions", "observations", "infos", "rewards", "terminated", "truncated", "resets", "failed")


def make(scene: str | os.PathLike[str], num_envs: int, *args: Any, **options: Any) -> VectorEnv:
    """`num_envs` worlds of a scene as one environment.

    observations, actions: quantities of `swanilda.gym`, read after and written before each step by the worlds themselves. reward,
    terminated: Lua expressions of `o` and `a`, the lists of observations and actions, evaluated in each world; or functions of Python for all
    worlds at once, with arrays (num_envs, ...). max_steps: actions until an episode is truncated, 0: none. steps_per_action: simulation steps.
    cameras: names and `Camera`s; observations are then a dictionary with `state` and the pictures. infos: names and quantities.
    randomize: what is drawn anew for each episode. prepare: Lua that runs once; begin: Lua at the start of each episode. threads: as many as
    there are processors. seed: of the simulators; world k's episodes follow from seed + k, or from reset's. autoreset: as gymnasium's vector
    environments. reset_by: `snapshot`, `start` (the simulation is stopped and started), or `auto`, with a snapshot where there can be one.
    on_error: `raise`, or `truncate`: episodes in which a script fails are truncated, with the reason in infos['error']. record: `Recordings`,
    the episodes that `swanilda view` is to play. render_mode='rgb_array', camera, resolution: for `render`. Other arguments are those of `Simulator`: kind, time_step, params, unsafe_functions, package_dirs, data_dir.
    """
    return VectorEnv(scene, num_envs, *args, **options)
