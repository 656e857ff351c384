//! Writing.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{Result, Write};

use scene::{Handle, special};

use super::{HEAD, MAX_VALUES, short};
use crate::Simulator;

/// Writes the hashes of a simulator's steps.
pub struct HashWriter<W> {
    file: W,
    targets: HashMap<i64, usize>,
    properties: HashMap<String, usize>,
    /// Bytes that are left for values; None when there were too many.
    left: Option<usize>,
}

impl<W: Write> HashWriter<W> {
    /// Begins a file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(file: W) -> Result<Self> {
        Self::with_limit(file, MAX_VALUES)
    }

    pub(super) fn with_limit(mut file: W, limit: usize) -> Result<Self> {
        writeln!(file, "{HEAD}")?;
        Ok(Self {
            file,
            targets: HashMap::new(),
            properties: HashMap::new(),
            left: Some(limit),
        })
    }

    /// Adds the state after a step; returns its hash.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn add(&mut self, sim: &Simulator) -> Result<u64> {
        let (mut names, mut values) = (String::new(), String::new());
        let hash = sim.state_hash_with(|value| {
            if self.left.is_none() {
                return;
            }
            let target = self.target(sim, value.target, &mut names);
            let property = self.property(value.name, &mut names);
            let separator = if values.is_empty() { '\t' } else { ' ' };
            // Writing to a string does not fail.
            let _ = match short(value.hash) {
                0 => write!(values, "{separator}{target}.{property}=-"),
                hash => write!(values, "{separator}{target}.{property}={hash:08x}"),
            };
        });
        self.write(sim, hash, &names, &values)?;
        Ok(hash)
    }

    fn write(&mut self, sim: &Simulator, hash: u64, names: &str, values: &str) -> Result<()> {
        let had_room = self.left.is_some();
        let left = self
            .left
            .and_then(|left| left.checked_sub(names.len() + values.len()));
        self.left = left;
        let (names, values) = if left.is_some() {
            (names, values)
        } else {
            ("", "")
        };
        if had_room && left.is_none() {
            writeln!(self.file, "e")?;
        }
        let (step, time) = (sim.steps(), sim.time());
        writeln!(self.file, "{names}s\t{step}\t{time}\t{hash:016x}{values}")
    }

    /// The number of an owner, which is introduced in `names` if it is new.
    fn target(&mut self, sim: &Simulator, target: i64, names: &mut String) -> usize {
        let next = self.targets.len();
        *self.targets.entry(target).or_insert_with(|| {
            let _ = writeln!(names, "t\t{target}\t{}", escaped(&shown(sim, target)));
            next
        })
    }

    fn property(&mut self, name: &str, names: &mut String) -> usize {
        if let Some(number) = self.properties.get(name) {
            return *number;
        }
        let number = self.properties.len();
        let _ = writeln!(names, "p\t{}", escaped(name));
        self.properties.insert(name.to_owned(), number);
        number
    }

    /// Completes the file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(mut self) -> Result<W> {
        self.file.flush()?;
        Ok(self.file)
    }
}

/// How people call the owner of a value: an object by its path.
pub(super) fn shown(sim: &Simulator, target: i64) -> String {
    let path = |handle| sim.scene().full_path(handle).ok();
    match target {
        special::SCENE => "the scene".to_owned(),
        special::APP => "the application".to_owned(),
        _ => Handle::from_raw(target)
            .and_then(path)
            .unwrap_or_else(|| format!("script {target}")),
    }
}

/// A text within a line.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() || c == '\\' {
            escaped.extend(c.escape_default());
        } else {
            escaped.push(c);
        }
    }
    escaped
}
