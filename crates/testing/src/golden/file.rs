//! The golden file: a text table.
//!
//! A first line names the format, a second one the columns; then comes a line for each sample, all separated by tabs.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use format::scene_file::write_whole;
use permissions::read_bounded;
use script::test_bench::Trace;

const FIRST_LINE: &str = "# swanilda golden 1";
/// A larger file is none of ours.
const MAX_SIZE: u64 = 64 << 20;

/// Reads a golden file; None when there is none.
///
/// # Errors
/// When it is damaged: where and how.
pub(super) fn read(path: &Path) -> Result<Option<Trace>, String> {
    match std::fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Ok(data) if data.len() > MAX_SIZE => {
            return Err(format!("the file is larger than {MAX_SIZE} bytes."));
        }
        _ => {}
    }
    let bytes = read_bounded(path).map_err(|error| error.to_string())?;
    parse(&String::from_utf8_lossy(&bytes)).map(Some)
}

fn parse(text: &str) -> Result<Trace, String> {
    let mut lines = text.lines().enumerate();
    if lines
        .next()
        .is_none_or(|(_, line)| line.trim_end() != FIRST_LINE)
    {
        return Err(format!("line 1: it does not begin with '{FIRST_LINE}'."));
    }
    let header = lines
        .next()
        .and_then(|(_, line)| line.strip_prefix("time\t"))
        .ok_or("line 2: the columns are missing.")?;
    let columns: Vec<String> = header.split('\t').map(str::to_owned).collect();
    let mut rows = Vec::new();
    for (i, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let row: Option<Vec<f64>> = line.split('\t').map(|value| value.parse().ok()).collect();
        let row = row.filter(|row| row.len() == columns.len() + 1 && row[0].is_finite());
        rows.push(row.ok_or_else(|| {
            format!(
                "line {}: {} numbers are expected.",
                i + 1,
                columns.len() + 1
            )
        })?);
    }
    if rows.is_empty() || rows.windows(2).any(|pair| pair[0][0] >= pair[1][0]) {
        return Err("the times must rise, and there must be some.".into());
    }
    Ok(Trace { columns, rows })
}

/// Writes a golden file, all of it or nothing.
///
/// # Errors
/// When the folder cannot be written.
pub(super) fn write(path: &Path, trace: &Trace) -> io::Result<()> {
    write_whole(path, print(trace).as_bytes())
}

fn print(trace: &Trace) -> String {
    let mut text = format!("{FIRST_LINE}\ntime");
    for column in &trace.columns {
        text.push('\t');
        text.push_str(&column.replace(|c: char| c.is_control(), " "));
    }
    text.push('\n');
    for row in &trace.rows {
        for (i, value) in row.iter().enumerate() {
            let separator = if i == 0 { "" } else { "\t" };
            write!(text, "{separator}{}", rounded(*value)).expect("strings take all");
        }
        text.push('\n');
    }
    text
}

/// Nine digits are more than tolerances ask for, and leave out the noise of the last ones.
fn rounded(value: f64) -> f64 {
    let rounded = format!("{value:.8e}").parse().unwrap_or(value);
    // No sign for zero.
    if rounded == 0.0 { 0.0 } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::{Trace, parse, print};

    fn trace() -> Trace {
        let rows = vec![
            vec![0.0, 1.0 / 3.0, -0.0],
            vec![0.05, 2e-13, f64::NAN],
            vec![0.1, 1e300, f64::INFINITY],
        ];
        Trace {
            columns: vec!["/box.x".into(), "two words".into()],
            rows,
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let text = print(&trace());
        assert!(
            text.starts_with(
                "# swanilda golden 1\ntime\t/box.x\ttwo words\n0\t0.333333333\t0\n0.05\t"
            ),
            "{text}"
        );
        let read = parse(&text).expect("it is ours");
        assert_eq!(
            (read.columns, read.rows[0].clone()),
            (trace().columns, vec![0.0, 0.333333333, 0.0])
        );
        assert!(read.rows[1][2].is_nan() && read.rows[2][2] == f64::INFINITY);
    }

    #[test]
    fn damaged_files_are_errors() {
        let text = print(&trace());
        for wrong in [
            "",
            "# swanilda golden 2\n",
            "# swanilda golden 1\n",
            "# swanilda golden 1\ntime\ta\n",
        ] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(
            parse(&text.replace("0.05\t", "0.05\tx\t")).expect_err("a word"),
            "line 4: 3 numbers are expected."
        );
        assert!(parse(&text.replace("0.05\t", "NaN\t")).is_err());
        assert!(
            parse(&text.replace("0.1\t", "0.01\t")).is_err(),
            "times must rise"
        );
        for end in 0..text.len() {
            let _ = parse(&text[..end]);
        }
    }
}
