//! From a world to a picture, in three passes: list what is in view, project its triangles, fill bands of rows.

use geometry::Finite;

use crate::lighting::Lighting;
use crate::parallel;
use crate::raster::{Band, Face, NO_FACE};
use crate::shade::{Owner, Shading};
use crate::surface::{Setup, Surface};
use crate::view::View;
use crate::{Background, Camera, Channels, Instance, Picture, World};

/// Triangles that one thread projects at a time.
const CHUNK_TRIANGLES: usize = 4096;

/// Draws pictures. It keeps its memory between them.
#[derive(Debug, Default)]
pub struct Renderer {
    threads: usize,
    chunks: Vec<Chunk>,
    bands: Vec<Band>,
}

/// Clusters of owners that are projected together, and the faces they have.
#[derive(Debug, Default)]
struct Chunk {
    clusters: Vec<(usize, usize)>,
    triangles: usize,
    setup: Setup,
}

/// A band and its part of the picture.
struct Rows<'a> {
    band: &'a mut Band,
    colour: &'a mut [u8],
    depth: &'a mut [f32],
    ids: &'a mut [u32],
}

impl Renderer {
    /// On up to `threads` threads; the pictures do not depend on their number.
    pub fn new(threads: usize) -> Self {
        Self { threads: threads.max(1), ..Self::default() }
    }

    /// A picture. Where the camera can see nothing (numbers that are not finite, `near` beyond `far`), it is empty.
    pub fn render(&mut self, world: &World, camera: &Camera, channels: Channels) -> Picture {
        let mut picture = Picture::default();
        self.render_into(world, camera, channels, &mut picture);
        picture
    }

    /// The same into a picture whose memory is used again.
    pub fn render_into(&mut self, world: &World, camera: &Camera, channels: Channels, picture: &mut Picture) {
        let resolution = camera.resolution.map(|side| side.min(Camera::MAX_RESOLUTION));
        picture.clear(resolution, channels);
        if resolution.contains(&0) {
            return;
        }
        let Some(view) = View::new(camera) else { return fill_background(world, picture) };
        let owners = owners(world, &view);
        self.list_clusters(&owners, &view);
        parallel::for_each(self.threads, &mut self.chunks, |_, chunk| chunk.project(&owners, &view));
        let shading = Shading { view: &view, owners: &owners, lighting: Lighting::new(world, &view), fog: world.fog };
        self.fill(&shading, &world.background, picture);
    }

    /// Lists the clusters of what is in view, cut into chunks.
    fn list_clusters(&mut self, owners: &[Owner], view: &View) {
        let mut used = 0;
        for (at, owner) in owners.iter().enumerate() {
            let (mesh, transform) = (owner.surface.mesh, &owner.surface.transform);
            if !view.may_see(transform.apply(&mesh.ball.centre), mesh.ball.radius) {
                continue;
            }
            for (cluster, range) in mesh.clusters.iter().map(|cluster| cluster.triangles.len()).enumerate() {
                if used == 0 || self.chunks[used - 1].triangles + range > CHUNK_TRIANGLES {
                    used += 1;
                    self.chunks.resize_with(self.chunks.len().max(used), Chunk::default);
                    self.chunks[used - 1].clear();
                }
                self.chunks[used - 1].clusters.push((at, cluster));
                self.chunks[used - 1].triangles += range;
            }
        }
        self.chunks.truncate(used);
    }

    fn fill(&mut self, shading: &Shading, background: &Background, picture: &mut Picture) {
        let [width, height] = picture.resolution.map(|side| side as usize);
        let rows = height.div_ceil(if self.threads == 1 { 1 } else { 4 * self.threads });
        self.bands.resize_with(height.div_ceil(rows), Band::default);
        let mut colour = picture.colour.chunks_mut(3 * width * rows);
        let mut depth = picture.depth.chunks_mut(width * rows);
        let mut ids = picture.ids.chunks_mut(width * rows);
        let parts = self.bands.iter_mut().map(|band| Rows {
            band,
            colour: colour.next().unwrap_or_default(),
            depth: depth.next().unwrap_or_default(),
            ids: ids.next().unwrap_or_default(),
        });
        let mut parts: Vec<Rows> = parts.collect();
        let chunks = &self.chunks;
        parallel::for_each(self.threads, &mut parts, |at, part| {
            let end = height.min((at + 1) * rows);
            part.band.clear([width as u32, height as u32], at * rows..end, shading.view.far_closeness() as f32);
            part.draw(chunks);
            part.shade(shading, chunks, background, height);
        });
    }
}

impl Chunk {
    fn clear(&mut self) {
        self.clusters.clear();
        self.triangles = 0;
    }

    fn project(&mut self, owners: &[Owner], view: &View) {
        self.setup.faces.clear();
        for (owner, cluster) in &self.clusters {
            let surface = &owners[*owner].surface;
            self.setup.add_cluster(view, surface, &surface.mesh.clusters[*cluster]);
        }
    }
}

/// A number for a face of a chunk. A chunk has at most six faces for each of its triangles, which is less than 2^16.
fn face_number(chunk: usize, face: usize) -> u32 {
    (chunk as u32) << 16 | face as u32
}

fn face_of(chunks: &[Chunk], number: u32) -> Option<&Face> {
    (number != NO_FACE).then(|| &chunks[(number >> 16) as usize].setup.faces[(number & 0xffff) as usize])
}

impl Rows<'_> {
    fn draw(&mut self, chunks: &[Chunk]) {
        for (at, chunk) in chunks.iter().enumerate() {
            for (face_at, face) in chunk.setup.faces.iter().enumerate() {
                self.band.draw(face, face_number(at, face_at));
            }
        }
    }

    fn shade(&mut self, shading: &Shading, chunks: &[Chunk], background: &Background, height: usize) {
        let width = self.band.row(0).len();
        for row in 0..self.band.rows {
            let y = self.band.first_row + row;
            for (column, number) in self.band.row(row).iter().enumerate() {
                let (at, ray, face) = (row * width + column, shading.view.ray(column, y), face_of(chunks, *number));
                if let Some(id) = self.ids.get_mut(at) {
                    *id = shading.id(face);
                }
                if let Some(depth) = self.depth.get_mut(at) {
                    *depth = shading.depth(face, ray);
                }
                if let Some(pixel) = self.colour.get_mut(3 * at..3 * at + 3) {
                    let colour = face.map_or_else(|| background.row(y, height), |face| shading.colour(face, ray));
                    pixel.copy_from_slice(&bytes(colour));
                }
            }
        }
    }
}

fn owners<'a>(world: &World<'a>, view: &View) -> Vec<Owner<'a>> {
    let finite = world.instances.iter().filter(|instance| instance.pose.is_finite());
    finite.enumerate().map(|(at, instance)| owner(instance, at as u32, view)).collect()
}

fn owner<'a>(instance: &Instance<'a>, at: u32, view: &View) -> Owner<'a> {
    let (mesh, transform) = (instance.mesh, view.transform(&instance.pose));
    let in_front = transform.apply(&mesh.ball.centre).z - mesh.ball.radius > view.near;
    let culling = instance.material.culling || (mesh.closed && in_front);
    Owner { id: instance.id, surface: Surface { mesh, transform, culling, owner: at }, material: instance.material }
}

fn fill_background(world: &World, picture: &mut Picture) {
    let [width, height] = picture.resolution.map(|side| side as usize);
    picture.depth.fill(1.0);
    picture.ids.fill(Picture::NOTHING);
    for (y, row) in picture.colour.chunks_mut(3 * width).enumerate() {
        let colour = bytes(world.background.row(y, height));
        row.chunks_exact_mut(3).for_each(|pixel| pixel.copy_from_slice(&colour));
    }
}

/// A colour in 8 bits: 0 to 1 becomes 0 to 255, rounded.
fn bytes(colour: [f32; 3]) -> [u8; 3] {
    colour.map(|part| (part * 255.0 + 0.5) as u8)
}
