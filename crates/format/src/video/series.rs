//! A series of PNG files, each complete as soon as it is there: `out-%05d.png` becomes `out-00000.png`, `out-00001.png`, ...

use std::path::{Path, PathBuf};

use super::{VideoError, VideoFile, VideoFormat};
use crate::picture::{Layout, Picture};
use crate::scene_file::write_whole;

pub(super) struct Series {
    name: Name,
    size: [u32; 2],
    /// Pictures so far.
    count: u64,
}

/// The name of a file with a place for a number.
#[derive(Debug, Clone, PartialEq)]
struct Name {
    before: String,
    digits: usize,
    after: String,
}

impl Name {
    /// The place of the number is as in C: `%d`, `%5d` and `%05d`, always with zeros before.
    fn parse(name: &str) -> Option<Self> {
        let (before, rest) = name.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        let digits = if digits.is_empty() {
            1
        } else {
            digits.parse().ok()?
        };
        let is_sound =
            (1..=20).contains(&digits) && !after.contains('%') && !after.contains(['/', '\\']);
        is_sound.then(|| Self {
            before: before.to_owned(),
            digits,
            after: after.to_owned(),
        })
    }

    fn path(&self, number: u64) -> PathBuf {
        let Self {
            before,
            digits,
            after,
        } = self;
        format!("{before}{number:0digits$}{after}").into()
    }
}

impl Series {
    pub(super) fn create(
        path: &Path,
        VideoFormat { size, .. }: VideoFormat,
    ) -> Result<Self, VideoError> {
        let name = path
            .to_str()
            .and_then(Name::parse)
            .ok_or(VideoError::Series)?;
        Ok(Self {
            name,
            size,
            count: 0,
        })
    }
}

impl VideoFile for Series {
    fn add(&mut self, picture: &[u8], periods: u64) -> Result<(), VideoError> {
        let picture = Picture::new(picture.to_vec(), self.size.map(i64::from), Layout::Rgb)?;
        let file = picture.encode("png", 100)?;
        for _ in 0..periods {
            write_whole(&self.name.path(self.count), &file)?;
            self.count += 1;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), VideoError> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_one_place_for_a_number() {
        let name =
            |text: &str| Name::parse(text).map(|name| name.path(7).to_string_lossy().into_owned());
        assert_eq!(name("a/out-%05d.png").as_deref(), Some("a/out-00007.png"));
        assert_eq!(name("%d.png").as_deref(), Some("7.png"));
        for wrong in [
            "out.png",
            "out-%s.png",
            "%d%d.png",
            "%99d.png",
            "%-5d.png",
            "%d/a.png",
        ] {
            assert_eq!(name(wrong), None, "{wrong}");
        }
    }
}
