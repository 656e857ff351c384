//! Every function that the coverage page says works is called somewhere in the suite: one that nothing calls may be broken unnoticed.
//!
//! A call is a name with arguments, `sim.wait(1)`, or a name handed on: `pcall(sim.wait, 1)`, `local wait = sim.wait`. The old
//! spelling `simWait` is the same function. A name in a comment, in a list or alone in quotes is no call.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Folders whose programs the suite runs.
const FOLDERS: [&str; 3] = ["tests", "scenes", "examples"];

/// Modules whose functions cases call as methods, by names in tables and by the module's name in a variable: their calls cannot be seen.
const BY_OTHER_NAMES: [&str; 7] = [
    "simEigen",
    "simIM",
    "simROS",
    "simROS2",
    "simUI",
    "simVision",
    "simZMQ",
];

/// Functions that say what a value is, or show it, and do not call it.
const LOOKS: [&str; 4] = ["type", "print", "tostring", "assert"];

#[test]
fn every_function_that_works_is_called() {
    let works = working();
    assert!(
        works.len() > 580 && works.contains("sim.getObjectPosition"),
        "{} functions are known",
        works.len()
    );
    let mut called = BTreeSet::new();
    for folder in FOLDERS {
        read(
            &Path::new(env!("CARGO_MANIFEST_DIR")).join(folder),
            &mut called,
        );
    }
    let uncalled: Vec<&String> = works.difference(&called).collect();
    assert!(
        uncalled.is_empty(),
        "{} functions are said to work, and nothing below {FOLDERS:?} calls them; add cases to tests/conformance: {uncalled:#?}",
        uncalled.len()
    );
}

#[test]
fn calls_are_told_from_mentions() {
    let called = |code: &str| calls("case.lua", code).collect::<Vec<_>>();
    assert_eq!(
        called("x = sim.wait (1) sim.test{2} sim.load'a' simGetName(3)"),
        [
            "sim.wait",
            "sim.test",
            "sim.load",
            "sim.getName",
            "simGetName"
        ]
    );
    assert_eq!(
        called("pcall(sim.wait, 1) try( sim.test) local f = sim.load"),
        ["sim.wait", "sim.test", "sim.load"]
    );
    assert_eq!(
        called("try('a', {1}, sim.wait, 1) simIK.solve()"),
        ["sim.wait", "simIK.solve"]
    );
    assert_eq!(called("run('sim.wait(1)')"), ["sim.wait"]);
    assert_eq!(
        called("for _, f in ipairs{sim.wait, 'sim.test', \"sim.load\"} do f() end"),
        [""; 0]
    );
    assert_eq!(
        called("function sim.wait(x) end print('a', sim.test) my.sim.load(1) x == sim.stop"),
        [""; 0]
    );
    assert_eq!(
        called("-- sim.wait(1)\n--[[ all\nsim.test(2)\n]]\nsim.load(3)"),
        ["sim.load"]
    );
    // The simulator of a test in Rust or Python is often called `sim`, too.
    assert_eq!(calls("case.rs", "sim.step(); // sim.getName(1)").count(), 0);
    assert_eq!(
        calls("case.py", "sim.step(); sim.getName(1)").collect::<Vec<_>>(),
        ["sim.getName"]
    );
}

/// The functions of `sim`, with those of old scripts, and of its modules that are documented without a reservation.
fn working() -> BTreeSet<String> {
    let modules = docs::module_functions()
        .into_iter()
        .filter(|function| !BY_OTHER_NAMES.contains(&&*function.category));
    let names = docs::functions()
        .into_iter()
        .chain(modules)
        .map(|function| function.name);
    names
        .filter(|name| name.starts_with("sim") && docs::difference(name).is_none())
        .collect()
}

/// Adds the calls in the programs of a folder.
fn read(folder: &Path, called: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder)
        .expect("a folder of the suite is readable")
        .flatten()
    {
        let path = entry.path();
        let name = path.to_string_lossy();
        if path.is_dir() {
            read(&path, called);
        } else if let Some(text) = comment_mark(&name).and_then(|_| fs::read_to_string(&path).ok())
        {
            called.extend(calls(&name, &text));
        }
    }
}

/// What begins a comment in a program of that name; None: no program.
fn comment_mark(name: &str) -> Option<&'static str> {
    let (_, extension) = name.rsplit_once('.')?;
    [("lua", "--"), ("rs", "//"), ("py", "#")]
        .iter()
        .find(|(known, _)| *known == extension)
        .map(|(_, mark)| *mark)
}

/// The full names of the functions that a program calls.
fn calls(name: &str, text: &str) -> impl Iterator<Item = String> {
    let is_lua = name.ends_with(".lua");
    let code = without_comments(text, comment_mark(name).unwrap_or("--"));
    let mut found = Vec::new();
    for (start, end) in names(&code) {
        let name = &code[start..end];
        let is_method = !is_lua && !name.contains(char::is_uppercase);
        if is_call(&code[..start], &code[end..]) && !is_method {
            found.extend(new_spelling(name));
            found.push(name.to_owned());
        }
    }
    found.into_iter()
}

/// `sim.wait` for `simWait`.
fn new_spelling(name: &str) -> Option<String> {
    let member = name
        .strip_prefix("sim")
        .filter(|member| !member.contains('.'))?;
    Some(format!(
        "sim.{}{}",
        member[..1].to_ascii_lowercase(),
        &member[1..]
    ))
}

/// The lines of a program up to their comments. Where a mark stands in a string, what follows is lost: that finds fewer calls, not more.
fn without_comments(text: &str, mark: &str) -> String {
    let mut code = String::new();
    let mut is_block = false;
    for line in text.lines() {
        let begins = mark == "--"
            && line
                .split_once("--[[")
                .is_some_and(|(_, rest)| !rest.contains("]]"));
        if !is_block {
            code.push_str(line.split(mark).next().unwrap_or_default());
            code.push('\n');
        }
        is_block = begins || is_block && !line.contains("]]");
    }
    code
}

/// Where names begin and end that start with `sim` and have at most one dot.
fn names(code: &str) -> impl Iterator<Item = (usize, usize)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    code.match_indices("sim").filter_map(move |(start, _)| {
        let rest = &code[start..];
        let first = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let member = rest[first..]
            .strip_prefix('.')
            .map_or(0, |m| 1 + m.find(|c| !is_part(c)).unwrap_or(m.len()));
        let length = first + if member > 1 { member } else { 0 };
        let is_inside = code[..start].ends_with(|c| is_part(c) || c == '.' || c == ':');
        (!is_inside && length > "sim.".len()).then_some((start, start + length))
    })
}

/// Whether a name with this before and this behind it is called or handed on.
fn is_call(before: &str, behind: &str) -> bool {
    let before = before.trim_end_matches(' ');
    match behind
        .trim_start_matches(' ')
        .chars()
        .next()
        .unwrap_or('\n')
    {
        '(' => !before.ends_with("function"),
        '{' | '\'' | '"' => !before.ends_with(['\'', '"']),
        ',' | ')' if before.ends_with(['(', ',']) => is_argument(before),
        ',' | ';' | '\n' => before
            .strip_suffix('=')
            .is_some_and(|left| !left.ends_with(['=', '~', '<', '>', '!'])),
        _ => false,
    }
}

/// Whether what follows is handed to a function that may call it: the bracket that is open there is round.
fn is_argument(before: &str) -> bool {
    let mut closed = 0;
    for (at, bracket) in before.rmatch_indices(['(', ')', '[', ']', '{', '}']) {
        match bracket {
            ")" | "]" | "}" => closed += 1,
            _ if closed > 0 => closed -= 1,
            _ => return bracket == "(" && !LOOKS.iter().any(|look| before[..at].ends_with(look)),
        }
    }
    false
}
