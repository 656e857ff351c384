//! One text in one state: how often its lines ran, and which of its functions have nothing new to run.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use super::{Counts, Function};

/// Lines beyond which nothing is counted: Lua code can name any line.
const MAX_LINE: usize = 1 << 20;
/// Files that are larger are no programs.
const MAX_FILE: u64 = 16 << 20;

/// The text of a Lua file; None when that is no readable file of sensible size.
pub fn read_text(path: &Path) -> Option<Vec<u8>> {
    // Lua code can name anything, such as a device that never ends.
    let is_file = std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() <= MAX_FILE);
    if is_file { std::fs::read(path).ok() } else { None }
}

/// The counts of a text.
pub(super) struct Text {
    pub chunk_name: Box<[u8]>,
    pub counts: Counts,
    /// The lines each function has not run so far.
    missing: Vec<BTreeSet<u32>>,
    /// The functions by the lines they begin at.
    by_line: HashMap<u32, u32>,
}

/// A function that is not among those of its text; it is never complete.
const UNKNOWN: u32 = u32::MAX;

impl Text {
    pub(super) fn new(chunk_name: &[u8], functions: Vec<Function>) -> Self {
        let mut text =
            Self { chunk_name: chunk_name.into(), counts: Vec::new(), missing: Vec::new(), by_line: HashMap::new() };
        for function in functions {
            let next = text.missing.len() as u32;
            let index = *text.by_line.entry(function.line).or_insert(next);
            if index == next {
                text.missing.push(BTreeSet::new());
            }
            // Functions that begin in one line count as one.
            text.missing[index as usize].extend(function.lines);
        }
        text
    }

    /// The number of the function that begins at that line.
    pub(super) fn function_at(&self, line: u32) -> u32 {
        self.by_line.get(&line).copied().unwrap_or(UNKNOWN)
    }

    /// Whether all lines of a function have run.
    pub(super) fn is_complete(&self, function: u32) -> bool {
        self.missing.get(function as usize).is_some_and(BTreeSet::is_empty)
    }

    /// A line runs.
    pub(super) fn count(&mut self, line: i32) {
        let index = (line as usize).wrapping_sub(1);
        match self.counts.get_mut(index) {
            Some(count) if *count > 0 => *count += 1,
            _ => self.count_first(index),
        }
    }

    #[cold]
    fn count_first(&mut self, index: usize) {
        if index >= MAX_LINE {
            return;
        }
        if self.counts.len() <= index {
            self.counts.resize(index + 1, 0);
        }
        self.counts[index] = 1;
        let line = index as u32 + 1;
        for missing in &mut self.missing {
            missing.remove(&line);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::executable;
    use super::Text;

    #[test]
    fn a_function_is_complete_when_all_its_lines_have_run() {
        let functions = executable(b"function f(x)\n  if x then\n    x = 1\n  end\nend\n").expect("it compiles");
        let mut text = Text::new(b"@a", functions);
        let (main, f) = (text.function_at(0), text.function_at(1));
        text.count(1);
        text.count(2);
        assert!(text.is_complete(main) && !text.is_complete(f) && !text.is_complete(text.function_at(2)));
        text.count(3);
        assert!(text.is_complete(f));
        assert_eq!(text.counts, [1, 1, 1]);
        text.count(i32::MAX);
        text.count(-1);
        text.count(0);
        assert_eq!(text.counts, [1, 1, 1]);
    }
}
