//! One simulator with a test file in it.

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::Config;
use super::apart::run_apart;
use super::captures::TestCapture;
use super::case::{Outcome, Status, TestCase};
use super::excerpt::{Excerpt, positions};
use super::plan::{Collection, Found};
use super::property::PropertyOptions;
use super::recording::TestRecording;
use scene::Data;
use script::TestBench;
use script::coverage::LineCounts;
use script::test_bench::CompiledFile;
use script::test_cases::{CaseSource, Note, TestCases};
use search::Value;
use simulator::{Limits, Options, ScriptKind, ScriptRef, Simulator, Tape};

/// A simulator that has loaded a test file.
pub(super) struct Session {
    sim: Simulator,
    sandbox: ScriptRef,
    bench: Rc<TestBench>,
    /// Folder of recordings of failed tests.
    recordings: Option<PathBuf>,
    /// What is captured of the simulator; completed after it.
    capture: Option<TestCapture>,
    /// Folder of persistent data of scripts; it is removed after the simulator.
    _data: Option<tempfile::TempDir>,
}

impl Session {
    /// A fresh simulator for the tests of `file`, to which everything comes from outside by the tape. Setting `stop` ends whatever runs in it.
    pub(super) fn new(
        config: &Config,
        file: &Path,
        seed: u32,
        stop: Arc<AtomicBool>,
        tape: &Tape,
    ) -> Self {
        Self::with_lines(config, file, seed, stop, tape, config.coverage.is_some())
    }

    /// The same, which counts the lines of scripts if asked to.
    pub(super) fn with_lines(
        config: &Config,
        file: &Path,
        seed: u32,
        stop: Arc<AtomicBool>,
        tape: &Tape,
        count_lines: bool,
    ) -> Self {
        let name = file.to_string_lossy().into_owned();
        let bench = TestBench::new(name, config.allowance.simulated, Some(run_apart));
        let folder = file
            .parent()
            .filter(|folder| *folder != Path::new(""))
            .unwrap_or(Path::new("."));
        // Without a folder of their own, tests share that of the user.
        let data = tempfile::tempdir().ok();
        let options = Options {
            seed,
            stop,
            threads: config.threads,
            limits: Some(Limits {
                memory: config.allowance.memory,
            }),
            count_lines,
            package_dirs: vec![folder.to_owned()],
            // The file itself is read by Lua.
            permissions: config.permissions_in(folder).allow_read(file).on_tape(tape),
            resources: config.resources.clone(),
            data_dir: data.as_ref().map(|data| data.path().to_owned()),
            ..Options::default()
        };
        let mut sim = Simulator::for_test(options, &bench);
        let sandbox = sim.add_script(ScriptKind::Sandbox, "swanilda test", b"require('busted')");
        let sandbox = sandbox.expect("the embedded library loads");
        Self {
            sim,
            sandbox,
            bench,
            recordings: config.record_failures.clone(),
            capture: None,
            _data: data,
        }
    }

    /// The same for those tests; a failed one is captured where that is asked for, with the choices of the case that it runs. The outcome of
    /// a test when that cannot be.
    pub(super) fn of_tests(
        config: &Config,
        tests: &[Arc<TestCase>],
        choices: Option<&[Value]>,
        stop: Arc<AtomicBool>,
    ) -> Result<Self, Box<Outcome>> {
        let (file, seed) = (&tests[0].file, tests[0].seed);
        let Some(captures) = &config.captures else {
            return Ok(Self::new(config, file, seed, stop, &Tape::default()));
        };
        let capture = TestCapture::start(captures, file, tests, choices).map_err(|error| {
            let message = format!("the test cannot be captured: {error}");
            Box::new(Outcome::new(Arc::clone(&tests[0]), Status::Error, message))
        })?;
        let session = Self::new(config, file, seed, stop, capture.tape());
        Ok(Self {
            capture: Some(capture),
            ..session
        })
    }

    /// The property that is run next has these cases.
    pub(super) fn take_cases_from(&mut self, source: CaseSource) {
        self.bench
            .cases
            .replace(Some(Rc::new(TestCases::new(source))));
    }

    /// What its last case has noted, and the lines that ran in its cases. It has no more.
    pub(super) fn end_cases(&mut self) -> (Vec<Note>, LineCounts) {
        let cases = self.bench.cases.take();
        let ended = cases.map(|cases| (cases.notes(), cases.take_line_counts()));
        ended.unwrap_or_default()
    }

    /// Whether a file that was compiled before may be loaded: a capture has the text.
    pub(super) fn takes_compiled(&self) -> bool {
        self.capture.is_none()
    }

    /// Loads the file and returns its tests.
    pub(super) fn collect(&mut self, file: &Path) -> Collection {
        let name = Data::text(&file.to_string_lossy());
        let answer = self.call("package.loaded.busted.collect", &[name]);
        let mut collection = Collection::new(file);
        match (
            &answer,
            answer.as_ref().and_then(|answer| answer.field("tests")),
        ) {
            (Some(answer), Some(Data::Array(tests))) => {
                collection.tests = tests.iter().map(found).collect();
                collection.simulates = answer.field("simulates").is_some_and(Data::truthy);
            }
            _ => collection.broken = Some(self.broken(file, answer.as_ref())),
        }
        collection.compiled = self.bench.compiled.take();
        collection
    }

    /// Loads the file to run tests of it: all, or only the one with that number. Its outcome when that fails.
    pub(super) fn load(
        &mut self,
        file: &Path,
        compiled: Option<CompiledFile>,
        number: Option<usize>,
    ) -> Result<(), Box<Outcome>> {
        self.bench.compiled.replace(compiled);
        let number = number.map_or(Data::Nil, |number| Data::Int(number as i64));
        let answer = self.call(
            "package.loaded.busted.load",
            &[Data::text(&file.to_string_lossy()), number],
        );
        match &answer {
            Some(answer) if answer.field("error").is_none() => Ok(()),
            answer => Err(Box::new(self.broken(file, answer.as_ref()))),
        }
    }

    fn broken(&self, file: &Path, answer: Option<&Data>) -> Outcome {
        let test = Arc::new(TestCase::of_file(file));
        let mut outcome = Outcome::new(test, Status::Error, "the file could not be loaded.");
        if let Some(error) = answer.and_then(|answer| answer.field("error")) {
            self.explain(&mut outcome, error);
        }
        outcome.console = self.bench.take_lines();
        outcome
    }

    /// Runs a test of the file, which has been collected.
    pub(super) fn run(&mut self, test: &Arc<TestCase>) -> Outcome {
        let Some(folder) = self.recordings.clone() else {
            return self.run_unrecorded(test);
        };
        let recording = match TestRecording::start(&self.sim) {
            Ok(recording) => recording,
            Err(error) => {
                let message = format!("the test cannot be recorded: {error}");
                return Outcome::new(Arc::clone(test), Status::Error, message);
            }
        };
        let mut outcome = self.run_unrecorded(test);
        recording.finish(&self.sim, &mut outcome, &folder);
        outcome
    }

    /// Says in the outcome of a failed test where its capture is.
    pub(super) fn note_capture(&mut self, outcome: &mut Outcome) {
        if let Some(capture) = &mut self.capture {
            capture.note(outcome);
        }
    }

    fn run_unrecorded(&mut self, test: &Arc<TestCase>) -> Outcome {
        let answer = self.call("package.loaded.busted.run", &[Data::Int(test.index as i64)]);
        let mut outcome = Outcome::new(
            Arc::clone(test),
            Status::Error,
            "the test could not be run to its end.",
        );
        if let Some(answer) = answer {
            outcome.status = status(&answer);
            outcome.message.clear();
            self.explain(&mut outcome, &answer);
        } else if let Some(line) = self
            .bench
            .lines_from(0)
            .iter()
            .rev()
            .find(|line| line.level == "error")
        {
            outcome.message.clone_from(&line.text);
        }
        (outcome.time, outcome.steps) = (self.sim.time(), self.sim.steps());
        outcome.goldens = self.bench.take_goldens();
        outcome.signals = self.bench.take_signals();
        outcome.console = self.bench.take_lines();
        self.explain_interruption(&mut outcome);
        outcome
    }

    /// A test that had to be stopped: where it was, as far as that is in its file or in a script of the scene.
    fn explain_interruption(&self, outcome: &mut Outcome) {
        let Some(trace) = self.bench.take_interruption() else {
            return;
        };
        outcome
            .console
            .retain(|line| !(line.level == "error" && line.text.starts_with("interrupted.")));
        let own = format!("{}:", self.bench.file);
        let is_known = |frame: &&str| {
            let shown = positions(frame);
            frame.starts_with(&own)
                || shown
                    .iter()
                    .any(|(name, _)| self.sim.source_shown_as(name).is_some())
        };
        let frames = || trace.lines().map(str::trim);
        outcome.line =
            frames().find_map(|frame| frame.strip_prefix(&own)?.split(':').next()?.parse().ok());
        outcome.message = frames().find(is_known).unwrap_or_default().to_owned();
        outcome.stopped_at = Some(outcome.message.clone()).filter(|place| !place.is_empty());
        outcome.excerpts.clear();
        self.quote(outcome);
        outcome.trace = trace;
    }

    /// Runs what is left to tear down after the last test, which fails when that does.
    pub(super) fn finish(&mut self, last: &mut Outcome) {
        let Some(answer) = self.call("package.loaded.busted.finish", &[]) else {
            return;
        };
        if status(&answer) != Status::Passed && !last.is_bad() {
            last.status = status(&answer);
            self.explain(last, &answer);
        }
    }

    fn explain(&self, outcome: &mut Outcome, answer: &Data) {
        outcome.message = text(answer, "message");
        outcome.todo = answer.field("todo").is_some_and(Data::truthy);
        outcome.trace = text(answer, "trace");
        outcome.line = line(answer);
        outcome.script = answer.field("script").map(as_text);
        if outcome.is_bad() {
            self.quote(outcome);
        }
    }

    /// Adds the source the outcome speaks of, as it is now.
    fn quote(&self, outcome: &mut Outcome) {
        for (name, line) in positions(&outcome.message) {
            let Some((script, code)) = self.sim.source_shown_as(name) else {
                continue;
            };
            outcome.excerpts.extend(Excerpt::of(&script, &code, line));
            outcome.script.get_or_insert(script);
        }
        if let (Some(line), Ok(source)) = (outcome.line, std::fs::read(&outcome.test.file)) {
            outcome
                .excerpts
                .extend(Excerpt::of(&self.bench.file, &source, line));
        }
    }

    /// Hands over the lines that ran since the last time.
    pub(super) fn take_line_counts(&mut self, outcome: &mut Outcome) {
        outcome.line_counts = self.sim.take_line_counts();
    }

    fn call(&mut self, function: &str, args: &[Data]) -> Option<Data> {
        self.sim
            .call(&self.sandbox, function, args)
            .ok()?
            .into_iter()
            .next()
    }
}

fn found(test: &Data) -> Found {
    let names = match test.field("name") {
        Some(Data::Array(names)) => names.iter().map(as_text).collect(),
        _ => Vec::new(),
    };
    Found {
        name: names,
        line: line(test),
        property: test.field("property").map(property),
    }
}

fn property(options: &Data) -> PropertyOptions {
    let count = |name: &str| match options.field(name) {
        Some(Data::Int(count)) => usize::try_from(*count).ok(),
        Some(Data::Float(count)) => Some(*count as usize),
        _ => None,
    };
    PropertyOptions {
        cases: count("cases"),
        shrinks: count("shrinks"),
        is_fresh: options.field("fresh").is_some_and(Data::truthy),
    }
}

fn status(answer: &Data) -> Status {
    match text(answer, "status").as_str() {
        "passed" => Status::Passed,
        "failed" => Status::Failed,
        "pending" => Status::Pending,
        _ => Status::Error,
    }
}

fn text(answer: &Data, field: &str) -> String {
    answer.field(field).map(as_text).unwrap_or_default()
}

fn as_text(data: &Data) -> String {
    if let Data::Text(bytes) = data {
        String::from_utf8_lossy(bytes).into_owned()
    } else {
        String::new()
    }
}

fn line(answer: &Data) -> Option<u32> {
    if let Some(Data::Int(line)) = answer.field("line") {
        u32::try_from(*line).ok()
    } else {
        None
    }
}
