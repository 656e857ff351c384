//! `--resources`: models and Lua files of an installation of CoppeliaSim that the user has.

use std::fs;
use std::path::Path;
use std::process::Output;

use tempfile::TempDir;
use test_support::process::output_of;

use super::{Scene, stderr, stdout, swanilda};

const SAVES_A_MODEL: &str = "sim = require 'sim'
function sysCall_init()
    local arm = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3}, 0)
    sim.setObjectAlias(arm, 'Arm')
    sim.setBoolProperty(arm, 'modelBase', true)
    sim.saveModel(arm, sim.getNamedStringParam('to'))
end";

const USES_IT: &str = "sim = require 'sim'
function sysCall_init()
    local ok, arm = pcall(sim.loadModel, 'models/robots/arm.ttm')
    print(ok, ok and sim.getObjectAlias(arm, 1) or arm)
    print(pcall(sim.loadModel, 'models/../../secret.ttm'))
    for _, name in ipairs{'mylib', 'oldlib', 'folder', 'utils'} do
        local found, module = pcall(require, name)
        print(name, found and (type(module) == 'string' and module or 'ours') or 'none')
    end
    print(sim.include('/lua/mylib.lua'))
    local folder = sim.getStringParam(sim.stringparam_resourcesdir)
    local function below(number)
        local path = sim.getStringParam(number)
        return folder ~= '' and path:sub(1, #folder) == folder and path:sub(#folder + 1) or path
    end
    print(folder == sim.getStringParam(sim.stringparam_application_path), below(sim.stringparam_modeldefaultdir), below(sim.stringparam_luadir))
end";

/// A made-up installation: a model, modules in the places where CoppeliaSim looks, and a model outside of it.
fn installation() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let root = folder.path().join("CoppeliaSim");
    for place in ["models/robots", "lua/deprecated", "lua/folder"] {
        fs::create_dir_all(root.join(place)).expect("our own folder is writable");
    }
    let write = |file: &str, text: &str| {
        fs::write(root.join(file), text).expect("our own folder is writable");
    };
    write("lua/mylib.lua", "return 'from lua'");
    write("lua/deprecated/oldlib.lua", "return 'from deprecated'");
    write("lua/folder/init.lua", "return 'a folder'");
    write("lua/utils.lua", "return 'not ours'");
    save_model(&root.join("models/robots/arm.ttm"));
    save_model(&folder.path().join("secret.ttm"));
    folder
}

fn save_model(file: &Path) {
    let param = format!("to={}", file.display());
    let output = Scene::new(SAVES_A_MODEL).run(&["--no-start", "--loops", "1", "-D", &param]);
    assert!(file.exists(), "{}", stderr(&output));
}

fn run(installation: &TempDir, args: &[&str]) -> Output {
    let root = installation.path().join("CoppeliaSim");
    let resources = format!("--resources={}", root.display());
    let all = [
        &[
            "--no-start",
            "--loops",
            "1",
            "--empty",
            "--quiet",
            resources.as_str(),
        ],
        args,
    ]
    .concat();
    Scene::new(USES_IT).run(&all)
}

const FOUND: &str = "true, /Arm\nfalse, -1: in sim.loadModel: file does not exist.\nmylib, from lua\noldlib, from deprecated\nfolder, a folder\nutils, ours\nfrom lua\n";

#[test]
fn models_and_modules_are_found() {
    let installation = installation();
    let output = run(&installation, &[]);
    let expected = format!("{FOUND}true, /models, /lua\n");
    assert_eq!(
        stdout(&output).replace('\\', "/"),
        expected,
        "{}",
        stderr(&output)
    );
}

#[test]
fn they_are_readable_with_no_unsafe_and_nothing_beside_them() {
    let installation = installation();
    let output = stdout(&run(&installation, &["--no-unsafe"]));
    assert!(
        output.starts_with("true, /Arm\nfalse, -1: in sim.loadModel: reading 'models/../../secret.ttm' is not allowed"),
        "{output}"
    );
    assert!(
        output.contains("mylib, from lua\noldlib, from deprecated\n"),
        "{output}"
    );
}

#[test]
fn they_are_not_with_deny_all() {
    let output = stdout(&run(&installation(), &["--deny-all"]));
    assert!(
        output.starts_with(
            "false, -1: in sim.loadModel: reading 'models/robots/arm.ttm' is not allowed"
        ),
        "{output}"
    );
    assert!(output.contains("mylib, none\n"), "{output}");
}

#[test]
fn without_them_a_model_is_missing() {
    let output = Scene::new(
        "sim = require 'sim' print(pcall(sim.loadModel, 'models/robots/arm.ttm')) print(sim.getStringParam(141) == '')",
    )
    .run(&["--no-start", "--loops", "1", "--quiet"]);
    assert_eq!(
        stdout(&output),
        "false, -1: in sim.loadModel: file does not exist.\ntrue\n"
    );
}

#[test]
fn the_environment_names_them_and_a_missing_folder_is_an_error() {
    let installation = installation();
    let scene = Scene::new("sim = require 'sim' print(require 'mylib')");
    let mut command = swanilda();
    command
        .arg("run")
        .arg(scene.path())
        .args(["--no-start", "--loops", "1", "--quiet"]);
    let found = output_of(command.env(
        "SWANILDA_RESOURCES",
        installation.path().join("CoppeliaSim"),
    ));
    assert_eq!(stdout(&found), "from lua\n");
    let missing = output_of(command.env("SWANILDA_RESOURCES", installation.path().join("nothing")));
    assert_eq!(missing.status.code(), Some(2));
    assert!(
        stderr(&missing).contains("there is no such folder"),
        "{}",
        stderr(&missing)
    );
}
