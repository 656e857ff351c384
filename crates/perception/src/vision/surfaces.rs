//! Meshes, materials and images of shapes, in the form the renderer needs. What several shapes share is prepared once.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use rendering::{Edges, Image, Material, Mesh, Texture, TextureMode};

use super::models::ModelPart;
use super::projection;
use scene::Scene;
use scene::appearance::colour::Colour;
use scene::appearance::texture::Texture as SceneTexture;
use scene::appearance::texture_mapping::{ApplyMode, TextureMapping, TextureSource};
use scene::shape::{Appearance, Part};

const EDGE_COLOUR: [f32; 3] = [0.0; 3];
/// Pixels.
const EDGE_WIDTH: f32 = 1.0;

/// Meshes and images that are in use.
#[derive(Default)]
pub(super) struct Surfaces {
    meshes: BTreeMap<MeshKey, Prepared>,
    /// By the address of the pixels.
    images: BTreeMap<usize, (SceneTexture, Arc<Image>)>,
}

/// Identity of a prepared mesh: the addresses of its lists, or the numbers themselves. The lists never change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct MeshKey {
    mesh: usize,
    coordinates: usize,
    projection: Option<(i32, [u64; 9])>,
}

struct Prepared {
    /// None for a mesh without area.
    mesh: Option<Rc<Mesh>>,
    /// They keep their addresses while they are here.
    _source: (Rc<geometry::Mesh>, Option<Rc<[f32]>>),
}

impl MeshKey {
    fn of(part: &Part) -> Self {
        let mapping = part.texture.as_deref();
        let explicit = mapping.filter(|mapping| !mapping.coordinates.is_empty());
        Self {
            mesh: Rc::as_ptr(&part.mesh) as usize,
            coordinates: explicit.map_or(0, |mapping| mapping.coordinates.as_ptr() as usize),
            projection: mapping.filter(|_| explicit.is_none()).map(projection::key),
        }
    }
}

impl Surfaces {
    /// Prepared part of a shape; None when nothing is visible.
    pub(super) fn part(&mut self, scene: &Scene, part: &Part) -> Option<ModelPart> {
        let mesh = self.mesh(part)?;
        let texture = part
            .texture
            .as_deref()
            .and_then(|mapping| self.texture(scene, mapping));
        let appearance = &part.appearance;
        Some(ModelPart {
            mesh,
            auxiliary: Material {
                culling: appearance.culling,
                ..Material::unlit(appearance.colour.auxiliary)
            },
            material: material(appearance, texture),
            pose: part.pose,
        })
    }

    /// Forgets meshes and images that no model uses.
    pub(super) fn drop_unused(&mut self) {
        self.meshes.retain(|_, prepared| {
            prepared
                .mesh
                .as_ref()
                .is_some_and(|mesh| Rc::strong_count(mesh) > 1)
        });
        self.images
            .retain(|_, (_, image)| Arc::strong_count(image) > 1);
    }

    #[cfg(test)]
    pub(super) fn prepared_meshes(&self) -> usize {
        self.meshes.len()
    }

    #[cfg(test)]
    pub(super) fn prepared_images(&self) -> usize {
        self.images.len()
    }

    fn mesh(&mut self, part: &Part) -> Option<Rc<Mesh>> {
        let prepared = self
            .meshes
            .entry(MeshKey::of(part))
            .or_insert_with(|| Prepared {
                mesh: prepared_mesh(part).map(Rc::new),
                _source: (
                    Rc::clone(&part.mesh),
                    part.texture
                        .as_ref()
                        .map(|mapping| Rc::clone(&mapping.coordinates)),
                ),
            });
        prepared.mesh.clone()
    }

    fn texture(&mut self, scene: &Scene, mapping: &TextureMapping) -> Option<Texture> {
        Some(Texture {
            image: self.image(scene, mapping.source)?,
            repeat: mapping.repeat,
            interpolate: mapping.interpolate,
            mode: if mapping.apply_mode == ApplyMode::DECAL {
                TextureMode::Decal
            } else {
                TextureMode::Modulate
            },
        })
    }

    fn image(&mut self, scene: &Scene, source: TextureSource) -> Option<Arc<Image>> {
        let id = match source {
            TextureSource::Texture(id) => id,
            TextureSource::Sensor(sensor) => {
                let sensor = scene.object(sensor).ok()?.vision_sensor().ok()?;
                return Image::new(sensor.view.resolution, false, &sensor.image()).map(Arc::new);
            }
        };
        let texture = scene.textures().get(id).ok()?;
        let address = texture.pixels().as_ptr() as usize;
        if let Some((_, image)) = self.images.get(&address) {
            return Some(Arc::clone(image));
        }
        let image = Arc::new(Image::new(
            texture.size(),
            texture.has_alpha(),
            texture.pixels(),
        )?);
        self.images
            .insert(address, (texture.clone(), Arc::clone(&image)));
        Some(image)
    }
}

fn prepared_mesh(part: &Part) -> Option<Mesh> {
    let mesh = &*part.mesh;
    Mesh::new(
        &mesh.vertices,
        &mesh.triangles,
        &mesh.normals,
        &texture_coordinates(part),
    )
}

/// Texture coordinates of each corner of each triangle of a mesh; none without a texture.
pub fn texture_coordinates(part: &Part) -> Vec<[f32; 2]> {
    match part.texture.as_deref() {
        None => Vec::new(),
        Some(mapping) if !mapping.coordinates.is_empty() => {
            mapping.coordinates.as_chunks().0.to_vec()
        }
        Some(mapping) => projection::coordinates(&part.mesh, mapping),
    }
}

fn material(appearance: &Appearance, texture: Option<Texture>) -> Material {
    Material {
        culling: appearance.culling,
        wireframe: appearance.wireframe,
        edges: appearance.edges.then_some(Edges {
            angle: appearance.edge_angle,
            borders: !appearance.edge_borders_hidden,
            colour: EDGE_COLOUR,
            width: EDGE_WIDTH,
        }),
        texture,
        ..of_colour(&appearance.colour)
    }
}

/// The surface of something with that colour.
pub(super) fn of_colour(colour: &Colour) -> Material {
    Material {
        specular: colour.specular,
        emission: colour.emission,
        opacity: colour.opacity.clamp(0.0, 1.0),
        ..Material::new(colour.ambient_diffuse)
    }
}
