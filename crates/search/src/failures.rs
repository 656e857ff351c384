//! Failing cases in files, so that they are tried first the next time.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Value as Json, json};

use super::choice::Value;

/// The greatest file that is read.
const MAX_SIZE: u64 = 16 << 20;

/// A case that has failed.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownFailure {
    /// The test, as people name it.
    pub test: String,
    /// What went wrong.
    pub message: String,
    /// The values of its choices.
    pub choices: Vec<Value>,
}

/// The values as a list of numbers in JSON.
pub fn text_of(values: &[Value]) -> String {
    as_json(values).to_string()
}

/// The values of such a list; None when it is none.
pub fn values_of(text: &str) -> Option<Vec<Value>> {
    from_json(&serde_json::from_str(text).ok()?)
}

fn as_json(values: &[Value]) -> Json {
    let number = |value: &Value| match value {
        Value::Integer(value) => json!(value),
        Value::Float(value) => json!(value),
    };
    values.iter().map(number).collect()
}

fn from_json(json: &Json) -> Option<Vec<Value>> {
    let value = |json: &Json| {
        let integer = json.as_i64().map(Value::Integer);
        integer.or_else(|| json.as_f64().map(Value::Float))
    };
    json.as_array()?.iter().map(value).collect()
}

impl KnownFailure {
    fn as_json(&self) -> Json {
        json!({ "test": self.test, "message": self.message, "choices": as_json(&self.choices) })
    }

    /// The failure that a file with that text is about; None when it is none.
    pub fn read(text: &[u8]) -> Option<Self> {
        let json: Json = serde_json::from_slice(text).ok()?;
        let text = |name: &str| Some(json.get(name)?.as_str()?.to_owned());
        Some(Self {
            test: text("test")?,
            message: text("message")?,
            choices: from_json(json.get("choices")?)?,
        })
    }
}

/// The folder of failing cases: a file for each test that has one.
#[derive(Debug, Clone)]
pub struct Failures {
    folder: PathBuf,
}

impl Failures {
    /// The failures in that folder, which is made for the first one.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// The file of a test.
    pub fn file(&self, test: &str) -> PathBuf {
        self.folder.join(format!("{}.json", file_stem(test)))
    }

    /// The failure of a test; None when there is none, or when the file is not one of these.
    pub fn load(&self, test: &str) -> Option<KnownFailure> {
        let file = self.file(test);
        let is_small = |file: &Path| fs::metadata(file).is_ok_and(|data| data.len() <= MAX_SIZE);
        let text = is_small(&file).then(|| fs::read(&file).ok())??;
        let failure = KnownFailure::read(&text)?;
        // Two tests may share a file's name, if rarely.
        (failure.test == test).then_some(failure)
    }

    /// Keeps the failure of a test in place of an earlier one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn save(&self, failure: &KnownFailure) -> io::Result<PathBuf> {
        fs::create_dir_all(&self.folder)?;
        let file = self.file(&failure.test);
        let part = file.with_extension("json.part");
        fs::write(&part, serde_json::to_vec_pretty(&failure.as_json())?)?;
        fs::rename(&part, &file)?;
        Ok(file)
    }

    /// Forgets the failure of a test, if there is one.
    pub fn remove(&self, test: &str) {
        if self.load(test).is_some() {
            // It is tried again where it cannot be removed, which does no harm.
            let _ = fs::remove_file(self.file(test));
        }
    }
}

/// The name of a test without its folder and without what file systems treat in a special way, and a number by which it differs from others.
fn file_stem(test: &str) -> String {
    const MAX_LENGTH: usize = 70;
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let name = test.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = name.chars().map(plain).take(MAX_LENGTH).collect();
    format!(
        "{}-{:08x}",
        name.trim_matches('-'),
        fnv(test.as_bytes()) as u32
    )
}

/// The hash of Fowler, Noll and Vo (FNV-1a).
fn fnv(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}
