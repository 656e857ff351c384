//! Scripts in Python: which interpreter runs them, what they include and import, and scenes that have them.

#![allow(clippy::disallowed_methods, reason = "tests look at the environment")]
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use test_support::process::run_bounded;

/// Whether that Python is there and runs this code.
fn works(python: &str, code: &str) -> bool {
    Command::new(python)
        .args(["-c", code])
        .output()
        .is_ok_and(|output| output.status.success())
}

fn has_python() -> bool {
    let found = works("python3", "");
    if !found {
        test_support::skipped_outside_of_ci("there is no python3");
    }
    found
}

/// A folder with files.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("it is in the folder")).expect("it can be made");
        fs::write(path, text).expect("it can be written");
    }
    folder
}

/// What `swanilda run` of a file in the folder prints, without the folder's name.
fn run(folder: &Path, file: &str, options: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("run")
        .arg(folder.join(file))
        .args(["--quiet", "--steps", "2"])
        .args(options);
    let output = run_bounded(&mut command).expect("it ends");
    output.replace(&format!("{}/", folder.display()), "")
}

#[test]
fn included_files_are_a_part_of_the_script() {
    if !has_python() {
        return;
    }
    let robot = "def sysCall_init():\n    global sim\n    sim = require('sim')\n    print('begins', speed())\n";
    let scene = "#python\n\ninclude robot\n\ndef speed():\n    return 1.5\n\ndef sysCall_sensing():\n    fail()\n";
    let files = folder(&[("scene.py", scene), ("robot.py", robot)]);
    let output = run(files.path(), "scene.py", &[]);
    assert!(
        output.contains("begins, 1.5")
            && output.contains("File \"scene.py\", line 9, in sysCall_sensing"),
        "{output}"
    );

    let failing = folder(&[
        ("scene.py", scene),
        ("robot.py", &robot.replace("speed()", "no_speed()")),
    ]);
    let output = run(failing.path(), "scene.py", &[]);
    assert!(
        output.contains("File \"robot.py\", line 4, in sysCall_init"),
        "{output}"
    );

    let elsewhere =
        "#luaExec additionalIncludePaths = {PLACE}\ninclude robot\ndef speed(): return 2\n";
    let files = folder(&[("more/robot.py", robot)]);
    let place = format!("'{}/more'", files.path().display());
    fs::write(
        files.path().join("scene.py"),
        elsewhere.replace("PLACE", &place),
    )
    .expect("it can be written");
    assert!(run(files.path(), "scene.py", &[]).contains("begins, 2"));

    let output = run(folder(&[("scene.py", scene)]).path(), "scene.py", &[]);
    assert!(
        output.contains("the included file 'robot.py' was not found."),
        "{output}"
    );
}

#[test]
fn imports_are_found_beside_the_scene_and_in_additional_paths() {
    if !has_python() {
        return;
    }
    let scene =
        "#luaExec additionalPaths = {PLACE}\nimport beside, further\nfrom package import inner\n
def sysCall_init():
    s = require('sim')
    assert s is sim and require('sim-1') is not None and require('simIK').createEnvironment() >= 0
    print(beside.value, further.value, inner.time())
    try:
        require('no_such_module')
    except Exception as error:
        print('refused', 'no_such_module' in str(error))
";
    let inner = "def time():\n    return require('sim').getSimulationTime()\n";
    let files = folder(&[
        ("beside.py", "value = 'beside'"),
        ("more/further.py", "value = 'further'"),
        ("package/__init__.py", ""),
        ("package/inner.py", inner),
    ]);
    let place = format!("'{}/more'", files.path().display());
    fs::write(
        files.path().join("scene.py"),
        scene.replace("PLACE", &place),
    )
    .expect("it can be written");
    let output = run(files.path(), "scene.py", &[]);
    assert!(
        output.contains("beside, further, 0.0") && output.contains("refused, True"),
        "{output}"
    );
}

/// A Python that says who it is.
fn named_python(folder: &Path, name: &str) -> String {
    let path = folder.join(name);
    fs::write(
        &path,
        format!("#!/bin/sh\nINTERPRETER={name} exec python3 \"$@\"\n"),
    )
    .expect("it can be written");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("it is ours");
    path.to_str().expect("its path is text").to_owned()
}

#[test]
fn the_interpreter_is_chosen_by_the_script_then_the_parameter_then_an_environment() {
    if !has_python() {
        return;
    }
    let files = folder(&[]);
    let [own, named] = ["own", "named"].map(|name| named_python(files.path(), name));
    let text = "import os, sys\ndef sysCall_init(): print('by', os.environ.get('INTERPRETER'), sys.flags.utf8_mode, sys.prefix)\n";
    fs::write(files.path().join("plain.py"), text).expect("it can be written");
    fs::write(
        files.path().join("chosen.py"),
        format!("#luaExec pythonExecutable='{own} -X utf8'\n{text}"),
    )
    .expect("it can be written");
    let parameter = format!("python={named}");
    assert!(run(files.path(), "plain.py", &[]).contains("by, None, "));
    assert!(run(files.path(), "plain.py", &["-D", &parameter]).contains("by, named, "));
    assert!(run(files.path(), "chosen.py", &["-D", &parameter]).contains("by, own, 1, "));

    if !works("python3", "import venv") {
        return;
    }
    let environment = files.path().join(".venv");
    let made = Command::new("python3")
        .args(["-m", "venv", "--without-pip"])
        .arg(&environment)
        .status();
    assert!(made.expect("it starts").success());
    assert!(
        run(files.path(), "plain.py", &[]).contains("/.venv")
            || run(files.path(), "plain.py", &[]).contains(", .venv")
    );
    assert!(run(files.path(), "plain.py", &["-D", &parameter]).contains("by, named, "));
    assert!(run(files.path(), "chosen.py", &[]).contains("by, own, 1, "));
}

/// Every Python from 3.9 on that is at hand, by its version.
fn pythons() -> Vec<(String, String)> {
    let home = std::env::var("HOME").unwrap_or_default();
    let on_path = (9..20).map(|minor| format!("python3.{minor}"));
    let of_pyenv = fs::read_dir(Path::new(&home).join(".pyenv/versions"))
        .into_iter()
        .flatten()
        .flatten();
    let of_pyenv = of_pyenv.map(|version| version.path().join("bin/python3").display().to_string());
    let mut found: Vec<(String, String)> = Vec::new();
    for python in on_path.chain(of_pyenv) {
        let code =
            "import sys; assert sys.version_info >= (3, 9); print('%d.%d' % sys.version_info[:2])";
        let Ok(output) = Command::new(&python).args(["-c", code]).output() else {
            continue;
        };
        let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        if output.status.success() && found.iter().all(|(known, _)| *known != version) {
            found.push((version, python));
        }
    }
    found
}

#[test]
fn every_python_at_hand_prints_the_same() {
    if !has_python() {
        return;
    }
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/cases");
    let pythons = pythons();
    for (version, python) in &pythons {
        let parameter = format!("python={python}");
        for case in ["basics", "messages", "sockets", "values", "connectivity"] {
            let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
            command
                .arg("run")
                .arg(cases.join(format!("{case}.py")))
                .args(["--quiet", "--steps", "12", "-D", &parameter]);
            let output = run_bounded(&mut command)
                .expect("it ends")
                .replace(&format!("{}/", cases.display()), "");
            let expected =
                fs::read_to_string(cases.join(format!("{case}.expected"))).expect("it is there");
            assert_eq!(output, expected, "{case} with Python {version}");
        }
    }
}

/// A Python with numpy: python3 itself, or that of an environment in `target/`, for which the Python index is needed once.
fn python_with_numpy() -> Option<String> {
    if works("python3", "import numpy") {
        return Some("python3".to_owned());
    }
    let environment = Path::new(env!("CARGO_TARGET_TMPDIR")).join("numpy-venv");
    let python = environment.join("bin/python").display().to_string();
    if !works(&python, "import numpy") && works("python3", "import ensurepip, venv") {
        // Whether these worked is seen below.
        let _ = Command::new("python3")
            .args(["-m", "venv", "--clear"])
            .arg(&environment)
            .status();
        let _ = Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "numpy"])
            .status();
    }
    works(&python, "import numpy").then_some(python)
}

#[test]
fn arrays_of_numpy_are_lists() {
    let Some(python) = python_with_numpy() else {
        return test_support::skipped_outside_of_ci(
            "there is no Python with numpy, and none can be made",
        );
    };
    let scene = "#luaExec function echo(...) return ... end
import numpy as np
def sysCall_init():
    sim = require('sim')
    def lua(name, *args):
        return sim.callScriptFunction(name + '@lua', sim.handle_self, *args)
    floor = sim.getObject('/Floor')
    sim.setObjectPosition(floor, np.array([1.0, 2.0, 3.0]))
    print(sim.getObjectPosition(np.int64(floor)), type(np.float32(0.5)).__name__)
    print(lua('echo', np.float32(0.5)), lua('echo', np.arange(6).reshape(2, 3)), lua('echo', np.bool_(True)))
    print(lua('echo', [np.int8(-1), {'a': np.zeros(2)}]), lua('echo', np.array(7)), lua('echo', np.array([])))
    self.result = np.array([1, 2])
def two():
    return self.result
def sysCall_sensing():
    import numpy
    print(require('sim').callScriptFunction('two@python', sim.handle_self))
    require('sim').quitSimulator()
";
    let files = folder(&[("scene.py", scene)]);
    let output = run(
        files.path(),
        "scene.py",
        &["-D", &format!("python={python}")],
    );
    let expected = "[1.0, 2.0, 3.0], float32\n0.5, [[0, 1, 2], [3, 4, 5]], True\n[-1, {'a': [0.0, 0.0]}], 7, []\n";
    assert!(output.starts_with(expected), "{output}");
}

#[test]
fn random_numbers_of_numpy_follow_the_seed() {
    let Some(python) = python_with_numpy() else {
        return test_support::skipped_outside_of_ci(
            "there is no Python with numpy, and none can be made",
        );
    };
    let scene = "import numpy as np
early = np.random.rand()
def sysCall_init():
    print(early, np.random.rand(), np.random.default_rng().random(), np.random.default_rng(1).random())
    require('sim').quitSimulator()
";
    let files = folder(&[("scene.py", scene)]);
    let interpreter = format!("python={python}");
    let with = |seed| {
        run(
            files.path(),
            "scene.py",
            &["-D", &interpreter, "--seed", seed],
        )
    };
    let numbers = with("5");
    assert!(numbers.starts_with("0."), "{numbers}");
    assert!(numbers.contains("0.5118216247002567"), "{numbers}");
    assert_eq!(with("5"), numbers);
    assert_ne!(with("6"), numbers);
}

#[test]
fn scenes_keep_their_scripts_in_python() {
    if !has_python() {
        return;
    }
    let make = "local sim = require 'sim'
local TEXT = [==[
#python
#luaExec function twice(x) return 2 * x end
def sysCall_init():
    global sim, steps
    sim = require('sim')
    steps = 0
def sysCall_actuation():
    global steps
    steps += 1
    print(sim.getObjectAlias(sim.getObject('..'), 2), steps, sim.callScriptFunction('twice@lua', sim.handle_self, steps))
]==]
function sysCall_init()
    local robot = sim.createDummy(0.1)
    sim.setObjectAlias(robot, 'Robot')
    local script = sim.createScript(sim.scripttype_simulation, TEXT, 0, 'python')
    sim.setObjectParent(script, robot)
    local old = sim.createDummy(0.1)
    sim.setObjectAlias(old, 'Old')
    local child = sim.createScript(sim.scripttype_customization, '#python\\ndef sysCall_init(): print(\"old\", require(\"sim\").getObjectAlias(0) is not None)\\n', 0, 'python')
    sim.setObjectParent(child, old)
    sim.saveScene(FOLDER .. '/saved.ttt')
    sim.quitSimulator()
end
";
    let files = folder(&[]);
    let make = make.replace("FOLDER", &format!("'{}'", files.path().display()));
    fs::write(files.path().join("make.lua"), make).expect("it can be written");
    run(files.path(), "make.lua", &["--no-start", "--as", "addon"]);
    let output = run(files.path(), "saved.ttt", &[]);
    for line in ["/Robot, 1, 2", "/Robot, 2, 4", "old, "] {
        assert!(output.contains(line), "{output}");
    }
    let mut inspect = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let output =
        run_bounded(inspect.arg("inspect").arg(files.path().join("saved.ttt"))).expect("it ends");
    assert!(output.to_lowercase().contains("python"), "{output}");
}
