"""Scripts in Python of scenes, which run in this interpreter."""

import builtins
import os
import pathlib
import re
import sys
import threading

import pytest

import swanilda

CASES = pathlib.Path(__file__).parent / "cases"


def written(folder, text, name="scene.py"):
    path = folder / name
    path.write_text(text)
    return path


SHARED = """
import os, sys, threading

def sysCall_init():
    global sim
    sim = require('sim')
    self.steps = 0
    os.seen_by_script = (os.getpid(), threading.get_ident())

def sysCall_actuation():
    self.steps += 1
    print('step', self.steps, sim.getSimulationTime())

def sysCall_cleanup():
    print('cleanup')

def add(a, b=1):
    return a + b
"""


def test_a_script_runs_in_this_process(tmp_path, capsys):
    with swanilda.Simulator(written(tmp_path, SHARED)) as s:
        assert os.seen_by_script == (os.getpid(), threading.get_ident())
        s.start()
        s.step(2)
        assert s.script("/Script").add(2) == 3
        assert s.errors == 0 and not hasattr(builtins, "sim") and not hasattr(builtins, "require")
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == ["step, 1, 0.0", "step, 2, 0.05"] and lines[-1] == "cleanup"


@pytest.mark.parametrize("case", sorted(CASES.glob("*.py")) + sorted(CASES.glob("*.lua")), ids=lambda path: path.stem)
def test_cases_print_the_same_as_in_a_process(case, capsys, tmp_path):
    def lines(**options):
        with swanilda.Simulator(case, seed=0, **options) as s:
            s.start()
            while s.steps < 12 and s.state == "running":
                s.step()
        captured = capsys.readouterr()
        return re.sub("0x[0-9a-f]+", "ADDRESS", captured.out + captured.err).splitlines()

    inside, outside = lines(), lines(params={"python": sys.executable})
    assert inside == outside


def test_modules_of_a_folder_belong_to_the_script(tmp_path, capsys):
    text = """
import helper
import package.inner as inner
from package import twice
def sysCall_init():
    helper.count += 1
    print(helper.name, helper.count, inner.here(), twice(4), helper.time())
"""
    for name in ["one", "two"]:
        folder = tmp_path / name
        (folder / "package").mkdir(parents=True)
        written(folder, text)
        helper = f"import math, other\nname, count = '{name}', 0\ndef time():\n    import other as late\n    return late.time()\n"
        written(folder, helper, "helper.py")
        written(folder, "def time():\n    return sim.getSimulationTime()\n", "other.py")
        written(folder / "package", "from .inner import twice\n", "__init__.py")
        written(folder / "package", "from . import deep\ndef twice(x): return 2 * x\ndef here(): return deep.here\n", "inner.py")
        written(folder / "package", f"here = 'in {name}'\n", "deep.py")
    for name in ["one", "two", "one"]:
        with swanilda.Simulator(tmp_path / name / "scene.py") as s:
            assert s.errors == 0
        assert capsys.readouterr().out.endswith(f"{name}, 1, in {name}, 8, 0.0\n")
    assert not [name for name in sys.modules if name.startswith("_swanilda_script")] and "helper" not in sys.modules


def test_a_module_that_the_program_has_imported_is_shared(tmp_path, monkeypatch):
    written(tmp_path, "seen = []\n", "common.py")
    monkeypatch.syspath_prepend(str(tmp_path))
    import common

    try:
        with swanilda.Simulator(written(tmp_path, "import common\ndef sysCall_init(): common.seen.append(1)\n"), quiet=True):
            assert common.seen == [1]
    finally:
        del sys.modules["common"]


THREAD = """
import threading, time
def sysCall_init():
    global sim
    sim = require('sim')
    print(threading.get_ident() == owner)

def sysCall_thread():
    print(threading.get_ident() == owner)
    sim.setStepping(True)
    for turn in range(3):
        print(turn, sim.getSimulationTime(), twice(turn))
        sim.step()
    sim.testCB(1, lambda *args: print('called', args), 2, 1)
    try:
        sim.getObject('/nothing')
    except Exception as error:
        print(error)
    %s

def twice(x):
    return 2 * x
"""


@pytest.mark.parametrize("end", ["1 / 0", "while True: sim.step()", "while True: time.sleep(0.001)", "while True: pass"])
def test_a_thread_has_its_own_and_ends(end, tmp_path, capsys):
    builtins.owner = threading.get_ident()
    before = threading.active_count()
    text = (THREAD % end).replace("while True: time", "sim.setStepping(False)\n    while True: time").replace(
        "while True: pass", "sim.setStepping(False)\n    while True: pass"
    )
    with swanilda.Simulator(written(tmp_path, text)) as s:
        s.start()
        s.step(6)
        assert s.errors == (end == "1 / 0")
        s.stop()
    del builtins.owner
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    expected = ["True", "False", "0, 0.0, 0", "1, 0.05, 2", "2, 0.1, 4", "called, (1, 2)", "called, (1, 2)"]
    assert lines[:7] == expected and "object does not exist" in lines[7]
    assert ("ZeroDivisionError" in captured.err) == (end == "1 / 0")
    assert threading.active_count() == before


def test_errors_are_those_of_scripts(tmp_path, capsys):
    text = "def sysCall_init(): pass\ndef sysCall_actuation():\n    inner()\ndef inner():\n    raise KeyError('no')\n"
    with swanilda.Simulator(written(tmp_path, text)) as s:
        s.start()
        s.step(2)
        assert s.errors == 1 and s.state == "running"
    assert "scene.py\", line 5, in inner" in capsys.readouterr().err
    with swanilda.Simulator(written(tmp_path, "def sysCall_init(:\n")) as s:
        assert s.errors == 1
    assert "line 1" in capsys.readouterr().err
    with swanilda.Simulator(written(tmp_path, "def sysCall_init(): raise SystemExit(3)\n")) as s:
        assert s.errors == 1
    assert "a script cannot end its process" in capsys.readouterr().err


def test_ctrl_c_in_a_script_reaches_the_program(tmp_path):
    text = "def sysCall_init(): pass\ndef sysCall_actuation(): raise KeyboardInterrupt\n"
    with swanilda.Simulator(written(tmp_path, text), quiet=True) as s:
        s.start()
        with pytest.raises(KeyboardInterrupt):
            s.step()


def test_restricted_simulators_refuse_it(tmp_path, capsys):
    with swanilda.Simulator(written(tmp_path, "def sysCall_init(): print('ran')\n"), unsafe_functions=False) as s:
        assert s.errors == 1
    captured = capsys.readouterr()
    assert "is not allowed" in captured.err and "ran" not in captured.out


def test_a_chosen_interpreter_has_a_process(tmp_path, capsys):
    text = "import os\ndef sysCall_init(): print(os.getpid() == %d)\n" % os.getpid()
    for params, expected in [({}, "True"), ({"python": sys.executable}, "False")]:
        with swanilda.Simulator(written(tmp_path, text), params=params):
            assert capsys.readouterr().out.strip().endswith(expected)


def test_scripts_in_both_languages_call_each_other(simulator, sim, capsys):
    python = """
def sysCall_init():
    global sim
    sim = require('sim')
def down(depth, other, own):
    return 0 if depth == 0 else 1 + sim.callScriptFunction('down', other, depth - 1, own, other)
def fail():
    raise KeyError('no')
"""
    lua = """
sim = require 'sim'
function down(depth, other, own)
    return depth == 0 and 0 or 1 + sim.callScriptFunction('down', other, depth - 1, own, other)
end
function try(other)
    return pcall(sim.callScriptFunction, 'fail', other)
end
"""
    lua = simulator.add_script(lua).handle
    script = sim.createScript(sim.scripttype_customization, python, 0, "python")
    sim.initScript(script)
    assert sim.callScriptFunction("down", script, 7, lua, script) == 7
    succeeded, reason = sim.callScriptFunction("try", lua, script)
    assert not succeeded and "error in script function" in reason
    assert simulator.errors == 1 and "line 8, in fail" in capsys.readouterr().err


def test_threads_have_their_own(tmp_path):
    path = written(tmp_path, "def sysCall_init(): self.n = 0\ndef sysCall_actuation(): self.n += 1\ndef n(): return self.n\n")
    results = []

    def work():
        with swanilda.Simulator(path, quiet=True) as s:
            s.start()
            s.step(50)
            results.append((s.script("/Script").n(), s.errors))

    threads = [threading.Thread(target=work) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert results == [(50, 0)] * 4


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_forked_child_cannot_call(tmp_path):
    text = "import os\ndef sysCall_init():\n    require('sim')\n    os.call_of_script = sim.getSimulationTime\n"
    with swanilda.Simulator(written(tmp_path, text), quiet=True):
        assert os.call_of_script() == 0
        child = os.fork()
        if child == 0:
            try:
                os.call_of_script()
            except swanilda.Error:
                os._exit(7)
            os._exit(1)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    with pytest.raises(RuntimeError, match="the script has ended"):
        os.call_of_script()
    del os.call_of_script
