//! The colours of a row, run by run from the left to the right.

use std::ops::Range;

use crate::Material;
use crate::coverage::face::Face;
use crate::projection::owner::{Content, Owner};
use crate::projection::strokes::unpacked;
use crate::shading::bytes;
use crate::shading::row::Row;
use crate::shading::visible::{Run, Shading};

/// Computes the colours of a row.
pub struct Painter<'a> {
    shading: &'a Shading<'a>,
    row: &'a mut Row,
    background: [f32; 3],
    /// Where the colours of the row go; of pixels that have one colour in common only there. Otherwise they stay in the row.
    bytes: Option<&'a mut [u8]>,
    unlit: Unlit<'a>,
}

/// Pixels of one surface whose normals are known, but not their light.
#[derive(Default)]
struct Unlit<'a> {
    pixels: Range<usize>,
    surface: Option<&'a Material>,
}

impl<'a> Painter<'a> {
    pub fn new(
        shading: &'a Shading<'a>,
        row: &'a mut Row,
        y: usize,
        bytes: Option<&'a mut [u8]>,
    ) -> Self {
        row.y = y;
        let rows = numbers::place(shading.view.resolution[1]);
        Self {
            shading,
            row,
            background: shading.background.row(y, rows),
            bytes,
            unlit: Unlit::default(),
        }
    }

    /// Paints a whole row.
    pub fn paint(mut self, runs: &[Run]) {
        for Run { pixels, face } in runs {
            match self.shading.face(*face) {
                Some((seen, owner)) => self.paint_face(pixels.clone(), *face, seen, owner),
                None => self.fill(pixels.clone(), self.background),
            }
        }
        self.light();
        self.row.cover_with_fog(self.shading, runs);
    }

    fn paint_face(&mut self, pixels: Range<usize>, number: u32, face: &Face, owner: &'a Owner) {
        let shading = self.shading;
        let texture = owner.content.material().and_then(|m| m.texture.as_ref());
        if !shading.lighting.is_uniform || shading.fog.is_some() || texture.is_some() {
            self.row.find_depths(shading.view, face, pixels.clone());
        }
        let Content::Surface(surface, material) = &owner.content else {
            return self.fill(pixels, unpacked(face.detail));
        };
        let remembered = self.row.remember(shading, surface, material, face, number);
        match (remembered.colour, texture) {
            (Some(colour), None) => self.fill(pixels, colour),
            (Some(colour), Some(_)) => self.cover(pixels, number, material, colour),
            (None, _) => self.interpolate(pixels, number, material),
        }
    }

    /// One colour for all pixels.
    fn fill(&mut self, pixels: Range<usize>, colour: [f32; 3]) {
        self.light();
        match &mut self.bytes {
            Some(bytes) => bytes::fill(&mut bytes[3 * pixels.start..3 * pixels.end], colour),
            None => self.row.fill(pixels, colour),
        }
    }

    /// A texture on a surface that is lit in the same way everywhere.
    fn cover(
        &mut self,
        pixels: Range<usize>,
        number: u32,
        material: &'a Material,
        colour: [f32; 3],
    ) {
        self.light();
        self.row.fill(pixels.clone(), colour);
        self.row.interpolate_uv(number, pixels.clone());
        self.finish(material, pixels);
    }

    /// Leaves pixels to be lit together with those to the left and to the right of the same surface.
    fn interpolate(&mut self, pixels: Range<usize>, number: u32, material: &'a Material) {
        let continues = self
            .unlit
            .surface
            .is_some_and(|other| std::ptr::eq(material, other));
        if !continues {
            self.light();
            self.unlit = Unlit {
                pixels: pixels.clone(),
                surface: Some(material),
            };
        }
        self.unlit.pixels.end = pixels.end;
        self.row.interpolate_normals(number, pixels.clone());
        if material.texture.is_some() {
            self.row.interpolate_uv(number, pixels);
        }
    }

    /// Lights what is unlit.
    fn light(&mut self) {
        if let Some(material) = self.unlit.surface.take() {
            let pixels = self.unlit.pixels.clone();
            self.row.light(self.shading, material, pixels.clone());
            self.finish(material, pixels);
        }
    }

    /// Applies the texture to pixels that are lit, and writes them.
    fn finish(&mut self, material: &Material, pixels: Range<usize>) {
        if let Some(texture) = &material.texture {
            let view = self.shading.view;
            self.row.apply_texture(view, texture, pixels.clone());
        }
        if let Some(bytes) = &mut self.bytes {
            self.row.write_bytes(pixels, bytes);
        }
    }
}
