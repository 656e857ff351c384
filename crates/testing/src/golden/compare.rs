//! Comparison of two traces.

use std::fmt;

use script::test_bench::{Tolerances, Trace};

/// The difference between two traces.
#[derive(Debug, Clone, PartialEq)]
pub enum Difference {
    /// They are not of the same quantities.
    Columns {
        /// Columns of the file that the test has not recorded.
        missing: Vec<String>,
        /// Columns of the test that are not in the file.
        new: Vec<String>,
    },
    /// They do not last equally long: the last times, seconds.
    Length {
        /// Of the file.
        expected: f64,
        /// Of the test.
        actual: f64,
    },
    /// Values are off by more than their tolerances.
    Values {
        /// The earliest of them.
        first: Divergence,
        /// The largest in units of its tolerance.
        worst: Divergence,
        /// Times that were compared.
        samples: usize,
        /// Times at which a value is off.
        off: usize,
        /// The columns that are off.
        columns: Vec<String>,
    },
}

/// One value that is too far off.
#[derive(Debug, Clone, PartialEq)]
pub struct Divergence {
    /// Seconds.
    pub time: f64,
    /// The name of the quantity.
    pub column: String,
    /// The value of the file.
    pub expected: f64,
    /// The value of the test.
    pub actual: f64,
    /// The deviation that is allowed.
    pub tolerance: f64,
}

impl Divergence {
    /// The deviation in units of the tolerance.
    fn ratio(&self) -> f64 {
        let deviation = (self.actual - self.expected).abs();
        if deviation.is_nan() {
            f64::INFINITY
        } else {
            deviation / self.tolerance
        }
    }
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            time,
            column,
            expected,
            actual,
            tolerance,
        } = self;
        write!(
            f,
            "at {time:.3} s {column} is {actual:.9}, expected {expected:.9} (off by "
        )?;
        write!(
            f,
            "{:.3e}, allowed {tolerance:.3e})",
            (actual - expected).abs()
        )
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Columns { missing, new } => {
                write!(
                    f,
                    "it has other quantities: missing [{}], new [{}].",
                    missing.join(", "),
                    new.join(", ")
                )
            }
            Self::Length { expected, actual } => {
                write!(f, "it ends at {actual:.3} s, expected {expected:.3} s.")
            }
            Self::Values {
                first,
                worst,
                samples,
                off,
                ..
            } => {
                write!(
                    f,
                    "{off} of {samples} samples are off.\n  first: {first}\n  worst: {worst}"
                )
            }
        }
    }
}

/// Compares `actual` with `expected` at the times of the latter, between samples along straight lines. With a tolerance of time, all of
/// it may be early or late: the best shift counts. None when they are alike.
pub(super) fn compare(
    expected: &Trace,
    actual: &Trace,
    tolerances: &Tolerances,
) -> Option<Difference> {
    if let Some(difference) = other_columns(expected, actual) {
        return Some(difference);
    }
    let place = |column| actual.columns.iter().position(|other| other == column);
    let columns: Vec<usize> = expected.columns.iter().filter_map(place).collect();
    let (last_expected, last_actual) = (last_time(expected), last_time(actual));
    if (last_expected - last_actual).abs()
        > tolerances.time + interval(expected).max(interval(actual)) * 0.5
    {
        return Some(Difference::Length {
            expected: last_expected,
            actual: last_actual,
        });
    }
    let find = |shift| divergences(expected, actual, &columns, tolerances, shift);
    let best = shifts(expected, tolerances.time)
        .map(find)
        .min_by(|a, b| worst_ratio(a).total_cmp(&worst_ratio(b)))?;
    difference(expected, best)
}

/// The difference of two traces of other quantities.
fn other_columns(expected: &Trace, actual: &Trace) -> Option<Difference> {
    let absent = |from: &Trace, of: &Trace| -> Vec<String> {
        of.columns
            .iter()
            .filter(|column| !from.columns.contains(column))
            .cloned()
            .collect()
    };
    let (missing, new) = (absent(actual, expected), absent(expected, actual));
    (!missing.is_empty() || !new.is_empty()).then_some(Difference::Columns { missing, new })
}

fn last_time(trace: &Trace) -> f64 {
    trace.rows.last().map_or(0.0, |row| row[0])
}

/// Seconds between two samples, on average.
fn interval(trace: &Trace) -> f64 {
    let first = trace.rows.first().map_or(0.0, |row| row[0]);
    (last_time(trace) - first) / (trace.rows.len().max(2) - 1) as f64
}

/// The shifts to try, the smallest first: quarters of the interval of samples.
fn shifts(expected: &Trace, time: f64) -> impl Iterator<Item = f64> {
    const MAX_SHIFTS: f64 = 200.0;
    let step = (interval(expected) / 4.0).max(time / MAX_SHIFTS);
    let count = if step > 0.0 {
        (time / step).floor().min(MAX_SHIFTS) as i32
    } else {
        0
    };
    (0..=count)
        .flat_map(move |i| [f64::from(i) * step, f64::from(-i) * step])
        .skip(1)
}

fn divergences(
    expected: &Trace,
    actual: &Trace,
    columns: &[usize],
    tolerances: &Tolerances,
    shift: f64,
) -> Vec<Divergence> {
    let mut found = Vec::new();
    for row in &expected.rows {
        let (before, after, share) = surrounding(actual, row[0] + shift);
        for (i, &column) in columns.iter().enumerate() {
            let name = &expected.columns[i];
            let (wanted, got) = (
                row[i + 1],
                between(before[column + 1], after[column + 1], share),
            );
            let tolerance = tolerance(tolerances, name, wanted);
            if !is_close(wanted, got, tolerance) {
                let column = name.clone();
                found.push(Divergence {
                    time: row[0],
                    column,
                    expected: wanted,
                    actual: got,
                    tolerance,
                });
            }
        }
    }
    found
}

/// The rows around a time, and how far it is from the first to the second; at the ends the last one there is.
fn surrounding(trace: &Trace, time: f64) -> (&[f64], &[f64], f64) {
    let after = trace
        .rows
        .partition_point(|row| row[0] < time)
        .min(trace.rows.len() - 1);
    let before = after.saturating_sub(1);
    let (a, b) = (&trace.rows[before], &trace.rows[after]);
    let share = if b[0] > a[0] {
        ((time - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0)
    } else {
        1.0
    };
    (a, b, share)
}

fn between(a: f64, b: f64, share: f64) -> f64 {
    match share {
        0.0 => a,
        1.0 => b,
        _ => a + (b - a) * share,
    }
}

fn tolerance(tolerances: &Tolerances, column: &str, expected: f64) -> f64 {
    let whole = column.rsplit_once('.').map_or(column, |(whole, _)| whole);
    let own = tolerances
        .columns
        .get(column)
        .or_else(|| tolerances.columns.get(whole));
    own.copied().unwrap_or_else(|| {
        tolerances
            .absolute
            .max(tolerances.relative * expected.abs())
    })
}

fn is_close(expected: f64, actual: f64, tolerance: f64) -> bool {
    expected == actual
        || expected.is_nan() && actual.is_nan()
        || (expected - actual).abs() <= tolerance
}

fn worst_ratio(found: &[Divergence]) -> f64 {
    found.iter().map(Divergence::ratio).fold(0.0, f64::max)
}

fn difference(expected: &Trace, found: Vec<Divergence>) -> Option<Difference> {
    let worst = found
        .iter()
        .max_by(|a, b| a.ratio().total_cmp(&b.ratio()))?
        .clone();
    let mut columns: Vec<String> = Vec::new();
    for divergence in &found {
        if !columns.contains(&divergence.column) {
            columns.push(divergence.column.clone());
        }
    }
    let mut times: Vec<f64> = found.iter().map(|divergence| divergence.time).collect();
    times.dedup();
    let (samples, off) = (expected.rows.len(), times.len());
    Some(Difference::Values {
        first: found.into_iter().next()?,
        worst,
        samples,
        off,
        columns,
    })
}

#[cfg(test)]
mod tests {
    use super::{Difference, Tolerances, Trace, compare};

    fn sine(dt: f64, late: f64, amplitude: f64) -> Trace {
        let row = |i: i32| {
            let time = f64::from(i) * dt;
            vec![time, amplitude * (time - late).sin(), 1.0]
        };
        let count = (2.0 / dt).round() as i32;
        Trace {
            columns: vec!["a".into(), "b".into()],
            rows: (0..=count).map(row).collect(),
        }
    }

    fn tolerances(absolute: f64, time: f64) -> Tolerances {
        Tolerances {
            absolute,
            relative: 0.0,
            time,
            ..Tolerances::default()
        }
    }

    #[test]
    fn the_first_and_the_worst_divergence_are_reported() {
        let expected = sine(0.05, 0.0, 1.0);
        let mut actual = expected.clone();
        actual.rows[10][1] += 0.01;
        actual.rows[20][2] -= 0.5;
        let Some(Difference::Values {
            first,
            worst,
            off,
            columns,
            ..
        }) = compare(&expected, &actual, &tolerances(1e-3, 0.0))
        else {
            panic!("they differ");
        };
        assert_eq!(
            (first.column.as_str(), worst.column.as_str(), off),
            ("a", "b", 2)
        );
        assert!(
            (first.time - 0.5).abs() < 1e-9
                && (worst.time - 1.0).abs() < 1e-9
                && columns == ["a", "b"]
        );
        assert_eq!(compare(&expected, &actual, &tolerances(0.6, 0.0)), None);
        let own = Tolerances {
            columns: [("a".to_owned(), 0.02), ("b".to_owned(), 0.6)].into(),
            ..tolerances(0.0, 0.0)
        };
        assert_eq!(compare(&expected, &actual, &own), None);
    }

    #[test]
    fn other_time_steps_and_shifts_are_aligned() {
        let expected = sine(0.05, 0.0, 1.0);
        assert_eq!(
            compare(&expected, &sine(0.02, 0.0, 1.0), &tolerances(1e-3, 0.0)),
            None
        );
        let late = sine(0.05, 0.1, 1.0);
        assert!(compare(&expected, &late, &tolerances(1e-2, 0.0)).is_some());
        // The end of a delayed trace is missing: its last value is used instead.
        assert_eq!(compare(&expected, &late, &tolerances(0.05, 0.1)), None);
    }

    #[test]
    fn length_and_quantities_matter() {
        let expected = sine(0.05, 0.0, 1.0);
        let mut short = expected.clone();
        short.rows.truncate(30);
        assert!(matches!(
            compare(&expected, &short, &tolerances(9.0, 0.0)),
            Some(Difference::Length { .. })
        ));
        let mut other = expected.clone();
        other.columns.swap(0, 1);
        assert!(matches!(
            compare(&expected, &other, &tolerances(1e-6, 0.0)),
            Some(Difference::Values { .. })
        ));
        other.columns[0] = "c".into();
        assert!(matches!(
            compare(&expected, &other, &tolerances(9.0, 0.0)),
            Some(Difference::Columns { .. })
        ));
    }

    #[test]
    fn what_is_no_number_is_equal_to_itself_only() {
        let mut expected = sine(0.05, 0.0, 1.0);
        expected.rows[3][1] = f64::NAN;
        assert_eq!(
            compare(&expected, &expected.clone(), &tolerances(0.0, 0.0)),
            None
        );
        assert!(compare(&expected, &sine(0.05, 0.0, 1.0), &tolerances(9.0, 0.0)).is_some());
        assert!(compare(&sine(0.05, 0.0, 1.0), &expected, &tolerances(9.0, 0.0)).is_some());
    }
}
