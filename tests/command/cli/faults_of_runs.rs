//! `swanilda run --faults FILE`.

use super::*;

const STEPS: usize = 6;

/// A controller that prints what it reads in each step: its number.
const SCENE: &str = r"sim = require 'sim'
function sysCall_init()
    local script = sim.createScript(sim.scripttype_simulation, [[
        sim = require 'sim'
        n = 0
        function read() return n end
        function sysCall_actuation() n = n + 1 print(read()) end
    ]])
    sim.setObjectAlias(script, 'controller')
end";

fn with_faults(faults: &str) -> (Output, String) {
    let scene = Scene::new(SCENE);
    fs::write(scene.folder.path().join("faults.lua"), faults).expect("our own folder is writable");
    let mut command = swanilda();
    command.current_dir(scene.folder.path());
    command.args([
        "run",
        "scene.lua",
        "--steps",
        "6",
        "--quiet",
        "--faults",
        "faults.lua",
    ]);
    let output = output_of(&mut command);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let numbers: Vec<_> = text.split_whitespace().take(STEPS).collect();
    (output, numbers.join(" "))
}

#[test]
fn faults_take_hold_after_the_first_step_and_at_their_times() {
    let (_, shifted) = with_faults("faults.bias('/controller', 'read', 10)");
    assert_eq!(shifted, "1 12 13 14 15 16");
    let (_, for_a_while) = with_faults(
        "at(0.1, function() local f = faults.bias('/controller', 'read', 10)
         at(0.2, function() f:stop() end) end)",
    );
    assert_eq!(for_a_while, "1 2 3 14 15 6");
}

#[test]
fn errors_name_the_file_of_faults_and_its_line() {
    let (output, _) = with_faults("\n\nfaults.fog('/controller')");
    assert_eq!(output.status.code(), Some(1));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("faults.lua:3"), "{errors}");
}
