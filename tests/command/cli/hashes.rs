//! `swanilda run --hash`, `--hash-file`, `--expect-hash`.

use super::{Scene, stderr, stdout};

/// A ball that falls, and a number that a script draws in each step.
const FALLS: &str = "sim = require 'sim'
function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.5, 0.5, 0.5})
    sim.setObjectAlias(ball, 'Ball')
    sim.setObjectPosition(ball, {0, 0, 2})
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
end
function sysCall_actuation() math.random() end";

#[test]
fn the_last_hash_is_that_of_every_run_with_the_seed() {
    let scene = Scene::new(FALLS);
    let hash = |args: &[&str]| {
        let args = [&["--steps", "5", "--quiet", "--hash"], args].concat();
        stdout(&scene.run(&args))
    };
    let first = hash(&[]);
    assert!(
        first.starts_with("state hash ") && first.ends_with(" after step 7\n"),
        "{first}"
    );
    assert_eq!(first, hash(&["--threads", "3"]));
    assert_ne!(first, hash(&["--seed", "2"]));
    let json = hash(&["--json"]);
    let word = first.split(' ').nth(2).expect("the hash is the third word");
    assert!(
        json.contains(r#""type":"hash""#) && json.contains(&format!("\"{word}\"")),
        "{json}"
    );
}

#[test]
fn a_run_that_differs_ends_there_and_names_the_value() {
    let scene = Scene::new(FALLS);
    let file = scene.folder.path().join("hashes.txt").display().to_string();
    let output = scene.run(&["--steps", "20", "--quiet", "--hash-file", &file]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));

    let same = scene.run(&["--steps", "10", "--quiet", "--expect-hash", &file]);
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    let said = stderr(&same);
    assert!(said.contains("after 10 steps are those of"), "{said}");
    assert!(said.contains("which has more"), "{said}");

    let moves = "if sim.getSimulationTime() > 0.42 then sim.setObjectAlias(ball, 'Other') end end";
    let code = FALLS.replace("math.random() end", &format!("math.random() {moves}"));
    std::fs::write(scene.path(), code).expect("our own folder is writable");
    let other = scene.run(&["--steps", "20", "--expect-hash", &file]);
    assert_eq!(other.status.code(), Some(3), "{}", stderr(&other));
    let said = stderr(&other);
    assert!(
        said.contains("the state after step 10 is another one: alias of /Ball"),
        "{said}"
    );
    assert!(said.contains("13 steps"), "it ends there: {said}");
}

#[test]
fn files_that_cannot_be_used_are_told() {
    let scene = Scene::new(FALLS);
    let text = scene.folder.path().join("text.txt");
    std::fs::write(&text, "no hashes\n").expect("our own folder is writable");
    let (text, nowhere) = (text.display().to_string(), "/nowhere/at/all".to_owned());
    for (option, file, reason) in [
        ("--expect-hash", &text, "no file of state hashes"),
        ("--expect-hash", &nowhere, "No such file"),
        ("--hash-file", &nowhere, "No such file"),
    ] {
        let output = scene.run(&["--steps", "1", option, file]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(reason), "{}", stderr(&output));
    }
}

/// Lua's own seed of its hashes would give another order in each process.
#[test]
fn names_have_the_same_order_in_each_process() {
    let scene = Scene::new(
        "local fields, order = {}, {}
        for i = 1, 40 do fields['field' .. i] = i end
        for name in pairs(fields) do order[#order + 1] = name end
        print(table.concat(order, ' '))",
    );
    let order = || stdout(&scene.run(&["--steps", "1", "--quiet"]));
    let first = order();
    assert_eq!(first.split(' ').count(), 40, "{first}");
    assert_eq!(first, order());
}
