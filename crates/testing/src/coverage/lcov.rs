//! The LCOV report, for genhtml and coverage services.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::FileCoverage;

/// All records, in the order of their names.
pub(super) fn text(records: &BTreeMap<PathBuf, FileCoverage>) -> String {
    let mut text = String::new();
    for (path, record) in records {
        // Writing to a string does not fail.
        let _ = write_record(&mut text, path, record);
    }
    text
}

fn write_record(text: &mut String, path: &Path, record: &FileCoverage) -> std::fmt::Result {
    writeln!(text, "TN:\nSF:{}", one_line(path))?;
    write_functions(text, record)?;
    for (line, count) in &record.lines {
        writeln!(text, "DA:{line},{count}")?;
    }
    writeln!(
        text,
        "LF:{}\nLH:{}\nend_of_record",
        record.lines.len(),
        record.hit()
    )
}

/// A record is read line by line: characters that would end a line are replaced.
fn one_line(path: &Path) -> String {
    path.display()
        .to_string()
        .replace(|c: char| c.is_control(), "_")
}

fn write_functions(text: &mut String, record: &FileCoverage) -> std::fmt::Result {
    let names = names(record);
    for (function, name) in record.functions.iter().zip(&names) {
        writeln!(text, "FN:{},{name}", function.line)?;
    }
    for (function, name) in record.functions.iter().zip(&names) {
        writeln!(text, "FNDA:{},{name}", record.calls(function))?;
    }
    let hit = record
        .functions
        .iter()
        .filter(|function| record.calls(function) > 0)
        .count();
    writeln!(text, "FNF:{}\nFNH:{hit}", record.functions.len())
}

/// LCOV knows functions by their names, so each must have one of its own.
fn names(record: &FileCoverage) -> Vec<String> {
    let mut known = HashSet::new();
    let name = |function: &script::coverage::FunctionLines| {
        let name = function
            .name
            .clone()
            .unwrap_or_else(|| format!("anonymous@{}", function.line));
        if known.insert(name.clone()) {
            name
        } else {
            format!("{name}@{}", function.line)
        }
    };
    record.functions.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::super::FileCoverage;
    use super::text;
    use script::executable;

    #[test]
    fn the_format_is_that_of_lcov() {
        let source = b"function f(x)\n  if x then\n    x = 1\n  end\nend\nf()\nlocal f = function()\n  f()\nend\n";
        let mut record = FileCoverage::new(executable(source).expect("it compiles"));
        record.add(&[1, 1, 0, 0, 0, 1]);
        let expected = "TN:\nSF:a/b.lua\nFN:1,f\nFN:7,f@7\nFNDA:1,f\nFNDA:0,f@7\nFNF:2\nFNH:1\n\
            DA:1,1\nDA:2,1\nDA:3,0\nDA:6,1\nDA:8,0\nLF:5\nLH:3\nend_of_record\n";
        assert_eq!(text(&[("a/b.lua".into(), record)].into()), expected);
    }

    #[test]
    fn a_file_name_is_one_line() {
        let record = FileCoverage::new(executable(b"x = 1").expect("it compiles"));
        let text = text(&[("a\nend_of_record\r.lua".into(), record)].into());
        assert!(
            text.starts_with("TN:\nSF:a_end_of_record_.lua\nFN"),
            "{text}"
        );
    }
}
