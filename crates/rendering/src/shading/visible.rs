//! Data of visible faces at their pixels: ids, depths, and the inputs of their colours.

use std::ops::Range;

use wide::u32x8;

use crate::coverage::band::NO_FACE;
use crate::coverage::face::Face;
use crate::projection::chunk::{Chunk, face};
use crate::projection::owner::Owner;
use crate::projection::view::View;
use crate::shading::lighting::Lighting;
use crate::{Background, Fog, Picture};

/// Everything that shading needs to know.
pub struct Shading<'a> {
    pub view: &'a View,
    pub owners: &'a [Owner<'a>],
    pub chunks: &'a [Chunk],
    pub lighting: Lighting<'a>,
    pub fog: Option<Fog>,
    pub background: Background,
}

/// Neighbouring pixels of a row that show the same face, or none.
#[derive(Debug, Clone)]
pub struct Run {
    pub pixels: Range<usize>,
    pub face: u32,
}

/// Pixels that are compared at once: most rows have long runs.
const STRETCH: usize = 64;

/// Lists the runs of a row, from the left to the right.
pub fn find_runs(faces: &[u32], runs: &mut Vec<Run>) {
    runs.clear();
    let mut start = 0;
    let mut end_run = |end: usize| {
        runs.push(Run {
            pixels: start..end,
            face: faces[start],
        });
        start = end;
    };
    let Some((_, next)) = faces.split_first() else {
        return;
    };
    let (stretches, rest) = next.as_chunks::<STRETCH>();
    for (at, stretch) in stretches.iter().enumerate() {
        let first = STRETCH * at;
        if faces[first..first + STRETCH] != *stretch {
            find_changes(&faces[first..], stretch.as_chunks().0, |at| {
                end_run(first + at);
            });
        }
    }
    let first = STRETCH * stretches.len();
    let (blocks, rest) = rest.as_chunks();
    find_changes(&faces[first..], blocks, |at| end_run(first + at));
    for at in faces.len() - rest.len()..faces.len() {
        if faces[at - 1] != faces[at] {
            end_run(at);
        }
    }
    end_run(faces.len());
}

/// Calls `end_run` with each place whose face is another one than that before. `next`: the faces, from the second on.
fn find_changes(faces: &[u32], next: &[[u32; 8]], mut end_run: impl FnMut(usize)) {
    for (block, next) in next.iter().enumerate() {
        let own = eight(&faces[8 * block..]);
        let mut changes = !own.simd_eq(u32x8::from(*next)).to_bitmask() & 0xff;
        while changes != 0 {
            end_run(8 * block + numbers::place(changes.trailing_zeros()) + 1);
            changes &= changes - 1;
        }
    }
}

fn eight(faces: &[u32]) -> u32x8 {
    u32x8::from(*faces.first_chunk().expect("there are as many next ones"))
}

impl<'a> Shading<'a> {
    /// The face with a number, and its owner.
    pub fn face(&self, number: u32) -> Option<(&'a Face, &'a Owner<'a>)> {
        let face = (number != NO_FACE).then(|| face(self.chunks, number))?;
        Some((face, &self.owners[numbers::place(face.owner)]))
    }

    /// The ids of a row.
    pub fn ids(&self, runs: &[Run], ids: &mut [u32]) {
        for run in runs {
            let owner = self.face(run.face).map(|(_, owner)| owner);
            ids[run.pixels.clone()].fill(owner.map_or(Picture::NOTHING, |owner| owner.id));
        }
    }

    /// `(z - near) / (far - near)` of the pixels of a row.
    pub fn depths(&self, y: usize, runs: &[Run], depths: &mut [f32]) {
        for Run { pixels, face } in runs {
            let depths = &mut depths[pixels.clone()];
            let Some((face, _)) = self.face(*face) else {
                depths.fill(1.0);
                continue;
            };
            let four = |at: usize| {
                let ray = self.view.ray(pixels.start + at, y);
                self.view.relative_depths(face, ray)
            };
            let (blocks, rest) = depths.as_chunks_mut::<4>();
            let whole = 4 * blocks.len();
            for (block, depths) in blocks.iter_mut().enumerate() {
                *depths = four(4 * block);
            }
            if !rest.is_empty() {
                rest.copy_from_slice(&four(whole)[..rest.len()]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_end_where_the_face_changes() {
        for lengths in [
            vec![],
            vec![1],
            vec![8],
            vec![9],
            vec![1, 1, 30, 2],
            vec![7, 1, 1, 8, 16, 3],
            vec![64, 65, 1],
            vec![1, 127, 64, 9],
            vec![200, 7, 130],
        ] {
            let faces: Vec<u32> = (7..)
                .zip(&lengths)
                .flat_map(|(face, length)| vec![face; *length])
                .collect();
            let mut runs = Vec::new();
            find_runs(&faces, &mut runs);
            let found: Vec<usize> = runs.iter().map(|run| run.pixels.len()).collect();
            assert_eq!(found, lengths);
            let all: Vec<u32> = runs
                .iter()
                .flat_map(|run| vec![run.face; run.pixels.len()])
                .collect();
            assert_eq!(all, faces);
        }
    }
}
