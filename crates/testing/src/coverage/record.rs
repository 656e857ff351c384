//! Counts of the lines of one text.

use std::collections::BTreeMap;

use script::coverage::FunctionLines;

/// A number of a line.
pub type Line = u32;

/// Counts of the lines of a text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FileCoverage {
    /// All lines that can run.
    pub lines: BTreeMap<Line, u64>,
    /// The functions of more than one line.
    pub functions: Vec<FunctionLines>,
}

impl FileCoverage {
    pub(super) fn new(mut functions: Vec<FunctionLines>) -> Self {
        let lines = functions
            .iter()
            .flat_map(|function| &function.lines)
            .map(|&line| (line, 0))
            .collect();
        // For a function in one line it is unknown whether it was called or only created.
        functions.retain(|function| function.line > 0 && function.lines[0] > function.line);
        Self { lines, functions }
    }

    /// Adds counts, that of line 1 first.
    pub(super) fn add(&mut self, counts: &[u64]) {
        for (&line, sum) in &mut self.lines {
            *sum = sum.saturating_add(counts.get(line as usize - 1).copied().unwrap_or_default());
        }
    }

    /// How many lines ran.
    pub fn hit(&self) -> usize {
        self.lines.values().filter(|&&count| count > 0).count()
    }

    /// The count of the first line of a function.
    pub(super) fn calls(&self, function: &FunctionLines) -> u64 {
        function
            .lines
            .first()
            .and_then(|line| self.lines.get(line))
            .copied()
            .unwrap_or_default()
    }

    /// First and last lines of the parts that never ran; lines that cannot run do not divide them.
    pub fn missed(&self) -> Vec<(Line, Line)> {
        let mut missed: Vec<(Line, Line)> = Vec::new();
        let mut goes_on = false;
        for (&line, &count) in &self.lines {
            match missed.last_mut() {
                Some(last) if count == 0 && goes_on => last.1 = line,
                _ if count == 0 => missed.push((line, line)),
                _ => {}
            }
            goes_on = count == 0;
        }
        missed
    }
}

#[cfg(test)]
mod tests {
    use super::FileCoverage;

    #[test]
    fn missed_lines_are_listed_as_ranges() {
        let counts = [(1, 1), (2, 0), (4, 0), (5, 3), (9, 0)];
        let record = FileCoverage {
            lines: counts.into(),
            functions: Vec::new(),
        };
        assert_eq!(record.missed(), [(2, 4), (9, 9)]);
        assert_eq!(record.hit(), 2);
    }

    #[test]
    fn counts_are_summed_over_the_lines_that_can_run() {
        let mut record = FileCoverage {
            lines: [(2, 1), (3, 0)].into(),
            functions: Vec::new(),
        };
        record.add(&[7, 2]);
        assert_eq!(record.lines, [(2, 3), (3, 0)].into());
    }
}
