//! The texts of scripts, as clients know them: files by their path, other texts by a number.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use script::LoadedText;
use serde_json::{Value, json};

/// Identifies a text through all runs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum SourceKey {
    /// A file.
    File(PathBuf),
    /// A text of the scene, by its title; one that was loaded as a string, by itself.
    Text(String),
    /// The text that a script has, whatever that is: for clients who know scripts by their handles.
    Script(i64),
}

impl SourceKey {
    /// The one of a text.
    pub fn of(text: &LoadedText) -> Self {
        match &text.file {
            Some(file) => Self::of_file(file),
            None if text.title == STRING => {
                Self::Text(String::from_utf8_lossy(&text.text).into_owned())
            }
            None => Self::Text(text.title.clone()),
        }
    }

    /// All that mean a text.
    pub fn all_of(text: &LoadedText) -> impl Iterator<Item = Self> {
        [Some(Self::of(text)), text.script.map(Self::Script)]
            .into_iter()
            .flatten()
    }

    fn of_file(file: &Path) -> Self {
        Self::File(file.canonicalize().unwrap_or_else(|_| file.to_owned()))
    }
}

/// The title of texts that were loaded as strings.
const STRING: &str = "load";

/// A text that was loaded.
struct Entry {
    key: SourceKey,
    text: Rc<LoadedText>,
}

/// All texts that were loaded, the latest of each key.
#[derive(Default)]
pub struct Sources {
    entries: Vec<Entry>,
    /// The lines with code of the texts that scripts have.
    of_scripts: BTreeMap<i64, BTreeSet<u32>>,
}

impl Sources {
    /// Notes a text; whether it is new.
    pub fn add(&mut self, text: &Rc<LoadedText>) -> bool {
        let key = SourceKey::of(text);
        if let Some(script) = text.script {
            self.of_scripts.insert(script, text.lines.clone());
        }
        let known = self.entries.iter_mut().find(|entry| entry.key == key);
        let is_new = known.is_none();
        match known {
            Some(entry) => entry.text = Rc::clone(text),
            None => self.entries.push(Entry {
                key,
                text: Rc::clone(text),
            }),
        }
        is_new
    }

    /// A text, as clients see it.
    pub fn describe(&self, text: &LoadedText) -> Value {
        let key = SourceKey::of(text);
        let place = self.entries.iter().position(|entry| entry.key == key);
        if let Some(file) = &text.file {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let mut described = json!({"name": name, "path": file.display().to_string()});
            // The files of a capture may be elsewhere.
            if let Some(place) = place.filter(|_| !file.is_file()) {
                described["sourceReference"] = json!(place + 1);
            }
            return described;
        }
        json!({
            "name": text.title, "sourceReference": place.map_or(0, |place| place + 1), "origin": "scene",
            "path": format!("swanilda:{}.lua", text.title),
        })
    }

    /// All texts.
    pub fn all(&self) -> Vec<Value> {
        let texts = self.entries.iter().map(|entry| &entry.text);
        texts.map(|text| self.describe(text)).collect()
    }

    /// The text with a number.
    pub fn content(&self, reference: i64) -> Option<String> {
        let place = usize::try_from(reference).ok()?.checked_sub(1)?;
        let entry = self.entries.get(place)?;
        Some(String::from_utf8_lossy(&entry.text.text).into_owned())
    }

    /// The text with a key, if it was loaded.
    pub fn text(&self, key: &SourceKey) -> Option<String> {
        let entry = self.entries.iter().find(|entry| entry.key == *key)?;
        Some(String::from_utf8_lossy(&entry.text.text).into_owned())
    }

    /// What a client means by a `Source`; in place of what the protocol has it may name a `script`.
    ///
    /// # Errors
    /// When there is no such text.
    pub fn key(&self, source: &Value) -> Result<SourceKey, String> {
        if let Some(script) = source["script"].as_i64() {
            return Ok(SourceKey::Script(script));
        }
        let reference = source["sourceReference"].as_u64().unwrap_or_default();
        if reference > 0 {
            let place = usize::try_from(reference).unwrap_or_default() - 1;
            let entry = self.entries.get(place);
            return entry
                .map(|entry| entry.key.clone())
                .ok_or_else(|| format!("there is no text with the number {reference}"));
        }
        let path = source["path"]
            .as_str()
            .ok_or("a source needs a path or a number")?;
        let title = path
            .strip_prefix("swanilda:")
            .and_then(|path| path.strip_suffix(".lua"));
        Ok(match title {
            Some(title) => SourceKey::Text(title.to_owned()),
            None => SourceKey::of_file(Path::new(path)),
        })
    }

    /// The lines with code of a text that was loaded, or of a file that is there; None where there is neither.
    pub fn lines(&self, key: &SourceKey) -> Option<BTreeSet<u32>> {
        if let SourceKey::Script(script) = key {
            return self.of_scripts.get(script).cloned();
        }
        if let Some(entry) = self.entries.iter().find(|entry| entry.key == *key) {
            return Some(entry.text.lines.clone());
        }
        let SourceKey::File(file) = key else {
            return None;
        };
        let functions = script::executable(&script::coverage::read_text(file)?)?;
        let lines = functions.into_iter().flat_map(|function| function.lines);
        Some(lines.collect())
    }
}
