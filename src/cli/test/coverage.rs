//! Coverage table on the terminal.

use std::fmt::Write;
use std::path::Path;

use testing::{Coverage, FileCoverage};

/// Ranges of missed lines that are shown of a script.
const RANGES: usize = 12;

/// A table with a row for each script, and what the count took.
pub(super) fn summary(coverage: &Coverage, report: &Path) -> String {
    let width = coverage
        .records
        .keys()
        .map(|path| path.display().to_string().chars().count())
        .max()
        .unwrap_or(0)
        .max(8);
    let mut text = format!("\n{:width$}  lines    hit       %  missed\n", "coverage");
    let (mut lines, mut hit) = (0, 0);
    for (path, record) in &coverage.records {
        text += &row(
            &path.display().to_string(),
            width,
            record.lines.len(),
            record.hit(),
            &missed(record),
        );
        lines += record.lines.len();
        hit += record.hit();
    }
    text += &row("total", width, lines, hit, "");
    // Writing to a string does not fail.
    if let Some(cost) = coverage.cost {
        let _ = writeln!(
            text,
            "counting makes Lua code up to {cost:.1} times slower, by a small loop measured now"
        );
    }
    let _ = writeln!(text, "coverage written to {}", report.display());
    text
}

fn row(name: &str, width: usize, lines: usize, hit: usize, missed: &str) -> String {
    let percent = if lines == 0 {
        100.0
    } else {
        hit as f64 * 100.0 / lines as f64
    };
    let row = format!("{name:width$}  {lines:5}  {hit:5}  {percent:6.1}  {missed}");
    format!("{}\n", row.trim_end())
}

fn missed(record: &FileCoverage) -> String {
    let ranges = record.missed();
    let shown = ranges.iter().take(RANGES);
    let mut words: Vec<_> = shown
        .map(|(a, b)| {
            if a == b {
                a.to_string()
            } else {
                format!("{a}-{b}")
            }
        })
        .collect();
    if ranges.len() > RANGES {
        words.push(format!("and {} more", ranges.len() - RANGES));
    }
    words.join(", ")
}
