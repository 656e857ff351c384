//! Reading.

use std::collections::BTreeMap;
use std::io::{BufRead, Read};

use super::HEAD;

/// Bytes that a line may have; more is no file of ours.
const MAX_LINE: u64 = 512 << 20;

/// Why a file of hashes cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum HashFileError {
    /// The file begins otherwise.
    #[error("it is no file of state hashes (its first line is not `{HEAD}`)")]
    NoHashes,
    /// What is wrong in a line.
    #[error("line {line}: {wrong}")]
    Damaged {
        /// The number of the line, from 1.
        line: u64,
        /// What is wrong.
        wrong: &'static str,
    },
    /// An error of the system.
    #[error("{0}")]
    Io(#[from] std::io::Error),
}

/// The owner of values, as the file names it.
pub(super) struct Target {
    pub number: i64,
    pub path: String,
}

/// A step of the file.
pub(super) struct Step {
    pub hash: u64,
}

/// Reads a file step by step.
pub(super) struct Reader<R> {
    file: R,
    line: u64,
    text: Vec<u8>,
    pub targets: Vec<Target>,
    pub properties: Vec<String>,
    /// Of the values at this step, by the numbers of owner and property.
    pub values: BTreeMap<(usize, usize), u32>,
    /// Whether the file has the values of this step.
    pub has_values: bool,
}

impl<R: BufRead> Reader<R> {
    pub(super) fn new(file: R) -> Result<Self, HashFileError> {
        let mut reader = Self {
            file,
            line: 0,
            text: Vec::new(),
            targets: Vec::new(),
            properties: Vec::new(),
            values: BTreeMap::new(),
            has_values: true,
        };
        if reader.next_line(HEAD.len() as u64 + 2)?.as_deref() == Some(HEAD) {
            Ok(reader)
        } else {
            Err(HashFileError::NoHashes)
        }
    }

    /// The next step; None at the end of the file.
    pub(super) fn next_step(&mut self) -> Result<Option<Step>, HashFileError> {
        while let Some(line) = self.next_line(MAX_LINE)? {
            let (kind, rest) = line.split_once('\t').unwrap_or((&line, ""));
            let taken = match kind {
                "s" => return Ok(Some(self.take_step(rest).map_err(|w| self.damaged(w))?)),
                "t" => self.take_target(rest),
                "p" => self.take_property(rest),
                "e" => {
                    self.has_values = false;
                    Ok(())
                }
                _ => Err("it begins with none of `t`, `p`, `s` and `e`"),
            };
            taken.map_err(|wrong| self.damaged(wrong))?;
        }
        Ok(None)
    }

    fn damaged(&self, wrong: &'static str) -> HashFileError {
        HashFileError::Damaged {
            line: self.line,
            wrong,
        }
    }

    fn next_line(&mut self, most: u64) -> Result<Option<String>, HashFileError> {
        self.text.clear();
        self.line += 1;
        let mut limited = (&mut self.file).take(most);
        limited.read_until(b'\n', &mut self.text)?;
        if self.text.is_empty() {
            return Ok(None);
        }
        if self.text.last() != Some(&b'\n') {
            return Err(self.damaged("it has no end"));
        }
        self.text.pop();
        match std::str::from_utf8(&self.text) {
            Ok(text) => Ok(Some(text.to_owned())),
            Err(_) => Err(self.damaged("it is no text")),
        }
    }

    fn take_target(&mut self, rest: &str) -> Result<(), &'static str> {
        let (number, path) = rest.split_once('\t').ok_or("an owner has no name")?;
        self.targets.push(Target {
            number: number.parse().map_err(|_| "an owner has no number")?,
            path: path.to_owned(),
        });
        Ok(())
    }

    fn take_property(&mut self, name: &str) -> Result<(), &'static str> {
        if name.is_empty() {
            return Err("a property has no name");
        }
        self.properties.push(name.to_owned());
        Ok(())
    }

    fn take_step(&mut self, rest: &str) -> Result<Step, &'static str> {
        let mut fields = rest.splitn(4, '\t');
        let mut field = || fields.next().ok_or("a step has number, time and hash");
        field()?
            .parse::<u64>()
            .map_err(|_| "a step has no number")?;
        field()?.parse::<f64>().map_err(|_| "a step has no time")?;
        let hash = hexadecimal(field()?, 16).ok_or("a step has no hash")?;
        for value in fields.next().into_iter().flat_map(|list| list.split(' ')) {
            self.take_value(value)?;
        }
        Ok(Step { hash })
    }

    fn take_value(&mut self, text: &str) -> Result<(), &'static str> {
        let (place, hash) = text.split_once('=').ok_or("a value has no hash")?;
        let place = place
            .split_once('.')
            .and_then(|(target, property)| Some((target.parse().ok()?, property.parse().ok()?)));
        let (target, property): (usize, usize) = place.ok_or("a value has no owner and name")?;
        if target >= self.targets.len() || property >= self.properties.len() {
            return Err("a value has an owner or name that no line before has");
        }
        if hash == "-" {
            self.values.remove(&(target, property));
            return Ok(());
        }
        let hash = hexadecimal(hash, 8).ok_or("the hash of a value has eight digits")?;
        self.values.insert((target, property), hash as u32);
        Ok(())
    }
}

fn hexadecimal(text: &str, digits: usize) -> Option<u64> {
    let all_digits = text.len() == digits && text.bytes().all(|b| b.is_ascii_hexdigit());
    u64::from_str_radix(text, 16).ok().filter(|_| all_digits)
}
