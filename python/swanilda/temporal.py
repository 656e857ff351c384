"""What has to hold over time, sampled at each step of a simulator.

    with temporal.Watch(simulator) as watch:
        watch.always(lambda: distance() - 0.05, "keeps 5 cm")
        watch.eventually(lambda: 0.1 - distance_to_goal(), within=30, name="arrives")
        simulator.step(600)

A condition returns a boolean, or a number that says how far from false it is: negative where it does not hold. The robustness of a property is such
a number for the whole run, as signal temporal logic defines it (A. Donze, O. Maler: Robust satisfaction of temporal logic over real-valued
signals, 2010); that of a boolean is infinite. In a property (`swanilda.property`), `g.always` and the others watch the simulator of the test.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing_extensions import Self

    from ._simulator import Simulator

Condition = Callable[[], "float | bool"]

_TOLERANCE = 1e-9  # seconds: time is a sum of steps


class Violation(AssertionError):
    """Something does not hold that has to."""


def _value(condition: Condition, name: str) -> float:
    value = condition()
    if value is True or value is False:
        return math.inf if value else -math.inf
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if math.isnan(number):
        raise TypeError(f"{name}: a condition returns a boolean or a number, not {value!r}")
    return number


def _by(value: float) -> str:
    return f" (by {-value:.6g})" if math.isfinite(value) else ""


class _Property:
    """Samples are given in the order of time. `sample` returns why the property is violated, if it is."""

    word = ""

    def __init__(self, name: str | None, begun: float, within: float | None = None) -> None:
        self.name = f"{self.word} '{name}'" if name else self.word
        self.begun, self.within = begun, within
        self.robustness = math.inf
        self.is_over = False

    def is_late(self, time: float) -> bool:
        return self.within is not None and time >= self.begun + self.within - _TOLERANCE

    def sample(self, time: float) -> str | None:
        raise NotImplementedError

    def finish(self, time: float) -> str | None:
        raise NotImplementedError

    def violated(self, reason: str) -> Violation:
        self.is_over = True
        if self.robustness >= 0:
            self.robustness = -math.inf
        return Violation(f"{self.name} {reason}")


class _Always(_Property):
    word = "always"

    def __init__(self, condition: Condition, name: str | None, begun: float) -> None:
        super().__init__(name, begun)
        self.condition = condition

    def sample(self, time: float) -> str | None:
        value = _value(self.condition, self.name)
        self.robustness = min(self.robustness, value)
        return f"does not hold at {time:.6g} s{_by(value)}" if value < 0 else None

    def finish(self, time: float) -> str | None:
        return None


class _Eventually(_Property):
    word = "eventually"

    def __init__(self, condition: Condition, within: float | None, name: str | None, begun: float) -> None:
        super().__init__(name, begun, within)
        self.condition, self.robustness = condition, -math.inf

    def sample(self, time: float) -> str | None:
        self.robustness = max(self.robustness, _value(self.condition, self.name))
        self.is_over = self.is_late(time)
        if self.is_over and self.robustness < 0:
            return f"has not come about within {self.within:g} s{_by(self.robustness)}"
        return None

    def finish(self, time: float) -> str | None:
        if self.robustness >= 0:
            return None
        before = "" if self.within is None else f", before {self.within:g} s have passed"
        return f"has not come about until the end at {time:.6g} s{before}{_by(self.robustness)}"


class _HoldsUntil(_Property):
    word = "until"

    def __init__(self, condition: Condition, end: Condition, within: float | None, name: str | None, begun: float) -> None:
        super().__init__(name, begun, within)
        self.condition, self.end = condition, end
        self.robustness, self.least = -math.inf, math.inf

    def sample(self, time: float) -> str | None:
        end = _value(self.end, self.name)
        self.robustness = max(self.robustness, min(end, self.least))
        if end >= 0:
            self.is_over = True
            return None
        value = _value(self.condition, self.name)
        self.least = min(self.least, value)
        if value < 0:
            return f"does not hold at {time:.6g} s{_by(value)}"
        return f"was not ended within {self.within:g} s" if self.is_late(time) else None

    def finish(self, time: float) -> str | None:
        return f"was not ended until the end at {time:.6g} s"


class _LeadsTo(_Property):
    word = "leads to"

    def __init__(self, condition: Condition, consequence: Condition, within: float, name: str | None, begun: float) -> None:
        super().__init__(name, begun)
        self.condition, self.consequence, self.window = condition, consequence, within
        self.history: list[tuple[float, float, float]] = []
        self.since: float | None = None

    def sample(self, time: float) -> str | None:
        condition, consequence = _value(self.condition, self.name), _value(self.consequence, self.name)
        self.history.append((time, condition, consequence))
        if consequence >= 0:
            self.since = None
        elif condition >= 0 and self.since is None:
            self.since = time
        if self.since is None or time <= self.since + self.window + _TOLERANCE:
            return None
        self._measure()
        return f"was begun at {self.since:.6g} s and has led to nothing within {self.window:g} s"

    def finish(self, time: float) -> str | None:
        self._measure()
        return None

    def _measure(self) -> None:
        """The least, over all times, of max(-condition, the greatest consequence within the window that begins there)."""
        self.robustness = math.inf
        greatest: deque[tuple[float, float]] = deque()  # samples of falling consequence, the latest first
        for time, condition, consequence in reversed(self.history):
            while greatest and greatest[-1][1] <= consequence:
                greatest.pop()
            greatest.append((time, consequence))
            while greatest[0][0] > time + self.window + _TOLERANCE:
                greatest.popleft()
            value = max(-condition, greatest[0][1])
            # A window that the run has cut off says nothing yet.
            if value >= 0 or self.history[-1][0] >= time + self.window - _TOLERANCE:
                self.robustness = min(self.robustness, value)


class Watch:
    """Properties of the steps of a simulator (`Simulator.step`, `Simulator.iterate`), until it is closed. What is violated is raised at once."""

    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator
        self._sim = simulator.require("sim")
        self._properties: list[_Property] = []
        self._sampled = -math.inf
        simulator._watches = (*simulator._watches, self)

    def always(self, condition: Condition, name: str | None = None) -> None:
        """The condition holds at each step from now on."""
        self._add(_Always(condition, name, self._time()))

    def eventually(self, condition: Condition, within: float | None = None, name: str | None = None) -> None:
        """The condition holds at some step within so many seconds, or until the watch ends."""
        self._add(_Eventually(condition, within, name, self._time()))

    def holds_until(self, condition: Condition, end: Condition, within: float | None = None, name: str | None = None) -> None:
        """The condition holds at each step until `end` does, which it does."""
        self._add(_HoldsUntil(condition, end, within, name, self._time()))

    def leads_to(self, condition: Condition, consequence: Condition, within: float, name: str | None = None) -> None:
        """Whenever the condition holds, the consequence does within so many seconds."""
        self._add(_LeadsTo(condition, consequence, within, name, self._time()))

    @property
    def robustness(self) -> float:
        """The least robustness of all; infinite without any."""
        return min((watched.robustness for watched in self._properties), default=math.inf)

    def finish(self) -> None:
        """The run is over: raises what has not come about."""
        self.sample()
        for watched in self._properties:
            if not watched.is_over:
                self._check(watched, watched.finish(self._time()))

    def close(self) -> None:
        """Nothing is watched any more."""
        self._simulator._watches = tuple(watch for watch in self._simulator._watches if watch is not self)

    def sample(self) -> None:
        """Samples all properties, once for each time of the simulation."""
        time = self._time()
        if time == self._sampled:
            return
        self._sampled = time
        for watched in self._properties:
            if not watched.is_over:
                self._check(watched, watched.sample(time))

    def _add(self, watched: _Property) -> None:
        self._properties.append(watched)
        if self._sim.getSimulationState() != self._sim.simulation_stopped:
            self._check(watched, watched.sample(self._time()))

    def _check(self, watched: _Property, reason: str | None) -> None:
        if reason is not None:
            raise watched.violated(reason)

    def _time(self) -> float:
        return self._simulator.time

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, *exception: object) -> None:
        try:
            if kind is None:
                self.finish()
        finally:
            self.close()
