//! Scenes that a script in Python builds, where a command wants a file: they are built, and saved without that script.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use test_support::process::output_of;

use super::scripts::has_python;

/// Builds a scene with a module beside it and a script of its own, and would take it away again when it ends.
const BUILDER: &str = "#python
import parts

def sysCall_init():
    global sim, box
    sim = require('sim')
    box = parts.box('Box')
    script = sim.createScript(sim.scripttype_simulation, 'function sysCall_init() print(\"kept\") end', 0, 'lua')
    sim.setObjectParent(script, box, True)
    print('built')

def sysCall_cleanup():
    sim.removeObjects([box])
";
const PARTS: &str = "def box(alias):
    from __main__ import sim
    handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [1, 1, 1])
    sim.setObjectAlias(handle, alias)
    return handle
";

fn swanilda(folder: &Path, args: &[&str]) -> (Output, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let output = output_of(command.args(args).current_dir(folder));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (said, complained) = (text(&output.stdout), text(&output.stderr));
    (output, said, complained)
}

#[test]
fn scenes_of_python_are_built_and_saved_without_their_script() {
    if !has_python() {
        return;
    }
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("it can be written");
    };
    write("scene.py", BUILDER);
    write("parts.py", PARTS);
    for file in ["scene.ttt", "scene.simscene.xml"] {
        let (output, said, complained) = swanilda(folder.path(), &["convert", "scene.py", file]);
        assert!(output.status.success(), "{file}: {complained}");
        assert!(
            said.is_empty() && complained.contains("built"),
            "{file}: {said}"
        );
    }
    for file in ["scene.py", "scene.ttt", "scene.simscene.xml"] {
        let (_, said, complained) = swanilda(folder.path(), &["inspect", file]);
        assert!(said.contains("  Box (Shape"), "{file}: {said}{complained}");
        assert_eq!(said.matches("(Script").count(), 1, "{file}: {said}");
    }
    let (_, said, _) = swanilda(folder.path(), &["run", "scene.ttt", "-q", "--steps", "1"]);
    assert_eq!(said, "kept\n", "it runs without Python");
    let (output, said, _) = swanilda(folder.path(), &["diff", "scene.py", "scene.ttt"]);
    assert!(output.status.success(), "the same is built again: {said}");
}

#[test]
fn scenes_of_python_that_fail_are_not_saved() {
    if !has_python() {
        return;
    }
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    for (text, reason) in [
        (
            "def sysCall_init():\n    raise ValueError('no box')\n",
            "line 2, in sysCall_init",
        ),
        (
            "import nowhere\ndef sysCall_init():\n    pass\n",
            "No module named 'nowhere'",
        ),
        ("def sysCall_init(:\n", "SyntaxError"),
    ] {
        fs::write(folder.path().join("scene.py"), text).expect("it can be written");
        for args in [
            &["convert", "scene.py", "scene.ttt"][..],
            &["inspect", "scene.py"],
        ] {
            let (output, said, complained) = swanilda(folder.path(), args);
            assert_eq!(output.status.code(), Some(2), "{args:?}: {said}");
            assert!(
                complained.contains(reason)
                    && complained.contains("its script did not come to its end"),
                "{args:?}: {complained}"
            );
        }
        assert!(!folder.path().join("scene.ttt").exists());
    }
}
