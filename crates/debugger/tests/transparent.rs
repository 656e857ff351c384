//! Code does the same with all its traps armed as without a debugger: cases of the conformance suite run twice and print the same.
//!
//! A piece of bytecode that does not do what the instruction in its place does, or a variable that is lost, shows here.

#![allow(clippy::disallowed_methods, reason = "ALL chooses the cases to run")]

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use script::{Armed, Debugger, LoadedText, Place, Script, Sim};
use simulator::{Console, LogLine, Options, ScriptKind, Simulator};
use test_support::parallel;

/// Every so many cases are run; all with `ALL` set.
const STRIDE: usize = 6;
/// Cases that print addresses, or the names that Lua finds in the code of a line for its errors: a trap takes the place of the instruction
/// by which it would find the name of what the line uses first.
const DIFFERENT: &[&str] = &[
    "x-errors-in-callbacks",
    "x-executescriptstring",
    "module-helpers",
];

/// Arms every trap, reads the variables, and goes on.
#[derive(Default)]
struct Inspector {
    lines: Cell<u64>,
}

impl Debugger for Inspector {
    fn text_loaded(&self, _: &Rc<Sim>, script: &Rc<Script>, _: &Rc<LoadedText>) {
        if let Some(runtime) = script.current_runtime()
            && let Some(debuggee) = runtime.interpreter.debuggee()
        {
            debuggee.arm(&|_| Armed::All);
        }
    }

    fn line_reached(&self, _: &Rc<Sim>, place: &Place<'_>) {
        self.lines.set(self.lines.get() + 1);
        assert!(place.text.lines.contains(&place.line));
        let runtime = place.script.current_runtime();
        let runtime =
            runtime.filter(|_| self.lines.get() < 5000 && self.lines.get().is_multiple_of(97));
        if let Some(debuggee) = runtime
            .as_ref()
            .and_then(|runtime| runtime.interpreter.debuggee())
        {
            for frame in debuggee.frames(3) {
                debuggee.variables(script::Container::Locals(frame.id), script::Page::default());
                assert!(debuggee.evaluate(Some(frame.id), "1 + 1").is_ok());
            }
            debuggee.forget_values();
        }
    }

    fn error_raised(&self, _: &Rc<Sim>, _: &Rc<Script>, _: &str, _: bool) {}

    fn scene_changed(&self, _: &Rc<Sim>, _: Option<&Rc<Script>>) {}

    fn answer_requests(&self, _: &Rc<Sim>, _: Option<&Rc<Script>>) -> bool {
        false
    }
}

#[derive(Clone, Default)]
struct Output(Rc<RefCell<String>>);

impl Console for Output {
    fn print(&mut self, line: &[u8], _: f64) {
        self.0.borrow_mut().push_str(&String::from_utf8_lossy(line));
        self.0.borrow_mut().push('\n');
    }

    fn log(&mut self, line: &LogLine<'_>) {
        self.0.borrow_mut().push_str(&line.original());
        self.0.borrow_mut().push('\n');
    }
}

fn cases() -> Vec<PathBuf> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/conformance")];
    let mut cases = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder)
            .expect("the cases are there")
            .flatten()
        {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "lua") {
                cases.push(path);
            }
        }
    }
    cases.sort();
    cases
}

/// What a case prints, and how many lines traps have seen.
fn run(case: &Path, debugger: Option<Rc<Inspector>>) -> String {
    let text = std::fs::read_to_string(case).unwrap_or_default();
    let header = |key: &str| {
        let start = format!("-- {key}: ");
        text.lines()
            .find_map(|line| line.strip_prefix(&start))
            .map(str::trim)
    };
    let kind = match header("as") {
        Some("simulation") => ScriptKind::Simulation,
        Some("customization") => ScriptKind::Customization,
        Some("addon") => ScriptKind::AddOn,
        Some("main") => ScriptKind::Main,
        _ => ScriptKind::Sandbox,
    };
    let output = Output::default();
    let data = tempfile::tempdir().expect("a temporary folder");
    let options = Options {
        data_dir: Some(data.path().to_owned()),
        original_errors: true,
        package_dirs: vec![Simulator::folder_of_scene(case)],
        ..Options::default()
    };
    let mut builder = Simulator::builder()
        .options(options)
        .console(Box::new(output.clone()));
    if let Some(debugger) = debugger {
        builder = builder.debugger(debugger);
    }
    let mut sim = builder.build();
    let _ = sim.add_script_of_file(kind, "Script", text.as_bytes(), Some(case));
    let passes = header("passes")
        .and_then(|passes| passes.parse().ok())
        .unwrap_or(0);
    let loops: u64 = header("loops")
        .and_then(|loops| loops.parse().ok())
        .unwrap_or(20);
    match passes {
        0 => (0..loops).for_each(|_| sim.iterate()),
        passes => {
            sim.step(passes);
            sim.stop();
        }
    }
    drop(sim);
    output.0.take()
}

/// How the outputs differ; None where they are the same.
fn difference(case: &Path) -> Option<String> {
    let case = case.to_owned();
    let thread = std::thread::Builder::new().stack_size(Simulator::STACK_SIZE);
    let compare = move || {
        let inspector = Rc::<Inspector>::default();
        let (plain, watched) = (run(&case, None), run(&case, Some(Rc::clone(&inspector))));
        if inspector.lines.get() == 0 {
            return Some(format!("{}: no trap was reached", case.display()));
        }
        let differ = plain.lines().zip(watched.lines()).find(|(a, b)| a != b);
        (plain != watched).then(|| format!("{}: {differ:?}", case.display()))
    };
    let thread = thread.spawn(compare).expect("there can be one more thread");
    thread.join().unwrap_or_else(|_| Some("it panics".into()))
}

#[test]
fn all_traps_armed_change_nothing() {
    let is_chosen = |i: usize| std::env::var_os("ALL").is_some() || i.is_multiple_of(STRIDE);
    let is_alike = |case: &PathBuf| {
        !DIFFERENT
            .iter()
            .any(|name| case.to_string_lossy().contains(name))
    };
    let cases = cases().into_iter().enumerate();
    let chosen = cases.filter(|(i, case)| is_chosen(*i) && is_alike(case));
    let chosen: Vec<PathBuf> = chosen.map(|(_, case)| case).collect();
    let differences = parallel::map(&chosen, |case| difference(case));
    let differences: Vec<String> = differences.into_iter().flatten().collect();
    assert!(
        differences.is_empty(),
        "{} of {}:\n{}",
        differences.len(),
        chosen.len(),
        differences.join("\n")
    );
}
