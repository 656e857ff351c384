//! Blobs of shapes: a mesh or image that several shapes share is made once.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use crate::blobs::Blob;
use scene::Scene;
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{TextureMapping, TextureSource};
use scene::shape::Part;

/// Blobs of meshes and images that are shown.
#[derive(Default)]
pub(super) struct Meshes {
    meshes: BTreeMap<Key, (Option<Part>, Arc<Blob>)>,
    /// By the address of the pixels.
    images: BTreeMap<usize, (Option<Texture>, Arc<Blob>)>,
    /// Addresses mean the same until [`forget`](Self::forget): nothing of the simulator is kept.
    pub(super) keeps_nothing: bool,
    /// There were new ones since those without use were dropped.
    has_new: bool,
}

/// What the blob of a mesh is made of: the addresses of its lists, or the numbers themselves. The lists never change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    mesh: usize,
    coordinates: usize,
    mapping: Option<(i32, [u64; 9])>,
    pose: [u64; 7],
    edges: Option<u64>,
}

impl Key {
    fn of(part: &Part, edges: Option<f64>) -> Self {
        let bits = |pose: &scene::Pose| geometry::pose::pose_to_array(pose).map(f64::to_bits);
        let mapping = |mapping: &TextureMapping| {
            let [x, y, z, qx, qy, qz, qw] = bits(&mapping.frame);
            let [u, v] = mapping.scale.map(f64::to_bits);
            (mapping.mode.0, [u, v, x, y, z, qx, qy, qz, qw])
        };
        let texture = part.texture.as_deref();
        Self {
            mesh: Rc::as_ptr(&part.mesh) as usize,
            coordinates: texture.map_or(0, |mapping| mapping.coordinates.as_ptr() as usize),
            mapping: texture.map(mapping),
            pose: bits(&part.pose),
            edges: edges.map(f64::to_bits),
        }
    }
}

/// Whether a mesh shows what a vision sensor sees.
pub(super) fn is_screen(part: &Part) -> bool {
    part.texture
        .as_ref()
        .is_some_and(|texture| matches!(texture.source, TextureSource::Sensor(_)))
}

impl Meshes {
    /// The blob of a mesh.
    pub(super) fn mesh(&mut self, part: &Part) -> Arc<Blob> {
        let edges = part.appearance.edges.then_some(part.appearance.edge_angle);
        self.has_new = true;
        // The copy of the part keeps the addresses in use while they are a key.
        let kept = || (!self.keeps_nothing).then(|| part.clone());
        let (_, blob) = self
            .meshes
            .entry(Key::of(part, edges))
            .or_insert_with(|| (kept(), Blob::mesh(part, edges)));
        Arc::clone(blob)
    }

    /// The blob of the image on a mesh; none where there is no such image.
    pub(super) fn image(&mut self, scene: &Scene, source: TextureSource) -> Option<Arc<Blob>> {
        let id = match source {
            TextureSource::Texture(id) => id,
            TextureSource::Sensor(sensor) => {
                let sensor = scene.object(sensor).ok()?.vision_sensor().ok()?;
                let rgba: Vec<u8> = sensor
                    .image()
                    .chunks_exact(3)
                    .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], u8::MAX])
                    .collect();
                return Some(Blob::image(sensor.view.resolution, &rgba));
            }
        };
        let texture = scene.textures().get(id).ok()?;
        self.has_new = true;
        let at = texture.pixels().as_ptr() as usize;
        let kept = || (!self.keeps_nothing).then(|| texture.clone());
        let (_, blob) = self
            .images
            .entry(at)
            .or_insert_with(|| (kept(), Blob::texture(texture)));
        Some(Arc::clone(blob))
    }

    /// Forgets all blobs: the addresses may be those of others now.
    pub(super) fn forget(&mut self) {
        self.meshes.clear();
        self.images.clear();
    }

    /// Forgets blobs that no object shows any more.
    pub(super) fn drop_unused(&mut self) {
        if std::mem::take(&mut self.has_new) {
            self.meshes
                .retain(|_, (_, blob)| Arc::strong_count(blob) > 1);
            self.images
                .retain(|_, (_, blob)| Arc::strong_count(blob) > 1);
        }
    }
}
