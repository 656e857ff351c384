"""Environments for gymnasium from scenes.

    from swanilda.gym import SceneEnv, joint_position, joint_velocity, target_force

    env = SceneEnv(
        'cart.lua',
        observations=[joint_position('/Slider', 2), joint_velocity('/Slider'), joint_position('/Hinge')],
        actions=[target_force('/Slider', 10)],
        reward=lambda o, a: 1.0,
        terminated=lambda o: abs(o[2]) > 0.2,
        max_steps=500,
    )

Needs gymnasium and numpy (`pip install swanilda[gym]`).
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy

from ._simulator import Simulator
from .recordings import Recorder
from .recordings import Recordings as Recordings

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Quantity:
    """Numbers that are read from the scene, or written to it, and their bounds. Objects are named by their paths."""

    def __init__(self, kind: str, texts: Sequence[str], low: ArrayLike = -math.inf, high: ArrayLike = math.inf) -> None:
        self.declared = (kind, list(texts))
        self.low, self.high = numpy.atleast_1d(numpy.asarray(low, float)), numpy.atleast_1d(numpy.asarray(high, float))

    def __repr__(self) -> str:
        kind, texts = self.declared
        return f"{kind}({', '.join(map(repr, texts))})"


def joint_position(path: str, bound: float = math.inf) -> Quantity:
    """The position of a joint, metres or radians."""
    return Quantity("joint_position", [path], -bound, bound)


def joint_velocity(path: str, bound: float = math.inf) -> Quantity:
    """The velocity of a joint, m/s or rad/s."""
    return Quantity("joint_velocity", [path], -bound, bound)


def joint_force(path: str, bound: float = math.inf) -> Quantity:
    """The force or torque of a joint's motor, N or N m."""
    return Quantity("joint_force", [path], -bound, bound)


def position(path: str, bound: float = math.inf) -> Quantity:
    """The position of an object in the world, metres."""
    return Quantity("position", [path], -bound, bound)


def velocity(path: str, bound: float = math.inf) -> Quantity:
    """The linear and the angular velocity of an object, m/s and rad/s."""
    return Quantity("velocity", [path], -bound, bound)


def quaternion(path: str) -> Quantity:
    """The orientation of an object as a quaternion x, y, z, w."""
    return Quantity("quaternion", [path], -1.0, 1.0)


def scene_property(path: str, name: str, low: ArrayLike = -math.inf, high: ArrayLike = math.inf) -> Quantity:
    """A property of an object, read or written: numbers, or true and false as 1 and 0."""
    return Quantity("property", [path, name], low, high)


def function(path: str, name: str, low: ArrayLike = -math.inf, high: ArrayLike = math.inf) -> Quantity:
    """What a global function of the script at that path returns; as an action it is called with the number."""
    return Quantity("function", [path, name], low, high)


def lua(text: str, low: ArrayLike = -math.inf, high: ArrayLike = math.inf) -> Quantity:
    """A Lua expression; as an action a statement, in which the number is `x`."""
    return Quantity("lua", [text], low, high)


def target_force(path: str, bound: float) -> Quantity:
    """The force or torque that the motor of a joint applies, N or N m."""
    return Quantity("target_force", [path], -bound, bound)


def target_velocity(path: str, bound: float) -> Quantity:
    """The velocity that the motor of a joint strives for, m/s or rad/s."""
    return Quantity("target_velocity", [path], -bound, bound)


def target_position(path: str, bound: float) -> Quantity:
    """The position that the motor of a joint strives for, metres or radians."""
    return Quantity("target_position", [path], -bound, bound)


class SceneEnv(gymnasium.Env[Any, Any]):
    """An environment from a scene.

    observations, actions: what is read after, and written before each action, by the simulator itself. reward(observation, action), terminated(observation):
    functions. max_steps: actions until an episode is truncated. steps_per_action: simulation steps. prepare(sim): called once, before
    the first episode; begin(sim, rng): at the start of each, to vary it with the random numbers of reset's seed. record: `Recordings`, the
    episodes that `swanilda view` is to play. Other arguments are those of `Simulator`.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        scene: str | os.PathLike[str],
        observations: Sequence[Quantity],
        actions: Sequence[Quantity],
        reward: Callable[[Any, Any], Any],
        terminated: Callable[[Any], Any],
        max_steps: int = 1000,
        steps_per_action: int = 1,
        prepare: Callable[[Any], Any] | None = None,
        begin: Callable[[Any, numpy.random.Generator], Any] | None = None,
        render_mode: str | None = None,
        camera: str | None = None,
        resolution: Sequence[int] = (320, 240),
        record: Recordings | None = None,
        **options: Any,
    ) -> None:
        self.render_mode, self._camera, self._resolution = render_mode, camera, resolution
        self._reward, self._terminated, self._begin = reward, terminated, begin
        self._max_steps, self._steps_per_action, self._count = max_steps, steps_per_action, 0
        self._recorder = Recorder(record, 1)
        options.setdefault("quiet", True)
        self.simulator = Simulator(scene, **options)
        self._sim = self.simulator.require("sim")
        if prepare:
            prepare(self._sim)
        declared = [[quantity.declared for quantity in each] for each in (observations, actions)]
        self._quantities = self.simulator._quantities(*declared)
        self.observation_space = box(observations, self._quantities.widths, numpy.float64)
        self.action_space = box(actions, [1] * len(actions), numpy.float32)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins an episode. `options['record']`: the file for its recording."""
        super().reset(seed=seed)
        self.simulator.end_recording()
        if self.simulator.state != "stopped":
            self.simulator.stop()
        self.simulator.start()
        self._count = 0
        if self._begin:
            self._begin(self._sim, self.np_random)
        file = (options or {}).get("record")
        for _, path, images in self._recorder.chosen([0], {0: file} if file else None):
            self.simulator.record(path, images)
        self._recorder.count([0])
        return self._observe(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self._quantities.write(numpy.asarray(action, float).ravel().tolist())
        self.simulator.step(self._steps_per_action)
        self._count += 1
        observation = self._observe()
        reward = float(self._reward(observation, action))
        ended = bool(self._terminated(observation)) or self.simulator._is_stopping
        is_long = self._count >= self._max_steps
        if ended or is_long:
            self.simulator.end_recording()
        return observation, reward, ended, is_long, {}

    def _observe(self) -> NDArray[numpy.float64]:
        return numpy.array(self._quantities.read())

    def render(self) -> Any:
        if self.render_mode == "rgb_array":
            camera = None if self._camera is None else self._sim.getObject(self._camera)
            return self.simulator.image(camera, self._resolution)
        return None

    def close(self) -> None:
        self.simulator.close()


def names_of(quantities: Sequence[Quantity], widths: Sequence[int]) -> list[str]:
    """A name for each number of quantities, which have so many each."""
    each = ((repr(quantity), width) for quantity, width in zip(quantities, widths))
    return [name if width == 1 else f"{name}[{at}]" for name, width in each for at in range(width)]


def vector(make: Callable[[], gymnasium.Env[Any, Any]], count: int, processes: bool = False) -> gymnasium.vector.VectorEnv[Any, Any, Any]:
    """`count` environments as one: `make` makes each. In this thread, or in a process each, which is worth it where steps are long."""
    if processes:
        # A simulator does not survive a fork.
        return gymnasium.vector.AsyncVectorEnv([make] * count, context="spawn")
    return gymnasium.vector.SyncVectorEnv([make] * count)


def box(quantities: Sequence[Quantity], widths: Sequence[int], dtype: Any) -> gymnasium.spaces.Box:
    """The space of quantities, which have so many numbers each."""
    low = [numpy.broadcast_to(quantity.low, width) for quantity, width in zip(quantities, widths)]
    high = [numpy.broadcast_to(quantity.high, width) for quantity, width in zip(quantities, widths)]
    return gymnasium.spaces.Box(numpy.concatenate([*low, []]).astype(dtype), numpy.concatenate([*high, []]).astype(dtype), dtype=dtype)
