//! Mechanics against closed forms: every file in tests/physics is a case that measures and compares. What came out stands in
//! docs/PHYSICS.md, which `UPDATE=1 cargo test --test command physics` rewrites.

#![allow(clippy::disallowed_methods, reason = "UPDATE=1 asks for new files")]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use test_support::parallel;
use test_support::process::run_for_code;

/// How long a case may take: some simulate minutes.
const LIMIT: Duration = Duration::from_secs(600);

/// A quantity a case has measured.
struct Check {
    what: String,
    measured: f64,
    expected: f64,
    tolerance: f64,
}

/// A case: what it is about, and its checks.
struct Case {
    name: String,
    about: String,
    checks: Vec<Check>,
}

#[test]
fn mechanics_comes_out_right() {
    let cases = run_all();
    let wrong: Vec<String> = cases
        .iter()
        .flat_map(|case| case.checks.iter().filter_map(|c| c.complaint(&case.name)))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let page = root().join("docs/PHYSICS.md");
    if std::env::var_os("UPDATE").is_some() {
        let text = fs::read_to_string(&page).expect("the page is there");
        fs::write(&page, with_table(&text, &table(&cases))).expect("the repository is writable");
    }
    let text = fs::read_to_string(&page).expect("the page is there");
    let missing: Vec<&str> = cases
        .iter()
        .map(|case| case.about.as_str())
        .filter(|about| !text.contains(about))
        .collect();
    assert!(
        missing.is_empty(),
        "not in docs/PHYSICS.md: {missing:?}\nrun UPDATE=1 cargo test --test command physics"
    );
}

impl Check {
    /// `CHECK<TAB>what<TAB>measured<TAB>expected<TAB>tolerance` in a line of the log.
    fn read(line: &str) -> Option<Self> {
        let fields: Vec<&str> = line.split_once("CHECK\t")?.1.split('\t').collect();
        let [what, measured, expected, tolerance] = fields[..] else {
            return None;
        };
        let number = |text: &str| text.trim().parse().unwrap_or(f64::NAN);
        let (measured, expected, tolerance) =
            (number(measured), number(expected), number(tolerance));
        Some(Self {
            what: what.to_owned(),
            measured,
            expected,
            tolerance,
        })
    }

    fn complaint(&self, case: &str) -> Option<String> {
        let fits = (self.measured - self.expected).abs() <= self.tolerance;
        (!fits).then(|| {
            format!(
                "{case}: {}: {} is not {} +- {}",
                self.what, self.measured, self.expected, self.tolerance
            )
        })
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All cases, as many at the same time as there are processors.
fn run_all() -> Vec<Case> {
    let entries = fs::read_dir(root().join("tests/physics"))
        .expect("tests/physics is readable")
        .flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "lua"));
    files.sort();
    assert!(!files.is_empty(), "there are cases");
    parallel::map(&files, |file| run(file))
}

fn run(file: &Path) -> Case {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .arg("run")
        .arg(file)
        .args(["--empty", "--time", "120"]);
    let (code, log) = run_for_code(&mut command, LIMIT)
        .unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let checks: Vec<Check> = log.lines().filter_map(Check::read).collect();
    assert!(
        code == 0 && !checks.is_empty(),
        "{}:\n{log}",
        file.display()
    );
    let source = fs::read_to_string(file).expect("the case is readable");
    let about = source
        .lines()
        .next()
        .and_then(|line| line.strip_prefix("-- "))
        .expect("a case begins with what it is about");
    Case {
        name: file
            .file_stem()
            .expect("a file")
            .to_string_lossy()
            .into_owned(),
        about: about.to_owned(),
        checks,
    }
}

/// The page with this table in place of the one it has.
fn with_table(page: &str, table: &str) -> String {
    let (head, rest) = page
        .split_once("<!-- cases -->")
        .expect("the page marks where the cases stand");
    let (_, tail) = rest
        .split_once("<!-- end of cases -->")
        .expect("the page marks where the cases end");
    format!("{head}<!-- cases -->\n{table}<!-- end of cases -->{tail}")
}

fn table(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases {
        let Case {
            name,
            about,
            checks,
        } = case;
        let _ = writeln!(
            text,
            "\n**[{name}](../tests/physics/{name}.lua)**: {about}\n\n| quantity | theory | off by | allowed |\n|---|---|---|---|"
        );
        for check in checks {
            let off = (check.measured - check.expected).abs();
            let _ = writeln!(
                text,
                "| {} | {:.6} | {off:.0e} | {:.0e} |",
                check.what, check.expected, check.tolerance
            );
        }
    }
    text
}
