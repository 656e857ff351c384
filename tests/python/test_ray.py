"""Sweeps on a local Ray of two workers, of which one is killed in the middle: by the first run that comes there."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

ray = pytest.importorskip("ray")

import swanilda  # noqa: E402
from swanilda.ray import dataset, sweep  # noqa: E402

SCENE = """
sim = require 'sim'
local batch = require 'swanilda.batch'

function sysCall_init()
    local pid = io.open('/proc/self/stat'):read('n')
    local pids = io.open(batch.param('pids'), 'a')
    pids:write(pid, '\\n')
    pids:close()
    batch.result('gain', 2 * batch.param('kp') + math.random())
end

function sysCall_actuation()
    local n = 0
    for i = 1, 2e5 do n = n + i end
    local kills = batch.param('kills')
    if kills and sim.getSimulationTime() > 0.2 and not io.open(kills) then
        io.open(kills, 'w'):close()
        os.execute('kill -9 ' .. math.tointeger(io.open('/proc/self/stat'):read('n')))
    end
    if sim.getSimulationTime() > 0.4 then sim.stopSimulation() end
end
"""


@pytest.fixture(scope="module")
def cluster():
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.lua"
    path.write_text(SCENE)
    return path


def alone(scene, folder, fixed):
    """The same runs in this process."""
    batch = swanilda._swanilda.Batch(str(scene), list(range(4)), [("kp", ["1", "2"])], fixed)
    for number in batch.open(str(folder)):
        batch.add(batch.simulate(number))
    return pathlib.Path(batch.finish()).read_bytes()


def test_a_worker_is_killed_and_nothing_is_lost(cluster, scene, tmp_path):
    fixed = {"pids": str(tmp_path / "pids.txt"), "kills": str(tmp_path / "killed")}
    rows = []

    def on_row(line):
        rows.append(json.loads(line))

    table = sweep(scene, {"kp": [1, 2]}, range(4), out=tmp_path / "ray", fixed=fixed, on_row=on_row)
    assert sorted(row["run"] for row in rows) == list(range(1, 9)), "nothing twice, nothing lost"
    pids = (tmp_path / "pids.txt").read_text().split()
    assert len(pids) > 8, "a run was made again"
    assert pathlib.Path(table).read_bytes() == alone(scene, tmp_path / "alone", fixed)
    assert dataset(tmp_path / "ray").count() == 8


@pytest.mark.skipif("SWANILDA_BIN" not in os.environ, reason="the command is not known")
def test_the_table_is_that_of_the_command(cluster, scene, tmp_path):
    pids = str(tmp_path / "pids.txt")
    command = [os.environ["SWANILDA_BIN"], "batch", str(scene), "--seeds", "0..3", "--sweep", "kp=1,2", "-D", f"pids={pids}"]
    subprocess.run([*command, "--out", str(tmp_path / "command")], check=True, capture_output=True, timeout=120)
    sweep(scene, {"kp": [1, 2]}, range(4), out=tmp_path / "ray", fixed={"pids": pids})
    for name in ["results.csv", "runs.jsonl"]:
        assert (tmp_path / "ray" / name).read_bytes() == (tmp_path / "command" / name).read_bytes()


@pytest.mark.skipif("SWANILDA_BIN" not in os.environ, reason="the command is not known")
def test_the_command_asks_ray(scene, tmp_path):
    pids = str(tmp_path / "pids.txt")
    command = [os.environ["SWANILDA_BIN"], "batch", str(scene), "--seeds", "0..1", "-D", f"pids={pids}", "-D", "kp=1"]
    folder = pathlib.Path(sys.executable).parent
    environment = {**os.environ, "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}"}
    for extra in [["--out", "alone"], ["--out", "ray", "--ray", "local"]]:
        subprocess.run([*command, *extra], check=True, capture_output=True, timeout=120, cwd=tmp_path, env=environment)
    assert (tmp_path / "ray" / "results.csv").read_bytes() == (tmp_path / "alone" / "results.csv").read_bytes()


def test_an_interrupted_sweep_goes_on(cluster, scene, tmp_path):
    fixed, rows = {"pids": str(tmp_path / "pids.txt")}, []

    def stops(line):
        rows.append(line)
        if len(rows) == 3:
            raise KeyboardInterrupt

    arguments = dict(params={"kp": [1, 2]}, seeds=range(4), out=tmp_path / "ray", fixed=fixed)
    with pytest.raises(KeyboardInterrupt):
        sweep(scene, on_row=stops, **arguments)
    sweep(scene, on_row=rows.append, **arguments)
    assert len(rows) == 8


def test_runs_that_fail_are_rows_with_an_error(cluster, tmp_path):
    scene = tmp_path / "bad.lua"
    scene.write_text("function sysCall_actuation() error('a wheel is off') end")
    table = sweep(scene, seeds=[1], out=tmp_path / "ray")
    assert "a wheel is off" in pathlib.Path(table).read_text()


def test_a_run_that_always_kills_its_worker_is_a_row_with_an_error(cluster, tmp_path):
    scene = tmp_path / "kills.lua"
    scene.write_text("local pid = io.open('/proc/self/stat'):read('n') os.execute('kill -9 ' .. math.tointeger(pid))")
    table = sweep(scene, seeds=[1], out=tmp_path / "ray", retries=1)
    assert "lost 2 times" in pathlib.Path(table).read_text()
