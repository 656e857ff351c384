//! The colours of a row of pixels.
//!
//! Normals and texture coordinates are interpolated by *runs*: neighbouring pixels of one face. Light is computed for longer runs of one
//! surface, eight pixels at a time. Blocks of eight pixels are written from the left to the right: what one writes beyond its run
//! is overwritten by the next.

use std::ops::Range;

use wide::f32x8;

use crate::Material;
use crate::coverage::band::NO_FACE;
use crate::coverage::face::{Face, LANES};
use crate::projection::owner::{Content, Owner};
use crate::projection::strokes::unpacked;
use crate::projection::view::View;
use crate::shading::attributes::Attributes;
use crate::shading::lighting::Vectors;
use crate::shading::visible::{Shading, runs};
use crate::three::three;

/// Number of faces whose attributes are kept from row to row.
const MAX_CACHED_FACES: usize = 512;

/// The pixels of a row while they are shaded, with room for eight more.
#[derive(Debug, Default)]
pub struct Row {
    y: usize,
    pub colour: [Vec<f32>; 3],
    normal: [Vec<f32>; 3],
    uv: [Vec<f32>; 2],
    /// Metres; only where something depends on it.
    depth: Vec<f32>,
    /// By the last digits of the number of a face.
    remembered: Vec<Remembered>,
}

/// Values common to the pixels of a face.
#[derive(Debug, Clone, Default)]
struct Remembered {
    face: Option<u32>,
    attributes: Attributes,
    /// Where it is the same everywhere.
    colour: Option<[f32; 3]>,
}

/// Pixels of one surface whose normals are known, but not their light.
struct Unlit<'a> {
    pixels: Range<usize>,
    surface: Option<&'a Material>,
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
        self.remembered.clear();
        self.remembered
            .resize(MAX_CACHED_FACES, Remembered::default());
    }

    /// Computes the colours of a row from the numbers of its faces.
    pub fn shade(&mut self, shading: &Shading, y: usize, faces: &[u32]) {
        self.y = y;
        let background = shading
            .background
            .row(y, numbers::place(shading.view.resolution[1]));
        let mut unlit = Unlit {
            pixels: 0..0,
            surface: None,
        };
        for (run, number) in runs(faces) {
            let Some((face, owner)) = shading.face(number) else {
                self.light(shading, &mut unlit, None);
                self.fill(run, background);
                continue;
            };
            let material = owner.content.material();
            let is_textured = material.is_some_and(|material| material.texture.is_some());
            if !shading.lighting.is_uniform || shading.fog.is_some() || is_textured {
                self.find_depths(shading.view, face, run.clone());
            }
            match (material, self.known_colour(shading, owner, face, number)) {
                (Some(material), None) => {
                    self.light(shading, &mut unlit, Some((material, run.start)));
                    self.interpolate(number, is_textured, run.clone());
                    unlit.pixels.end = run.end;
                }
                (_, colour) => {
                    self.light(shading, &mut unlit, None);
                    self.fill(run, colour.unwrap_or_default());
                }
            }
        }
        self.light(shading, &mut unlit, None);
        self.cover_with_fog(shading, faces);
    }

    fn fill(&mut self, run: Range<usize>, colour: [f32; 3]) {
        self.colour
            .iter_mut()
            .zip(colour)
            .for_each(|(list, part)| list[run.clone()].fill(part));
    }

    fn find_depths(&mut self, view: &View, face: &Face, run: Range<usize>) {
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

    /// The colour of a face where it is the same everywhere.
    fn known_colour(
        &mut self,
        shading: &Shading,
        owner: &Owner,
        face: &Face,
        number: u32,
    ) -> Option<[f32; 3]> {
        let Content::Surface(surface, material) = &owner.content else {
            return Some(unpacked(face.detail));
        };
        let entry = &mut self.remembered[numbers::place(number) % MAX_CACHED_FACES];
        if entry.face != Some(number) {
            let attributes =
                Attributes::new(shading.view, surface, face, material.texture.is_some());
            let is_uniform =
                attributes.is_flat && shading.lighting.is_uniform && material.texture.is_none();
            let colour = is_uniform.then(|| {
                let normals = attributes.normals(0, 0);
                shading
                    .lighting
                    .lit(material, normals, [f32x8::ZERO; 3], 0)
                    .map(|part| part.to_array()[0])
            });
            *entry = Remembered {
                face: Some(number),
                attributes,
                colour,
            };
        }
        entry.colour
    }

    fn interpolate(&mut self, number: u32, is_textured: bool, run: Range<usize>) {
        let attributes = &self.remembered[numbers::place(number) % MAX_CACHED_FACES].attributes;
        for x in run.clone().step_by(8) {
            let normals = attributes.normals(x, self.y);
            self.normal
                .iter_mut()
                .zip(normals)
                .for_each(|(list, part)| store(list, x, part));
        }
        for x in run.step_by(8).filter(|_| is_textured) {
            let uv = attributes.uv(x, self.y);
            self.uv
                .iter_mut()
                .zip(uv)
                .for_each(|(list, part)| store(list, x, part));
        }
    }

    /// Lights what is unlit, unless what comes next is of the same surface.
    fn light<'a>(
        &mut self,
        shading: &Shading,
        unlit: &mut Unlit<'a>,
        next: Option<(&'a Material, usize)>,
    ) {
        if let (Some(material), Some((other, _))) = (unlit.surface, next)
            && std::ptr::eq(material, other)
        {
            return;
        }
        if let Some(material) = unlit.surface {
            for x in unlit.pixels.clone().step_by(8) {
                let normals = three(|i| load(&self.normal[i], x));
                let colours = shading.lighting.lit(
                    material,
                    normals,
                    self.points(shading.view, x),
                    unlit.pixels.end - x,
                );
                self.colour
                    .iter_mut()
                    .zip(colours)
                    .for_each(|(list, part)| store(list, x, part));
            }
            self.apply_texture(shading.view, material, unlit.pixels.clone());
        }
        let start = next.map_or(0, |(_, start)| start);
        *unlit = Unlit {
            pixels: start..start,
            surface: next.map(|(material, _)| material),
        };
    }

    /// Eight points in the camera's axes: right, up, depth; metres.
    fn points(&self, view: &View, x: usize) -> Vectors {
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

    fn apply_texture(&mut self, view: &View, material: &Material, pixels: Range<usize>) {
        let Some(texture) = &material.texture else {
            return;
        };
        for x in pixels {
            let scale = if view.perspective { self.depth[x] } else { 1.0 };
            let sample = texture.sample([self.uv[0][x] * scale, self.uv[1][x] * scale]);
            let colour = texture.combine(three(|i| self.colour[i][x]), sample);
            (0..3).for_each(|i| self.colour[i][x] = colour[i]);
        }
    }

    fn cover_with_fog(&mut self, shading: &Shading, faces: &[u32]) {
        let Some(fog) = &shading.fog else { return };
        for x in (0..faces.len()).filter(|x| faces[*x] != NO_FACE) {
            let colour = fog.cover(three(|i| self.colour[i][x]), f64::from(self.depth[x]));
            (0..3).for_each(|i| self.colour[i][x] = colour[i]);
        }
    }

    /// Blends the pixels of another row over its own.
    pub fn blend(&mut self, shading: &Shading, other: &Self, faces: &[u32]) {
        for (run, number) in runs(faces) {
            let Some((_, owner)) = shading.face(number) else {
                continue;
            };
            for (own, other) in self.colour.iter_mut().zip(&other.colour) {
                let pixels = own[run.clone()].iter_mut().zip(&other[run.clone()]);
                pixels.for_each(|(own, other)| *own += (other - *own) * owner.opacity);
            }
        }
    }

    /// Writes red, green and blue in 8 bits: 0 to 1 becomes 0 to 255, rounded.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the colours were limited to 0 to 255; this runs for every pixel"
    )]
    pub fn write_bytes(&self, pixels: &mut [u8]) {
        for (at, block) in pixels.chunks_mut(3 * 8).enumerate() {
            let parts = three(|i| {
                let limited = load(&self.colour[i], 8 * at)
                    .max(f32x8::ZERO)
                    .min(f32x8::ONE);
                (limited * 255.0 + 0.5).fast_trunc_int().to_array()
            });
            for (lane, pixel) in block.chunks_exact_mut(3).enumerate() {
                pixel.copy_from_slice(&three(|i| parts[i][lane] as u8));
            }
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
