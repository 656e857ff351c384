"""Tables of what worlds have gone through."""

import concurrent.futures
import json
import pathlib
import zlib

import pytest

pyarrow = pytest.importorskip("pyarrow")
pytest.importorskip("gymnasium")

import numpy  # noqa: E402
import pyarrow.parquet  # noqa: E402

import swanilda  # noqa: E402
from swanilda import dataset, gym, lerobot, vec  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"


def make(autoreset, **changes):
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
        **changes,
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


SCENE_THAT_MOVES = """
sim = require 'sim'
function sysCall_init()
    local rail = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(rail, sim.shapeintparam_respondable, 0)
    joint = sim.createJoint(sim.joint_prismatic_subtype, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(joint, 'slider')
    sim.setObjectParent(joint, rail, false)
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
    sim.setJointTargetVelocity(joint, 0)
    body = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(body, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(body, sim.shapeintparam_respondable, 0)
    sim.setObjectParent(body, joint, false)
end
function sysCall_actuation()
    if not by_hand then sim.setJointTargetVelocity(joint, 0.1 + sim.getSimulationTime()) end
    if sim.getSimulationTime() > 0.42 and ends then sim.stopSimulation() end
end
function ending() ends = true end
function steered() by_hand = true end
"""
OBSERVED = [gym.lua("sim.getSimulationTime()"), gym.joint_position("/slider")]
ACTED = [gym.target_velocity("/slider", 1)]


@pytest.fixture
def simulator(tmp_path):
    scene = tmp_path / "scene.lua"
    scene.write_text(SCENE_THAT_MOVES)
    with swanilda.Simulator(scene, quiet=True) as simulator:
        yield simulator


def test_a_script_demonstrates(simulator):
    table = dataset.demonstrate(simulator, OBSERVED, ACTED, episodes=2, max_steps=3, steps_per_action=2, reward=lambda o, a: o[1] + a[0])
    columns = table.to_pydict()
    assert columns["episode"] == [0] * 3 + [1] * 3 and columns["step"] == [0, 1, 2] * 2 and columns["world"] == [0] * 6
    before, after, action = (numpy.array(columns[name]) for name in ("observation", "next_observation", "action"))
    assert numpy.allclose(before[:3, 0], [0, 0.1, 0.2]) and (after[:2] == before[1:3]).all()
    # What the script has set in the second step of each action, at the time before that step.
    assert numpy.allclose(action[:, 0], [0.15, 0.25, 0.35] * 2) and after[2, 1] > after[0, 1] > 0
    assert columns["truncated"] == [False, False, True] * 2 and not any(columns["terminated"])
    assert columns["reward"] == pytest.approx(after[:, 1] + action[:, 0])
    assert (before[3:] == before[:3]).all()


def test_the_end_of_a_demonstration_is_that_of_the_simulation(simulator):
    simulator.script("/Script").ending()
    columns = dataset.demonstrate(simulator, OBSERVED, ACTED).to_pydict()
    assert columns["terminated"] == [False] * 9 + [True] and not any(columns["truncated"])
    columns = dataset.demonstrate(simulator, OBSERVED, ACTED, terminated=lambda o: o[0] > 0.12).to_pydict()
    assert columns["terminated"] == [False, False, True]


class Person:
    """A client of the viewer's page."""

    def __init__(self, url, client):
        self.page, self.steps, self.count = client.connect(url.replace("http", "ws", 1) + "stream", max_size=None), 0, 0

    def look(self):
        """The next message, if it is a text."""
        message = self.page.recv(30)
        message = json.loads(message) if isinstance(message, str) else {}
        self.steps = message.get("scene", {}).get("steps", self.steps)
        return message

    def do(self, what, **members):
        self.count += 1
        self.page.send(json.dumps({"id": self.count, "do": what, **members}))
        while True:
            reply = self.look()
            if reply.get("type") == "reply" and reply["id"] == self.count:
                assert "error" not in reply, reply
                return

    def wait(self):
        """Until two more steps were made."""
        until = self.steps + 2
        while self.steps < until:
            self.look()


def test_a_person_demonstrates_in_the_viewer(simulator):
    client = pytest.importorskip("websockets.sync.client")
    simulator.script("/Script").steered()
    joint, url = simulator.require("sim").getObject("/slider"), simulator.view().url

    def drive():
        person = Person(url, client)
        with person.page:
            person.do("set", handle=joint, name="targetVelocity", value=0.5)
            person.wait()
            person.do("pause")
            person.do("set", handle=joint, name="targetVelocity", value=0.7)
            person.do("play")
            person.wait()
            person.do("stop")

    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        driving = pool.submit(drive)
        columns = dataset.demonstrate(simulator, OBSERVED, ACTED, speed=1).to_pydict()
        driving.result(60)
    actions = [action for (action,) in columns["action"]]
    assert actions == sorted(actions) and actions.count(0.5) >= 2 and actions.count(0.7) >= 2 and set(actions) <= {0.0, 0.5, 0.7}
    assert columns["terminated"] == [False] * (len(actions) - 1) + [True]
    # The first action that acts is that of the row: the slider moves in it.
    first = actions.index(0.5)
    places = [place for _, place in columns["next_observation"]]
    assert all(abs(place) < 1e-6 for place in places[:first]) and places[first] > 0.001


def test_what_cannot_be_demonstrated_is_refused(simulator):
    with pytest.raises(swanilda.Error, match="/motor"):
        dataset.demonstrate(simulator, OBSERVED, [gym.target_velocity("/motor", 1)])
    with pytest.raises(ValueError, match="speed"):
        dataset.demonstrate(simulator, OBSERVED, ACTED, speed=0)
    with pytest.raises(ValueError, match="nothing was demonstrated"):
        dataset.demonstrate(simulator, OBSERVED, ACTED, episodes=0)


def pictures_of(files):
    """Pictures in PNG files, as Pillow or the browser would read them: rows without filters."""
    return [zlib.decompress(file[41 : 41 + int.from_bytes(file[33:37], "big")]) for file in files]


def test_a_table_becomes_a_dataset_of_lerobot(tmp_path):
    envs = make("NextStep", cameras={"view": vec.Camera("/DefaultCamera", (8, 6))})
    table = dataset.record(envs, lambda observations: numpy.full((3, 1), 0.5), 10, seed=1, pictures=True)
    lerobot.write(table, tmp_path / "set", task="slide")
    info = json.loads((tmp_path / "set/meta/info.json").read_text())
    assert (info["fps"], info["total_episodes"], info["total_frames"]) == (20, 6, 24)
    assert info["features"]["observation.state"]["names"][1] == "joint_position('/Slider')"
    assert info["features"]["observation.images.view"]["shape"] == [6, 8, 3]
    frames = pyarrow.parquet.read_table(tmp_path / "set/data/chunk-000/file-000.parquet").to_pydict()
    assert set(frames) == set(info["features"]) and frames["index"] == list(range(24))
    assert frames["episode_index"] == [episode for episode in range(6) for _ in range(4)] and frames["frame_index"] == [0, 1, 2, 3] * 6
    assert frames["timestamp"] == pytest.approx([0, 0.05, 0.1, 0.15] * 6) and frames["next.done"] == [False, False, False, True] * 6
    assert frames["action"] == [0.5] * 24 and frames["height"] == [2] * 24
    assert numpy.allclose(frames["observation.state"], table["observation"].to_pylist())
    assert [picture["bytes"] for picture in frames["observation.images.view"]] == table["view"].to_pylist()
    statistics = json.loads((tmp_path / "set/meta/stats.json").read_text())
    assert statistics["action"] | {"mean": [0.5], "std": [0], "q50": [0.5], "count": [24]} == statistics["action"]
    assert statistics["observation.state"]["max"][0] == pytest.approx(0.15)
    assert 0 < statistics["observation.images.view"]["mean"][0][0][0] < 1
    episodes = pyarrow.parquet.read_table(tmp_path / "set/meta/episodes/chunk-000/file-000.parquet").to_pydict()
    assert episodes["dataset_from_index"] == [0, 4, 8, 12, 16, 20] and episodes["tasks"] == [["slide"]] * 6
    with pytest.raises(FileExistsError, match="folder of its own"):
        lerobot.write(table, tmp_path / "set", task="slide")
    with pytest.raises(ValueError, match="give fps"):
        lerobot.write(table.replace_schema_metadata({}), tmp_path / "other", task="slide")


def test_lerobot_reads_it(simulator, tmp_path):
    reader = pytest.importorskip("lerobot.datasets.lerobot_dataset", reason="lerobot is not installed: it needs torch")
    table = dataset.demonstrate(
        simulator, OBSERVED, ACTED, episodes=2, max_steps=5, cameras={"view": vec.Camera("/DefaultCamera", (8, 6))}
    )
    lerobot.write(table, tmp_path / "set", task="slide")
    read = reader.LeRobotDataset("local/set", root=tmp_path / "set")
    assert (read.num_episodes, read.num_frames, read.fps) == (2, 10, 20)
    item = read[7]
    assert item["task"] == "slide" and item["episode_index"] == 1 and item["frame_index"] == 2
    assert numpy.allclose(item["observation.state"].numpy(), table["observation"][7].as_py())
    assert item["action"].item() == pytest.approx(table["action"][7].as_py()[0])
    rows = numpy.frombuffer(pictures_of([table["view"][7].as_py()])[0], numpy.uint8).reshape(6, 25)[:, 1:].reshape(6, 8, 3)
    assert numpy.allclose(item["observation.images.view"].numpy().transpose(1, 2, 0) * 255, rows)
    assert set(read.meta.stats) == set(read.features)
