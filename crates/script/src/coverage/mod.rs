//! Line coverage of scripts.
//!
//! A state counts the lines of its script's own text and of Lua files that were loaded by name (`@file`), but not those of the simulator's
//! library. A line counts once for each state that has run it. Interpreters count; this module collects their counts. `testing` writes
//! the reports.

mod text;

use std::collections::BTreeMap;
use std::path::PathBuf;

pub use text::read_text;

/// A text whose lines are counted.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum CountedText {
    /// A Lua file, by the name under which it was loaded.
    File(PathBuf),
    /// A script of the scene.
    Script {
        /// The path of the scene's file; empty without one.
        scene: String,
        /// The object's path in the scene.
        path: String,
        /// The text, with bytes as in the scene; its own copy, since counts outlive the memory of their simulator.
        text: Vec<u8>,
    },
}

/// A function of a text.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FunctionLines {
    /// Its first line; 0 for the main function of the text.
    pub line: u32,
    /// The lines of its body that can run, in the order of the text.
    pub lines: Vec<u32>,
    /// Its name in the text, if it has one.
    pub name: Option<String>,
}

/// The number of states in which each line ran, from line 1. Lines after the last entry never ran.
pub type Counts = Vec<u64>;

/// The counts of many texts.
#[derive(Debug, Clone, Default)]
pub struct LineCounts {
    /// The counts of each text.
    pub texts: BTreeMap<CountedText, Counts>,
    /// The functions of texts whose language says so while they run; those of Lua are found when they are reported.
    pub functions: BTreeMap<CountedText, Vec<FunctionLines>>,
}

impl LineCounts {
    /// Adds the counts of another simulator or state.
    pub fn merge(&mut self, other: Self) {
        other
            .texts
            .into_iter()
            .for_each(|(text, counts)| self.add(text, &counts));
        self.functions.extend(other.functions);
    }

    /// Adds counts of the lines of a text, from line 1, to those that it has.
    pub fn add(&mut self, text: CountedText, counts: &[u64]) {
        let sums = self.texts.entry(text).or_default();
        if sums.len() < counts.len() {
            sums.resize(counts.len(), 0);
        }
        sums.iter_mut()
            .zip(counts)
            .for_each(|(sum, count)| *sum = sum.saturating_add(*count));
    }
}
