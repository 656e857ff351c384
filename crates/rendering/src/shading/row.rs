//! The colours of a row of pixels.
//!
//! Normals and texture coordinates are interpolated by *runs*: neighbouring pixels of one face. Light is computed for longer runs of one
//! surface, eight pixels at a time. Blocks of eight pixels are written from the left to the right: what one writes beyond its run
//! is overwritten by the next.

use std::ops::Range;

use wide::f32x8;

use crate::coverage::band::NO_FACE;
use crate::coverage::face::{Face, LANES};
use crate::projection::surface::Surface;
use crate::projection::view::View;
use crate::shading::attributes::Attributes;
use crate::shading::bytes;
use crate::shading::lighting::Vectors;
use crate::shading::visible::{Run, Shading};
use crate::three::three;
use crate::{Material, Texture};

/// Number of faces whose attributes are kept from row to row.
const MAX_CACHED_FACES: usize = 2048;

/// The pixels of a row while they are shaded, with room for eight more.
#[derive(Debug, Default)]
pub struct Row {
    pub y: usize,
    colour: [Vec<f32>; 3],
    normal: [Vec<f32>; 3],
    uv: [Vec<f32>; 2],
    /// Metres; only where something depends on it.
    depth: Vec<f32>,
    /// How many pictures were begun.
    picture: u64,
    /// By the last digits of the number of a face.
    remembered: Vec<Remembered>,
}

/// Values common to the pixels of a face.
#[derive(Debug, Clone, Default)]
pub struct Remembered {
    /// The picture, counted from 1, and the number of the face in it.
    face: (u64, u32),
    attributes: Attributes,
    /// Where it is the same everywhere.
    pub colour: Option<[f32; 3]>,
}

impl Row {
    /// Prepares for a picture.
    pub fn begin(&mut self, width: usize) {
        let lists = self
            .colour
            .iter_mut()
            .chain(&mut self.normal)
            .chain(&mut self.uv)
            .chain([&mut self.depth]);
        lists.for_each(|list| list.resize(width + 8, 0.0));
        self.picture += 1;
        self.remembered
            .resize(MAX_CACHED_FACES, Remembered::default());
    }

    pub fn fill(&mut self, pixels: Range<usize>, colour: [f32; 3]) {
        self.colour
            .iter_mut()
            .zip(colour)
            .for_each(|(list, part)| list[pixels.clone()].fill(part));
    }

    pub fn find_depths(&mut self, view: &View, face: &Face, run: Range<usize>) {
        for x in run.step_by(8) {
            let closeness = face.closeness_of_eight(view.ray(x, self.y));
            let far = f32x8::splat(numbers::single(view.far));
            let depth = if view.perspective {
                f32x8::ONE / closeness
            } else {
                far - closeness * numbers::single(view.far - view.near)
            };
            store(&mut self.depth, x, depth);
        }
    }

    /// What the pixels of a face have in common.
    pub fn remember(
        &mut self,
        shading: &Shading,
        surface: &Surface,
        material: &Material,
        face: &Face,
        number: u32,
    ) -> &Remembered {
        let entry = &mut self.remembered[numbers::place(number) % MAX_CACHED_FACES];
        let face_now = (self.picture, number);
        if entry.face != face_now {
            let attributes =
                Attributes::new(shading.view, surface, face, material.texture.is_some());
            let is_uniform = attributes.is_flat && shading.lighting.is_uniform;
            let colour = is_uniform.then(|| {
                let normals = attributes.normals(0, 0);
                shading
                    .lighting
                    .lit(material, normals, [f32x8::ZERO; 3], 0)
                    .map(|part| part.to_array()[0])
            });
            *entry = Remembered {
                face: face_now,
                attributes,
                colour,
            };
        }
        entry
    }

    /// The normals of pixels of a face that is remembered.
    pub fn interpolate_normals(&mut self, number: u32, pixels: Range<usize>) {
        let attributes = &self.remembered[numbers::place(number) % MAX_CACHED_FACES].attributes;
        for x in pixels.step_by(8) {
            let normals = attributes.normals(x, self.y);
            self.normal
                .iter_mut()
                .zip(normals)
                .for_each(|(list, part)| store(list, x, part));
        }
    }

    /// The texture coordinates of pixels of a face that is remembered.
    pub fn interpolate_uv(&mut self, number: u32, pixels: Range<usize>) {
        let attributes = &self.remembered[numbers::place(number) % MAX_CACHED_FACES].attributes;
        for x in pixels.step_by(8) {
            let uv = attributes.uv(x, self.y);
            self.uv
                .iter_mut()
                .zip(uv)
                .for_each(|(list, part)| store(list, x, part));
        }
    }

    /// Lights pixels of a surface.
    pub fn light(&mut self, shading: &Shading, material: &Material, pixels: Range<usize>) {
        for x in pixels.clone().step_by(8) {
            let normals = three(|i| load(&self.normal[i], x));
            let points = self.points(shading, x);
            let count = pixels.end - x;
            let colours = shading.lighting.lit(material, normals, points, count);
            self.store_colours(x, colours);
        }
    }

    /// Eight points in the camera's axes: right, up, depth; metres. Zero where nothing depends on them.
    fn points(&self, shading: &Shading, x: usize) -> Vectors {
        if shading.lighting.is_uniform {
            return [f32x8::ZERO; 3];
        }
        let view = shading.view;
        let ray = view.ray(x, self.y);
        let ray = [
            numbers::single(ray[0] * view.over_scale),
            numbers::single(ray[1] * view.over_scale),
        ];
        let depth = load(&self.depth, x);
        let spread = if view.perspective { depth } else { f32x8::ONE };
        let column = f32x8::splat(ray[0]) + LANES * numbers::single(view.over_scale);
        [column * spread, f32x8::splat(ray[1]) * spread, depth]
    }

    pub fn apply_texture(&mut self, view: &View, texture: &Texture, pixels: Range<usize>) {
        for x in pixels.step_by(8) {
            let [u, v] = [load(&self.uv[0], x), load(&self.uv[1], x)];
            let depth = if view.perspective {
                load(&self.depth, x)
            } else {
                f32x8::ONE
            };
            let lit = three(|i| load(&self.colour[i], x));
            self.store_colours(x, texture.cover(lit, [u * depth, v * depth]));
        }
    }

    fn store_colours(&mut self, x: usize, colours: Vectors) {
        self.colour
            .iter_mut()
            .zip(colours)
            .for_each(|(list, part)| store(list, x, part));
    }

    pub fn cover_with_fog(&mut self, shading: &Shading, runs: &[Run]) {
        let Some(fog) = &shading.fog else { return };
        let seen = runs.iter().filter(|run| run.face != NO_FACE);
        for x in seen.flat_map(|run| run.pixels.clone()) {
            let colour = fog.cover(three(|i| self.colour[i][x]), f64::from(self.depth[x]));
            (0..3).for_each(|i| self.colour[i][x] = colour[i]);
        }
    }

    /// Blends the pixels of another row over its own.
    pub fn blend(&mut self, shading: &Shading, other: &Self, runs: &[Run]) {
        for Run { pixels, face } in runs {
            let Some((_, owner)) = shading.face(*face) else {
                continue;
            };
            for (own, other) in self.colour.iter_mut().zip(&other.colour) {
                let pixels = own[pixels.clone()].iter_mut().zip(&other[pixels.clone()]);
                pixels.for_each(|(own, other)| *own += (other - *own) * owner.opacity);
            }
        }
    }

    /// Writes the colours of some pixels of the row.
    pub fn write_bytes(&self, pixels: Range<usize>, bytes: &mut [u8]) {
        let bytes = &mut bytes[3 * pixels.start..3 * pixels.end];
        for (x, eight) in pixels.step_by(8).zip(bytes.chunks_mut(3 * 8)) {
            bytes::write(eight, three(|i| load(&self.colour[i], x)));
        }
    }
}

fn load(list: &[f32], at: usize) -> f32x8 {
    f32x8::from(
        *list[at..]
            .first_chunk::<8>()
            .expect("rows have room for eight pixels more"),
    )
}

fn store(list: &mut [f32], at: usize, numbers: f32x8) {
    *list[at..]
        .first_chunk_mut::<8>()
        .expect("rows have room for eight pixels more") = numbers.to_array();
}
