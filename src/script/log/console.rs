//! Where prints and log lines of a simulator go.

use super::verbosity;

/// One line of the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogLine<'a> {
    /// Who speaks: a script's path, `sandboxScript`, `CoppeliaSim`'s place taken by `Swanilda`, ...
    pub origin: &'a str,
    /// `sim.verbosity_*` with its flag bits.
    pub level: i64,
    pub text: &'a str,
    /// Simulated time, seconds.
    pub time: f64,
    /// The simulator reports its own status, e.g. that the simulation started.
    pub status: bool,
}

impl LogLine<'_> {
    /// The line as it is shown.
    pub fn decorated(&self) -> String {
        if self.level & verbosity::UNDECORATED == verbosity::UNDECORATED {
            return self.text.to_owned();
        }
        format!("[{}:{}]   {}", self.origin, verbosity::word(self.level), self.text)
    }
}

/// Where a script writes with Lua's `io`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stream {
    Output,
    Error,
}

/// Receives what a simulator and its scripts say. Lines below the verbosity asked for do not arrive here.
pub trait Console {
    /// One call of a script's `print`: the line without its end, and the simulated time, seconds.
    fn print(&mut self, line: &[u8], time: f64);

    fn log(&mut self, line: &LogLine<'_>);

    /// What a script wrote to a stream of the process, where scripts have none of their own: parts of lines.
    fn write(&mut self, text: &[u8], stream: Stream, time: f64) {
        let _ = (text, stream, time);
    }
}

/// Swallows everything.
pub struct Silent;

impl Console for Silent {
    fn print(&mut self, _: &[u8], _: f64) {}

    fn log(&mut self, _: &LogLine<'_>) {}
}
