//! The rows of a batch on disk.
//!
//! `batch.json` says what the batch is. `runs.jsonl` gets a line for each run as it ends, so that an interruption loses none; when all are done
//! they stand there in order, and in `results.csv`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::{Batch, Row, Run};
use format::scene_file::write_whole;
use format::scene_input::SceneInput;
use permissions::Permissions;

/// Why a folder is of no use.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The folder belongs to a batch of another scene or other runs.
    #[error(
        "{0} holds the results of another batch: choose another folder, or begin anew with --force."
    )]
    Other(PathBuf),
    /// The scene cannot be read.
    #[error("{0}")]
    Scene(String),
    /// A file cannot be read or written.
    #[error("{0}: {1}")]
    Io(PathBuf, io::Error),
}

/// A folder with the rows of a batch.
pub struct Store {
    folder: PathBuf,
    rows: BTreeMap<usize, Row>,
    log: File,
    /// What the user should know of the files that were there.
    pub notice: Option<String>,
}

impl Store {
    /// Opens or creates the folder of a batch. With `anew`, existing rows are discarded, and those of which no file says to which batch they
    /// belong: a disk that was full, or a kill, may have left it empty.
    ///
    /// # Errors
    /// When it cannot be written, or holds another batch.
    pub fn open(folder: &Path, batch: &Batch, anew: bool) -> Result<Self, StoreError> {
        let about = |error| StoreError::Io(folder.to_owned(), error);
        let description = describe(batch).map_err(StoreError::Scene)?;
        fs::create_dir_all(folder).map_err(about)?;
        let (manifest, log) = (folder.join("batch.json"), folder.join("runs.jsonl"));
        let found = fs::read_to_string(&manifest).ok();
        let known = found.as_ref().filter(|text| is_whole(text));
        if known.is_some_and(|text| *text != description) && !anew {
            return Err(StoreError::Other(folder.to_owned()));
        }
        let notice = (found.is_some() && known.is_none() && !anew).then(|| damaged(&manifest));
        let text = if anew || known.is_none() {
            String::new()
        } else {
            fs::read_to_string(&log).unwrap_or_default()
        };
        if known.is_none_or(|text| *text != description) {
            write_whole(&manifest, description.as_bytes()).map_err(about)?;
        }
        let rows = rows(&text, &batch.runs());
        // A line cut off by an interruption is left out.
        let lines: String = rows.values().map(|row| line(row) + "\n").collect();
        write_whole(&log, lines.as_bytes()).map_err(about)?;
        let log = OpenOptions::new().append(true).open(&log).map_err(about)?;
        Ok(Self {
            folder: folder.to_owned(),
            rows,
            log,
            notice,
        })
    }

    /// Whether a folder can become that of a batch.
    ///
    /// # Errors
    /// When it holds another batch, or the scene cannot be read.
    pub fn check(folder: &Path, batch: &Batch) -> Result<(), StoreError> {
        let description = describe(batch).map_err(StoreError::Scene)?;
        let found = fs::read_to_string(folder.join("batch.json")).ok();
        let is_other = |text: &String| is_whole(text) && *text != description;
        if found.as_ref().is_some_and(is_other) {
            return Err(StoreError::Other(folder.to_owned()));
        }
        Ok(())
    }

    /// Forgets the rows that were there.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn clear(&mut self) -> Result<(), StoreError> {
        self.rows.clear();
        let cut = self.log.set_len(0);
        cut.map_err(|error| StoreError::Io(self.folder.clone(), error))
    }

    /// The runs that are not done yet.
    pub fn missing(&self, runs: &[Run]) -> Vec<Run> {
        runs.iter()
            .filter(|run| !self.rows.contains_key(&run.number))
            .cloned()
            .collect()
    }

    /// Keeps a row.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add(&mut self, row: Row) -> Result<(), StoreError> {
        writeln!(self.log, "{}", line(&row))
            .map_err(|error| StoreError::Io(self.folder.clone(), error))?;
        self.rows.insert(row.run.number, row);
        Ok(())
    }

    /// Keeps the row of a line that [`Row::line`] made elsewhere; false when it is no row of this batch, or is there already.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add_line(&mut self, text: &str, runs: &[Run]) -> Result<bool, StoreError> {
        let Some(row) = rows(text, runs).into_values().next() else {
            return Ok(false);
        };
        let is_new = !self.rows.contains_key(&row.run.number);
        if is_new {
            self.add(row)?;
        }
        Ok(is_new)
    }

    /// How many runs failed.
    pub fn failed(&self) -> usize {
        self.rows.values().filter(|row| row.error.is_some()).count()
    }

    /// The rows so far, in order.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.values()
    }

    /// Writes all rows in order; the same whatever the order of the runs was.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn finish(&self) -> Result<PathBuf, StoreError> {
        let about = |error| StoreError::Io(self.folder.clone(), error);
        let lines: String = self.rows.values().map(|row| line(row) + "\n").collect();
        write_whole(&self.folder.join("runs.jsonl"), lines.as_bytes()).map_err(about)?;
        let table = self.folder.join("results.csv");
        let csv = self.csv().map_err(|error| about(io::Error::other(error)))?;
        write_whole(&table, csv.as_bytes()).map_err(about)?;
        Ok(table)
    }

    fn csv(&self) -> Result<String, Box<dyn std::error::Error + Send + Sync>> {
        let params: BTreeSet<&String> = self
            .rows
            .values()
            .flat_map(|row| row.run.params.iter().map(|p| &p.0))
            .collect();
        let results: BTreeSet<&String> = self
            .rows
            .values()
            .flat_map(|row| row.results.keys())
            .collect();
        let mut table = csv::Writer::from_writer(Vec::new());
        let head = ["run", "seed"]
            .into_iter()
            .chain(params.iter().map(|name| name.as_str()));
        table.write_record(
            head.chain(["error", "steps", "time"])
                .chain(results.iter().map(|name| name.as_str())),
        )?;
        for row in self.rows.values() {
            let param = |name: &&String| {
                row.run
                    .params
                    .iter()
                    .find(|p| p.0 == **name)
                    .map_or("", |p| p.1.as_str())
                    .to_owned()
            };
            let result = |name: &&String| row.results.get(*name).cloned().unwrap_or_default();
            let mut record = vec![row.run.number.to_string(), row.run.seed.to_string()];
            record.extend(params.iter().map(param));
            record.extend([
                row.error.clone().unwrap_or_default(),
                row.steps.to_string(),
                seconds(row.time).to_string(),
            ]);
            record.extend(results.iter().map(result));
            table.write_record(record)?;
        }
        Ok(String::from_utf8(table.into_inner()?)?)
    }
}

/// Identity of a batch: the scene's contents, the runs and their limits.
fn describe(batch: &Batch) -> Result<String, String> {
    let sweeps: Vec<Value> = batch
        .sweeps
        .iter()
        .map(|(name, values)| json!([name, values]))
        .collect();
    let scene = SceneInput::read(&batch.scene, &Permissions::all())?.bytes();
    let mut description = json!({
        "scene": batch.scene.display().to_string(), "checksum": format!("{:016x}", checksum(&scene)), "seeds": batch.seeds,
        "sweeps": sweeps, "fixed": batch.fixed, "time": batch.time, "version": env!("CARGO_PKG_VERSION"),
    });
    if let Some(time) = batch.branch_at {
        description["branchAt"] = time.into();
    }
    Ok(format!("{description:#}\n"))
}

/// FNV-1a, 64 bits: enough to notice that a file has changed.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Time is a sum of steps: its last digits are rounding errors.
fn seconds(time: f64) -> f64 {
    (time * 1e9).round() / 1e9
}

impl Row {
    /// The row as a line of `runs.jsonl`.
    pub fn line(&self) -> String {
        line(self)
    }

    /// The row as JSON.
    pub fn value(&self) -> Value {
        value(self)
    }
}

fn line(row: &Row) -> String {
    value(row).to_string()
}

fn value(row: &Row) -> Value {
    let params: Map<String, Value> = row
        .run
        .params
        .iter()
        .map(|(name, value)| (name.clone(), typed(value)))
        .collect();
    let results: Map<String, Value> = row
        .results
        .iter()
        .map(|(name, value)| (name.clone(), typed(value)))
        .collect();
    json!({
        "run": row.run.number, "seed": row.run.seed, "params": params, "error": row.error, "steps": row.steps,
        "time": seconds(row.time), "results": results,
    })
}

/// A number where the text is one that is written so.
fn typed(text: &str) -> Value {
    let is_written_so = |number: &serde_json::Number| number.to_string().as_str() == text;
    serde_json::from_str(text)
        .ok()
        .filter(is_written_so)
        .map_or_else(|| Value::from(text), Value::Number)
}

fn untyped(value: &Value) -> String {
    value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned)
}

/// The rows of a log that belong to the runs; damaged lines are left out, so that their runs are made again.
fn rows(text: &str, runs: &[Run]) -> BTreeMap<usize, Row> {
    let by_number: BTreeMap<usize, &Run> = runs.iter().map(|run| (run.number, run)).collect();
    let row = |line: &str| {
        let value: Value = serde_json::from_str(line).ok()?;
        let run = *by_number.get(&usize::try_from(value["run"].as_u64()?).ok()?)?;
        let results = value["results"]
            .as_object()?
            .iter()
            .map(|(name, value)| (name.clone(), untyped(value)))
            .collect();
        let error = value["error"].as_str().map(str::to_owned);
        Some(Row {
            run: run.clone(),
            error,
            steps: value["steps"].as_u64()?,
            time: value["time"].as_f64()?,
            results,
        })
    };
    text.lines()
        .filter_map(row)
        .map(|row| (row.run.number, row))
        .collect()
}

/// Whether a text is all of a `batch.json`, of whatever batch.
fn is_whole(text: &str) -> bool {
    serde_json::from_str::<Value>(text).is_ok_and(|value| value.is_object())
}

fn damaged(manifest: &Path) -> String {
    format!(
        "{} is empty or cut off, as a full disk or a kill leaves it: the batch begins anew",
        manifest.display()
    )
}

#[cfg(test)]
mod tests {
    use super::{Row, Run, line, rows, typed};

    #[test]
    fn rows_come_back_and_damaged_ones_do_not() {
        let run = Run {
            number: 1,
            seed: 7,
            params: vec![("kp".into(), "1.50".into())],
        };
        let results = [
            ("a".to_owned(), "0.1".to_owned()),
            ("b".into(), "1e3".into()),
            ("c".into(), "007".into()),
        ]
        .into();
        let row = Row {
            run: run.clone(),
            error: Some("x\n\"y\"".into()),
            steps: 3,
            time: 0.15,
            results,
        };
        let text = line(&row);
        assert_eq!(
            rows(&text, std::slice::from_ref(&run))
                .into_values()
                .collect::<Vec<_>>(),
            [row]
        );
        for end in 0..text.len() {
            assert!(rows(&text[..end], std::slice::from_ref(&run)).is_empty());
        }
        assert!(rows(&text.replace("\"run\":1", "\"run\":2"), &[run]).is_empty());
    }

    #[test]
    fn numbers_are_numbers_if_they_stay_as_they_are_written() {
        assert!(typed("1.5").is_number() && typed("-3").is_number());
        assert!(typed("1.50").is_string() && typed("007").is_string() && typed("nan").is_string());
    }
}
