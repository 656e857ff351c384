"""Many worlds as one environment."""

import pathlib
import signal
import threading

import pytest

gymnasium = pytest.importorskip("gymnasium")

import numpy  # noqa: E402
from gymnasium.vector import AutoresetMode  # noqa: E402

from recorded import exported, needs_command  # noqa: E402

from swanilda import Error, gym, vec  # noqa: E402

SCENE = pathlib.Path(__file__).parents[2] / "scenes" / "inverted_pendulum.lua"
PREPARE = "sim.removeObjects{sim.getObject('/Controller'), sim.getObject('/Script')}"


def make(count=4, **changes):
    arguments = {
        "observations": [gym.joint_position("/Slider", 4), gym.joint_velocity("/Slider"), gym.joint_position("/Hinge")],
        "actions": [gym.target_velocity("/Slider", 3)],
        "reward": "1 - math.abs(o[1]) + a[1]",
        "terminated": "math.abs(o[3]) > 0.5",
        "max_steps": 30,
        "prepare": PREPARE,
        "begin": "sim.setJointTargetVelocity(sim.getObject('/Slider'), 0.2 * math.random() - 0.1)",
        "randomize": [vec.displacement("/Slider", [-0.1, 0, 0], [0.1, 0, 0])],
    }
    return vec.make(SCENE, count, **arguments | changes)


def episode(envs, seed, steps=60):
    """All that comes out of a number of steps."""
    seen = [envs.reset(seed=seed)[0]]
    rng = numpy.random.default_rng(1)
    for _ in range(steps):
        # All worlds get the same, so that those of other environments can.
        action = numpy.full((envs.num_envs, 1), rng.uniform(-0.1, 0.1))
        seen += envs.step(action)[:4]
    return seen


@pytest.mark.parametrize("autoreset", list(AutoresetMode)[:2])
def test_a_world_is_the_same_alone_and_among_others(autoreset):
    together = episode(make(5, threads=3, autoreset=autoreset), 10)
    for world in (0, 3):
        alone = episode(make(1, autoreset=autoreset), 10 + world)
        assert all((one[world] == other[0]).all() for one, other in zip(together, alone))
    assert any((each[0] != each[3]).any() for each in together)


def test_functions_of_all_worlds_give_the_same_as_lua():
    by_python = make(reward=lambda o, a: 1 - abs(o[:, 0]) + a[:, 0], terminated=lambda o: abs(o[:, 2]) > 0.5)
    for one, other in zip(episode(make(), 3), episode(by_python, 3)):
        assert (one == other).all()


def test_episodes_end_as_gymnasium_says():
    spaces = make()
    assert spaces.single_observation_space.shape == (3,) and spaces.action_space.shape == (4, 1)
    assert spaces.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP
    next_step = make(2, terminated=None, infos={"place": gym.position("/Slider")})
    same_step = make(2, terminated=None, autoreset="SameStep")
    first = next_step.reset(seed=1)[1]["place"]
    same_step.reset(seed=1)
    zeros = numpy.zeros((2, 1))
    for _ in range(29):
        next_step.step(zeros), same_step.step(zeros)
    last, _, terminated, truncated, infos = next_step.step(zeros)
    assert truncated.all() and not terminated.any() and "final_obs" not in infos
    begun, reward, terminated, truncated, begun_infos = next_step.step(zeros)
    assert not truncated.any() and (reward == 0).all() and (abs(begun[:, 1]) < 1e-9).all()
    observation, reward, _, truncated, infos = same_step.step(zeros)
    assert truncated.all() and infos["_final_obs"].all() and (reward != 0).all()
    assert (numpy.stack(infos["final_obs"]) == last).all() and (observation == begun).all()
    assert (first != begun_infos["place"]).any(axis=1).all()


def test_some_worlds_begin_again():
    envs = make(3, autoreset="Disabled")
    first, _ = envs.reset(seed=1)
    moved, *_ = envs.step(numpy.ones((3, 1)))
    begun, _ = envs.reset(seed=[7, 2, 7], options={"reset_mask": numpy.array([False, True, False])})
    assert (begun[[0, 2]] == moved[[0, 2]]).all() and (begun[1] == first[1]).all()


def test_infos_and_pictures():
    envs = make(
        2,
        infos={"slider": gym.position("/Slider"), "time": gym.lua("sim.getSimulationTime()")},
        cameras={"view": vec.Camera("/DefaultCamera", (32, 24))},
        render_mode="rgb_array",
        camera="/DefaultCamera",
        resolution=(16, 8),
    )
    observation, infos = envs.reset(seed=1)
    assert infos["slider"].shape == (2, 3) and infos["time"].shape == (2,)
    assert observation["view"].shape == (2, 24, 32, 3) and observation["view"].std() > 0
    assert envs.observation_space.contains(observation)
    assert [picture.shape for picture in envs.render()] == [(8, 16, 3)] * 2


def test_a_failing_world_is_named_and_nothing_else_is_lost():
    fails = gym.lua("if x > 2 then error('too fast') end; sim.setJointTargetVelocity(sim.getObject('/Slider'), x)", -3, 3)
    actions = numpy.array([[0.1], [2.5], [0.1]])
    envs = make(3, actions=[fails])
    envs.reset(seed=1)
    with pytest.raises(vec.WorldError, match="world 1: .*too fast") as caught:
        envs.step(actions)
    assert [world for world, _ in caught.value.failures] == [1]
    envs.step(numpy.zeros((3, 1)))
    observation, _, _, truncated, _ = envs.step(numpy.zeros((3, 1)))
    assert numpy.isfinite(observation).all() and not truncated.any()

    envs = make(3, actions=[fails], on_error="truncate")
    envs.reset(seed=1)
    with pytest.warns(RuntimeWarning, match="world 1"):
        _, rewards, _, truncated, infos = envs.step(actions)
    assert list(truncated) == [False, True, False] and rewards[1] == 0 and rewards[0] != 0
    assert "too fast" in infos["error"][1] and list(infos["_error"]) == [False, True, False]


def test_wrong_actions_and_declarations_are_refused():
    envs = make(2)
    envs.reset(seed=1)
    with pytest.raises(ValueError, match=r"\(2, 1\)"):
        envs.step(numpy.zeros(2))
    with pytest.raises(ValueError, match="action 0 of world 1 is no finite number"):
        envs.step([[0.0], [numpy.nan]])
    with pytest.raises(Error, match="world 0: '/Motor'"):
        make(observations=[gym.joint_position("/Motor")])
    with pytest.raises(Error, match="the property weight of|property 'weight'"):
        make(observations=[gym.scene_property("/Pole", "weight")])
    with pytest.raises(ValueError, match="'joint_position' cannot be used here"):
        make(actions=[gym.joint_position("/Slider")])
    with pytest.raises(Error, match="world 0: .*nowhere"):
        vec.make("nowhere.ttt", 1, [], [], "0")


def test_scripts_in_python_run_in_every_world(tmp_path):
    scene = tmp_path / "scene.py"
    scene.write_text("#python\ndef sysCall_init():\n    sim = require('sim')\n\ndef double(): return 2 * sim.getSimulationTime()\n")
    envs = vec.make(scene, 2, [gym.function("/Script", "double")], [], "0", max_steps=3)
    assert not envs.resets_by_snapshot
    envs.reset(seed=1)
    for _ in range(5):
        observation, *_ = envs.step(numpy.zeros((2, 0)))
    # Three steps, a new episode, and a step.
    assert numpy.allclose(observation, 2 * 0.05)


def test_the_wrappers_of_gymnasium_work():
    envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(make(2, terminated=None))
    envs.reset(seed=1)
    for _ in range(30):
        *_, infos = envs.step(envs.action_space.sample() * 0)
    assert list(infos["episode"]["l"]) == [30, 30]
    envs.close()


@needs_command
@pytest.mark.parametrize("autoreset", ["NextStep", "SameStep"])
def test_chosen_episodes_are_recorded(tmp_path, autoreset):
    folder = tmp_path / "episodes"
    arguments = {"max_steps": 5, "autoreset": autoreset, "terminated": None}
    envs = make(3, record=vec.Recordings(folder, worlds=[0, 2], every=2), **arguments)
    for one, other in zip(episode(envs, 1, steps=17), episode(make(3, **arguments), 1, steps=17)):
        assert (one == other).all()
    assert sorted(path.name for path in folder.iterdir()) == [f"world-{k}-episode-{n}.swr" for k in (0, 2) for n in (0, 2)]
    times, frames, _ = exported(folder / "world-2-episode-2.swr")
    assert times == pytest.approx([0, 0.05, 0.1, 0.15, 0.2, 0.25]) and any("Slider" in frame for frame in frames)
    # The next episode of another world, as a file of its own.
    envs.reset(seed=1, options={"record": {1: tmp_path / "one.swr"}})
    envs.step(numpy.zeros((3, 1)))
    envs.close()
    assert exported(tmp_path / "one.swr")[0] == pytest.approx([0, 0.05])


@needs_command
def test_the_recording_of_a_failed_episode_shows_the_error(tmp_path):
    envs = make(1, actions=[gym.lua("if x > 2 then error('too fast') end", -3, 3)], record=vec.Recordings(tmp_path))
    envs.reset(seed=1)
    with pytest.raises(vec.WorldError, match="too fast"):
        envs.step([[2.5]])
    assert any("too fast" in text for text in exported(tmp_path / "world-0-episode-0.swr")[2])


def test_recordings_that_cannot_be_are_refused(tmp_path):
    envs = make(2)
    with pytest.raises(vec.WorldError, match="world 1: cannot write .*nowhere"):
        envs.reset(options={"record": {1: tmp_path / "nowhere" / "a.swr"}})
    with pytest.raises(ValueError, match="no world 2: they are 0 to 1"):
        envs.reset(options={"record": {2: tmp_path / "a.swr"}})
    with pytest.raises(ValueError, match="no episode begins in world 1"):
        envs.reset(options={"record": {1: tmp_path / "a.swr"}, "reset_mask": numpy.array([True, False])})
    with pytest.raises(ValueError, match="from 1, not 0"):
        make(record=vec.Recordings(tmp_path, every=0))
    envs.reset(seed=1)
    # A folder that goes away takes recordings with it, not steps.
    envs = make(1, record=vec.Recordings(tmp_path / "gone"), max_steps=1)
    envs.reset(seed=1)
    for path in (tmp_path / "gone").iterdir():
        path.unlink()
    (tmp_path / "gone").rmdir()
    envs.step(numpy.zeros((1, 1)))
    with pytest.warns(RuntimeWarning, match="world 0: cannot write"):
        observation, *_ = envs.step(numpy.zeros((1, 1)))
    assert numpy.isfinite(observation).all()


@pytest.mark.parametrize("reset_by", ["snapshot", "start"])
def test_ctrl_c_ends_what_takes_long_and_the_worlds_go_on(reset_by):
    endless = gym.lua("while x > 2 do end", -3, 3)
    envs = make(3, actions=[endless], threads=3, reset_by=reset_by)
    envs.reset(seed=1)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        envs.step([[0], [2.5], [0]])
    observation, rewards, *_ = envs.step(numpy.zeros((3, 1)))
    assert numpy.isfinite(observation).all() and list(rewards != 0) == [True, False, True]
    envs = make(2, steps_per_action=10**12, reset_by=reset_by)
    envs.reset(seed=1)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        envs.step(numpy.zeros((2, 1)))


def test_ctrl_c_ends_the_making_of_worlds(tmp_path):
    scene = tmp_path / "scene.lua"
    scene.write_text("function sysCall_init() while true do end end")
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        vec.make(scene, 2, [], [], "0")


@pytest.mark.parametrize("reset_by", ["snapshot", "start"])
def test_an_episode_ends_with_the_step_in_which_a_script_stops_the_simulation(tmp_path, reset_by):
    scene = tmp_path / "scene.lua"
    scene.write_text("sim = require 'sim'\nfunction sysCall_actuation() if sim.getSimulationTime() > 0.08 then sim.stopSimulation() end end")
    envs = vec.make(scene, 1, [gym.lua("sim.getSimulationTime()")], [], "o[1]", reset_by=reset_by)
    seen = [envs.reset(seed=1)[0].item()]
    ended = []
    for _ in range(7):
        observation, _, terminated, *_ = envs.step(numpy.zeros((1, 0)))
        seen.append(observation.item())
        ended.append(terminated.item())
    assert seen == pytest.approx([0, 0.05, 0.1, 0.15, 0, 0.05, 0.1, 0.15]) and ended == [False, False, True, False, False, False, True]
