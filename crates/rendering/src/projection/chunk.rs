//! Pieces of work: what is projected together, and the numbers of faces.

use std::ops::Range;

use crate::coverage::face::Face;
use crate::projection::owner::{Owner, Pass};
use crate::projection::surface::Setup;
use crate::projection::view::View;

/// Triangles, points or lines of one chunk.
const ELEMENTS: usize = 2048;

/// Faces of a group, at most.
const GROUP: usize = 32;

/// Pieces of owners that are projected together, and the faces that they have.
#[derive(Debug, Default)]
pub struct Chunk {
    /// Owner, and number of the piece.
    pieces: Vec<(usize, usize)>,
    elements: usize,
    setup: Setup,
    /// The faces of the pieces, few together, so that those in some rows are found soon.
    groups: Vec<Group>,
}

#[derive(Debug)]
struct Group {
    faces: Range<usize>,
    owner: usize,
    /// First and last.
    rows: [u16; 2],
}

/// The chunks of a picture. Their memory is used again.
#[derive(Debug, Default)]
pub struct Chunks {
    list: Vec<Chunk>,
    used: usize,
}

impl Chunks {
    pub fn clear(&mut self) {
        self.used = 0;
    }

    /// Adds a piece to the last chunk, or to a new one where that is full.
    pub fn push(&mut self, owner: usize, piece: usize, elements: usize) {
        if self.used == 0 || self.list[self.used - 1].elements + elements > ELEMENTS {
            self.begin_chunk();
        }
        let chunk = &mut self.list[self.used - 1];
        chunk.pieces.push((owner, piece));
        chunk.elements += elements;
    }

    fn begin_chunk(&mut self) {
        self.used += 1;
        if self.list.len() < self.used {
            self.list.push(Chunk::default());
        }
        let chunk = &mut self.list[self.used - 1];
        chunk.pieces.clear();
        chunk.elements = 0;
    }

    pub fn all(&self) -> &[Chunk] {
        &self.list[..self.used]
    }

    pub fn all_mut(&mut self) -> &mut [Chunk] {
        &mut self.list[..self.used]
    }
}

impl Chunk {
    /// Finds the faces.
    pub fn project(&mut self, owners: &[Owner], view: &View) {
        self.setup.faces.clear();
        self.groups.clear();
        for &(owner, piece) in &self.pieces {
            let first = self.setup.faces.len();
            owners[owner].content.project(view, piece, &mut self.setup);
            let faces = &self.setup.faces[first..];
            let groups = faces.chunks(GROUP).zip((first..).step_by(GROUP));
            self.groups.extend(groups.map(|(faces, first)| Group {
                faces: first..first + faces.len(),
                owner,
                rows: rows(faces),
            }));
        }
    }

    /// The faces of opaque or other owners that may be in some rows, with their places in the chunk and their owners.
    pub fn faces_in<'a>(
        &'a self,
        rows: Range<usize>,
        owners: &'a [Owner<'a>],
        is_opaque: bool,
    ) -> impl Iterator<Item = (usize, &'a Face, &'a Owner<'a>)> {
        let in_rows = move |[first, last]: [u16; 2]| {
            usize::from(first) < rows.end && usize::from(last) >= rows.start
        };
        let groups = self
            .groups
            .iter()
            .map(|group| (group, &owners[group.owner]));
        let groups = groups.filter(move |(group, owner)| {
            (owner.pass == Pass::Opaque) == is_opaque && in_rows(group.rows)
        });
        groups.flat_map(move |(group, owner)| {
            group
                .faces
                .clone()
                .map(move |at| (at, &self.setup.faces[at], owner))
        })
    }
}

/// The first and the last row of some faces.
fn rows(faces: &[Face]) -> [u16; 2] {
    faces.iter().fold([u16::MAX, 0], |[first, last], face| {
        [first.min(face.bounds[1][0]), last.max(face.bounds[1][1])]
    })
}

/// A number for a face of a chunk. A chunk has at most six faces for each of its elements, which is less than 2^16.
pub fn face_number(chunk: usize, face: usize) -> u32 {
    numbers::count_u32(chunk) << 16 | numbers::count_u32(face)
}

/// The face with a number.
pub fn face(chunks: &[Chunk], number: u32) -> &Face {
    &chunks[numbers::place(number >> 16)].setup.faces[numbers::place(number & 0xffff)]
}
