"""The simulator: what is easier in Python than in the extension."""

from __future__ import annotations

import contextlib
import inspect
import os
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex, SupportsInt

from . import _display, _swanilda

if TYPE_CHECKING:
    import numpy
    from numpy.typing import NDArray
    from typing_extensions import Self

    from .temporal import Watch


class Script:
    """A script of a simulator. Its global functions are attributes: `script.position(2)`."""

    def __init__(self, simulator: Simulator, handle: int) -> None:
        self._simulator = simulator
        self.handle = handle

    def require(self, name: str) -> Any:
        """A module, in the name of this script: relative paths such as '..' start at it."""
        return self._simulator.require(name, self.handle)

    def call(self, function: str, *args: Any) -> Any:
        """Calls a global function of the script."""
        return self._simulator._call_script(self.handle, function, *args)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("__"):
            raise AttributeError(name)

        def function(*args: Any) -> Any:
            return self.call(name, *args)

        function.__name__ = name
        return function

    def __index__(self) -> int:
        return self.handle

    def __repr__(self) -> str:
        return f"<script {self.handle} of a simulator>"


class Simulator(_swanilda.Simulator):
    """A simulator, in-process. It belongs to the thread that makes it.

    scene: a scene or model of CoppeliaSim, a Lua file or an unpacked folder; without one the default scene, or nothing if `empty`.
    seed: of every random number of scripts. params: named parameters for scripts. kind: the type of script that a Lua file becomes.
    time_step: seconds. quiet: shows neither prints nor the log. unsafe_functions=False: scripts reach no files, programs or networks.
    """

    _watches: tuple[Watch, ...] = ()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def step(self, count: int = 1) -> int:
        """Steps of the simulation; returns how many ran, fewer when a script stopped or paused it."""
        if not self._watches:
            return super().step(count)
        for made in range(count):
            if not super().step(1):
                return made
            self._sample()
        return count

    def iterate(self) -> None:
        """One iteration of the loop, with a step if the simulation runs."""
        super().iterate()
        self._sample()

    def _sample(self) -> None:
        for watch in self._watches:
            watch.sample()

    def branch(self, n: int) -> list[Simulator]:
        """Simulators that go on from the present moment, each as this one would: what happens in one is unknown to the others.

        One of them is in memory at a time, so to go from one to another takes as long as a snapshot and a restore. Modules and scripts
        belong to the simulator that they were asked of.
        """
        return [Simulator(_branch=number) for number in self._branch(n)]

    def script(self, path: str | SupportsIndex) -> Script:
        """The script with that path or handle."""
        sim = self.require("sim")
        handle = sim.getObject(path) if isinstance(path, str) else path.__index__()
        return Script(self, handle)

    def add_script(self, code: object, kind: str = "customization", name: str = "") -> Script:
        """Adds a script.

        code: Lua as text; or in Python a module, an object or a class, whose functions `sysCall_init`, `sysCall_actuation`, ... are
        called. A class is instantiated each time the script starts; if it takes an argument, with the `Script`. `sysCall_thread` is a
        generator: it waits for the next step at each `yield`.
        kind: 'customization', 'simulation' or 'addon'; Lua also 'sandbox' and 'main'.
        """
        if isinstance(code, str):
            return Script(self, self._add_lua_script(kind, name, code.encode()))
        return Script(self, self._add_python_script(kind, name or _name_of(code), self._factory(code)))

    def _factory(self, code: Any) -> Callable[[int], Any]:
        if not inspect.isclass(code):
            return lambda handle: code
        create: Callable[..., Any] = code
        if _takes_an_argument(code):
            return lambda handle: create(Script(self, handle))
        return lambda handle: create()

    def image(self, sensor: SupportsInt | None = None, resolution: Sequence[int] | None = None) -> NDArray[numpy.uint8]:
        """What a vision sensor or camera sees, or a picture of the scene, as an array (height, width, 3) of bytes, upright."""
        import numpy

        width, height, rows = self._picture(_handle(sensor), resolution)
        return numpy.frombuffer(rows, numpy.uint8).reshape(height, width, 3)

    def sensor_image(self, sensor: SupportsInt) -> NDArray[numpy.uint8]:
        """The image that a vision sensor took when it was last handled, as an array (height, width, 3) of bytes, upright."""
        import numpy

        rows, (width, height) = self.require("sim").getVisionSensorImg(int(sensor))
        return numpy.frombuffer(rows, numpy.uint8).reshape(height, width, 3)[::-1]

    def sensor_depth(self, sensor: SupportsInt) -> NDArray[numpy.float32]:
        """The depths that a vision sensor saw when it was last handled, in metres, as an array (height, width) of floats, upright."""
        import numpy

        sim = self.require("sim")
        depths, (width, height) = sim.getVisionSensorDepth(int(sensor), 1)
        return numpy.frombuffer(depths, numpy.float32).reshape(height, width)[::-1]

    def objects(self) -> list[tuple[int, str, int]]:
        """The objects of the scene: a list of (handle, path, type)."""
        sim = self.require("sim")
        handles = sim.getObjectsInTree(sim.handle_scene)
        return [(handle, sim.getObjectAlias(handle, 2), sim.getObjectType(handle)) for handle in handles]

    def record(self, path: str | os.PathLike[str], images: bool = False) -> contextlib.AbstractContextManager[object]:
        """Records what the simulator shows from now on in a file that `swanilda view` plays, until `end_recording`, `close` or the end of a
        `with s.record('run.swr'):`. images: with what vision sensors see."""
        self._record(path, images)
        ending = contextlib.ExitStack()
        ending.callback(self.end_recording)
        return ending

    def view(self, port: int = 0, height: int = 480) -> _display.View:
        """The viewer's page: a notebook shows it, `.url` is its address. It follows the steps; `serve` looks after it between them."""
        return _display.View(self._view(port), height)

    def serve(self, seconds: float | None = None) -> None:
        """Runs the loop for people who look at the viewer's page, for some seconds or until ctrl-c."""
        end = None if seconds is None else time.monotonic() + seconds
        while end is None or time.monotonic() < end:
            self._serve(0.02)

    def _repr_html_(self) -> str | None:
        return _display.simulator_html(self) if self.is_open else None

    def __repr__(self) -> str:
        if not self.is_open:
            return "<closed simulator>"
        return f"<simulator: {self.state}, {self.time:.3f} s>"

    def __reduce__(self) -> NoReturn:
        raise TypeError("a simulator stays in its process: make one in each")


def _handle(thing: SupportsInt | None) -> int | None:
    return None if thing is None else int(thing)


def _name_of(code: object) -> str:
    name = getattr(code, "__name__", None) or type(code).__name__
    return "".join(c if c.isalnum() or c == "_" else "_" for c in os.path.basename(name))


def _takes_an_argument(cls: type) -> bool:
    try:
        return bool(inspect.signature(cls).parameters)
    except ValueError:
        return False
