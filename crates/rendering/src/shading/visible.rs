//! Data of visible faces at their pixels: ids, depths, and the inputs of their colours.

use std::ops::Range;

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

/// The runs of equal numbers in a row.
pub fn runs(faces: &[u32]) -> impl Iterator<Item = (Range<usize>, u32)> {
    let mut start = 0;
    faces.chunk_by(|a, b| a == b).map(move |run| {
        start += run.len();
        (start - run.len()..start, run[0])
    })
}

impl<'a> Shading<'a> {
    /// The face with a number, and its owner.
    pub fn face(&self, number: u32) -> Option<(&'a Face, &'a Owner<'a>)> {
        let face = (number != NO_FACE).then(|| face(self.chunks, number))?;
        Some((face, &self.owners[numbers::place(face.owner)]))
    }

    /// The ids of a row.
    pub fn ids(&self, faces: &[u32], ids: &mut [u32]) {
        for (run, number) in runs(faces) {
            ids[run].fill(
                self.face(number)
                    .map_or(Picture::NOTHING, |(_, owner)| owner.id),
            );
        }
    }

    /// `(z - near) / (far - near)` of the pixels of a row.
    pub fn depths(&self, y: usize, faces: &[u32], depths: &mut [f32]) {
        for (run, number) in runs(faces) {
            let Some((face, _)) = self.face(number) else {
                depths[run].fill(1.0);
                continue;
            };
            for (block, depths) in depths[run.clone()].chunks_mut(4).enumerate() {
                let four = self
                    .view
                    .relative_depths(face, self.view.ray(run.start + 4 * block, y));
                depths.copy_from_slice(&four[..depths.len()]);
            }
        }
    }
}
