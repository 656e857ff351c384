//! The text format: `facet ... vertex x y z` three times `... endfacet`, in one or more solids.

use crate::error::{ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::{MeshFile, Part};
use crate::text::{Words, name, quoted};

pub(super) fn read(bytes: &[u8], mut limits: Limits) -> Result<MeshFile> {
    let mut words = Words::new(bytes);
    let mut file = MeshFile::default();
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(ReadError::new(
                words.place(),
                "solid",
                format!("{} is not `solid`", quoted(word)),
            ));
        }
        let mut part = Part {
            name: name(words.rest_of_line()),
            ..Part::default()
        };
        solid(&mut words, &mut part)?;
        limits.take(part.vertices.len(), part.triangles.len())?;
        file.parts.push(part);
    }
    Ok(file)
}

/// Facets up to `endsolid`.
fn solid(words: &mut Words, part: &mut Part) -> Result<()> {
    loop {
        let Some(word) = words.next() else {
            return Err(ReadError::new(
                words.place(),
                "solid",
                "the file ends before `endsolid`",
            ));
        };
        match &*word.to_ascii_lowercase() {
            b"facet" => facet(words, part)?,
            b"endsolid" => {
                words.rest_of_line();
                return Ok(());
            }
            _ => {
                return Err(ReadError::new(
                    words.place(),
                    "solid",
                    format!("{} is no facet", quoted(word)),
                ));
            }
        }
    }
}

/// Up to `endfacet`; more than three corners are a fan.
fn facet(words: &mut Words, part: &mut Part) -> Result<()> {
    let first = numbers::count_u32(part.vertices.len());
    loop {
        let Some(word) = words.next() else {
            return Err(ReadError::new(
                words.place(),
                "facet",
                "the file ends before `endfacet`",
            ));
        };
        match word {
            b"vertex" | b"VERTEX" => part.vertices.push(words.vector("vertex")?),
            b"endfacet" | b"ENDFACET" => break,
            b"endsolid" | b"ENDSOLID" => {
                return Err(ReadError::new(
                    words.place(),
                    "facet",
                    "`endsolid` before `endfacet`",
                ));
            }
            // `outer loop`, `endloop`, `normal` and its numbers.
            _ => {}
        }
    }
    let corners = numbers::count_u32(part.vertices.len()) - first;
    if corners < 3 {
        return Err(ReadError::new(
            words.place(),
            "facet",
            "fewer than three vertices",
        ));
    }
    part.triangles
        .extend((1..corners - 1).map(|corner| [first, first + corner, first + corner + 1]));
    Ok(())
}
