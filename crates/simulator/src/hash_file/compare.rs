//! Comparing a run with a file.

use std::collections::BTreeMap;
use std::fmt::{Display, Formatter};
use std::io::BufRead;

use super::read::{HashFileError, Reader};
use super::short;
use super::write::{escaped, shown};
use crate::Simulator;

/// So many differing values are named.
const MOST_NAMED: usize = 10;

/// Compares the steps of a simulator with those of a file.
pub struct Comparison<R> {
    reader: Reader<R>,
    /// The hashes of values here, by owner and name.
    values: BTreeMap<(i64, String), u32>,
    equal: u64,
}

/// What a comparison of a step found.
#[derive(Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The state is the same.
    Equal,
    /// The state is another one.
    Differs(Difference),
    /// The file has no further step.
    EndOfFile,
}

/// A step after which the states differ.
#[derive(Debug, PartialEq, Eq)]
pub struct Difference {
    /// Number of the step in its simulation, from 1.
    pub step: u64,
    /// Values that differ, no more than ten; none where the file does not have them.
    pub values: Vec<DifferentValue>,
    /// How many more there are.
    pub more: usize,
}

/// A value that differs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DifferentValue {
    /// Path of the object, or what else has the value.
    pub owner: String,
    /// The property, or what the value is.
    pub name: String,
    /// Which of the two has it.
    pub presence: Presence,
}

/// Which run has a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// Both, with different values.
    Both,
    /// Only the one of the file.
    File,
    /// Only this one.
    Here,
}

impl<R: BufRead> Comparison<R> {
    /// With a file of hashes.
    ///
    /// # Errors
    /// When it is none.
    pub fn new(file: R) -> Result<Self, HashFileError> {
        Ok(Self {
            reader: Reader::new(file)?,
            values: BTreeMap::new(),
            equal: 0,
        })
    }

    /// How many steps were equal.
    pub fn equal_steps(&self) -> u64 {
        self.equal
    }

    /// Whether the file has further steps.
    ///
    /// # Errors
    /// When it is damaged.
    pub fn has_more(&mut self) -> Result<bool, HashFileError> {
        Ok(self.reader.next_step()?.is_some())
    }

    /// Compares the state after a step with the next one of the file.
    ///
    /// # Errors
    /// When the file is damaged.
    pub fn compare(&mut self, sim: &Simulator) -> Result<Verdict, HashFileError> {
        let values = &mut self.values;
        let hash = sim.state_hash_with(|value| {
            let place = (value.target, escaped(value.name));
            match short(value.hash) {
                0 => values.remove(&place),
                hash => values.insert(place, hash),
            };
        });
        let Some(step) = self.reader.next_step()? else {
            return Ok(Verdict::EndOfFile);
        };
        if step.hash == hash {
            self.equal += 1;
            return Ok(Verdict::Equal);
        }
        Ok(Verdict::Differs(self.difference(sim)))
    }

    fn difference(&self, sim: &Simulator) -> Difference {
        let mut values = match self.reader.has_values {
            true => self.differing(sim),
            false => Vec::new(),
        };
        let more = values.len().saturating_sub(MOST_NAMED);
        values.truncate(MOST_NAMED);
        Difference {
            step: sim.steps(),
            values,
            more,
        }
    }

    /// First those of the file, in the order in which it names them.
    fn differing(&self, sim: &Simulator) -> Vec<DifferentValue> {
        let mut found = Vec::new();
        let mut here = self.values.clone();
        for (&(target, property), &hash) in &self.reader.values {
            let target = &self.reader.targets[target];
            let name = &self.reader.properties[property];
            let presence = match here.remove(&(target.number, name.clone())) {
                Some(ours) if ours == hash => continue,
                Some(_) => Presence::Both,
                None => Presence::File,
            };
            found.push(DifferentValue {
                owner: target.path.clone(),
                name: name.clone(),
                presence,
            });
        }
        found.extend(here.into_keys().map(|(target, name)| DifferentValue {
            owner: shown(sim, target),
            name,
            presence: Presence::Here,
        }));
        found
    }
}

impl Display for Difference {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "the state after step {} is another one", self.step)?;
        if self.values.is_empty() {
            return write!(f, "; the file does not say which value");
        }
        for (at, value) in self.values.iter().enumerate() {
            write!(f, "{} {value}", if at == 0 { ":" } else { "," })?;
        }
        match self.more {
            0 => Ok(()),
            more => write!(f, ", and {more} more"),
        }
    }
}

impl Display for DifferentValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of {}", self.name, self.owner)?;
        match self.presence {
            Presence::Both => Ok(()),
            Presence::File => write!(f, " (only in the file)"),
            Presence::Here => write!(f, " (only here)"),
        }
    }
}
