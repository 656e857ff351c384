//! Warnings about files that are no XML.

use crate::limits;
use crate::report::{Parsed, Warning, WarningKind};
use crate::xml::short;

/// Collects warnings.
#[derive(Debug, Default)]
pub(super) struct Notes {
    warnings: Vec<Warning>,
    further: usize,
}

impl Notes {
    /// Something was not understood, and left out.
    pub fn add(&mut self, line: u32, element: &str, message: impl Into<String>) {
        if self.warnings.len() >= limits::WARNINGS {
            self.further += 1;
            return;
        }
        self.warnings.push(Warning {
            line,
            element: short(element),
            message: message.into(),
            kind: WarningKind::NotUnderstood,
        });
    }

    pub fn finish<T>(mut self, value: T) -> Parsed<T> {
        self.warnings.sort_by_key(|warning| warning.line);
        Parsed {
            value,
            warnings: self.warnings,
            further_warnings: self.further,
        }
    }
}

/// The line of a place in a text, from 1.
pub(super) fn line_at(text: &str, at: usize) -> u32 {
    let before = text.as_bytes().iter().take(at);
    let lines = before.filter(|byte| **byte == b'\n').count() + 1;
    u32::try_from(lines).unwrap_or(u32::MAX)
}
