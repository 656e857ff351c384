//! Files that a file includes.

use crate::limits;
use crate::report::Warning;
use crate::sdf::Include;

/// A file that an `<include>` names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Included {
    /// The contents of the file.
    pub bytes: Vec<u8>,
    /// The folder that relative names in it are in.
    pub folder: String,
}

/// Levels of files that include files.
const MAX_DEPTH: usize = 8;
/// Included files in all.
const MAX_INCLUDES: usize = 1000;

/// Looks up files within limits, and collects their warnings.
pub struct Reader<'a> {
    include: Include<'a>,
    /// The names of the files that are being read, from the outermost.
    open: Vec<String>,
    count: usize,
    bytes: usize,
    warnings: Vec<Warning>,
}

impl<'a> Reader<'a> {
    pub fn new(include: Include<'a>) -> Self {
        Self {
            include,
            open: Vec::new(),
            count: 0,
            bytes: 0,
            warnings: Vec::new(),
        }
    }

    /// The file of a name. [`close`](Self::close) ends it.
    pub fn open(&mut self, uri: &str) -> Result<Included, String> {
        if self.open.iter().any(|open| open == uri) {
            return Err("it includes itself".into());
        }
        if self.open.len() >= MAX_DEPTH || self.count >= MAX_INCLUDES {
            return Err(format!(
                "more than {MAX_DEPTH} files inside of each other, or {MAX_INCLUDES} in all, are not read"
            ));
        }
        let file = (self.include)(uri)?;
        (self.count, self.bytes) = (self.count + 1, self.bytes + file.bytes.len());
        if self.bytes > limits::BYTES {
            return Err(format!(
                "the files have more than {} bytes together",
                limits::BYTES
            ));
        }
        self.open.push(uri.to_owned());
        Ok(file)
    }

    /// Ends the last file that was opened.
    pub fn close(&mut self, warnings: Vec<Warning>) {
        let Some(uri) = self.open.pop() else { return };
        let room = limits::WARNINGS.saturating_sub(self.warnings.len());
        let named = |warning: Warning| Warning {
            message: format!("{} (in {uri})", warning.message),
            ..warning
        };
        self.warnings
            .extend(warnings.into_iter().take(room).map(named));
    }

    pub fn into_warnings(self) -> Vec<Warning> {
        self.warnings
    }
}
