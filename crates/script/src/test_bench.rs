//! Access of a test to its simulator, and its results for the test runner.
//!
//! A bench lies outside of the simulator's memory, which `t.branch` brings back: what tests leave on it stays.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use heap::outside;

use super::coverage::LineCounts;
use super::log::console::{Console, LogLine, OutputStream};
use super::log::verbosity;
use crate::options::Options;
use crate::test_cases::{Signal, TestCases};
use scene::object::script_object::ScriptType;

/// Bytes of the console a test may fill; the rest is counted only.
const CONSOLE_SIZE: usize = 1 << 20;
/// Bytes of a line that a script writes in parts; what is longer becomes several.
const LINE_SIZE: usize = 1 << 16;

/// A line a simulator or its scripts wrote.
#[derive(Debug, Clone, PartialEq)]
pub struct ConsoleLine {
    /// Simulated time, seconds.
    pub time: f64,
    /// Who wrote it; None for a `print`.
    pub origin: Option<String>,
    /// `info`, `error`, ...; `print` for a print and what was written to standard output, `stderr` for what was written there.
    pub level: &'static str,
    /// The line, without its end, in the words of CoppeliaSim.
    pub text: String,
    /// An error as people read it, with files and hints.
    pub located: Option<String>,
}

impl ConsoleLine {
    fn printed(level: &'static str, text: &[u8], time: f64) -> Self {
        let text = String::from_utf8_lossy(text).into_owned();
        Self {
            time,
            origin: None,
            level,
            text,
            located: None,
        }
    }

    /// The line as it is shown.
    pub fn shown(&self) -> String {
        match &self.origin {
            Some(origin) => format!("[{origin}:{}]   {}", self.level, self.text),
            _ => self.text.clone(),
        }
    }
}

/// Named quantities over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trace {
    /// The names of the quantities, without that of time.
    pub columns: Vec<String>,
    /// Time, then a value for each column.
    pub rows: Vec<Vec<f64>>,
}

/// Tolerances of the comparison with a recorded trace.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerances {
    /// Deviation that is allowed for every value, in the unit of its column.
    pub absolute: f64,
    /// Deviation that is allowed as a share of the expected value; the larger of the two counts.
    pub relative: f64,
    /// Absolute tolerances of single columns.
    pub columns: BTreeMap<String, f64>,
    /// Maximum shift of the whole trace in time, seconds.
    pub time: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            absolute: 1e-6,
            relative: 1e-4,
            columns: BTreeMap::new(),
            time: 0.0,
        }
    }
}

/// A picture, and how much it may differ from a recorded one.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Width and height, pixels.
    pub resolution: [u32; 2],
    /// Red, green, blue of each pixel, the top row first.
    pub pixels: Vec<u8>,
    /// How far a colour may be off, of 255.
    pub tolerance: u8,
    /// Which share of the pixels may be off by more.
    pub share: f64,
}

/// Something to compare with what was recorded under that name.
#[derive(Debug, Clone, PartialEq)]
pub struct Golden {
    /// The name under which it was recorded, without the ending of a file.
    pub name: String,
    /// What is compared.
    pub content: GoldenContent,
}

/// Content of a recording.
#[derive(Debug, Clone, PartialEq)]
pub enum GoldenContent {
    /// Quantities over time, and how much they may deviate.
    Trace {
        /// The quantities.
        trace: Trace,
        /// How much they may deviate from the recording.
        tolerances: Tolerances,
    },
    /// A picture.
    Image(Snapshot),
}

/// A scene to run in a separate simulator.
#[derive(Debug, Clone, PartialEq)]
pub struct RunRequest {
    /// A Lua file, one of CoppeliaSim, or an unpacked one.
    pub scene: PathBuf,
    /// Type of the script.
    pub kind: ScriptType,
    /// From nothing instead of the default scene.
    pub empty: bool,
    /// Whether the simulation is started from outside.
    pub start: bool,
    /// Loop iterations without a start, and of a paused simulation.
    pub loops: u64,
    /// Limit of simulation steps.
    pub steps: Option<u64>,
    /// Limit of simulated time, seconds.
    pub time: Option<f64>,
    /// Simulated seconds after which it has failed.
    pub time_limit: f64,
}

/// The result of such a run.
#[derive(Debug, Clone, Default)]
pub struct RunReport {
    /// The output of the simulator and its scripts.
    pub lines: Vec<ConsoleLine>,
    /// Uncaught script errors.
    pub errors: u64,
    /// Simulation steps.
    pub steps: u64,
    /// Simulated seconds.
    pub time: f64,
    /// The named parameters at its end.
    pub params: BTreeMap<String, String>,
    /// The names of parameters that scripts have read.
    pub params_read: BTreeSet<String>,
    /// How often lines of scripts ran; empty unless the options ask for that.
    pub line_counts: LineCounts,
}

/// Runs a scene in a simulator with these options; why it could not, otherwise.
pub type RunApart = fn(Options, &RunRequest) -> Result<RunReport, String>;

/// Levels of the lines of streams, in the order of `OutputStream`.
const LEVELS: [&str; 2] = ["print", "stderr"];

/// What a language has made of the text of a file, which other simulators can load; only the language knows what it is.
pub type CompiledFile = Arc<dyn Any + Send + Sync>;

/// The link between a test's script and its runner.
#[derive(Debug, Default)]
pub struct TestBench {
    /// The test's file, as the user named it.
    pub file: String,
    /// Simulated seconds a test may take.
    pub time_limit: f64,
    /// Runs scenes that the test requests.
    pub run_apart: Option<RunApart>,
    /// The test's file, once a simulator has compiled it.
    pub compiled: RefCell<Option<CompiledFile>>,
    /// The cases of the property that is tested.
    pub cases: RefCell<Option<Rc<TestCases>>>,
    goldens: RefCell<Vec<Golden>>,
    signals: RefCell<Vec<Signal>>,
    lines: RefCell<Vec<ConsoleLine>>,
    /// Lines of standard output and error that have no end so far.
    unfinished: [RefCell<Vec<u8>>; 2],
    /// Position of the Lua code when it was stopped.
    interruption: RefCell<Option<String>>,
    size: Cell<usize>,
    lost: Cell<usize>,
}

impl TestBench {
    /// A bench for the tests of `file`, each of which may simulate for `time_limit` seconds.
    pub fn new(file: String, time_limit: f64, run_apart: Option<RunApart>) -> Rc<Self> {
        Rc::new(Self {
            file,
            time_limit,
            run_apart,
            ..Self::default()
        })
    }

    /// A console that writes onto the bench.
    pub fn console(self: &Rc<Self>) -> Box<dyn Console> {
        Box::new(Recorder(Rc::clone(self)))
    }

    /// The output from line number `first` on.
    pub fn lines_from(&self, first: usize) -> Vec<ConsoleLine> {
        self.lines
            .borrow()
            .get(first..)
            .unwrap_or_default()
            .to_vec()
    }

    /// Lines that have no end so far.
    pub fn unfinished(&self, time: f64) -> Vec<ConsoleLine> {
        let texts = self
            .unfinished
            .iter()
            .map(|text| text.borrow().clone())
            .zip(LEVELS);
        let begun = texts.filter(|(text, _)| !text.is_empty());
        begun
            .map(|(text, level)| ConsoleLine::printed(level, &text, time))
            .collect()
    }

    /// Leaves something to be compared with what was recorded.
    pub fn add_golden(&self, golden: &Golden) {
        outside(|| self.goldens.borrow_mut().push(golden.clone()));
    }

    /// Hands over what the test compares with recordings.
    pub fn take_goldens(&self) -> Vec<Golden> {
        self.goldens.take()
    }

    /// Leaves what was sampled of a temporal property.
    pub fn add_signal(&self, signal: &Signal) {
        outside(|| self.signals.borrow_mut().push(signal.clone()));
    }

    /// Hands over what was sampled of temporal properties.
    pub fn take_signals(&self) -> Vec<Signal> {
        self.signals.take()
    }

    /// Lua code was stopped; the first time counts, since code that catches the error is stopped again.
    pub(crate) fn note_interruption(&self, trace: impl FnOnce() -> String) {
        let mut interruption = self.interruption.borrow_mut();
        if interruption.is_none() {
            let trace = trace();
            *interruption = outside(|| Some(trace.clone()));
        }
    }

    /// Lua's traceback when it was stopped.
    pub fn take_interruption(&self) -> Option<String> {
        self.interruption.take()
    }

    /// Forgets the lines after the first `count`: those of a case that is undone.
    pub fn truncate_lines(&self, count: usize) {
        let mut lines = self.lines.borrow_mut();
        lines.truncate(count);
        let sizes = lines
            .iter()
            .map(|line| line.text.len() + size_of::<ConsoleLine>());
        self.size.set(sizes.sum());
        self.lost.set(0);
        for text in &self.unfinished {
            text.borrow_mut().clear();
        }
    }

    /// How many lines there are.
    pub fn line_count(&self) -> usize {
        self.lines.borrow().len()
    }

    /// Hands the console over, with a last line that counts what did not fit.
    pub fn take_lines(&self) -> Vec<ConsoleLine> {
        let time = self.lines.borrow().last().map_or(0.0, |line| line.time);
        self.unfinished(time)
            .into_iter()
            .for_each(|line| self.write(line));
        self.unfinished
            .iter()
            .for_each(|text| text.borrow_mut().clear());
        let mut lines = self.lines.take();
        self.size.set(0);
        let lost = self.lost.take();
        if lost > 0 {
            let plural = if lost == 1 { "" } else { "s" };
            let text = format!("{lost} more line{plural}: a test may write {CONSOLE_SIZE} bytes.");
            lines.push(ConsoleLine {
                time,
                origin: None,
                level: "warning",
                text,
                located: None,
            });
        }
        lines
    }

    /// Parts of lines, or a whole one with its end.
    fn write_parts(&self, mut text: &[u8], stream: OutputStream, time: f64) {
        let mut unfinished = self.unfinished[stream as usize].borrow_mut();
        while let Some(end) = text.iter().position(|&byte| byte == b'\n') {
            unfinished.extend_from_slice(&text[..end]);
            self.write(ConsoleLine::printed(
                LEVELS[stream as usize],
                &std::mem::take(&mut *unfinished),
                time,
            ));
            text = &text[end + 1..];
        }
        for part in text.chunks(LINE_SIZE) {
            if unfinished.len() + part.len() > LINE_SIZE {
                self.write(ConsoleLine::printed(
                    LEVELS[stream as usize],
                    &std::mem::take(&mut *unfinished),
                    time,
                ));
            }
            unfinished.extend_from_slice(part);
        }
    }

    fn write(&self, line: ConsoleLine) {
        let size = self
            .size
            .get()
            .saturating_add(line.text.len() + size_of::<ConsoleLine>());
        if size > CONSOLE_SIZE {
            return self.lost.set(self.lost.get() + 1);
        }
        self.size.set(size);
        self.lines.borrow_mut().push(line);
    }
}

/// Captures output, except the simulator's messages about its own state.
struct Recorder(Rc<TestBench>);

impl Console for Recorder {
    fn print(&mut self, line: &[u8], time: f64) {
        if self.0.unfinished[OutputStream::Output as usize]
            .borrow()
            .is_empty()
        {
            return self.0.write(ConsoleLine::printed(
                LEVELS[OutputStream::Output as usize],
                line,
                time,
            ));
        }
        self.write(&[line, b"\n"].concat(), OutputStream::Output, time);
    }

    fn write(&mut self, text: &[u8], stream: OutputStream, time: f64) {
        self.0.write_parts(text, stream, time);
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !line.status {
            self.0.write(ConsoleLine {
                time: line.time,
                origin: Some(line.origin.to_owned()),
                level: verbosity::name(line.level),
                text: line.plain_text().into_owned(),
                located: line.located.map(str::to_owned),
            });
        }
    }
}
