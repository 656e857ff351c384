//! Messages about wrong files and options say what to do.

use std::fs;
use std::process::Output;

use test_support::process::output_of;

use super::{Scene, stderr, stdout, swanilda};

/// What `swanilda COMMAND FILE` says about a file with that name and content.
fn said_about(command: &str, name: &str, content: &[u8]) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let path = folder.path().join(name);
    fs::write(&path, content).expect("our own folder is writable");
    let output = output_of(swanilda().arg(command).arg(&path));
    assert_eq!(output.status.code(), Some(2), "{name}: {}", stdout(&output));
    stderr(&output)
}

#[test]
fn files_of_other_kinds_are_not_run_as_lua() {
    let noise: Vec<u8> = (0..3000u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    for (name, content, reason) in [
        ("r.ttt", &noise[..], "not a scene or model of CoppeliaSim"),
        ("r", &noise, "neither a script in Lua or Python nor a scene"),
        ("empty.ttt", b"", "the file is empty"),
        ("empty.urdf", b"", "no valid XML"),
        (
            "robot.urdf",
            b"<?xml version='1.0'?><robot name='a'/>",
            "nothing in it to simulate: line 1, <robot>: has no link",
        ),
        (
            "empty_link.urdf",
            b"<robot name='a'>\n<link name='x'/></robot>",
            "line 2, <link>: 'x' has nothing to see, to touch or to weigh",
        ),
        (
            "lost_mesh.urdf",
            b"<robot name='a'><link name='x'>\n<visual><geometry><mesh filename='package://foo/a.stl'/></geometry></visual></link></robot>",
            "line 2, <visual>: link 'x': file 'package://foo/a.stl' not found",
        ),
        (
            "element.xml",
            b"<mujoco><worldbody><body>\n<gom type='sphere' size='1'/></body></worldbody></mujoco>",
            "line 2, <gom>",
        ),
        (
            "kind.xml",
            b"<mujoco><worldbody><body>\n<geom type='sphre' size='1'/></body></worldbody></mujoco>",
            "line 2, <geom>: a geom of type 'sphre' is not read",
        ),
        (
            "robot.urdf.xacro",
            b"<?xml version='1.0'?><robot name='a'/>",
            "xacro FILE > robot.urdf",
        ),
        (
            "robot.sdf",
            b"<?xml version='1.0'?><sdf/>",
            "line 1, <sdf>: has no model",
        ),
        (
            "other.world",
            b"<robot/>",
            "line 1: the file begins with <robot> instead of <sdf>",
        ),
        (
            "robot.xml",
            b"<mujoco><worldbody></mujoco>",
            "no valid XML: line 1",
        ),
        (
            "robot.mjcf",
            b"<mujoco/>",
            "line 1, <mujoco>: has no body and no geom",
        ),
    ] {
        let said = said_about("run", name, content);
        assert!(
            said.contains(reason) && said.contains(name),
            "{name}: {said}"
        );
    }
}

fn run(args: &[&str]) -> Output {
    Scene::new("").run(args)
}

#[test]
fn options_say_what_they_need() {
    for (args, needed) in [
        (
            &["--time", "-1"][..],
            "a number of seconds is needed, zero or more",
        ),
        (&["--steps", "-1"], "a whole number is needed"),
        (
            &["--verbosity", "loud"],
            "the levels are none, errors, warnings",
        ),
        (&["--bind", "1.2.3"], "an IP address is needed"),
        (
            &["--remote-api", "--bind", "192.0.2.1", "--unsafe"],
            "it is not an address of this machine",
        ),
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            stderr(&output).contains(needed),
            "{args:?}: {}",
            stderr(&output)
        );
    }
}

#[test]
fn a_folder_without_tests_says_how_to_begin() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let test = |args: &[&str]| {
        let output = output_of(swanilda().arg("test").args(args).current_dir(folder.path()));
        assert_eq!(output.status.code(), Some(5));
        stdout(&output)
    };
    assert!(test(&[]).contains("--init"));
    fs::write(
        folder.path().join("a_test.lua"),
        "it('passes', function() end)",
    )
    .expect("our own folder is writable");
    let filtered = test(&["--filter", "nothing is named so"]);
    assert!(filtered.contains("leave out all 1"), "{filtered}");
}

#[test]
fn our_own_scenes_need_nothing_that_is_missing() {
    let output = output_of(swanilda().args(["doctor", "scenes"]));
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
}

#[cfg(unix)]
#[test]
fn a_run_without_an_end_says_so_once() {
    use std::process::{Command, Stdio};
    use test_support::process::{LIMIT, wait_until, wait_within};
    let scene = Scene::new("");
    let log = scene.path().with_file_name("log");
    let mut child = swanilda();
    let child = child
        .arg("run")
        .arg(scene.path())
        .args(["--realtime", "--empty"])
        .stdout(Stdio::null());
    let mut child = child
        .stderr(fs::File::create(&log).expect("our own folder"))
        .spawn()
        .expect("the command starts");
    let said = || {
        fs::read_to_string(&log)
            .expect("our own file")
            .matches("This run has no end so far")
            .count()
    };
    wait_until("it is said", || said() > 0);
    let signal = ["-INT", &child.id().to_string()].map(str::to_owned);
    Command::new("kill")
        .args(signal)
        .status()
        .expect("kill exists");
    assert!(
        wait_within(&mut child, LIMIT).is_some(),
        "the process goes on"
    );
    assert_eq!(said(), 1);
}

#[test]
fn a_missing_plugin_is_named_in_one_line() {
    let said =
        "simCHAI3D is a plugin of CoppeliaSim that Swanilda does not have yet (docs/PLUGINS.md)";
    for code in [
        "print(select(2, pcall(require, 'simCHAI3D')))",
        "print(select(2, pcall(function() simCHAI3D.start() end)))",
    ] {
        let output = Scene::new(code).run(&["--steps", "1", "--empty", "--quiet"]);
        assert_eq!(
            stdout(&output),
            format!("{said}\n"),
            "{code}: {}",
            stderr(&output)
        );
    }
    let library = Scene::new("print(select(2, pcall(require, 'parserx')))")
        .run(&["--steps", "1", "--empty", "--quiet"]);
    assert!(
        stdout(&library).starts_with("parserx is a Lua module of CoppeliaSim"),
        "{}",
        stdout(&library)
    );
    let unknown = Scene::new("require 'nobody.has.this'").run(&["--steps", "1", "--empty"]);
    assert!(
        stderr(&unknown).contains("no file"),
        "other names list the places: {}",
        stderr(&unknown)
    );
}

#[test]
fn original_errors_list_the_places_where_a_plugin_was_searched() {
    let scene = Scene::new(
        "local _, text = pcall(require, 'simCHAI3D') print((text:gsub('\\n.*', '')))\nrequire 'simCHAI3D'",
    );
    let output = scene.run(&["--steps", "1", "--empty", "--quiet", "--original-errors"]);
    assert_eq!(stdout(&output), "module 'simCHAI3D' not found:\n");
    let log = stderr(&output);
    assert!(
        log.contains("[/Script:error]   module 'simCHAI3D' not found:\n"),
        "{log}"
    );
    assert!(
        log.contains("no field package.preload['simCHAI3D']\n"),
        "{log}"
    );
    assert!(!log.contains("PLUGINS.md"), "{log}");
}

/// Modules of the library have names that a scene's own modules have too.
#[test]
fn a_scene_s_own_module_goes_before_a_missing_plugin_and_a_helper() {
    for name in ["simCHAI3D", "utils", "matrix", "functional", "stringx"] {
        let scene = Scene::new(&format!("print(require('{name}').mine)"));
        let module = scene.folder.path().join(name).with_extension("lua");
        fs::write(module, "return {mine = 7}").expect("our own folder is writable");
        let output = scene.run(&["--steps", "1", "--empty", "--quiet"]);
        assert_eq!(stdout(&output), "7\n", "{name}");
    }
}

/// Standard error of a run of this code, and the path of its file.
fn log_of(code: &str) -> (String, String) {
    let scene = Scene::new(code);
    let output = scene.run(&["--steps", "2"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    (stderr(&output), scene.path().display().to_string())
}

#[test]
fn errors_name_file_line_and_object() {
    let (log, path) = log_of(
        "sim = require 'sim'\nfor i = 1, 6 do sim.setObjectAlias(sim.createDummy(0.1), 'joint' .. i) end\n\
         print(select(2, pcall(sim.getObject, '/joint9')))\nsim.getObject('/joint7')",
    );
    let error = format!(
        "{path}:4: in sim._getObject: object does not exist, or alias/path is ill formatted.\n"
    );
    assert!(log.contains(&error), "{log}");
    assert!(
        log.contains("\nno object '/joint7'; did you mean '/joint6'?\nstack traceback:\n"),
        "{log}"
    );
    assert!(!log.contains("sim/script"), "no line of the library: {log}");
    let (log, path) = log_of("function sysCall_init()\n    self.x = 1\nend");
    assert!(
        log.contains(&format!(
            "[/Script:error]   {path}:2: attempt to index a nil value"
        )),
        "{log}"
    );
    let (log, path) = log_of("x = 1\ny = = 2");
    assert!(
        log.contains(&format!("{path}:2: unexpected symbol")),
        "{log}"
    );
    let (log, path) = log_of("sim = require 'sim'\nrequire 'simCHAI3D'");
    assert!(
        log.contains(&format!("{path}:2: simCHAI3D is a plugin")) && !log.contains("\"base\""),
        "{log}"
    );
}

#[test]
fn scripts_catch_the_original_text() {
    let code = "sim = require 'sim'\nprint(select(2, pcall(sim.getObject, '/a')))\nprint(select(2, pcall(error, 'x')))\n\
                print(select(2, pcall(function() local y = z.w end)))";
    let output = Scene::new(code).run(&["--steps", "1", "--empty", "--quiet"]);
    assert!(
        stdout(&output).contains("in sim._getObject: object does not exist"),
        "{}",
        stdout(&output)
    );
    assert!(
        stdout(&output).contains("[string \"/Script\"]:4: attempt to index"),
        "{}",
        stdout(&output)
    );
}

/// What the log says when `call` fails.
fn hint_for(call: &str) -> String {
    let code = format!(
        "local s2 = require('sim')\nsim = s2\nsimIK = require 'simIK'\nown = {{}}\nfunction sysCall_init()\n  d = sim.createDummy(0.1)\n  {call}\nend"
    );
    stderr(&Scene::new(&code).run(&["--no-start", "--quiet"]))
}

#[test]
fn errors_name_the_argument_that_is_nil_and_the_name_that_was_meant() {
    for (call, hint) in [
        (
            "sim.setObjectPosition(nil, {0, 0, 0})",
            "sim.setObjectPosition: argument 1 (objectHandle) is nil",
        ),
        (
            "sim.setObjectPosition(d)",
            "sim.setObjectPosition: argument 2 (position) is missing",
        ),
        (
            "sim.buildPose(1, {0, 0, 0})",
            "sim.buildPose: argument 1 (position) is no table",
        ),
        (
            "sim.getObjectHandel('/a')",
            "sim has no 'getObjectHandel'; did you mean 'getObjectHandle'?",
        ),
        (
            "s2.getObjetc('/a')",
            "sim has no 'getObjetc'; did you mean 'getObject'?",
        ),
        (
            "simIK.creatGroup(3)",
            "simIK has no 'creatGroup'; did you mean 'createGroup'?",
        ),
        (
            "simGetObjectHandel('a')",
            "sim has no 'getObjectHandel'; did you mean 'getObjectHandle'?",
        ),
        (
            "sim.loadModel('models/robots/x.ttm')",
            "no file 'models/robots/x.ttm'; models of a CoppeliaSim that you have are found with --resources DIR",
        ),
    ] {
        let said = hint_for(call);
        assert!(said.contains(hint), "{call}: {said}");
    }
    for call in [
        "own.getObjetc()",
        "pcall(sim.loadModel, 'x.ttm') sim.getObject(17, {})",
    ] {
        let said = hint_for(call);
        assert!(said.contains("scene.lua:7: "), "{call}: {said}");
        let hints = ["did you mean", "no file", " is nil"];
        assert!(
            hints.iter().all(|hint| !said.contains(hint)),
            "{call}: {said}"
        );
    }
}

/// Builds a scene, and would take it away again when it ends.
const BUILDER: &str = "sim = require 'sim'
function sysCall_init()
    box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
    sim.setObjectAlias(box, 'Box')
    print('built')
end
function sysCall_cleanup() sim.removeObjects{box} end";

#[test]
fn scenes_of_scripts_are_built_and_saved_without_them() {
    let scene = Scene::new(BUILDER);
    let command = |args: &[&str]| output_of(swanilda().args(args).current_dir(scene.folder.path()));
    let converted = command(&["convert", "scene.lua", "scene.ttt"]);
    assert!(converted.status.success(), "{}", stderr(&converted));
    assert!(stderr(&converted).contains("built"));
    for file in ["scene.ttt", "scene.lua"] {
        let seen = command(&["inspect", file]);
        let text = stdout(&seen);
        assert!(text.contains("  Box (Shape"), "{file}: {text}");
        assert!(!text.contains("(Script"), "{file}: {text}");
    }
    fs::write(scene.path(), "error('no')").expect("our own folder is writable");
    let failed = command(&["convert", "scene.lua", "other.ttt"]);
    assert_eq!(failed.status.code(), Some(2));
    assert!(stderr(&failed).contains("its script did not come to its end"));
}
