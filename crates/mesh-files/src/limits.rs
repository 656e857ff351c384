//! How much a file may become.

use crate::error::{Location, ReadError, Result};

/// The largest mesh that is read. A file without instances stays far below: its own length bounds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Vertices of all parts together.
    pub vertices: usize,
    /// Triangles of all parts together.
    pub triangles: usize,
    /// Parts.
    pub parts: usize,
}

impl Default for Limits {
    /// 20 million vertices and triangles, some 700 MB.
    fn default() -> Self {
        Self {
            vertices: 20_000_000,
            triangles: 20_000_000,
            parts: 100_000,
        }
    }
}

impl Limits {
    /// Takes away what one more part needs.
    pub(crate) fn take(&mut self, vertices: usize, triangles: usize) -> Result<()> {
        let left = |have: usize, need: usize, what: &str| {
            have.checked_sub(need)
                .ok_or_else(|| ReadError::new(Location::File, what, "more than the limit"))
        };
        self.vertices = left(self.vertices, vertices, "vertices")?;
        self.triangles = left(self.triangles, triangles, "triangles")?;
        self.parts = left(self.parts, 1, "parts")?;
        Ok(())
    }
}
