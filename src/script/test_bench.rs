//! What a test sees of the simulator it runs in, and what it leaves for the one who runs it.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::console::{Console, LogLine};
use super::verbosity;

/// Bytes of the console a test may fill; the rest is counted only.
const CONSOLE_SIZE: usize = 1 << 20;

/// A line a simulator or its scripts wrote.
#[derive(Debug, Clone, PartialEq)]
pub struct ConsoleLine {
    /// Simulated time, seconds.
    pub time: f64,
    /// Who wrote it; None for a `print`.
    pub origin: Option<String>,
    /// `info`, `error`, ...; `print` for a print.
    pub level: &'static str,
    pub text: String,
}

/// Named quantities over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trace {
    pub columns: Vec<String>,
    /// Time, then a value for each column.
    pub rows: Vec<Vec<f64>>,
}

/// How far a trace may be from the recorded one.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerances {
    pub absolute: f64,
    /// Share of the expected value.
    pub relative: f64,
    /// Absolute tolerances of single columns.
    pub columns: BTreeMap<String, f64>,
    /// How much earlier or later all of it may happen, seconds.
    pub time: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { absolute: 1e-6, relative: 1e-4, columns: BTreeMap::new(), time: 0.0 }
    }
}

/// A trace a test wants to be compared with the one recorded under that name.
#[derive(Debug, Clone, PartialEq)]
pub struct Golden {
    pub name: String,
    pub trace: Trace,
    pub tolerances: Tolerances,
}

/// The link between a test's script and its runner.
#[derive(Debug, Default)]
pub struct TestBench {
    /// The test's file, as the user named it.
    pub file: String,
    /// Simulated seconds a test may take.
    pub time_limit: f64,
    pub goldens: RefCell<Vec<Golden>>,
    lines: RefCell<Vec<ConsoleLine>>,
    size: Cell<usize>,
    lost: Cell<usize>,
}

impl TestBench {
    /// A bench for the tests of `file`, each of which may simulate for `time_limit` seconds.
    pub fn new(file: String, time_limit: f64) -> Rc<Self> {
        Rc::new(Self { file, time_limit, ..Self::default() })
    }

    /// A console that writes onto the bench.
    pub fn console(self: &Rc<Self>) -> Box<dyn Console> {
        Box::new(Recorder(Rc::clone(self)))
    }

    /// What has been written from line number `first` on.
    pub fn lines_from(&self, first: usize) -> Vec<ConsoleLine> {
        self.lines.borrow().get(first..).unwrap_or_default().to_vec()
    }

    pub fn line_count(&self) -> usize {
        self.lines.borrow().len()
    }

    /// Hands the console over, with a last line that tells what did not fit.
    pub fn take_lines(&self) -> Vec<ConsoleLine> {
        let mut lines = self.lines.take();
        self.size.set(0);
        let lost = self.lost.take();
        if lost > 0 {
            let time = lines.last().map_or(0.0, |line| line.time);
            let text = format!("{lost} more lines: a test may write {CONSOLE_SIZE} bytes.");
            lines.push(ConsoleLine { time, origin: None, level: "warning", text });
        }
        lines
    }

    fn write(&self, line: ConsoleLine) {
        let size = self.size.get().saturating_add(line.text.len() + size_of::<ConsoleLine>());
        if size > CONSOLE_SIZE {
            return self.lost.set(self.lost.get() + 1);
        }
        self.size.set(size);
        self.lines.borrow_mut().push(line);
    }
}

/// Keeps what the simulator says; the simulator's talk about itself is left out.
struct Recorder(Rc<TestBench>);

impl Console for Recorder {
    fn print(&mut self, line: &[u8], time: f64) {
        let text = String::from_utf8_lossy(line).into_owned();
        self.0.write(ConsoleLine { time, origin: None, level: "print", text });
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !line.chatter {
            self.0.write(ConsoleLine {
                time: line.time,
                origin: Some(line.origin.to_owned()),
                level: verbosity::word(line.level),
                text: line.text.to_owned(),
            });
        }
    }
}
