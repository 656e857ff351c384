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

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Quantity:
    """Numbers that are read from the scene, or written to it, and their bounds."""

    def __init__(self, path: str, low: ArrayLike, high: ArrayLike, prepare: Callable[[Any, int], Callable[..., Any]]) -> None:
        self.path, self.low, self.high = path, numpy.atleast_1d(low), numpy.atleast_1d(high)
        self._prepare = prepare

    def prepare(self, sim: Any) -> Callable[..., Any]:
        """The function that reads or writes it."""
        return self._prepare(sim, sim.getObject(self.path))


def joint_position(path: str, bound: float = math.inf) -> Quantity:
    """The position of a joint, metres or radians."""
    return Quantity(path, -bound, bound, lambda sim, joint: lambda: (sim.getJointPosition(joint),))


def joint_velocity(path: str, bound: float = math.inf) -> Quantity:
    """The velocity of a joint, m/s or rad/s."""
    return Quantity(path, -bound, bound, lambda sim, joint: lambda: (sim.getJointVelocity(joint),))


def position(path: str, bound: float = math.inf) -> Quantity:
    """The position of an object in the world, metres."""
    return Quantity(path, [-bound] * 3, [bound] * 3, lambda sim, thing: lambda: sim.getObjectPosition(thing))


def velocity(path: str, bound: float = math.inf) -> Quantity:
    """The linear and the angular velocity of an object, m/s and rad/s."""

    def prepare(sim: Any, thing: int) -> Callable[[], list[float]]:
        def read() -> list[float]:
            linear, angular = sim.getObjectVelocity(thing)
            return [*linear, *angular]

        return read

    return Quantity(path, [-bound] * 6, [bound] * 6, prepare)


def quaternion(path: str) -> Quantity:
    """The orientation of an object as a quaternion x, y, z, w."""
    return Quantity(path, [-1.0] * 4, [1.0] * 4, lambda sim, thing: lambda: sim.getObjectQuaternion(thing))


def target_force(path: str, bound: float) -> Quantity:
    """The force or torque that the motor of a joint applies, N or N m."""

    def prepare(sim: Any, joint: int) -> Callable[[float], Any]:
        sim.setIntProperty(joint, "dynCtrlMode", sim.jointdynctrl_force)
        return lambda value: sim.setJointTargetForce(joint, value)

    return Quantity(path, -bound, bound, prepare)


def target_velocity(path: str, bound: float) -> Quantity:
    """The velocity that the motor of a joint strives for, m/s or rad/s."""

    def prepare(sim: Any, joint: int) -> Callable[[float], Any]:
        sim.setIntProperty(joint, "dynCtrlMode", sim.jointdynctrl_velocity)
        return lambda value: sim.setJointTargetVelocity(joint, value)

    return Quantity(path, -bound, bound, prepare)


def target_position(path: str, bound: float) -> Quantity:
    """The position that the motor of a joint strives for, metres or radians."""

    def prepare(sim: Any, joint: int) -> Callable[[float], Any]:
        sim.setIntProperty(joint, "dynCtrlMode", sim.jointdynctrl_position)
        return lambda value: sim.setJointTargetPosition(joint, value)

    return Quantity(path, -bound, bound, prepare)


class SceneEnv(gymnasium.Env[Any, Any]):
    """An environment from a scene.

    observations, actions: what is read after, and written before each action. reward(observation, action), terminated(observation):
    functions. max_steps: actions until an episode is truncated. steps_per_action: simulation steps. prepare(sim): called once, before
    the first episode; begin(sim, rng): at the start of each, to vary it with the random numbers of reset's seed. Other arguments are
    those of `Simulator`.
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
        **options: Any,
    ) -> None:
        self.render_mode, self._camera, self._resolution = render_mode, camera, resolution
        self._reward, self._terminated, self._begin = reward, terminated, begin
        self._max_steps, self._steps_per_action, self._count = max_steps, steps_per_action, 0
        self.observation_space = _box(observations, numpy.float64)
        self.action_space = _box(actions, numpy.float32)
        options.setdefault("quiet", True)
        self.simulator = Simulator(scene, **options)
        self._sim = self.simulator.require("sim")
        if prepare:
            prepare(self._sim)
        self._readers = [quantity.prepare(self._sim) for quantity in observations]
        self._writers = [quantity.prepare(self._sim) for quantity in actions]

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        if self.simulator.state != "stopped":
            self.simulator.stop()
        self.simulator.start()
        self._count = 0
        if self._begin:
            self._begin(self._sim, self.np_random)
        return self._observe(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        values = numpy.asarray(action).tolist()
        for write, value in zip(self._writers, values):
            write(value)
        self.simulator.step(self._steps_per_action)
        self._count += 1
        observation = self._observe()
        reward = float(self._reward(observation, action))
        ended = bool(self._terminated(observation))
        return observation, reward, ended, self._count >= self._max_steps, {}

    def _observe(self) -> NDArray[numpy.float64]:
        return numpy.array([number for read in self._readers for number in read()])

    def render(self) -> Any:
        if self.render_mode == "rgb_array":
            camera = None if self._camera is None else self._sim.getObject(self._camera)
            return self.simulator.image(camera, self._resolution)
        return None

    def close(self) -> None:
        self.simulator.close()


def vector(make: Callable[[], gymnasium.Env[Any, Any]], count: int, processes: bool = False) -> gymnasium.vector.VectorEnv[Any, Any, Any]:
    """`count` environments as one: `make` makes each. In this thread, or in a process each, which is worth it where steps are long."""
    if processes:
        # A simulator does not survive a fork.
        return gymnasium.vector.AsyncVectorEnv([make] * count, context="spawn")
    return gymnasium.vector.SyncVectorEnv([make] * count)


def _box(quantities: Sequence[Quantity], dtype: Any) -> gymnasium.spaces.Box:
    low = numpy.concatenate([quantity.low for quantity in quantities]).astype(dtype)
    high = numpy.concatenate([quantity.high for quantity in quantities]).astype(dtype)
    return gymnasium.spaces.Box(low, high, dtype=dtype)
