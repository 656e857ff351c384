//! Samples of quantities over time: as a table, in figures, as curves.

use scene::Data;
use serde_json::{Value, json};

use crate::values::{number, short, value};

/// Samples that are kept.
pub(super) const MAX_SAMPLES: usize = 200_000;

/// Values of quantities at times.
#[derive(Debug, Clone, Default)]
pub(super) struct Samples {
    watched: Vec<(String, &'static str)>,
    columns: Vec<String>,
    pub times: Vec<f64>,
    rows: Vec<Vec<Data>>,
}

/// A column of numbers.
pub(super) struct Curve<'a> {
    pub name: &'a str,
    pub points: Vec<(f64, f64)>,
}

impl Samples {
    /// Samples of quantities: their names and units.
    pub(super) fn of(watched: Vec<(String, &'static str)>) -> Self {
        Self {
            watched,
            ..Self::default()
        }
    }

    /// Adds the values of the quantities now. Vectors take several columns.
    pub(super) fn add(&mut self, time: f64, values: &[Data]) {
        if self.rows.is_empty() {
            let named = self.watched.iter().zip(values);
            self.columns = named
                .flat_map(|((name, unit), value)| columns(name, unit, value))
                .collect();
        }
        let row: Vec<Data> = values.iter().flat_map(parts).collect();
        if row.len() == self.columns.len() && self.rows.len() < MAX_SAMPLES {
            self.times.push(time);
            self.rows.push(row);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty() || self.columns.is_empty()
    }

    /// Rows that are shown of so many: the first, the last, and some between, evenly.
    fn chosen(&self, most: usize) -> Vec<usize> {
        let count = self.rows.len();
        if count <= most {
            return (0..count).collect();
        }
        let last = (most - 1).max(1);
        (0..=last).map(|at| at * (count - 1) / last).collect()
    }

    /// A table of at most so many rows, and the least and the largest value of each column of numbers.
    pub(super) fn text(&self, most: usize) -> String {
        let mut out = format!("t [s] | {}\n", self.columns.join(" | "));
        for at in self.chosen(most) {
            let cells: Vec<String> = self.rows[at].iter().map(short).collect();
            out += &format!("{} | {}\n", number(self.times[at]), cells.join(" | "));
        }
        let curves = self.curves();
        if self.rows.len() > most {
            out += &format!("({} of {} samples)\n", most, self.rows.len());
        }
        if self.rows.len() > 1 {
            for curve in curves {
                out += &format!("{}\n", curve.summary());
            }
        }
        out
    }

    /// The same for programs.
    pub(super) fn json(&self, most: usize) -> Value {
        let rows: Vec<Value> = self
            .chosen(most)
            .into_iter()
            .map(|at| {
                std::iter::once(json!(self.times[at]))
                    .chain(self.rows[at].iter().map(value))
                    .collect()
            })
            .collect();
        let columns: Vec<&str> = std::iter::once("t [s]")
            .chain(self.columns.iter().map(String::as_str))
            .collect();
        json!({"columns": columns, "rows": rows})
    }

    /// The columns of numbers.
    pub(super) fn curves(&self) -> Vec<Curve<'_>> {
        let curve = |(column, name): (usize, &'_ String)| {
            let points = self.times.iter().zip(&self.rows);
            let points = points.map(|(time, row)| Some((*time, row[column].as_f64()?)));
            points
                .collect::<Option<Vec<_>>>()
                .map(|points| (name.clone(), points))
        };
        let found: Vec<_> = self.columns.iter().enumerate().map(curve).collect();
        found
            .into_iter()
            .zip(&self.columns)
            .filter_map(|(found, name)| {
                Some(Curve {
                    name,
                    points: found?.1,
                })
            })
            .collect()
    }
}

impl Curve<'_> {
    /// Least and largest value with their times, and the last one.
    fn summary(&self) -> String {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (low, high) = (
            self.points.iter().min_by(by_value),
            self.points.iter().max_by(by_value),
        );
        let (Some(low), Some(high), Some(last)) = (low, high, self.points.last()) else {
            return String::new();
        };
        if low.1 == high.1 {
            return format!("{}: always {}", self.name, number(low.1));
        }
        format!(
            "{}: least {} at {} s, largest {} at {} s, last {}",
            self.name,
            number(low.1),
            number(low.0),
            number(high.1),
            number(high.0),
            number(last.1)
        )
    }

    /// Least, largest and last value.
    pub(super) fn figures(&self) -> [f64; 3] {
        let values = || self.points.iter().map(|point| point.1);
        [
            values().fold(f64::INFINITY, f64::min),
            values().fold(f64::NEG_INFINITY, f64::max),
            values().next_back().unwrap_or(f64::NAN),
        ]
    }
}

fn columns(name: &str, unit: &str, value: &Data) -> Vec<String> {
    let unit = if unit.is_empty() {
        String::new()
    } else {
        format!(" [{unit}]")
    };
    match value {
        Data::Array(all) => (1..=all.len())
            .map(|at| format!("{name}[{at}]{unit}"))
            .collect(),
        _ => vec![format!("{name}{unit}")],
    }
}

fn parts(value: &Data) -> Vec<Data> {
    match value {
        Data::Array(all) => all.clone(),
        other => vec![other.clone()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(count: usize) -> Samples {
        let mut samples = Samples::of(vec![("/a.position".into(), "m"), ("b".into(), "")]);
        for at in 0..count {
            let x = at as f64;
            let vector = Data::Array(vec![Data::Float(x), Data::Float(-x)]);
            samples.add(x / 10.0, &[vector, Data::text("on")]);
        }
        samples
    }

    #[test]
    fn a_table_has_the_first_and_the_last_row() {
        let text = samples(100).text(3);
        assert_eq!(
            text,
            "t [s] | /a.position[1] [m] | /a.position[2] [m] | b\n0 | 0 | 0 | on\n4.9 | 49 | -49 | on\n9.9 | 99 | -99 | on\n\
             (3 of 100 samples)\n\
             /a.position[1] [m]: least 0 at 0 s, largest 99 at 9.9 s, last 99\n\
             /a.position[2] [m]: least -99 at 9.9 s, largest 0 at 0 s, last -99\n"
        );
    }

    #[test]
    fn only_numbers_are_curves() {
        let samples = samples(4);
        let curves = samples.curves();
        assert_eq!(curves.len(), 2);
        assert_eq!(curves[1].figures(), [-3.0, 0.0, -3.0]);
    }

    #[test]
    fn a_row_of_another_form_is_left_out() {
        let mut samples = samples(2);
        samples.add(5.0, &[Data::Nil, Data::Nil]);
        assert_eq!(samples.times.len(), 2);
    }
}
