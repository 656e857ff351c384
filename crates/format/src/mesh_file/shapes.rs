//! Parts of mesh files as shapes, and shapes as parts.

use std::rc::Rc;

use geometry::Mesh;
use mesh_files::{Material, MeshFile, Part};

use crate::picture::{Layout, Picture};
use scene::appearance::colour::Colour;
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{TextureMapping, TextureSource};
use scene::shape::{Appearance, Shape};
use scene::{Pose, Scene, SceneError, SceneResult};

/// Which parts of the appearance of a mesh file are taken over.
#[derive(Debug, Clone, Copy)]
pub struct ImportedAppearance {
    /// Diffuse, specular and emissive colours.
    pub colours: bool,
    /// The opacity.
    pub transparency: bool,
    /// The longest side of a texture in pixels; larger ones are made smaller. None: no textures.
    pub textures: Option<u32>,
}

/// A shape for each part, with the frame of the file. What could not be used is added to the file's warnings.
///
/// # Errors
/// Where a part is too large for a scene.
pub fn to_shapes(
    file: &mut MeshFile,
    imported: ImportedAppearance,
    scene: &mut Scene,
) -> SceneResult<Vec<Shape>> {
    let mut numbers = vec![None; file.textures.len()];
    if let Some(longest) = imported.textures {
        for (number, texture) in numbers.iter_mut().zip(&file.textures) {
            match picture(texture, longest) {
                Ok(texture) => *number = Some(scene.textures_mut().add(texture)?),
                Err(why) => file
                    .warnings
                    .push(format!("texture {}: {why}", texture.name)),
            }
        }
    }
    file.parts
        .iter()
        .map(|part| {
            shape(
                part,
                imported,
                part.material.texture.and_then(|texture| numbers[texture]),
            )
        })
        .collect()
}

/// The image of a texture; files begin with the top row, textures with the bottom one.
fn picture(texture: &mesh_files::Texture, longest: u32) -> Result<Texture, String> {
    let picture =
        Picture::decode(&texture.bytes, Layout::Rgba).map_err(|error| error.to_string())?;
    let resolution = picture.resolution();
    let picture = match resolution.iter().any(|side| *side > i64::from(longest)) {
        true => picture
            .scaled([i64::from(longest); 2], true, Layout::Rgba)
            .map_err(|error| error.to_string())?,
        false => picture,
    };
    let size = picture.resolution().map(numbers::low_u32);
    let stem = texture
        .name
        .rsplit_once('.')
        .map_or(texture.name.as_str(), |(stem, _)| stem);
    let pixels = picture.flipped(false, true).into_bytes();
    Texture::new(stem, size, true, &pixels).ok_or_else(|| "its size is not supported".into())
}

fn shape(part: &Part, imported: ImportedAppearance, texture: Option<i64>) -> SceneResult<Shape> {
    let appearance = appearance(&part.material, imported);
    let mesh = mesh(part, appearance.shading_angle)?;
    let mut shape = Shape::from_mesh(mesh, appearance)?;
    let coordinates: Rc<[f32]> = part
        .uv
        .as_flattened()
        .as_flattened()
        .iter()
        .map(|x| numbers::single(*x))
        .collect();
    let is_sound = coordinates.iter().all(|x| x.is_finite()) && !coordinates.is_empty();
    if let Some(texture) = texture.filter(|_| is_sound) {
        let mapping = TextureMapping {
            coordinates,
            ..TextureMapping::new(TextureSource::Texture(texture))
        };
        shape.parts[0].texture = Some(Box::new(mapping));
    }
    Ok(shape)
}

/// With the normals of the file, or where it has none those of its shading.
fn mesh(part: &Part, shading_angle: f64) -> SceneResult<Mesh> {
    let refused = |error: geometry::MeshError| SceneError::Refused(error.to_string());
    let mut mesh = Mesh::new(part.vertices.clone(), part.triangles.clone()).map_err(refused)?;
    if part.normals.is_empty() {
        mesh.compute_normals(shading_angle);
        return Ok(mesh);
    }
    for (own, file) in mesh.normals.iter_mut().zip(part.normals.as_flattened()) {
        let length = file.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 && length.is_finite() {
            *own = file.map(|x| x / length);
        }
    }
    Ok(mesh)
}

fn appearance(material: &Material, imported: ImportedAppearance) -> Appearance {
    let mut appearance = Shape::mesh_appearance();
    let single = |colour: [f64; 3]| colour.map(numbers::single);
    if imported.colours {
        let colour = &mut appearance.colour;
        *colour = Colour {
            ambient_diffuse: material.diffuse.map_or(colour.ambient_diffuse, single),
            specular: material.specular.map_or(colour.specular, single),
            emission: material.emission.map_or(colour.emission, single),
            ..*colour
        };
    }
    if imported.transparency {
        appearance.colour.opacity = numbers::single(1.0 - material.transparency);
    }
    appearance
}

/// The meshes of shapes as parts of a file.
pub struct ShapeParts {
    /// The file under construction.
    pub file: MeshFile,
    /// The kind of textures, an extension such as `png`. None: without.
    pub textures: Option<&'static str>,
    /// Whether parts have the colours of the shapes.
    pub colours: bool,
    /// Whether parts have normals.
    pub normals: bool,
}

impl ShapeParts {
    /// Adds the meshes of a shape, whose frame lies at a pose.
    ///
    /// # Errors
    /// When a texture is not in the scene.
    pub fn add(
        &mut self,
        name: &str,
        shape: &Shape,
        pose: &Pose,
        scene: &Scene,
    ) -> SceneResult<()> {
        for part in &shape.parts {
            let mut mesh = Mesh::default();
            mesh.append(&part.mesh, &(pose * part.pose));
            let mapping = part
                .texture
                .as_deref()
                .filter(|mapping| self.textures.is_some() && !mapping.coordinates.is_empty());
            let uv = mapping.map_or_else(Vec::new, |mapping| corners(&mapping.coordinates));
            let texture = match mapping {
                Some(mapping) if uv.len() == mesh.triangles.len() => self.texture(mapping, scene),
                _ => None,
            };
            self.file.parts.push(Part {
                name: name.into(),
                normals: if self.normals {
                    mesh.normals.as_chunks().0.to_vec()
                } else {
                    Vec::new()
                },
                uv: if texture.is_some() { uv } else { Vec::new() },
                material: self.material(&part.appearance, texture),
                vertices: mesh.vertices,
                triangles: mesh.triangles,
            });
        }
        Ok(())
    }

    fn material(&self, appearance: &Appearance, texture: Option<usize>) -> Material {
        let colour = &appearance.colour;
        let double = |colour: [f32; 3]| {
            self.colours
                .then(|| colour.map(|x| f64::from(x).clamp(0.0, 1.0)))
        };
        Material {
            name: String::new(),
            diffuse: double(colour.ambient_diffuse),
            specular: double(colour.specular),
            emission: double(colour.emission).filter(|emission| *emission != [0.0; 3]),
            transparency: if self.colours {
                1.0 - f64::from(colour.opacity).clamp(0.0, 1.0)
            } else {
                0.0
            },
            texture,
            double_sided: !appearance.culling,
        }
    }

    /// The number of a texture among those of the file. None for the picture of a vision sensor.
    fn texture(&mut self, mapping: &TextureMapping, scene: &Scene) -> Option<usize> {
        let TextureSource::Texture(id) = mapping.source else {
            return None;
        };
        let texture = scene.textures().get(id).ok()?;
        let kind = self.textures?;
        let name = format!("texture{id}.{kind}");
        if let Some(known) = self
            .file
            .textures
            .iter()
            .position(|texture| texture.name == name)
        {
            return Some(known);
        }
        let picture =
            Picture::new(texture.rgba(), texture.size().map(i64::from), Layout::Rgba).ok()?;
        let bytes = picture.flipped(false, true).encode(kind, 100).ok()?;
        self.file.textures.push(mesh_files::Texture { name, bytes });
        Some(self.file.textures.len() - 1)
    }
}

fn corners(coordinates: &[f32]) -> Vec<[[f64; 2]; 3]> {
    let triangles = coordinates.as_chunks::<6>().0.iter();
    triangles
        .map(|&[a, b, c, d, e, f]| [[a, b], [c, d], [e, f]].map(|uv| uv.map(f64::from)))
        .collect()
}
