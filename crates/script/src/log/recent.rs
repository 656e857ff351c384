//! Lines of the log and prints that a viewer or a recorder has not read yet, with the script they come from.

use std::collections::VecDeque;

use super::console::LogLine;
use super::verbosity;

/// Most lines that are kept; the oldest are dropped first.
const MAX_LINES: usize = 10_000;

/// A line of the log, or of a script's `print`.
#[derive(Debug, Clone, PartialEq)]
pub struct RecentLine {
    /// Simulated time, seconds.
    pub time: f64,
    /// `sim.verbosity_*`; None for a print.
    pub level: Option<i64>,
    /// Who wrote it: the path of a script, `sandboxScript` or `CoppeliaSim`.
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
    pub fn level_name(&self) -> &'static str {
        let named = |level: i64| {
            verbosity::NAMES
                .iter()
                .find(|(_, number)| *number == verbosity::plain(level))
        };
        self.level.map_or("print", |level| {
            named(level).map_or("infos", |(name, _)| name)
        })
    }

    /// Whether a script raised an error that nobody caught.
    pub fn is_script_error(&self) -> bool {
        self.level
            .is_some_and(|level| verbosity::plain(level) == verbosity::SCRIPT_ERRORS)
    }
}

/// The last lines; none while nobody reads. A viewer and a recorder may read at the same time.
#[derive(Debug, Default)]
pub(super) struct Recent {
    lines: Option<VecDeque<RecentLine>>,
    /// How many lines there were before those.
    gone: u64,
    /// How many the viewer has taken.
    taken: u64,
}

impl Recent {
    pub(super) fn push(&mut self, line: impl FnOnce() -> RecentLine) {
        let Some(lines) = &mut self.lines else { return };
        if lines.len() == MAX_LINES {
            lines.pop_front();
            self.gone += 1;
        }
        lines.push_back(line());
    }

    /// Begins to keep lines if nobody has read so far.
    pub(super) fn begin(&mut self) {
        self.lines.get_or_insert_default();
    }

    /// The lines since the last call.
    pub(super) fn take(&mut self) -> Vec<RecentLine> {
        let mut taken = self.taken;
        let lines = self.since(&mut taken);
        self.taken = taken;
        lines
    }

    /// The lines after the first `seen` of all, which become all.
    pub(super) fn since(&self, seen: &mut u64) -> Vec<RecentLine> {
        let Some(lines) = &self.lines else {
            return Vec::new();
        };
        let known = usize::try_from(seen.saturating_sub(self.gone))
            .unwrap_or(usize::MAX)
            .min(lines.len());
        *seen = self.gone + lines.len() as u64;
        lines.range(known..).cloned().collect()
    }
}

impl RecentLine {
    pub(super) fn of_log(line: &LogLine<'_>, script: Option<i64>) -> Self {
        let located = line.located.map(|located| {
            LogLine {
                text: located,
                ..*line
            }
            .plain_text()
            .into_owned()
        });
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
