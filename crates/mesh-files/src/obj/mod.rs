//! Wavefront OBJ: polygons by object, group and material. Lines, points, curves and smoothing groups are left out.

mod materials;
mod write;

use std::collections::BTreeMap;

pub(crate) use write::write;

use crate::Resolve;
use crate::corners::{Corner, Lists, NONE, part, push_polygon};
use crate::error::{Location, ReadError, Result};
use crate::limits::Limits;
use crate::mesh_file::MeshFile;
use crate::text::{name, no_number, number, number_or_zero, quoted, words};
use materials::Library;

#[derive(Default)]
struct Reader {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    uv: Vec<[f64; 2]>,
    /// Of each group and material: its number in `triangles`.
    groups: BTreeMap<(Vec<u8>, Vec<u8>), usize>,
    triangles: Vec<Vec<[Corner; 3]>>,
    group: Vec<u8>,
    material: Vec<u8>,
    /// The number of the current group and material, once it has a face.
    current: Option<usize>,
    polygon: Vec<Corner>,
    /// Faces of two corners or one, which some programs write for edges.
    edges: usize,
}

pub(crate) fn read(bytes: &[u8], mut limits: Limits, resolve: Resolve) -> Result<MeshFile> {
    let (mut reader, mut library) = (Reader::default(), Library::default());
    for (line, content) in logical_lines(bytes) {
        reader.line(&content, Location::Line(line), &mut library, resolve)?;
    }
    let lists = Lists {
        positions: &reader.positions,
        normals: &reader.normals,
        uv: &reader.uv,
    };
    let mut names: Vec<_> = reader.groups.iter().collect();
    names.sort_by_key(|(_, number)| **number);
    let mut file = MeshFile::default();
    for (((group, material), _), triangles) in names.into_iter().zip(&reader.triangles) {
        let part = part(name(group), lists, triangles, library.material(material));
        limits.take(part.vertices.len(), part.triangles.len())?;
        file.parts.push(part);
    }
    (file.textures, file.warnings) = (library.textures, library.warnings);
    if reader.edges > 0 {
        file.warnings.push(format!(
            "{} faces of fewer than three corners are left out",
            reader.edges
        ));
    }
    Ok(file)
}

/// Lines with their numbers; one that ends in a backslash goes on in the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, std::borrow::Cow<'_, [u8]>)> {
    let mut lines = bytes.split(|&byte| byte == b'\n').zip(1..);
    std::iter::from_fn(move || {
        let (first, number) = lines.next()?;
        let mut whole = std::borrow::Cow::Borrowed(first.trim_ascii_end());
        while whole.ends_with(b"\\") {
            let whole = whole.to_mut();
            whole.pop();
            match lines.next() {
                Some((next, _)) => whole.extend_from_slice(next.trim_ascii_end()),
                None => break,
            }
        }
        Some((number, whole))
    })
}

impl Reader {
    fn line(
        &mut self,
        line: &[u8],
        place: Location,
        library: &mut Library,
        resolve: Resolve,
    ) -> Result<()> {
        let line = line.trim_ascii_start();
        let end = line
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(line.len());
        let (keyword, rest) = (&line[..end], line[end..].trim_ascii());
        match keyword {
            b"v" => self.positions.push(vector(rest, place)?),
            b"vn" => self.normals.push(three(rest)),
            b"vt" => self.uv.push([
                number_or_zero(words(rest).next()),
                number_or_zero(words(rest).nth(1)),
            ]),
            b"f" | b"fo" => self.face(rest, place)?,
            b"g" | b"o" => (self.group, self.current) = (rest.to_vec(), None),
            b"usemtl" => (self.material, self.current) = (rest.to_vec(), None),
            b"mtllib" => library.load(rest, resolve),
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, rest: &[u8], place: Location) -> Result<()> {
        self.polygon.clear();
        for word in words(rest) {
            self.polygon.push(self.corner(word, place)?);
        }
        if self.polygon.len() < 3 {
            self.edges += 1;
            return Ok(());
        }
        let number = self.current_group();
        push_polygon(&self.polygon, &self.positions, &mut self.triangles[number]);
        Ok(())
    }

    fn current_group(&mut self) -> usize {
        if let Some(number) = self.current {
            return number;
        }
        let key = (self.group.clone(), self.material.clone());
        let number = *self.groups.entry(key).or_insert(self.triangles.len());
        if number == self.triangles.len() {
            self.triangles.push(Vec::new());
        }
        self.current = Some(number);
        number
    }

    /// `position`, `position/uv`, `position//normal` or `position/uv/normal`.
    fn corner(&self, word: &[u8], place: Location) -> Result<Corner> {
        let mut indices = word.split(|&byte| byte == b'/');
        let refused = || {
            ReadError::new(
                place,
                "face",
                format!("{} names nothing that was defined before", quoted(word)),
            )
        };
        let mut next = |length: usize| match indices.next() {
            None | Some(b"") => Ok(NONE),
            Some(index) => relative(index, length).ok_or_else(refused),
        };
        let corner = Corner {
            position: next(self.positions.len())?,
            uv: next(self.uv.len())?,
            normal: next(self.normals.len())?,
        };
        if corner.position == NONE {
            Err(refused())
        } else {
            Ok(corner)
        }
    }
}

/// Indices count from 1, or backwards from what was defined last.
fn relative(word: &[u8], length: usize) -> Option<u32> {
    let index: i64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    let index = if index < 0 {
        index.checked_add(numbers::count(length))?
    } else {
        index - 1
    };
    usize::try_from(index)
        .ok()
        .filter(|index| *index < length)
        .map(numbers::count_u32)
}

fn vector(rest: &[u8], place: Location) -> Result<[f64; 3]> {
    let mut words = words(rest);
    let mut next = || {
        let word = words.next();
        word.and_then(number)
            .ok_or_else(|| ReadError::new(place, "vertex", no_number(word)))
    };
    Ok([next()?, next()?, next()?])
}

fn three(rest: &[u8]) -> [f64; 3] {
    let mut words = words(rest);
    [
        number_or_zero(words.next()),
        number_or_zero(words.next()),
        number_or_zero(words.next()),
    ]
}
