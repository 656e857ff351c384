//! From a world to a picture, in three passes: list what is in view, project its triangles, fill bands of rows.

use std::ops::Range;

use crate::parallel::Workers;
use crate::projection::chunk::Chunks;
use crate::projection::owner::{Owner, owners};
use crate::projection::view::View;
use crate::shading::lighting::Lighting;
use crate::shading::strip::{Pixels, Strip};
use crate::shading::visible::Shading;
use crate::{Camera, Channels, Picture, World};

/// Pixels of a strip, at least and at most: what is known of them stays in the cache of a core while faces are drawn and shaded.
const STRIP_PIXELS: [usize; 2] = [2048, 40_960];

/// What a thread draws at least: pixels, and chunks of triangles.
const THREAD_PIXELS: usize = 16_384;
const THREAD_CHUNKS: usize = 4;

/// Draws pictures. It keeps its memory between them.
#[derive(Debug, Default)]
pub struct Renderer {
    workers: Workers,
    chunks: Chunks,
    /// One for each part of a picture that has a thread of its own.
    strips: Vec<Strip>,
}

impl Renderer {
    /// On up to `threads` threads; the pictures do not depend on their number.
    pub fn new(threads: usize) -> Self {
        Self {
            workers: Workers::new(threads),
            ..Self::default()
        }
    }

    /// A picture. Where the camera can see nothing (numbers that are not finite, `near` beyond `far`), it is empty.
    pub fn render(&mut self, world: &World, camera: &Camera, channels: Channels) -> Picture {
        let mut picture = Picture::default();
        self.render_into(world, camera, channels, &mut picture);
        picture
    }

    /// The same into a picture whose memory is used again.
    pub fn render_into(
        &mut self,
        world: &World,
        camera: &Camera,
        channels: Channels,
        picture: &mut Picture,
    ) {
        picture.resize(
            camera
                .resolution
                .map(|side| side.min(Camera::MAX_RESOLUTION)),
            channels,
        );
        if picture.resolution.contains(&0) {
            return;
        }
        let Some(view) = View::new(camera) else {
            return picture.fill(&world.background);
        };
        let owners = owners(world, &view, channels);
        self.list_pieces(&owners, &view);
        self.workers
            .for_each(self.chunks.all_mut(), THREAD_CHUNKS, |_, chunk| {
                chunk.project(&owners, &view);
            });
        let shading = Shading {
            view: &view,
            owners: &owners,
            chunks: self.chunks.all(),
            lighting: Lighting::new(world, &view),
            fog: world.fog,
            background: world.background,
        };
        fill(&shading, &self.workers, &mut self.strips, picture);
    }

    fn list_pieces(&mut self, owners: &[Owner], view: &View) {
        self.chunks.clear();
        for (at, owner) in owners.iter().enumerate() {
            if owner.content.may_be_seen(view) {
                owner
                    .content
                    .pieces()
                    .enumerate()
                    .for_each(|(piece, elements)| self.chunks.push(at, piece, elements));
            }
        }
    }
}

/// Draws and shades all rows.
fn fill(shading: &Shading, workers: &Workers, strips: &mut Vec<Strip>, picture: &mut Picture) {
    let resolution @ [width, height] = picture.resolution.map(numbers::place);
    let threads = workers.count().min(width * height / THREAD_PIXELS).max(1);
    let rows = strip_rows(resolution, threads);
    let parts = parts(picture, rows);
    let count = if threads == 1 { 1 } else { parts.len() };
    if strips.len() < count {
        strips.resize_with(count, Strip::default);
    }
    if threads == 1 {
        for (rows, mut pixels) in parts {
            strips[0].fill(shading, rows, &mut pixels);
        }
        return;
    }
    let mut parts: Vec<_> = strips.iter_mut().zip(parts).collect();
    let least = THREAD_PIXELS.div_ceil(width * rows);
    workers.for_each(&mut parts, least, |_, (strip, (rows, pixels))| {
        strip.fill(shading, rows.clone(), pixels);
    });
}

/// The rows of each strip, and their pixels.
fn parts(picture: &mut Picture, rows: usize) -> Vec<(Range<usize>, Pixels<'_>)> {
    let [width, height] = picture.resolution.map(numbers::place);
    let mut colour = picture.colour.chunks_mut(3 * width * rows);
    let mut depth = picture.depth.chunks_mut(width * rows);
    let mut ids = picture.ids.chunks_mut(width * rows);
    let part = |first: usize| {
        let pixels = Pixels {
            colour: colour.next().unwrap_or_default(),
            depth: depth.next().unwrap_or_default(),
            ids: ids.next().unwrap_or_default(),
        };
        (first..height.min(first + rows), pixels)
    };
    (0..height).step_by(rows).map(part).collect()
}

/// How many rows a strip has.
fn strip_rows([width, height]: [usize; 2], threads: usize) -> usize {
    let strips = if threads == 1 { 1 } else { 4 * threads };
    let [least, most] = STRIP_PIXELS;
    let pixels = (width * height.div_ceil(strips)).clamp(least, most);
    pixels.div_ceil(width)
}
