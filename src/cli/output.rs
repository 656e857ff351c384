//! What a simulator says on a terminal: prints to stdout, the log to stderr.

use std::io::Write;

use crate::{Console, LogLine};

/// Plain text.
pub(super) struct Text {
    /// Leave out what the simulator says about itself.
    pub quiet: bool,
}

impl Console for Text {
    fn print(&mut self, line: &[u8]) {
        let mut out = std::io::stdout().lock();
        // A closed pipe is no reason to stop a simulation.
        let _ = out.write_all(line).and_then(|()| out.write_all(b"\n"));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !(self.quiet && line.chatter) {
            let _ = std::io::stdout().flush();
            let _ = writeln!(std::io::stderr().lock(), "{}", line.decorated());
        }
    }
}
