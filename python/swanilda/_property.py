"""Properties: tests that run for many cases, whose values a search chooses and shrinks.

    @swanilda.property(cases=200)
    def test_parks(g, simulator):
        speed = g.float(0.1, 1.5)
        ...
        g.robustness(distance - 0.05)
        assert distance > 0.05

The same generators as in tests in Lua (docs/TESTING.md). A simulator among the arguments of the test, such as the fixture `simulator`,
is brought back before each case. Strategies of Hypothesis, given by name, are drawn and shrunk by Hypothesis instead.
"""

from __future__ import annotations

import builtins
import functools
import inspect
import linecache
import math
import os
import random
import re
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from . import _swanilda
from ._simulator import Simulator
from .temporal import Condition, Watch

T = TypeVar("T")

_FAILURES = os.path.join(".swanilda", "failures")
_SEED = 123456


class _Discarded(Exception):
    """The case has values that the test has no use for."""


class Cases:
    """What a property draws the values of a case from."""

    def __init__(self, native: _swanilda.Cases, simulators: Sequence[Simulator] = ()) -> None:
        self._native = native
        self._simulators = simulators
        self._begin()

    def _begin(self) -> None:
        self._depth = 0
        self._notes: list[str] = []
        self._robustness = math.inf
        self._watch: Watch | None = None

    @contextmanager
    def _part(self) -> Iterator[Callable[[Any], None]]:
        """Choices that belong together; the value of the outermost part is noted with its line."""
        frame = _frame_of_test() if self._depth == 0 else None
        self._depth += 1
        self._native.span(True)
        made: list[Any] = []
        try:
            yield made.append
        finally:
            self._depth -= 1
            self._native.span(False)
        if frame and made:
            self._note(frame, repr(made[0]))

    def _note(self, frame: tuple[str, int], text: str) -> None:
        line = linecache.getline(*frame).strip()
        self._notes.append(f"{frame[1]}: {line}  -> {text}")

    def float(self, lo: builtins.float, hi: builtins.float, simplest: builtins.float | None = None) -> builtins.float:
        """A number from `lo` to `hi`; simplest where it is nearest to zero, unless said otherwise."""
        with self._part() as made:
            _check_bounds(lo, hi)
            value = self._native.choose_float(lo, hi, _nearest(lo, hi, 0.0 if simplest is None else simplest))
            made(value)
        return value

    def integer(self, lo: int, hi: int, simplest: int | None = None) -> int:
        """A whole number from `lo` to `hi`."""
        with self._part() as made:
            _check_bounds(lo, hi)
            value = self._native.choose_integer(lo, hi, _nearest(lo, hi, 0 if simplest is None else simplest))
            made(value)
        return value

    def boolean(self) -> bool:
        """False is simplest."""
        with self._part() as made:
            value = self._native.choose_integer(0, 1, 0) == 1
            made(value)
        return value

    def seed(self) -> int:
        """A seed, with which Python's `random` begins."""
        value = self.integer(0, 0x7FFFFFFF)
        random.seed(value)
        return value

    def choice(self, alternatives: Sequence[T]) -> T:
        """One of them; the first is simplest."""
        if not alternatives:
            raise ValueError("g.choice: a sequence of alternatives is expected, the simplest first")
        with self._part() as made:
            value = alternatives[self._native.choose_integer(0, len(alternatives) - 1, 0)]
            made(value)
        return value

    def subset(self, elements: Sequence[T]) -> builtins.list[T]:
        """Some of them, in order."""
        with self._part() as made:
            value = [element for element in elements if self._native.choose_integer(0, 1, 0) == 1]
            made(value)
        return value

    def list(self, element: Callable[[], T], min: int = 0, max: int = 100) -> builtins.list[T]:
        """What `element` draws, between `min` and `max` times."""
        with self._part() as made:
            value: builtins.list[T] = []
            more = True
            while more:
                self._native.span(True)
                more = self._follows(len(value), min, max)
                if more:
                    value.append(element())
                self._native.span(False)
            made(value)
        return value

    def _follows(self, count: int, least: int, most: int) -> bool:
        # A choice also where there is none, so that elements can be left out and what comes after stays.
        if count < least:
            return self._native.choose_integer(1, 1, 1) == 1
        if count >= most:
            return self._native.choose_integer(0, 0, 0) == 1
        return self._native.follows(1 - 1 / (2 + (most - least) / 2))

    def _within(self, value: Any) -> builtins.float:
        return self.float(value[0], value[1]) if isinstance(value, Sequence) else builtins.float(value)

    def point(self, x: Any = 0.0, y: Any = 0.0, z: Any = 0.0) -> builtins.list[builtins.float]:
        """`[x, y, z]` in metres; a pair is a range, a number is fixed."""
        with self._part() as made:
            value = [self._within(x), self._within(y), self._within(z)]
            made(value)
        return value

    def pose(
        self, x: Any = 0.0, y: Any = 0.0, z: Any = 0.0, roll: Any = 0.0, pitch: Any = 0.0, yaw: Any = 0.0
    ) -> builtins.list[builtins.float]:
        """A pose `[x, y, z, qx, qy, qz, qw]`; angles in radians about the fixed axes x, y, z, in this order."""
        with self._part() as made:
            a, b, c = (self._within(angle) / 2 for angle in (roll, pitch, yaw))
            sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
            quaternion = [
                sa * cb * cc - ca * sb * sc,
                ca * sb * cc + sa * cb * sc,
                ca * cb * sc - sa * sb * cc,
                ca * cb * cc + sa * sb * sc,
            ]
            value = [*(self._within(part) for part in (x, y, z)), *quaternion]
            made(value)
        return value

    def path(
        self, x: Any = 0.0, y: Any = 0.0, z: Any = 0.0, points: tuple[int, int] = (2, 6)
    ) -> builtins.list[builtins.list[builtins.float]]:
        """A list of points."""
        return self.list(lambda: self.point(x, y, z), points[0], points[1])

    def assume(self, condition: bool) -> None:
        """Discards the case unless the condition holds."""
        if not condition:
            raise _Discarded

    def note(self, name: str, value: object) -> None:
        """Shows a value with the case."""
        self._note(_frame_of_test(), f"{name} = {value!r}")

    def robustness(self, value: builtins.float) -> None:
        """How far the case is from failing, such as a clearance; the least of a case leads the search."""
        self._robustness = min(self._robustness, builtins.float(value))

    def always(self, condition: Condition, name: str | None = None) -> None:
        """The condition holds at each step of the simulator from now on (`swanilda.temporal`)."""
        self._watched().always(condition, name)

    def eventually(self, condition: Condition, within: builtins.float | None = None, name: str | None = None) -> None:
        """The condition holds at some step within so many seconds, or until the end of the case."""
        self._watched().eventually(condition, within, name)

    def holds_until(
        self, condition: Condition, end: Condition, within: builtins.float | None = None, name: str | None = None
    ) -> None:
        """The condition holds at each step until `end` does, which it does."""
        self._watched().holds_until(condition, end, within, name)

    def leads_to(self, condition: Condition, consequence: Condition, within: builtins.float, name: str | None = None) -> None:
        """Whenever the condition holds, the consequence does within so many seconds."""
        self._watched().leads_to(condition, consequence, within, name)

    def _watched(self) -> Watch:
        if self._watch is None:
            if len(self._simulators) != 1:
                raise TypeError(
                    "what has to hold over time is watched in the simulator of the test: it needs one as an argument, such as the fixture sim"
                )
            self._watch = Watch(self._simulators[0])
        return self._watch

    def _run(self, test: Callable[..., Any], args: Any, kwargs: Any) -> None:
        """Runs the test for this case."""
        self._begin()
        try:
            test(*args, g=self, **kwargs)
            if self._watch:
                self._watch.finish()
        finally:
            if self._watch:
                self.robustness(self._watch.robustness)
                self._watch.close()


def _check_bounds(lo: float, hi: float) -> None:
    if not (math.isfinite(lo) and math.isfinite(hi)):
        raise ValueError("bounds are finite")
    if lo > hi:
        raise ValueError(f"the lower bound {lo} is above the upper one, {hi}")


def _nearest(lo: Any, hi: Any, value: Any) -> Any:
    return max(lo, min(hi, value))


def _frame_of_test() -> tuple[str, int]:
    """The file and the line outside of this module that draws."""
    frame = sys._getframe(1)
    own = (__file__, contextmanager.__code__.co_filename)
    while frame.f_code.co_filename in own and frame.f_back:
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def property(
    function: Callable[..., Any] | None = None,
    *,
    cases: int = 100,
    shrinks: int = 300,
    seed: int = _SEED,
    **strategies: Any,
) -> Callable[..., Any]:
    """Makes a test run for many cases.

    The test gets its values from its argument `g` (`Cases`), or, for each strategy of Hypothesis that is given by name, as that argument.
    `cases` are tried, until one fails; it is then shrunk in at most `shrinks` runs, kept in `.swanilda/failures`, and tried first
    the next time.
    """

    def decorate(test: Callable[..., Any]) -> Callable[..., Any]:
        if strategies:
            return _by_hypothesis(test, strategies, cases)
        return _by_search(test, cases, shrinks, seed)

    return decorate(function) if function is not None else decorate


def _by_search(test: Callable[..., Any], cases: int, shrinks: int, seed: int) -> Callable[..., Any]:
    @functools.wraps(test)
    def run(*args: Any, **kwargs: Any) -> None:
        native = _swanilda.Cases(_name_of(test), _FAILURES, cases, shrinks, seed)
        simulators = _simulators_of([*args, *kwargs.values()])
        case = Cases(native, simulators)
        restore = _restoring(simulators)
        while native.next():
            restore()
            native.finish(*_ended(test, case, args, kwargs))
        tried, shrunk, failing = native.result()
        if failing is None:
            return
        restore()
        native.repeat(failing)
        _raise_failure(test, case, args, kwargs, f"failed in case {tried} of the search, shrunk in {shrunk} runs:", failing)

    run.__signature__ = _without(test, {"g"})  # type: ignore[attr-defined]
    return run


def _name_of(test: Callable[..., Any]) -> str:
    file = inspect.getsourcefile(test) or ""
    try:
        file = os.path.relpath(file)
    except ValueError:  # another drive
        pass
    return f"{file}::{test.__qualname__}"


def _without(test: Callable[..., Any], names: set[str]) -> inspect.Signature:
    """The signature that pytest is to see: these are no fixtures."""
    signature = inspect.signature(test)
    kept = [parameter for name, parameter in signature.parameters.items() if name not in names]
    return signature.replace(parameters=kept)


def _simulators_of(values: Sequence[Any]) -> list[Simulator]:
    """The simulators among the arguments of a test, each once."""
    simulators = [value for value in values if isinstance(value, Simulator)]
    simulators += [value.simulator for value in values if isinstance(getattr(value, "simulator", None), Simulator)]
    return list(dict.fromkeys(simulators))


def _restoring(simulators: Sequence[Simulator]) -> Callable[[], None]:
    """A function that brings the simulators back to where they are now."""
    moments = [(simulator, simulator.snapshot()) for simulator in simulators]

    def restore() -> None:
        for simulator, snapshot in moments:
            simulator.restore(snapshot)

    return restore


def _ended(test: Callable[..., Any], case: Cases, args: Any, kwargs: Any) -> tuple[str, str, float]:
    try:
        case._run(test, args, kwargs)
    except _Discarded:
        return "discarded", "", math.inf
    except Exception as error:
        robustness = case._robustness if case._robustness < 0 else -math.inf
        return "failed", _place_of(error), robustness
    return "passed", "", case._robustness


def _place_of(error: Exception) -> str:
    """Two cases that fail at the same line with messages that differ in numbers only fail for the same reason."""
    frames = traceback.extract_tb(error.__traceback__)
    last = frames[-1]
    lines = str(error).splitlines() or [""]
    message = re.sub(r"-?\d[\d.e+-]*", "#", lines[0])
    return f"{type(error).__name__}:{last.filename}:{last.lineno}:{message}"


def _raise_failure(test: Any, case: Cases, args: Any, kwargs: Any, found: str, failing: Sequence[float]) -> None:
    try:
        case._run(test, args, kwargs)
    except Exception as error:
        values = [found, *(f"    {note}" for note in case._notes)]
        case._native.keep(f"{type(error).__name__}: {error}", failing)
        _add_note(error, "\n".join(values))
        raise
    raise AssertionError(f"{found} it passes when it is run again: something of a case is left over")


def _add_note(error: Exception, text: str) -> None:
    if hasattr(error, "add_note"):
        error.add_note(text)
    else:  # before Python 3.11
        error.args = (f"{error}\n{text}", *error.args[1:])


def _by_hypothesis(test: Callable[..., Any], strategies: dict[str, Any], cases: int) -> Callable[..., Any]:
    try:
        import hypothesis
    except ImportError as error:
        raise ImportError("strategies are drawn by Hypothesis: pip install hypothesis, or draw from the argument g") from error
    unknown = [name for name, strategy in strategies.items() if not isinstance(strategy, hypothesis.strategies.SearchStrategy)]
    if unknown:
        raise TypeError(f"{unknown[0]} is neither an option of swanilda.property nor a strategy of Hypothesis")

    @functools.wraps(test)
    def run(*args: Any, **kwargs: Any) -> None:
        restore = _restoring(_simulators_of([*args, *kwargs.values()]))

        @hypothesis.settings(max_examples=cases, deadline=None, database=None)
        @hypothesis.given(**strategies)
        def example(**values: Any) -> None:
            restore()
            test(*args, **kwargs, **values)

        example()

    run.__signature__ = _without(test, set(strategies))  # type: ignore[attr-defined]
    return run
