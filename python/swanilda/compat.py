"""Programs written for CoppeliaSim's remote API client, in-process: a drop-in for `coppeliasim_zmqremoteapi_client`.

    from swanilda.compat import RemoteAPIClient

    client = RemoteAPIClient()
    sim = client.require('sim')

There is no server: all clients of a thread share one simulator, by default one with the default scene; `use(simulator)` chooses
another, and `RemoteAPIClient(simulator=...)` one for this client. Where the remote simulator runs by itself while a program that does
not step looks on, here each call is preceded by one iteration of the loop. So such programs are deterministic.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

from . import _simulator

__all__ = ["RemoteAPIClient", "use"]

_ADVANCING, _STOPPED = 0x10, 0
_current = threading.local()


def use(simulator: _simulator.Simulator) -> None:
    """Makes a simulator the one of all clients of this thread that do not name one."""
    _current.simulator = simulator


def _shared() -> _simulator.Simulator:
    simulator: _simulator.Simulator | None = getattr(_current, "simulator", None)
    if simulator is None or not simulator.is_open:
        simulator = _simulator.Simulator()
        use(simulator)
    return simulator


class RemoteAPIClient:
    """A client. Host and ports are for programs that pass them; nothing listens there."""

    def __init__(
        self,
        host: str = "localhost",
        port: int = 23000,
        cntport: int | None = None,
        *,
        verbose: int | None = None,
        simulator: _simulator.Simulator | None = None,
    ) -> None:
        self.simulator = simulator or _shared()
        self._level, self._stopping = 0, False
        self._modules: dict[str, _Module] = {}
        self._sim = self.simulator.require("sim")

    def require(self, name: str) -> Any:
        """A module: its functions, with results as the remote client has them."""
        if name not in self._modules:
            plain = self.simulator.require(name)
            self._modules[name] = _Sim(self, name, plain) if name == "sim" else _Module(self, name, plain)
        return self._modules[name]

    # The name of older clients.
    getObject = require

    def call(self, func: str, args: Iterable[Any] = ()) -> Any:
        """Calls a function by its full name."""
        module, _, member = func.rpartition(".")
        return getattr(self.require(module), member)(*args)

    def setStepping(self, enable: bool | int = True) -> int:
        """Whether the simulation waits for step(); returns the level before."""
        before = self._level
        if isinstance(enable, bool):
            self._level = max(0, self._level + (1 if enable else -1))
        else:
            self._level = max(0, int(enable))
        return before

    def step(self, wait: bool = True) -> None:
        """One step; returns at once when the simulation does not run."""
        if self._state() & _ADVANCING:
            self.simulator.iterate()

    def _state(self) -> int:
        state: int = self._sim.getSimulationState()
        return state

    def _advance(self) -> None:
        """What a remote simulator does by itself between two requests."""
        state = self._state()
        self._stopping = self._stopping and state != _STOPPED
        if state != _STOPPED and (self._level == 0 or self._stopping):
            self.simulator.iterate()


class _Module:
    def __init__(self, client: RemoteAPIClient, name: str, plain: Any) -> None:
        self._client, self._name, self._plain = client, name, plain

    def __getattr__(self, name: str) -> Any:
        member = getattr(self._plain, name)
        if callable(member):
            member = self._function(member)
        setattr(self, name, member)
        return member

    def _function(self, plain: Any) -> Callable[..., Any]:
        client = self._client
        wrapped: dict[int, tuple[Any, Any]] = {}

        def prepared(value: Any, depth: int = 2) -> Any:
            if callable(value):
                key = id(value)
                if key not in wrapped:
                    wrapped[key] = (value, _returning(value))  # kept, so that the key stays its own
                return wrapped[key][1]
            if depth and isinstance(value, (list, tuple)) and len(value) <= 16:
                return [prepared(item, depth - 1) for item in value]
            if depth and isinstance(value, dict) and len(value) <= 16:
                return {key: prepared(item, depth - 1) for key, item in value.items()}
            return value

        def function(*args: Any) -> Any:
            client._advance()
            return plain(*map(prepared, args))

        function.__name__ = plain.__name__
        return function

    def __dir__(self) -> list[str]:
        return dir(self._plain)


def _returning(callback: Callable[..., Any]) -> Callable[..., Any]:
    """In callbacks of remote clients, a list is several results and anything else is one; there is no None after the last argument."""

    def call(*args: Any) -> Any:
        while args and args[-1] is None:
            args = args[:-1]
        result = callback(*args)
        if isinstance(result, list):
            return tuple(result)
        return (list(result),) if isinstance(result, tuple) else result

    call.__name__ = getattr(callback, "__name__", "callback")
    return call


class _Sim(_Module):
    """What means something else for a program outside than for a script."""

    def setStepping(self, enable: bool | int = True) -> int:
        return self._client.setStepping(enable)

    def step(self, wait: bool = True) -> None:
        self._client.step(wait)

    def stopSimulation(self, wait: bool = False) -> None:
        self._plain.stopSimulation()
        self._client._stopping = True
        while wait and self.getSimulationState() != _STOPPED:
            pass

    def yield_(self) -> None:
        self._client.step()

    def copyTable(self, table: Any) -> Any:
        import copy

        return copy.deepcopy(table)

    def getScriptFunctions(self, script: int) -> _Functions:
        return _Functions(self, script)


class _Functions:
    """The functions of a script as attributes."""

    def __init__(self, sim: _Sim, script: int) -> None:
        self._sim, self._script = sim, script

    def __getattr__(self, name: str) -> Any:
        return lambda *args: self._sim.callScriptFunction(name, self._script, *args)
