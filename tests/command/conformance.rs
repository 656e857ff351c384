//! Runs every case below `tests/conformance` through the command line and compares with what CoppeliaSim 4.10 printed.
//!
//! A case is discovered, never listed. `KNOWN.md` names the cases that do not pass yet; one that passes must leave the list.
//! `CASE=name` runs the cases whose name contains that text and shows how they differ.

#![allow(clippy::disallowed_methods, reason = "CASE chooses the cases to run")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use test_support::compare::{difference, normalize};
use test_support::parallel;
use test_support::process::run_bounded;

#[test]
fn cases_print_what_the_original_prints() {
    let filter = std::env::var("CASE").unwrap_or_default();
    let cases: Vec<PathBuf> = discover()
        .into_iter()
        .filter(|path| path.to_string_lossy().contains(&filter))
        .collect();
    assert!(!cases.is_empty(), "no case matches {filter:?}");
    let known = known_failures();
    let failures = run_all(&cases);
    let surprises: Vec<String> = failures
        .iter()
        .filter(|(name, _)| !filter.is_empty() || !known.contains_key(*name))
        .map(|(name, difference)| format!("{name}:\n{difference}\n"))
        .collect();
    let fixed: Vec<&String> = known
        .keys()
        .filter(|name| is_among(&cases, name) && !failures.contains_key(*name))
        .collect();
    println!(
        "{} of {} cases pass",
        cases.len() - failures.len(),
        cases.len()
    );
    assert!(
        surprises.is_empty(),
        "{} cases differ:\n{}",
        surprises.len(),
        surprises.join("\n")
    );
    assert!(
        fixed.is_empty() || !filter.is_empty(),
        "these pass now, take them off KNOWN.md: {fixed:?}"
    );
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/conformance")
}

/// Every `.lua` below the folder that has an `.expected` beside it.
fn discover() -> Vec<PathBuf> {
    let mut pending = vec![root()];
    let mut cases = Vec::new();
    while let Some(dir) = pending.pop() {
        for entry in fs::read_dir(&dir)
            .expect("the conformance folder is readable")
            .flatten()
        {
            let path = entry.path();
            if path.is_dir() {
                pending.push(path);
            } else if path.extension().is_some_and(|e| e == "lua")
                && path.with_extension("expected").exists()
            {
                cases.push(path);
            }
        }
    }
    cases.sort();
    cases
}

/// `folder/case` of each row of the tables in KNOWN.md, with its reason.
fn known_failures() -> BTreeMap<String, String> {
    let text = fs::read_to_string(root().join("KNOWN.md")).unwrap_or_default();
    let rows = text
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once("` |"));
    rows.map(|(name, reason)| (name.to_owned(), reason.trim_matches([' ', '|']).to_owned()))
        .collect()
}

fn is_among(cases: &[PathBuf], name: &str) -> bool {
    cases.iter().any(|case| case_name(case) == name)
}

fn case_name(case: &Path) -> String {
    let relative = case
        .strip_prefix(root())
        .expect("discovered below the root")
        .with_extension("");
    relative.to_string_lossy().into_owned()
}

/// The cases that differ, with how.
fn run_all(cases: &[PathBuf]) -> BTreeMap<String, String> {
    let differences = parallel::map(cases, |case| run_case(case));
    cases
        .iter()
        .zip(differences)
        .filter_map(|(case, difference)| Some((case_name(case), difference?)))
        .collect()
}

/// How the output of a case differs from the recording, if it does.
fn run_case(case: &Path) -> Option<String> {
    let text = fs::read_to_string(case).expect("a case is readable text");
    let header = |key: &str| {
        text.lines()
            .find_map(|l| l.strip_prefix(&format!("-- {key}: ")))
            .map(str::trim)
    };
    let data = tempfile::tempdir().expect("a temporary folder can be made");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("run")
        .arg(case)
        .arg("--data-dir")
        .arg(data.path())
        .args([
            "--as",
            header("as").unwrap_or("sandbox"),
            "--empty",
            "--original-errors",
            "--quiet",
        ]);
    match header("passes").unwrap_or("0") {
        "0" => command.args(["--no-start", "--loops", header("loops").unwrap_or("20")]),
        passes => command.args(["--steps", passes]),
    };
    let expected = fs::read_to_string(case.with_extension("expected")).expect("discover saw it");
    let tolerance = header("tol").map_or(0.0, |tol| tol.parse().expect("a tolerance is a number"));
    match run_bounded(&mut command) {
        Ok(output) => difference(
            &normalize(&expected, case),
            &normalize(&output, case),
            tolerance,
        ),
        Err(error) => Some(error),
    }
}
