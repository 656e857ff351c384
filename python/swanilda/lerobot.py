"""Tables of `swanilda.dataset` as datasets of LeRobot, version 3.0 (https://huggingface.co/docs/lerobot/lerobot-dataset-v3).

    from swanilda import dataset, lerobot

    lerobot.write(dataset.demonstrate(simulator, observations, actions), 'pushes', task='push the cube')

    LeRobotDataset('local/pushes', root='pushes')      # in lerobot

Needs pyarrow (`pip install pyarrow`), not lerobot.
"""

from __future__ import annotations

import json
import os
import pathlib
import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy
import pyarrow
import pyarrow.compute
import pyarrow.parquet

__all__ = ["write"]

# Where parts of a dataset lie in its folder.
_FILE = "chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
_DATA, _EPISODES = f"data/{_FILE}", f"meta/episodes/{_FILE}"
_FILES_OF_CHUNK = 1000
# Bytes of a file, about.
_FILE_SIZE = 100 << 20
_COUNTERS = {"timestamp": "float32", "frame_index": "int64", "episode_index": "int64", "index": "int64", "task_index": "int64"}
_QUANTILES = (1, 10, 50, 90, 99)
# Pictures of an episode, and of all, that statistics are made of.
_PICTURES = 50


def write(
    table: pyarrow.Table, folder: str | os.PathLike[str], task: str, fps: float | None = None, robot_type: str | None = None
) -> None:
    """Writes a table of `record` or `demonstrate` into a new folder.

    task: what the robot does, in words. fps: actions per second, otherwise as the table's metadata say. Each episode of each world is one.
    Columns become `observation.state` and `action` (float32), `next.reward`, `next.done`, `observation.images.NAME` for pictures; infos
    keep their names. A last episode that was cut off counts like any other.
    """
    root = pathlib.Path(folder)
    if root.exists() and any(root.iterdir()):
        raise FileExistsError(f"{root} has something in it already: a dataset needs a folder of its own")
    if not table.num_rows:
        raise ValueError("the table has no rows")
    facts = json.loads((table.schema.metadata or {}).get(b"swanilda", b"{}"))
    rate = fps or 1 / _known(facts, "action_duration")
    pictures = [field.name for field in table.schema if field.type == pyarrow.binary()]
    frames = _frames(table.sort_by([(name, "ascending") for name in ("world", "episode", "step")]), rate, pictures)
    features = _features(frames, facts, pictures, table)
    episodes = list(_write_frames(root, frames, features, task))
    _write_table(root / _EPISODES.format(chunk_index=0, file_index=0), pyarrow.Table.from_pylist(episodes))
    _write_table(root / "meta/tasks.parquet", _tasks(task))
    _write_json(root / "meta/stats.json", _statistics(frames, features))
    _write_json(root / "meta/info.json", _info(features, rate, robot_type, len(episodes), frames.num_rows))


def _known(facts: Mapping[str, Any], name: str) -> float:
    if name not in facts:
        raise ValueError("the table does not say how long an action takes: give fps")
    return float(facts[name])


def _frames(table: pyarrow.Table, rate: float, pictures: list[str]) -> pyarrow.Table:
    """The rows as LeRobot names them, with its counters."""
    count = table.num_rows
    key = [table[name].to_numpy() for name in ("world", "episode")]
    starts = numpy.flatnonzero(numpy.concatenate([[True], (numpy.diff(key[0]) != 0) | (numpy.diff(key[1]) != 0)]))
    episode = numpy.searchsorted(starts, numpy.arange(count), "right") - 1
    frame = numpy.arange(count) - starts[episode]
    columns = {"observation.state": _numbers(table["observation"]), "action": _numbers(table["action"])}
    for name in pictures:
        files = table[name].combine_chunks()
        columns[f"observation.images.{name}"] = pyarrow.StructArray.from_arrays([files, pyarrow.nulls(count, pyarrow.string())], ["bytes", "path"])
    columns["next.reward"] = table["reward"].cast(pyarrow.float32())
    columns["next.done"] = pyarrow.compute.or_(table["terminated"], table["truncated"])
    known = {"world", "episode", "step", "observation", "action", "next_observation", "reward", "terminated", "truncated", *pictures}
    columns |= {name: _numbers(table[name]) for name in table.column_names if name not in known}
    counters = (frame / rate, frame, episode, numpy.arange(count), numpy.zeros(count))
    columns |= {name: numpy.asarray(values, kind) for (name, kind), values in zip(_COUNTERS.items(), counters)}
    return pyarrow.table(columns)


def _numbers(column: pyarrow.ChunkedArray) -> Any:
    """Numbers or lists of them in single precision; a list of one number is the number."""
    if not pyarrow.types.is_fixed_size_list(column.type):
        return column.cast(pyarrow.float32())
    numbers, width = column.combine_chunks().flatten().cast(pyarrow.float32()), column.type.list_size
    return numbers if width == 1 else pyarrow.FixedSizeListArray.from_arrays(numbers, width)


def _features(frames: pyarrow.Table, facts: Mapping[str, Any], pictures: list[str], table: pyarrow.Table) -> dict[str, dict[str, Any]]:
    """What each column has: its type, shape and names."""
    names = {"observation.state": facts.get("observation"), "action": facts.get("action")}
    features: dict[str, dict[str, Any]] = {}
    for field in frames.schema:
        width = field.type.list_size if pyarrow.types.is_fixed_size_list(field.type) else 1
        kind = {"float": "float32", "double": "float64"}.get(str(field.type), str(field.type))
        features[field.name] = {"dtype": "float32" if width > 1 else kind, "shape": [width], "names": names.get(field.name)}
    for name in pictures:
        width, height = _size(table[name][0].as_py())
        shape = {"dtype": "image", "shape": [height, width, 3], "names": ["height", "width", "channels"]}
        features[f"observation.images.{name}"] = shape
    return features


def _write_frames(root: pathlib.Path, frames: pyarrow.Table, features: Mapping[str, Any], task: str) -> Iterator[dict[str, Any]]:
    """Writes whole episodes into files of limited size; what is to be known of each episode."""
    number = frames["episode_index"].to_numpy()
    starts = [*numpy.flatnonzero(numpy.concatenate([[True], numpy.diff(number) != 0])).tolist(), frames.num_rows]
    waiting: list[pyarrow.Table] = []
    file = 0
    for episode, (start, end) in enumerate(zip(starts, starts[1:])):
        part = frames.slice(start, end - start)
        if waiting and sum(each.nbytes for each in waiting) + part.nbytes > _FILE_SIZE:
            _write_table(root / _place(_DATA, file), pyarrow.concat_tables(waiting))
            waiting, file = [], file + 1
        waiting.append(part)
        chunk_index, file_index = divmod(file, _FILES_OF_CHUNK)
        facts = {"episode_index": episode, "tasks": [task], "length": end - start, "dataset_from_index": start, "dataset_to_index": end}
        facts |= {"data/chunk_index": chunk_index, "data/file_index": file_index}
        facts |= {"meta/episodes/chunk_index": 0, "meta/episodes/file_index": 0}
        own = _statistics(part, features)
        yield facts | {f"stats/{name}/{kind}": value for name, each in own.items() for kind, value in each.items()}
    _write_table(root / _place(_DATA, file), pyarrow.concat_tables(waiting))


def _place(pattern: str, file: int) -> str:
    chunk_index, file_index = divmod(file, _FILES_OF_CHUNK)
    return pattern.format(chunk_index=chunk_index, file_index=file_index)


def _statistics(frames: pyarrow.Table, features: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """What each number is like: least and largest value, mean, standard deviation, quantiles; of pictures those of each colour, from 0 to 1."""
    found = {}
    for name, feature in features.items():
        is_image = feature["dtype"] == "image"
        numbers = _pixels(frames[name]) / 255 if is_image else _columns(frames[name])
        quantiles = numpy.percentile(numbers, _QUANTILES, axis=0)
        each = {"min": numbers.min(axis=0), "max": numbers.max(axis=0), "mean": numbers.mean(axis=0), "std": numbers.std(axis=0)}
        each |= {f"q{share:02d}": values for share, values in zip(_QUANTILES, quantiles)}
        shape = (3, 1, 1) if is_image else (-1,)
        found[name] = {kind: values.reshape(shape).tolist() for kind, values in each.items()} | {"count": [frames.num_rows]}
    return found


def _columns(column: pyarrow.ChunkedArray) -> Any:
    """An array (rows, numbers of a row)."""
    whole = column.combine_chunks()
    values = whole.flatten() if pyarrow.types.is_fixed_size_list(whole.type) else whole.cast(pyarrow.float64())
    return values.to_numpy(zero_copy_only=False).astype(float).reshape(len(column), -1)


def _pixels(column: pyarrow.ChunkedArray) -> Any:
    """An array (pixels, 3) of some of the pictures, whose files `swanilda.dataset` has written: rows without filters in one chunk."""
    pixels = []
    for row in numpy.unique(numpy.linspace(0, len(column) - 1, _PICTURES).astype(int)):
        file = column[int(row)].as_py()["bytes"]
        width, height = _size(file)
        end = 41 + int.from_bytes(file[33:37], "big")
        rows = numpy.frombuffer(zlib.decompress(file[41:end]), numpy.uint8).reshape(height, 1 + 3 * width)
        pixels.append(rows[:, 1:].reshape(-1, 3))
    return numpy.concatenate(pixels)


def _size(file: bytes) -> tuple[int, int]:
    """Width and height of a PNG file."""
    return int.from_bytes(file[16:20], "big"), int.from_bytes(file[20:24], "big")


def _tasks(task: str) -> pyarrow.Table:
    """The only task, as the index of a table of pandas (https://pandas.pydata.org/docs/development/developer.html)."""
    index = "__index_level_0__"
    table = pyarrow.table({"task_index": numpy.zeros(1, int), index: [task]})
    column = {"name": "task_index", "field_name": "task_index", "pandas_type": "int64", "numpy_type": "int64", "metadata": None}
    task_column = {"name": None, "field_name": index, "pandas_type": "unicode", "numpy_type": "object", "metadata": None}
    facts = {"index_columns": [index], "column_indexes": [], "columns": [column, task_column], "pandas_version": "2.0.0"}
    return table.replace_schema_metadata({"pandas": json.dumps(facts)})


def _info(features: Mapping[str, Any], rate: float, robot_type: str | None, episodes: int, frames: int) -> dict[str, Any]:
    return {
        "codebase_version": "v3.0",
        "robot_type": robot_type,
        "total_episodes": episodes,
        "total_frames": frames,
        "total_tasks": 1,
        "chunks_size": _FILES_OF_CHUNK,
        "data_files_size_in_mb": _FILE_SIZE >> 20,
        "video_files_size_in_mb": 200,
        "fps": int(rate) if rate == int(rate) else rate,
        "splits": {"train": f"0:{episodes}"},
        "data_path": _DATA,
        "video_path": None,
        "features": features,
    }


def _write_table(path: pathlib.Path, table: pyarrow.Table) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    pyarrow.parquet.write_table(table, path)


def _write_json(path: pathlib.Path, content: Mapping[str, Any]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=4))
