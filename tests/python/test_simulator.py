"""Simulators in-process: scenes, calls, values, errors, scripts in Python, threads and processes."""

import array
import math
import multiprocessing
import os
import pathlib
import signal
import subprocess
import sys
import threading
import tracemalloc

import pytest

from recorded import exported, needs_command

import swanilda

SCENES = pathlib.Path(__file__).parents[2] / "scenes"


def test_a_scene_runs_and_is_read(simulator, sim):
    with swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=1, quiet=True) as s:
        sim = s.require("sim")
        rail = sim.getObject("/Rail")
        assert sim.getObjectPosition(rail, sim.handle_world) == [0, 0, 1]
        s.start()
        while s.time < 1:
            s.step()
        assert (s.steps, s.errors, s.state) == (20, 0, "running")
        angle, place = s.script("/Controller").state()
        assert abs(angle) < 0.2 and 0 < place < 1
        s.stop()
        assert s.state == "stopped"


def test_the_same_seed_is_the_same_run():
    def run():
        with swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=7, quiet=True) as s:
            s.start()
            s.step(50)
            sim = s.require("sim")
            return sim.getObjectPose(sim.getObject("/Pole"), -1), s.state_hash()

    assert run() == run()


@needs_command
def test_a_run_is_recorded(tmp_path):
    with swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=7, quiet=True) as s:
        s.start()
        s.step(2)
        before = s.snapshot()
        with s.record(tmp_path / "a.swr"):
            s.step(3)
            for go_back in (lambda: s.restore(before), lambda: s.branch(1)):
                with pytest.raises(swanilda.Error, match="end_recording"):
                    go_back()
        s.step(10)
        s.restore(before)
        s.record(tmp_path / "b.swr")
        s.step(1)
        s.record(tmp_path / "c.swr")
        s.step(2)
        with pytest.raises(OSError, match="nowhere"):
            s.record(tmp_path / "nowhere" / "d.swr")
    times = [exported(tmp_path / f"{name}.swr")[0] for name in "abc"]
    assert [pytest.approx(each) for each in times] == [[0.1, 0.15, 0.2, 0.25], [0.1, 0.15], [0.15, 0.2, 0.25]]


def test_a_snapshot_is_brought_back_with_the_same_future():
    with swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=7, quiet=True) as s:
        sim = s.require("sim")
        s.start()
        s.step(20)
        before, hash_then = s.snapshot(), s.state_hash()
        assert before.own_bytes > 0

        def future():
            hashes = []
            for _ in range(20):
                s.step()
                hashes.append((s.state_hash(), sim.getSimulationTime()))
            return hashes

        first = future()
        for _ in range(3):
            s.restore(before)
            assert s.state_hash() == hash_then
            assert future() == first
        with swanilda.Simulator(quiet=True) as other:
            with pytest.raises(swanilda.Error, match="another simulator"):
                other.restore(before)


def pushed(s, force, steps=20):
    """The hashes of steps in which the pole is pushed."""
    sim = s.require("sim")
    pole = sim.getObject("/Pole")
    hashes = []
    for _ in range(steps):
        if force:
            sim.addForce(pole, [0, 0, 0], [force, 0, 0])
        s.step()
        hashes.append((s.state_hash(), s.time, s.steps))
        yield hashes[-1]


def pendulum(steps=20):
    s = swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=7, quiet=True)
    s.start()
    s.step(steps)
    return s


def test_branches_go_on_apart_in_any_order():
    forces = (0, 0.5, 1)
    alone = []
    for force in forces:
        with pendulum() as s:
            alone.append(list(pushed(s, force)))
    with pendulum() as s:
        branches = s.branch(3)
        assert [type(b) for b in branches] == [swanilda.Simulator] * 3
        assert len({b.state_hash() for b in [s, *branches]}) == 1
        # In turns, step by step.
        runs = [pushed(b, force) for b, force in zip(branches, forces)]
        assert list(zip(*runs)) == list(zip(*alone))
        assert s.steps == 20
        assert list(pushed(s, 0)) == alone[0]
        assert s.branch(0) == []
        # A branch has branches of its own, and snapshots are the simulator's.
        before = branches[1].snapshot()
        later = branches[1].branch(1)[0]
        branches[1].step()
        assert later.state_hash() == alone[1][-1][0] != branches[1].state_hash()
        s.restore(before)
        assert s.state_hash() == later.state_hash()


def test_what_belongs_to_a_branch_calls_there():
    with swanilda.Simulator(quiet=True) as s:
        counter = s.add_script("n = 0  function add() n = n + 1  return n end")
        a, b = s.branch(2)
        in_a, in_b = a.script(counter), b.script(counter)
        assert [in_a.add(), in_a.add(), in_b.add(), counter.add(), in_a.add()] == [1, 2, 1, 1, 3]
        sim_a, sim_b = a.require("sim"), b.require("sim")
        sim_a.createDummy(0.1)
        assert len(sim_a.getObjectsInTree(sim_a.handle_scene)) == 1 + len(sim_b.getObjectsInTree(sim_b.handle_scene))
        new = a.add_script("function here() return true end")
        assert new.here()
        with pytest.raises(swanilda.Error):
            b.script(new).here()


def test_branches_are_closed_one_by_one():
    with swanilda.Simulator(quiet=True) as s:
        s.start()
        a, b, c = s.branch(3)
        a.step()
        s.close()
        a.step()
        a.close()
        assert not s.is_open and not a.is_open and b.is_open
        with pytest.raises(swanilda.Error, match="closed"):
            a.step()
        b.step(3)
        del b
        assert (c.steps, c.state) == (0, "running")
        c.step(2)
        c.close()
        assert not c.is_open


def test_a_branch_with_a_socket_is_not_left():
    with swanilda.Simulator(quiet=True) as s:
        other = s.branch(1)[0]
        script = s.add_script("simZMQ = require 'simZMQ'  socket = simZMQ.socket(simZMQ.ctx_new(), simZMQ.REP)")
        for use in (other.step, other.state_hash, other.start, lambda: other.require("sim")):
            with pytest.raises(swanilda.Error, match="does not reach a ZeroMQ context, a ZeroMQ socket"):
                use()
        assert other.is_open
        with pytest.raises(swanilda.Error, match="does not reach a ZeroMQ context, a ZeroMQ socket"):
            s.branch(1)
        s.require("sim").removeObjects([script.handle])
        other.start()
        other.step()
        with pytest.raises(swanilda.Error, match="does not exist"):
            other.require("sim").getObjectPosition(script.handle)


def test_no_branch_is_entered_from_inside_another(simulator, sim):
    other = simulator.branch(1)[0]
    theirs = other.require("sim")
    before = simulator.snapshot()
    errors = []

    def uses_others(*_):
        for use in (lambda: theirs.getSimulationTime(), other.snapshot, simulator.snapshot, lambda: simulator.restore(before)):
            with pytest.raises(swanilda.Error, match="at work|middle of a step") as raised:
                use()
            errors.append(str(raised.value))

    simulator.start()
    limits = {"maxVel": [1.0], "maxAccel": [1.0], "maxJerk": [10.0]}
    sim.moveToConfig({"pos": [0.0], "targetPos": [0.01], **limits, "callback": uses_others})
    assert len(errors) > 4
    assert simulator.time > 0 and theirs.getSimulationTime() == 0


def test_a_simulator_is_shown_or_branched(simulator):
    branches = simulator.branch(1)
    for each in (simulator, *branches):
        with pytest.raises(swanilda.Error, match="no branches"):
            each.view()
    branches[0].close()
    simulator.view()
    with pytest.raises(swanilda.Error, match="no branches"):
        simulator.branch(1)


def test_there_are_snapshots_however_many_simulators_there_were():
    for _ in range(1100):
        with swanilda.Simulator(empty=True, quiet=True) as s:
            s.snapshot()


def test_no_snapshot_forgets_variables_of_python(simulator):
    class Robot:
        def sysCall_init(self):
            self.count = 1

    script = simulator.add_script(Robot)
    with pytest.raises(swanilda.Error, match="variables of a script"):
        simulator.snapshot()
    simulator.require("sim").removeObjects([script.handle])
    simulator.snapshot()


def test_values_pass_both_ways(simulator, sim):
    echo = simulator.add_script("function echo(...) return ... end")
    for value in [True, False, 5, -(2**63), 0.5, math.inf, "text", "ä", b"", b"\0\xff", [1, 2.5, "x"], {"a": [1], 2: "b"}]:
        back = echo.echo(value)
        assert back == value and type(back) is type(value)
    assert echo.echo() is None
    assert echo.echo(1, None, "x") == (1, None, "x")
    assert echo.echo((1, 2)) == [1, 2]
    assert echo.echo(bytearray(b"ab"), memoryview(b"cd")) == (b"ab", b"cd")
    with pytest.raises(OverflowError):
        echo.echo(2**63)
    with pytest.raises(TypeError, match="no values of type set"):
        echo.echo({1})
    nested = []
    nested.append(nested)
    with pytest.raises(ValueError, match="nested"):
        echo.echo(nested)


def test_arrays_are_lists(simulator, sim):
    numpy = pytest.importorskip("numpy")
    dummy = sim.createDummy(0.1)
    sim.setObjectPosition(dummy, numpy.array([1.0, 2.0, 3.0]))
    sim.setObjectPosition(dummy, [numpy.float64(1), numpy.int32(2), numpy.float32(3)])
    assert sim.getObjectPosition(numpy.int64(dummy)) == [1, 2, 3]

    echo = simulator.add_script("function echo(...) return ... end")

    def check(value):
        back, expected = echo.echo(value), value.tolist()
        assert back == expected and repr(back) == repr(expected), value

    numbers = numpy.arange(24)
    for kind in "?bBhHiIlLqQfde":
        for order in "=<>":
            check(numbers.astype(numpy.dtype(kind).newbyteorder(order)))
    check(numpy.array([-(2**63), 2**63 - 1]))
    check(numpy.array([-1, -128], dtype=numpy.int8))
    check(numpy.array([0.1, -math.inf, math.inf, 5e-324]))
    for shape in [(24,), (4, 6), (2, 3, 4), (24, 1), (0,), (0, 3), (3, 0), (2, 0, 2)]:
        cube = numpy.resize(numbers * 0.5, shape)
        for view in [cube, cube.T, numpy.asfortranarray(cube), cube[::-1], cube[::2], cube[..., ::-1]]:
            check(view)
    for scalar in [numpy.float64(0.1), numpy.float32(0.1), numpy.int16(-3), numpy.uint8(200), numpy.bool_(True), numpy.array(2.5)]:
        assert echo.echo(scalar) == scalar.item() and type(echo.echo(scalar)) is type(scalar.item())

    check(array.array("d", [0.5, 1.5]))
    check(array.array("B", [1, 255]))
    check(numpy.array(["a", "b"]))
    check(numpy.array([1, "b", 2.5], dtype=object))
    assert echo.echo([numpy.array([1.5]), {"a": numpy.array([True])}]) == [[1.5], {"a": [True]}]
    assert echo.echo(memoryview(numpy.array([1, 2], dtype=numpy.uint16))) == b"\1\0\2\0"
    assert echo.echo(numpy.ma.array([1, 2, 3], mask=[False, True, False])) == echo.echo([1, None, 3])
    with pytest.raises(OverflowError):
        echo.echo(numpy.array([2**63], dtype=numpy.uint64))
    with pytest.raises(TypeError):
        echo.echo(numpy.array([1j]))


def test_an_array_takes_no_object_for_each_element(simulator):
    numpy = pytest.importorskip("numpy")
    count = simulator.add_script("function count(list) return #list end")
    numbers = numpy.arange(100_000, dtype=numpy.float64)
    tracemalloc.start()
    assert count.count(numbers) == len(numbers)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2 * numbers.nbytes


def test_images_are_upright(simulator, sim):
    numpy = pytest.importorskip("numpy")
    sim.removeObjects(sim.getObjectsInTree(sim.handle_scene))
    sensor = sim.createVisionSensor(1 | 2, [64, 48, 0, 0], [0.01, 10, 1, 0.1, 0, 0, 0, 0, 0, 0, 0])
    sim.setObjectOrientation(sensor, [-math.pi / 2, 0, math.pi])
    box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.3, 0.3, 0.3])
    sim.setObjectPosition(box, [0, 2, 0.6])
    sim.handleVisionSensor(sensor)
    image, depth = simulator.sensor_image(sensor), simulator.sensor_depth(sensor)
    assert image.shape == (48, 64, 3) and image.dtype == numpy.uint8
    upper, lower = depth[:24].min(), depth[24:].min()
    assert upper < 2.5 < lower, "the box is above the middle, or the image is upside down"
    assert simulator.image(resolution=[32, 16]).shape == (16, 32, 3)
    assert simulator.image(sensor).shape == (48, 64, 3)


def test_errors_have_the_words_of_scripts(simulator, sim):
    with pytest.raises(swanilda.Error, match=r"^in sim.getObjectPosition: object does not exist\.$"):
        sim.getObjectPosition(987654)
    with pytest.raises(swanilda.Error, match=r"^in sim.getObject: object does not exist, or alias/path is ill formatted\.$"):
        sim.getObject("/nothing")
    with pytest.raises(swanilda.Error, match="not implemented in Swanilda: sim.getThreadId"):
        sim.getThreadId()
    with pytest.raises(AttributeError, match="module 'sim' has no member 'nothing'"):
        sim.nothing
    with pytest.raises(swanilda.Error):
        simulator.require("no_such_module")
    with pytest.raises(swanilda.Error, match="cannot read"):
        swanilda.Simulator("no_such_scene.ttt")
    with pytest.raises(swanilda.Error, match=r"start\(\) it first"):
        simulator.step()
    with pytest.raises(swanilda.Error, match=r"sim.wait: .*start\(\) it first"):
        sim.wait(1)
    with pytest.raises(ValueError):
        swanilda.Simulator(kind="nothing")


def test_every_module_and_constant(simulator, sim):
    assert sim.handle_world == -1 and callable(sim.getObject)
    assert {"getObject", "handle_world"} <= set(dir(sim))
    assert simulator.require("simZMQ").z85_encode("\1\2\3\4") == "0rJua"
    assert simulator.require("simUI").curve_type.time is not None
    assert simulator.require("itertools").product([[1, 2], ["a"]]) == [[1, "a"], [2, "a"]]
    assert "relativeTo" in sim.getObjectPosition.__doc__


def test_functions_that_wait_run_the_steps(simulator, sim):
    simulator.start()
    before = simulator.time
    left = sim.wait(0.2)
    assert simulator.time == pytest.approx(before + 0.2 + left)
    sim.step()
    assert simulator.steps == 5


class Robot:
    made = []

    def __init__(self, script):
        self.script, self.sim, self.calls = script, script.require("sim"), []
        Robot.made.append(self)

    def sysCall_init(self):
        self.calls.append("init")

    def sysCall_actuation(self):
        self.calls.append(self.sim.getSimulationTime())

    def sysCall_thread(self):
        for turn in range(2):
            self.calls.append(f"thread {turn}")
            yield

    def sysCall_cleanup(self):
        self.calls.append("cleanup")

    def double(self, number):
        return 2 * number, "twice"


def test_a_class_is_a_script(simulator, sim):
    Robot.made.clear()
    robot = simulator.add_script(Robot, kind="simulation")
    simulator.start()
    simulator.step(3)
    assert robot.double(4) == (8, "twice")
    assert sim.callScriptFunction("double", robot.handle, 5) == (10, "twice")
    asks = simulator.add_script("sim = require 'sim' function ask(robot) return sim.callScriptFunction('double', robot, 1) end")
    assert asks.ask(robot.handle) == (2, "twice")
    simulator.stop()
    calls = Robot.made[0].calls
    assert calls[0] == "init" and calls[-1] == "cleanup" and calls[1:5] == ["thread 0", 0.0, "thread 1", 0.05]
    simulator.start()
    simulator.step()
    assert len(Robot.made) == 2, "each run has an instance of its own"


def test_an_exception_of_a_script_is_raised_and_ends_it(simulator, capsys):
    class Broken:
        def sysCall_actuation(self):
            raise ValueError("a wheel is off")

    simulator.add_script(Broken)
    simulator.start()
    with pytest.raises(ValueError, match="a wheel is off"):
        simulator.step(10)
    assert simulator.errors == 1
    assert "a wheel is off" in capsys.readouterr().err


def test_functions_of_lua_call_back(simulator, sim):
    seen = []
    movement = {"vel": 0.5, "accel": 0.5, "jerk": 0.5}
    params = {
        "pos": [0.0], "targetPos": [0.1], "maxVel": [1.0], "maxAccel": [1.0], "maxJerk": [10.0],
        "callback": lambda data: seen.append(data["pos"]),
    }
    simulator.start()
    sim.moveToConfig(params)
    assert movement and seen[-1] == pytest.approx([0.1]) and len(seen) > 3

    def fails(data):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        sim.moveToConfig({**params, "callback": fails})


def test_a_function_that_the_simulator_calls_cannot_step_it(simulator):
    class Steps:
        def sysCall_actuation(self):
            simulator.step()

    simulator.add_script(Steps)
    simulator.start()
    with pytest.raises(swanilda.Error, match="in the middle of a step"):
        simulator.step()


def test_scripts_print_to_pythons_streams(simulator, capsys):
    simulator.add_script("print('from lua') error('from lua, too')")
    out, err = capsys.readouterr()
    assert "from lua\n" in out and "from lua, too" in err


def test_threads_have_simulators_of_their_own(sim):
    refused, times = [], []

    def work(number):
        try:
            sim.getObject("/Floor")
        except swanilda.Error as error:
            refused.append(str(error))
        with swanilda.Simulator(SCENES / "inverted_pendulum.lua", seed=number, quiet=True) as s:
            s.start()
            s.step(20)
            times.append(s.time)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(refused) == 4 and "another thread" in refused[0]
    assert times == [pytest.approx(1)] * 4


def test_other_threads_run_while_it_steps():
    """The lock of Python is free during a step: a thread that counts gets on."""
    count, done = [0], threading.Event()

    def counts():
        while not done.is_set():
            count[0] += 1

    with swanilda.Simulator(quiet=True) as s:
        s.add_script("function sysCall_actuation() local n = 0 for i = 1, 2e6 do n = n + i end end")
        s.start()
        thread = threading.Thread(target=counts)
        thread.start()
        counted = 0
        # A busy machine may have no processor for the thread during a single step.
        for _ in range(100):
            before = count[0]
            s.step()
            counted = count[0] - before
            if counted > 1000:
                break
        done.set()
        thread.join()
    assert counted > 1000


def _steps_in_a_process(number):
    with swanilda.Simulator(quiet=True, seed=number) as s:
        s.start()
        return s.step(3)


@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_processes(simulator, method):
    context = multiprocessing.get_context(method)
    with context.Pool(2) as pool:
        assert pool.map(_steps_in_a_process, range(2)) == [3, 3]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
def test_a_simulator_does_not_survive_a_fork(simulator):
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            simulator.start()
            os.write(write, b"started")
        except swanilda.Error as error:
            os.write(write, str(error).encode())
        finally:
            os._exit(0)
    os.waitpid(child, 0)
    assert b"does not survive a fork" in os.read(read, 1000)
    simulator.start()
    assert simulator.step() == 1


def test_the_end_of_python_is_the_end_of_simulators():
    code = "import swanilda\nclass R:\n def sysCall_cleanup(self): print('cleaned up')\ns = swanilda.Simulator()\ns.add_script(R)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "cleaned up\n", "")


def test_a_closed_simulator_says_so():
    s = swanilda.Simulator(quiet=True)
    sim = s.require("sim")
    s.close()
    s.close()
    with pytest.raises(swanilda.Error, match="is closed"):
        sim.getObject("/Floor")
    assert repr(s) == "<closed simulator>" and s._repr_html_() is None


def test_notebooks_show_a_picture_and_a_table(simulator):
    page = simulator._repr_html_()
    assert "data:image/png;base64," in page and "/Floor" in page
    view = simulator.view()
    assert view.url.startswith("http://127.0.0.1:") and view.url in view._repr_html_()
    simulator.serve(0.05)


def test_code_without_a_purpose_is_refused(simulator, sim):
    for bad in [(), (None,), ("x",), ([],), ({},), (math.nan,), (1, 2, 3, 4, 5, 6)]:
        try:
            sim.setObjectPosition(*bad)
        except swanilda.Error:
            pass


def by_ctrl_c(call):
    """Calls what ctrl-c ends a moment later."""
    threading.Timer(0.2, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        call()


@pytest.mark.parametrize("callback", ["sysCall_actuation", "sysCall_thread"])
def test_ctrl_c_ends_a_script_that_never_ends(simulator, callback):
    simulator.add_script(f"function {callback}() while true do pcall(function() while true do end end) end end")
    other = simulator.add_script("function f() while true do end end")
    simulator.start()
    by_ctrl_c(simulator.step)
    by_ctrl_c(lambda: other.f())
    simulator.stop()
    simulator.start()
    assert simulator.step() == 1


def test_ctrl_c_ends_many_slow_steps(simulator):
    simulator.add_script("function sysCall_actuation() local t = os.clock() while os.clock() < t + 0.05 do end end")
    simulator.start()
    by_ctrl_c(lambda: simulator.step(10**6))
    assert simulator.errors == 0 and 0 < simulator.steps < 32
