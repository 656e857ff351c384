"""Tables of what worlds have gone through."""

import pathlib

import pytest

pyarrow = pytest.importorskip("pyarrow")
pytest.importorskip("gymnasium")

import numpy  # noqa: E402
import pyarrow.parquet  # noqa: E402

from swanilda import dataset, gym, vec  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"


def make(autoreset):
    return vec.make(
        SCENE,
        3,
        observations=[gym.lua("sim.getSimulationTime()"), gym.joint_position("/Slider")],
        actions=[gym.target_velocity("/Slider", 1)],
        reward="a[1]",
        max_steps=4,
        prepare="sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}",
        infos={"height": gym.lua("2")},
        autoreset=autoreset,
    )


@pytest.mark.parametrize("autoreset, steps", [("NextStep", 10), ("SameStep", 8)])
def test_rows_follow_each_other(tmp_path, autoreset, steps):
    actions = iter(numpy.linspace(0.1, 0.9, steps * 3).reshape(steps, 3, 1))
    table = dataset.record(make(autoreset), lambda observations: next(actions), steps, seed=1)
    dataset.write(table, tmp_path / "rows.parquet")
    columns = pyarrow.parquet.read_table(tmp_path / "rows.parquet").to_pydict()
    # Two episodes of four actions: the step between them is none, where the next one begins one.
    assert columns["world"] == [0] * 8 + [1] * 8 + [2] * 8
    assert columns["episode"][:8] == [0] * 4 + [1] * 4 and columns["step"][:8] == [0, 1, 2, 3] * 2
    before, after = numpy.array(columns["observation"]), numpy.array(columns["next_observation"])
    assert numpy.allclose(before[:8, 0], [0, 0.05, 0.1, 0.15] * 2) and numpy.allclose(after[:8, 0], [0.05, 0.1, 0.15, 0.2] * 2)
    assert (after[:3] == before[1:4]).all() and (after[4:7] == before[5:8]).all()
    assert columns["reward"] == [action for action, in columns["action"]] and len(set(columns["reward"])) == 24
    assert columns["truncated"][:8] == [False, False, False, True] * 2 and not any(columns["terminated"])
    assert columns["height"] == [2] * 24


def test_worlds_that_do_not_begin_again_are_refused():
    with pytest.raises(ValueError, match="NextStep or SameStep"):
        dataset.record(make("Disabled"), lambda observations: observations, 1)
