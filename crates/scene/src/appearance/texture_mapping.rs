//! Texture mapping on meshes, and the images of a scene.

use std::collections::BTreeMap;
use std::rc::Rc;

use bitflags::bitflags;

use super::texture::Texture;
use crate::shape::{Part, Shape};
use crate::{Field, Handle, Object, Pose, Scene, SceneError, SceneResult};

/// Number of the first texture (`sim.object_texturestart`), and the first number beyond the range (`sim.object_textureend`).
const FIRST_TEXTURE: i64 = 2_180_009;
const TEXTURE_END: i64 = 2_280_009;

/// Texture mapping on a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureMapping {
    /// The image.
    pub source: TextureSource,
    /// The projection; unused where there are coordinates.
    pub mode: MappingMode,
    /// Size of the image, metres.
    pub scale: [f64; 2],
    /// Where it is projected from, in the frame of the vertices.
    pub frame: Pose,
    /// Bilinear filtering instead of the nearest pixel.
    pub interpolate: bool,
    /// Whether the image repeats along u and v beyond its border.
    pub repeat: [bool; 2],
    /// How the image is mixed with the colour of the mesh.
    pub apply_mode: ApplyMode,
    /// u and v of each corner of each triangle; empty where the image is projected. Shared between copies.
    pub coordinates: Rc<[f32]>,
}

/// `sim.texturemap_*`: how an image is projected. Files may have other numbers, which are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MappingMode(pub i32);

impl MappingMode {
    /// Onto the xy plane of the projection frame.
    pub const PLANE: Self = Self(0);
    /// Around the z axis of the projection frame.
    pub const CYLINDER: Self = Self(1);
    /// From the origin of the projection frame onto a sphere.
    pub const SPHERE: Self = Self(2);
    /// From six sides of a cube.
    pub const CUBE: Self = Self(3);

    /// From a number of a script; None for an unknown one.
    pub fn from_raw(raw: i64) -> Option<Self> {
        [Self::PLANE, Self::CYLINDER, Self::SPHERE, Self::CUBE]
            .into_iter()
            .find(|mode| i64::from(mode.0) == raw)
    }
}

/// `sim.textureapplymode_*`: how an image and the colour below it are mixed. Other numbers are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ApplyMode(pub i64);

impl ApplyMode {
    /// The image is multiplied with the colour.
    pub const MODULATE: Self = Self(0);
    /// The image replaces the colour.
    pub const DECAL: Self = Self(1);

    /// [`DECAL`](Self::DECAL) if `decal`, else [`MODULATE`](Self::MODULATE).
    pub fn decal_if(decal: bool) -> Self {
        if decal { Self::DECAL } else { Self::MODULATE }
    }
}

bitflags! {
    /// Options of `sim.createTexture` and `sim.setShapeTexture`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct TextureOptions: i64 {
        /// The nearest pixel instead of bilinear filtering.
        const NOT_INTERPOLATED = 0x1;
        /// The image replaces the colour.
        const DECAL = 0x2;
        /// The image repeats along u.
        const REPEAT_U = 0x4;
        /// The image repeats along v.
        const REPEAT_V = 0x8;
        const _ = !0;
    }
}

/// Where an image comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextureSource {
    /// A texture of the scene, by its number.
    Texture(i64),
    /// The image of a vision sensor.
    Sensor(Handle),
}

impl TextureSource {
    /// From a number of a script or a file: those of objects mean vision sensors.
    pub fn from_raw(raw: i64) -> Option<Self> {
        match Handle::from_raw(raw) {
            Some(sensor) => Some(Self::Sensor(sensor)),
            None => (raw >= FIRST_TEXTURE).then_some(Self::Texture(raw)),
        }
    }

    /// The number of the texture, or the handle of the sensor.
    pub fn raw(self) -> i64 {
        match self {
            Self::Texture(id) => id,
            Self::Sensor(sensor) => sensor.raw(),
        }
    }
}

impl TextureMapping {
    /// Projected onto a plane, one metre wide, repeated.
    pub fn new(source: TextureSource) -> Self {
        Self {
            source,
            mode: MappingMode::PLANE,
            scale: [1.0, 1.0],
            frame: Pose::identity(),
            interpolate: true,
            repeat: [true, true],
            apply_mode: ApplyMode::MODULATE,
            coordinates: Rc::default(),
        }
    }

    /// The same mapping with filtering, repetition and mixing as `options` say.
    pub fn with_options(self, options: TextureOptions) -> Self {
        Self {
            interpolate: !options.contains(TextureOptions::NOT_INTERPOLATED),
            apply_mode: ApplyMode::decal_if(options.contains(TextureOptions::DECAL)),
            repeat: [TextureOptions::REPEAT_U, TextureOptions::REPEAT_V]
                .map(|axis| options.contains(axis)),
            ..self
        }
    }

    /// Turns each triangle as [`Mesh::flip`](geometry::Mesh::flip) does.
    pub(crate) fn flip(&mut self) {
        let turned = self
            .coordinates
            .as_chunks::<6>()
            .0
            .iter()
            .flat_map(|&[a, b, c, d, e, f]| [a, b, e, f, c, d]);
        self.coordinates = turned.collect();
    }

    /// The same on some of the triangles only.
    pub(crate) fn of_triangles(&self, triangles: &[usize]) -> Self {
        let all = self.coordinates.as_chunks::<6>().0;
        let some = triangles
            .iter()
            .filter_map(|at| all.get(*at))
            .flatten()
            .copied();
        Self {
            coordinates: some.collect(),
            ..self.clone()
        }
    }
}

impl Part {
    /// The number of its texture; None without one, or where a sensor gives the image.
    fn texture_id(&self) -> Option<i64> {
        match self.texture.as_ref()?.source {
            TextureSource::Texture(id) => Some(id),
            TextureSource::Sensor(_) => None,
        }
    }
}

impl Shape {
    /// The numbers of its textures; some may come more than once.
    pub fn texture_ids(&self) -> impl Iterator<Item = i64> {
        self.parts.iter().filter_map(Part::texture_id)
    }
}

/// The images of a scene, by their numbers.
#[derive(Debug, Default, PartialEq)]
pub struct Textures(BTreeMap<i64, Texture>);

impl Textures {
    /// Adds an image and returns its number; an equal image is shared.
    ///
    /// # Errors
    /// When there are too many.
    pub fn add(&mut self, texture: Texture) -> SceneResult<i64> {
        if let Some((id, _)) = self.0.iter().find(|(_, other)| **other == texture) {
            return Ok(*id);
        }
        self.add_new(texture)
    }

    /// Adds an image of its own and returns its number.
    ///
    /// # Errors
    /// When there are too many.
    pub fn add_new(&mut self, texture: Texture) -> SceneResult<i64> {
        let id = self
            .0
            .last_key_value()
            .map_or(FIRST_TEXTURE, |(last, _)| last + 1);
        if id >= TEXTURE_END {
            return Err(SceneError::Refused(
                "the scene has too many textures.".into(),
            ));
        }
        self.0.insert(id, texture);
        Ok(id)
    }

    /// The texture with that number.
    ///
    /// # Errors
    /// When there is no such texture.
    pub fn get(&self, id: i64) -> SceneResult<&Texture> {
        self.0.get(&id).ok_or_else(no_texture)
    }

    /// All images with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &Texture)> {
        self.0.iter().map(|(id, texture)| (*id, texture))
    }

    /// Removes all images.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    fn get_mut(&mut self, id: i64) -> SceneResult<&mut Texture> {
        self.0.get_mut(&id).ok_or_else(no_texture)
    }
}

impl Scene {
    /// The textures of the scene.
    pub fn textures(&self) -> &Textures {
        &self.textures
    }

    /// Images are no part of what the journal records: meshes are, when they get one.
    pub fn textures_mut(&mut self) -> &mut Textures {
        &mut self.textures
    }

    /// Changes an image on all meshes that use it.
    ///
    /// # Errors
    /// When there is no such texture, or `change` refuses.
    pub fn modify_texture<R>(
        &mut self,
        id: i64,
        change: impl FnOnce(&mut Texture) -> SceneResult<R>,
    ) -> SceneResult<R> {
        let result = change(self.textures.get_mut(id)?)?;
        let users: Vec<Handle> = self
            .objects()
            .filter(|object| uses(object, id))
            .map(Object::handle)
            .collect();
        for user in users {
            self.modify(user, Field::Texture, |_| ())?;
        }
        Ok(result)
    }

    /// Puts an image on all meshes of a shape, or takes theirs away. Textures that no mesh has any more are forgotten.
    ///
    /// # Errors
    /// When the object is no shape, or the texture or sensor does not exist.
    pub fn set_shape_texture(
        &mut self,
        handle: Handle,
        mapping: Option<TextureMapping>,
    ) -> SceneResult<()> {
        match mapping.as_ref().map(|mapping| mapping.source) {
            Some(TextureSource::Texture(id)) => drop(self.textures.get(id)?),
            Some(TextureSource::Sensor(sensor)) => drop(self.object(sensor)?.vision_sensor()?),
            None => {}
        }
        let before: Vec<i64> = self.object(handle)?.shape()?.texture_ids().collect();
        self.try_modify(handle, Field::Texture, |object| {
            for part in &mut object.shape_mut()?.parts {
                part.texture = mapping.clone().map(Box::new);
            }
            Ok(())
        })?;
        self.forget_unused_textures(&before);
        Ok(())
    }

    /// Forgets those of the textures that no mesh has.
    pub(crate) fn forget_unused_textures(&mut self, ids: &[i64]) {
        for id in ids {
            if self.textures.get(*id).is_ok() && !self.objects().any(|object| uses(object, *id)) {
                self.textures.0.remove(id);
            }
        }
    }
}

fn uses(object: &Object, id: i64) -> bool {
    object
        .shape()
        .is_ok_and(|shape| shape.texture_ids().any(|other| other == id))
}

/// The error for a texture that is not there.
pub fn no_texture() -> SceneError {
    SceneError::Refused("texture does not exist.".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use geometry::PrimitiveKind;

    fn image(name: &str) -> Texture {
        Texture::new(name, [1, 1], false, &[1, 2, 3]).unwrap()
    }

    fn cube(scene: &mut Scene) -> Handle {
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [0.1; 3], Default::default()).unwrap();
        scene.add("c", Kind::Shape(Box::new(shape))).unwrap()
    }

    #[test]
    fn an_image_is_kept_once_and_while_it_is_used() {
        let mut scene = Scene::new();
        let (a, b) = (cube(&mut scene), cube(&mut scene));
        let id = scene.textures_mut().add(image("a")).unwrap();
        assert_eq!(
            (
                id,
                scene.textures_mut().add(image("b")),
                scene.textures_mut().add(image("a"))
            ),
            (FIRST_TEXTURE, Ok(FIRST_TEXTURE + 1), Ok(FIRST_TEXTURE))
        );
        let mapping = TextureMapping::new(TextureSource::Texture(id));
        scene.set_shape_texture(a, Some(mapping.clone())).unwrap();
        scene.set_shape_texture(b, Some(mapping)).unwrap();
        scene.set_shape_texture(a, None).unwrap();
        assert!(scene.textures().get(id).is_ok());
        scene.remove(&[b]).unwrap();
        assert!(scene.textures().get(id).is_err());
        let gone = Some(TextureMapping::new(TextureSource::Texture(id)));
        assert!(scene.set_shape_texture(a, gone).is_err());
    }

    #[test]
    fn coordinates_follow_the_triangles() {
        let mut mapping = TextureMapping::new(TextureSource::Texture(FIRST_TEXTURE));
        mapping.coordinates = (0..12u8).map(f32::from).collect();
        assert_eq!(
            *mapping.of_triangles(&[1]).coordinates,
            [6., 7., 8., 9., 10., 11.]
        );
        mapping.flip();
        assert_eq!(mapping.coordinates[..6], [0., 1., 4., 5., 2., 3.]);
    }
}
