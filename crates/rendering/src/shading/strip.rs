//! Rows of a picture that are filled together: faces are drawn, then shaded row by row.

use std::ops::Range;

use crate::coverage::band::{Band, Fragment, NO_FACE};
use crate::projection::chunk::face_number;
use crate::projection::owner::Pass;
use crate::shading::painter::Painter;
use crate::shading::row::Row;
use crate::shading::visible::{Run, Shading, find_runs};

/// Fragments whose memory is used again; that of more is freed, since each strip has its own.
const KEPT_FRAGMENTS: usize = 1 << 16;

/// The memory for some rows.
#[derive(Debug, Default)]
pub struct Strip {
    band: Band,
    /// Fragments drawn over the opaque faces.
    fragments: Vec<Fragment>,
    row: Row,
    /// The faces of the closest fragments.
    closest: Vec<u32>,
    runs: Vec<Run>,
    layer: Vec<u32>,
    layer_row: Row,
}

/// The channels of a strip; those that are not wanted are empty.
pub struct Pixels<'a> {
    pub colour: &'a mut [u8],
    pub depth: &'a mut [f32],
    pub ids: &'a mut [u32],
}

impl Strip {
    pub fn fill(&mut self, shading: &Shading, rows: Range<usize>, pixels: &mut Pixels) {
        self.band.clear(
            shading.view.resolution,
            rows.clone(),
            numbers::single(shading.view.far_closeness()),
        );
        self.draw(shading);
        self.shade(shading, pixels);
        if self.fragments.len() > KEPT_FRAGMENTS {
            self.fragments = Vec::new();
        }
    }

    fn draw(&mut self, shading: &Shading) {
        let rows = self.band.rows.clone();
        for (at, chunk) in shading.chunks.iter().enumerate() {
            for (face_at, face, _) in chunk.faces_in(rows.clone(), shading.owners, true) {
                self.band.draw(face, face_number(at, face_at));
            }
        }
        self.fragments.clear();
        for (at, chunk) in shading.chunks.iter().enumerate() {
            for (face_at, face, owner) in chunk.faces_in(rows.clone(), shading.owners, false) {
                let is_overlay = owner.pass == Pass::Overlay;
                self.band.collect(
                    face,
                    face_number(at, face_at),
                    is_overlay,
                    &mut self.fragments,
                );
            }
        }
        self.fragments.sort_unstable();
    }

    fn shade(&mut self, shading: &Shading, pixels: &mut Pixels) {
        let width = numbers::place(shading.view.resolution[0]);
        self.row.begin(width);
        if !self.fragments.is_empty() {
            self.layer_row.begin(width);
        }
        let mut first = 0;
        for at in 0..self.band.rows.len() {
            let count = self.fragments[first..]
                .iter()
                .take_while(|fragment| numbers::place(fragment.row) == at)
                .count();
            let fragments = first..first + count;
            first += count;
            self.shade_row(shading, at, fragments, pixels);
        }
    }

    fn shade_row(
        &mut self,
        shading: &Shading,
        at: usize,
        fragments: Range<usize>,
        pixels: &mut Pixels,
    ) {
        let (y, width) = (self.band.rows.start + at, self.band.row(at).len());
        if fragments.is_empty() {
            find_runs(self.band.row(at), &mut self.runs);
        } else {
            self.find_closest(shading, at, fragments.clone());
            find_runs(&self.closest, &mut self.runs);
        }
        if let Some(ids) = pixels.ids.get_mut(at * width..(at + 1) * width) {
            shading.ids(&self.runs, ids);
        }
        if let Some(depths) = pixels.depth.get_mut(at * width..(at + 1) * width) {
            shading.depths(y, &self.runs, depths);
        }
        let Some(colours) = pixels.colour.get_mut(3 * at * width..3 * (at + 1) * width) else {
            return;
        };
        if fragments.is_empty() && shading.fog.is_none() {
            return Painter::new(shading, &mut self.row, y, Some(colours)).paint(&self.runs);
        }
        find_runs(self.band.row(at), &mut self.runs);
        Painter::new(shading, &mut self.row, y, None).paint(&self.runs);
        self.blend(shading, at, fragments);
        self.row.write_bytes(0..width, colours);
    }

    /// Finds the closest faces of a row with fragments, for depths and ids.
    fn find_closest(&mut self, shading: &Shading, at: usize, fragments: Range<usize>) {
        self.closest.clear();
        self.closest.extend(self.band.row(at));
        for fragment in &self.fragments[fragments] {
            if shading
                .face(fragment.face())
                .is_some_and(|(_, owner)| !owner.is_decoration)
            {
                self.closest[numbers::place(fragment.column)] = fragment.face();
            }
        }
    }

    /// Blends the fragments of a row over its opaque faces: first the farthest of each pixel, then the next ones.
    fn blend(&mut self, shading: &Shading, at: usize, fragments: Range<usize>) {
        let mut visible = visible(shading, &self.fragments[fragments]);
        visible.sort_by_key(|(layer, _)| *layer);
        for layer in visible.chunk_by(|a, b| a.0 == b.0) {
            self.layer.clear();
            self.layer.resize(self.band.row(at).len(), NO_FACE);
            for (_, fragment) in layer {
                self.layer[numbers::place(fragment.column)] = fragment.face();
            }
            find_runs(&self.layer, &mut self.runs);
            let y = self.band.rows.start + at;
            Painter::new(shading, &mut self.layer_row, y, None).paint(&self.runs);
            self.row.blend(shading, &self.layer_row, &self.runs);
        }
    }
}

/// The fragments of a row that no opaque one covers, with their places in their pixels: 0 is the farthest.
fn visible<'a>(shading: &Shading, fragments: &'a [Fragment]) -> Vec<(usize, &'a Fragment)> {
    let is_opaque = |fragment: &Fragment| {
        shading
            .face(fragment.face())
            .is_some_and(|(_, owner)| owner.opacity == 1.0)
    };
    let pixels = fragments.chunk_by(|a, b| a.column == b.column);
    let uncovered = pixels.map(|pixel| &pixel[pixel.iter().rposition(is_opaque).unwrap_or(0)..]);
    uncovered
        .flat_map(|pixel| pixel.iter().enumerate())
        .collect()
}
