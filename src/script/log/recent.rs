//! Lines of the log and prints that a viewer or a recorder has not read yet, with the script they come from.

use std::collections::VecDeque;

use super::console::LogLine;
use super::verbosity;

/// Lines that wait at most; the oldest go first.
const MOST: usize = 10_000;

/// A line of the log, or of a script's `print`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RecentLine {
    /// Simulated time, seconds.
    pub time: f64,
    /// `sim.verbosity_*`; None for a print.
    pub level: Option<i64>,
    pub origin: String,
    /// The handle of the script.
    pub script: Option<i64>,
    /// In the words of CoppeliaSim.
    pub text: String,
    /// An error as people read it, with files and hints.
    pub located: Option<String>,
}

impl RecentLine {
    /// The name of its level as on the command line, or `print`.
    pub(crate) fn level_name(&self) -> &'static str {
        let named = |level: i64| verbosity::NAMES.iter().find(|(_, number)| *number == verbosity::plain(level));
        self.level.map_or("print", |level| named(level).map_or("infos", |(name, _)| name))
    }

    /// Whether a script raised an error that nobody caught.
    pub(crate) fn is_script_error(&self) -> bool {
        self.level.is_some_and(|level| verbosity::plain(level) == verbosity::SCRIPT_ERRORS)
    }
}

/// Lines that wait to be read; none while nobody reads.
#[derive(Debug, Default)]
pub(super) struct Recent(Option<VecDeque<RecentLine>>);

impl Recent {
    pub(super) fn push(&mut self, line: impl FnOnce() -> RecentLine) {
        let Some(lines) = &mut self.0 else { return };
        if lines.len() == MOST {
            lines.pop_front();
        }
        lines.push_back(line());
    }

    /// Begins to keep lines if nobody has read so far.
    pub(super) fn begin(&mut self) {
        self.0.get_or_insert_default();
    }

    /// The lines since the last call.
    pub(super) fn take(&mut self) -> Vec<RecentLine> {
        self.0.as_mut().map(|lines| lines.drain(..).collect()).unwrap_or_default()
    }
}

impl RecentLine {
    pub(super) fn of_log(line: &LogLine<'_>, script: Option<i64>) -> Self {
        let located = line.located.map(|located| LogLine { text: located, ..*line }.plain_text().into_owned());
        Self {
            time: line.time,
            level: Some(line.level),
            origin: line.origin.to_owned(),
            script,
            text: line.plain_text().into_owned(),
            located,
        }
    }
}
