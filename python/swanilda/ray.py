"""Batches of runs on a cluster of Ray: the same table as `swanilda batch`, byte for byte.

    from swanilda.ray import sweep

    sweep('scene.lua', {'kp': [1, 2, 5]}, seeds=range(100), out='results')

Needs ray (`pip install swanilda[ray]`), and the package and the scene on each machine.
"""

from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import ray

from . import _swanilda

__all__ = ["dataset", "sweep"]

# Runs that are under way for each processor of the cluster: the next is there when one ends.
AHEAD = 2


@ray.remote(max_retries=0)
def _simulate(description: dict[str, Any], number: int) -> str:
    return _swanilda.Batch(**description).simulate(number)


def sweep(
    scene: str | os.PathLike[str],
    params: Mapping[str, Iterable[Any]] | None = None,
    seeds: Iterable[int] = (0,),
    cluster: str | None = None,
    *,
    out: str | os.PathLike[str] = "results",
    fixed: Mapping[str, Any] | None = None,
    time: float | None = None,
    timeout: float = 3600.0,
    retries: int = 3,
    force: bool = False,
    on_row: Callable[[str], Any] | None = None,
) -> os.PathLike[str]:
    """Runs a scene with all combinations of parameters and seeds; returns the path of the table.

    params: names with the values each takes. cluster: address of a Ray cluster; without one, that of this process or a local one.
    out: the folder of `runs.jsonl` and `results.csv`; an interrupted sweep goes on there, `force` begins anew. time, timeout: limits of
    a run, in simulated seconds and by the clock. A run that is lost with its worker is made again up to `retries` times; then its row
    has an error. on_row: called with each row, a line of JSON, as it comes.
    """
    if not ray.is_initialized():
        ray.init(address=cluster, log_to_driver=False, include_dashboard=False)
    description: dict[str, Any] = {
        "scene": os.fspath(scene),
        "seeds": [int(seed) for seed in seeds],
        "sweeps": [(name, [_text(value) for value in values]) for name, values in (params or {}).items()],
        "fixed": {name: _text(value) for name, value in (fixed or {}).items()},
        "time": time,
        "timeout": timeout,
    }
    batch = _swanilda.Batch(**description)
    waiting = batch.open(os.fspath(out), force)[::-1]
    # Workers have another working directory.
    remote = {**description, "scene": str(pathlib.Path(scene).resolve())}
    under_way: dict[Any, int] = {}
    losses: dict[int, int] = {}
    while waiting or under_way:
        while waiting and len(under_way) < AHEAD * max(1, int(ray.cluster_resources().get("CPU", 1))):
            number = waiting.pop()
            under_way[_simulate.remote(remote, number)] = number
        for done in ray.wait(list(under_way), num_returns=1)[0]:
            number = under_way.pop(done)
            line = _line(batch, done, number, losses, retries)
            if line is None:
                waiting.append(number)
            elif batch.add(line) and on_row:
                on_row(line)
    return batch.finish()


def _line(batch: _swanilda.Batch, done: Any, number: int, losses: dict[int, int], retries: int) -> str | None:
    """The row of a run; None when it was lost and is to be made again."""
    try:
        return ray.get(done)
    except ray.exceptions.RayTaskError as error:
        return batch.lost(number, str(error.cause))
    except ray.exceptions.RayError as error:
        losses[number] = losses.get(number, 0) + 1
        if losses[number] <= retries:
            return None
        return batch.lost(number, f"lost {losses[number]} times: {type(error).__name__}")


def dataset(out: str | os.PathLike[str] = "results") -> Any:
    """The rows of a sweep as a Ray Dataset."""
    import ray.data

    return ray.data.read_json(os.path.join(os.fspath(out), "runs.jsonl"))


def _text(value: Any) -> str:
    """A parameter in the words of the command line."""
    return value if isinstance(value, str) else repr(value) if isinstance(value, float) else str(value)


def _main() -> None:
    """The runs of `swanilda batch --ray`: its arguments as JSON. The exit code is 3 when some failed."""
    import json
    import sys

    arguments = json.loads(sys.argv[1])
    sweeps = arguments.pop("params")
    print(sweep(params=dict(sweeps), **arguments))
    lines = pathlib.Path(arguments["out"], "runs.jsonl").read_text().splitlines()
    sys.exit(3 if any(json.loads(line)["error"] is not None for line in lines) else 0)


if __name__ == "__main__":
    # As a module of its own name, so that workers find its functions.
    from swanilda.ray import _main as main

    main()
