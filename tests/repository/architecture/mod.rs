//! What Cargo does not hold: imports between the rooms of a crate, which point inwards only (docs/ARCHITECTURE.md), and who may do what.

mod circles;
mod functions;
mod imports;
mod outside;
mod page;
mod rules;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use imports::{
    code_lines, crate_of, has_word, is_test, module_path, read, relative, rooms_used, root,
    sources, without_tests, without_texts,
};
use outside::{INPUTS, NO_PERMISSION_NEEDED, SYSTEM_CALLS};
use rules::{FUNCTIONS_FOR_SCRIPTS, LUA_NAMES, LUA_ROOMS, ROOMS, ROOTS_FOR_OTHERS, Rooms};

#[test]
fn rooms_use_what_they_may() {
    let wrong: Vec<String> = sources()
        .iter()
        .filter(|file| !is_test(file))
        .flat_map(|file| forbidden_rooms(file))
        .collect();
    assert!(
        wrong.is_empty(),
        "see ROOMS in tests/repository/architecture/rules.rs:\n{}",
        wrong.join("\n")
    );
}

/// The rooms that a file uses, though its own may not.
fn forbidden_rooms(file: &Path) -> Vec<String> {
    let path = module_path(file);
    let [layer, room, ..] = path.as_slice() else {
        return Vec::new();
    };
    let Some((_, rooms)) = ROOMS.iter().find(|(of, _)| of == layer) else {
        return Vec::new();
    };
    let Some((_, may_use)) = rooms.iter().find(|(of, _)| of == room) else {
        return vec![format!(
            "{}: `{room}` is no room of `{layer}`",
            file.display()
        )];
    };
    let names_root_only = ROOTS_FOR_OTHERS.contains(&layer.as_str());
    let is_forbidden = |used: &String| {
        used != room
            && (names_root_only || is_room(rooms, used))
            && !may_use.contains(&used.as_str())
    };
    let used = rooms_used(&without_tests(&read(file)), &path);
    used.into_iter()
        .filter(is_forbidden)
        .map(|used| format!("{}: {room} must not use {used}", file.display()))
        .collect()
}

fn is_room(rooms: Rooms, name: &str) -> bool {
    rooms.iter().any(|(room, _)| *room == name)
}

/// The host of scripts speaks to the trait `Interpreter`; names of languages may stand in texts.
#[test]
fn the_script_host_knows_no_language() {
    let mut wrong = Vec::new();
    for file in sources().into_iter().filter(|file| !is_test(file)) {
        let path = module_path(&file);
        let [layer, room, ..] = path.as_slice() else {
            continue;
        };
        if layer != "script" || LUA_ROOMS.contains(&room.as_str()) {
            continue;
        }
        let names_lua = |line: &&str| {
            LUA_NAMES
                .iter()
                .any(|name| has_word(&without_texts(line), name))
        };
        let text = without_tests(&read(&file));
        wrong.extend(
            code_lines(&text)
                .filter(names_lua)
                .map(|line| format!("{}: {}", file.display(), line.trim())),
        );
    }
    assert!(
        wrong.is_empty(),
        "let the trait `Interpreter` do it:\n{}",
        wrong.join("\n")
    );
}

/// `Sim` is the whole simulator: who holds it may do anything, whatever the signature says.
#[test]
fn functions_for_scripts_reach_the_simulator_through_their_context() {
    let mut wrong = Vec::new();
    for file in sources()
        .into_iter()
        .filter(|file| has_functions_for_scripts(file))
    {
        let text = read(&file);
        let hold = |line: &&str| {
            line.contains(".sim()") || line.contains("sim.upgrade()") || has_word(line, "Sim")
        };
        wrong.extend(
            code_lines(&text)
                .filter(hold)
                .map(|line| format!("{}: {}", file.display(), line.trim())),
        );
    }
    assert!(
        wrong.is_empty(),
        "add a narrow accessor to `Cx` instead:\n{}",
        wrong.join("\n")
    );
}

fn has_functions_for_scripts(file: &Path) -> bool {
    crate_of(file).is_some_and(|name| {
        FUNCTIONS_FOR_SCRIPTS
            .iter()
            .any(|prefix| name.starts_with(prefix))
    })
}

/// Files, programs and sockets: code that reaches them for a script asks for permission in the same file (docs/PERMISSIONS.md).
#[test]
fn who_calls_the_operating_system_asks_for_permission() {
    let mut wrong = Vec::new();
    let for_scripts = |file: &PathBuf| {
        has_functions_for_scripts(file) || crate_of(file).as_deref() == Some("script")
    };
    for file in sources().into_iter().filter(for_scripts) {
        let text = without_tests(&read(&file));
        let calls = SYSTEM_CALLS
            .iter()
            .filter(|call| code_lines(&text).any(|line| line.contains(**call)));
        if !text.contains("ermissions")
            && !NO_PERMISSION_NEEDED
                .iter()
                .any(|(name, _)| relative(&file).ends_with(name))
        {
            wrong.extend(calls.map(|call| format!("{}: {call}", file.display())));
        }
    }
    assert!(
        wrong.is_empty(),
        "ask `cx.permissions()` first:\n{}",
        wrong.join("\n")
    );
}

/// A replay is the same run because all that comes from outside comes by the tape: here is where.
#[test]
fn the_tape_has_few_inputs() {
    const METHODS: &[&str] = &[".input(", ".input_for(", ".content(", ".poll(", ".signal("];
    let on_tape = |file: &PathBuf| {
        let text = without_tests(&read(file));
        crate_of(file).as_deref() != Some("capture")
            && has_word(&text, "tape")
            && METHODS.iter().any(|method| text.contains(method))
    };
    let found: BTreeSet<String> = sources()
        .iter()
        .filter(|file| !is_test(file) && on_tape(file))
        .map(|file| relative(file).display().to_string())
        .collect();
    let named: BTreeSet<String> = INPUTS.iter().map(|(file, _)| (*file).to_owned()).collect();
    assert_eq!(
        found, named,
        "see INPUTS in tests/repository/architecture/rules.rs"
    );
}

/// What belongs to one part is a field of that part: `Sim` only puts the parts together.
#[test]
fn the_simulator_consists_of_few_parts() {
    let text = read(&root().join("crates/script/src/host/sim.rs"));
    let (_, body) = text
        .split_once("struct Sim {\n")
        .expect("the simulator is a struct");
    let (body, _) = body.split_once("\n}").expect("the struct ends");
    let fields: Vec<_> = code_lines(body)
        .filter(|line| line.contains(": "))
        .collect();
    assert!(
        (2..=15).contains(&fields.len()),
        "{} fields: {fields:#?}",
        fields.len()
    );
}

#[test]
fn every_module_says_what_it_is_for() {
    let silent: Vec<_> = sources()
        .into_iter()
        .filter(|file| !read(file).starts_with("//!"))
        .collect();
    assert!(silent.is_empty(), "these begin without `//!`: {silent:?}");
}

/// What a static holds outlives the simulator that needs it first, so it must not lie in its memory.
#[test]
fn statics_are_made_outside_of_simulators() {
    let wrong: Vec<_> = sources()
        .into_iter()
        .filter(|file| {
            // The reference is written without a simulator.
            let elsewhere = ["crates/heap", "crates/docs"].map(|folder| root().join(folder));
            !elsewhere.iter().any(|folder| file.starts_with(folder))
        })
        .filter(|file| code_lines(&read(file)).any(|line| line.contains("LazyLock")))
        .collect();
    assert!(wrong.is_empty(), "use `heap::Lazy` there: {wrong:?}");
}
