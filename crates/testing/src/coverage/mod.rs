//! Line coverage of the scripts and files under test.
//!
//! Counts of all tests are summed here, so that it does not matter which test ran where. A text is reported under the name of the file that
//! has it; a script that is inside of a scene file under that of a copy, which is written beside the report.

mod cost;
mod lcov;
mod place;
mod record;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

pub use record::FileCoverage;

use place::Places;
use script::coverage::{CountedText, FunctionLines, LineCounts};
use script::executable;

/// The coverage of all texts.
#[derive(Debug, Default)]
pub struct Coverage {
    /// By the name of the file.
    pub records: BTreeMap<PathBuf, FileCoverage>,
    /// Copies to write of the texts that have no file.
    copies: BTreeMap<PathBuf, Vec<u8>>,
    /// How many times longer short lines of Lua take that are counted, if that could be measured.
    pub cost: Option<f64>,
}

impl Coverage {
    /// The coverage of `counts` for the file `report`, without the tests themselves (`tests`).
    pub(super) fn new(report: &Path, tests: &[PathBuf], counts: LineCounts) -> Self {
        Self {
            cost: cost::of_a_loop(),
            ..Self::of(report, tests, counts)
        }
    }

    /// The same, without the cost of counting.
    pub fn of(report: &Path, tests: &[PathBuf], counts: LineCounts) -> Self {
        let mut coverage = Self::default();
        let mut places = Places::new(report, tests);
        let mut functions = counts.functions;
        for (text, counts) in counts.texts {
            let functions = functions.remove(&text);
            coverage.add(&mut places, &text, &counts, functions);
        }
        coverage
    }

    /// Adds a text; None for the functions of one in Lua.
    fn add(
        &mut self,
        places: &mut Places,
        text: &CountedText,
        counts: &[u64],
        functions: Option<Vec<FunctionLines>>,
    ) {
        let Some(place) = places.of(text) else { return };
        let functions = functions.or_else(|| executable(&place.text));
        let Some(functions) = functions.filter(|functions| !functions.is_empty()) else {
            return;
        };
        let record = self
            .records
            .entry(place.path.clone())
            .or_insert_with(|| FileCoverage::new(functions));
        record.add(counts);
        if place.is_copy {
            self.copies.insert(place.path, place.text);
        }
    }

    /// Writes the report, and the copies it refers to.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, report: &Path) -> io::Result<()> {
        for (path, text) in &self.copies {
            write_file(path, text)?;
        }
        write_file(report, self.lcov().as_bytes())
    }

    /// The report in LCOV's format.
    pub fn lcov(&self) -> String {
        lcov::text(&self.records)
    }
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let about =
        |error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", path.display()));
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(about)?;
    }
    std::fs::write(path, bytes).map_err(about)
}
