"""Episodes in which a scene acts by itself, or a person in it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy

from .gym import Quantity, names_of

if TYPE_CHECKING:
    from ._simulator import Simulator
    from .vec import Camera

# What motors are to do can be read as properties of their joints.
_TARGETS = {"target_position": "targetPosition", "target_velocity": "targetVelocity", "target_force": "targetForce"}
# Polling interval while the simulation is paused, seconds.
_PAUSE = 0.02


class Demonstration:
    """What is noted of a simulator."""

    def __init__(
        self,
        simulator: Simulator,
        observations: Sequence[Quantity],
        actions: Sequence[Quantity],
        steps_per_action: int,
        cameras: Mapping[str, Camera],
        speed: float | None,
    ) -> None:
        if speed is not None and not speed > 0:
            raise ValueError(f"speed is a factor above 0, or None, not {speed}")
        sim = simulator.require("sim")
        read = [_read_back(action) for action in actions]
        self._quantities = simulator._quantities([quantity.declared for quantity in (*observations, *read)], [])
        widths = self._quantities.widths
        self._observed = sum(widths[: len(observations)])
        self._simulator, self._steps_per_action = simulator, steps_per_action
        self.cameras = {name: (sim.getObject(camera.path), camera.resolution) for name, camera in cameras.items()}
        self.action_duration = steps_per_action * float(sim.getSimulationTimeStep())
        self._wall = 0.0 if speed is None else self.action_duration / speed
        self.names = {"observation": names_of(observations, widths), "action": names_of(actions, widths[len(observations) :])}

    def episode(self, max_steps: int, terminated: Callable[[Any], Any] | None) -> Iterator[dict[str, Any]]:
        """Starts the simulation; the actions until its end, each when the next one is known to follow or not."""
        self._start()
        waiting: dict[str, Any] | None = None
        before, step = self._read()[0], 0
        while max_steps == 0 or step < max_steps:
            pictures, began = self._pictures(), time.monotonic()
            if not self._advance():
                break
            after, action = self._read()
            if waiting:
                yield waiting
            waiting = {"step": step, "observation": before, "action": action, "next_observation": after}
            is_over = self._simulator._is_stopping or (terminated is not None and bool(terminated(after)))
            waiting |= {"terminated": is_over, "truncated": False, **pictures}
            before, step = after, step + 1
            if waiting["terminated"]:
                break
            # What pages do from now on acts in the next step.
            self._attend(began + self._wall)
        if waiting:
            is_long = step == max_steps
            yield waiting | {"terminated": waiting["terminated"] or not is_long, "truncated": is_long}

    def _start(self) -> None:
        if self._simulator.state != "stopped":
            self._simulator.stop()
        self._simulator.start()

    def _advance(self) -> bool:
        """Makes the steps of an action; false where the simulation has ended, or is paused and no page can make it go on."""
        left = self._steps_per_action
        while left > 0 and not self._simulator._is_stopping:
            if self._simulator._advance():
                left -= 1
            elif self._simulator.state == "paused" and not self._attend(time.monotonic() + _PAUSE):
                return False
        return left < self._steps_per_action and self._simulator.state != "stopped"

    def _attend(self, until: float) -> bool:
        """Serves pages until that time; whether there can be some."""
        while True:
            left = max(0.0, until - time.monotonic())
            is_shown = self._simulator._attend(left)
            if left == 0.0:
                return is_shown
            if not is_shown:
                time.sleep(left)

    def _read(self) -> tuple[Any, Any]:
        numbers = numpy.array(self._quantities.read())
        return numbers[: self._observed], numbers[self._observed :]

    def _pictures(self) -> dict[str, Any]:
        return {name: self._simulator.image(camera, resolution) for name, (camera, resolution) in self.cameras.items()}


def _read_back(action: Quantity) -> Quantity:
    """The quantity that says what an action has set."""
    kind, texts = action.declared
    return Quantity("property", [*texts, _TARGETS[kind]], action.low, action.high) if kind in _TARGETS else action
