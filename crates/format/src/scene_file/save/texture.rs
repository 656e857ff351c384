//! Textures and their mapping on meshes.

use super::Context;
use crate::ttt::Rest;
use crate::ttt::chunks::{Texture as Chunk, TextureMapping as MappingChunk};
use scene::Scene;
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{ApplyMode, TextureMapping, TextureSource};

/// The images of a scene, or those of a model that are `used`.
pub(super) fn all(scene: &Scene, used: impl Fn(i64) -> bool) -> Vec<Chunk> {
    scene
        .textures()
        .iter()
        .filter(|(id, _)| used(*id))
        .map(|(id, texture)| image(id, texture))
        .collect()
}

fn image(id: i64, texture: &Texture) -> Chunk {
    let [width, height] = texture.size();
    Chunk {
        id_and_size: Some([
            numbers::low_i32(id),
            width.cast_signed(),
            height.cast_signed(),
        ]),
        name: Some(texture.name.as_str().into()),
        flags: Some(texture.has_alpha().into()),
        pixels: Some(Rest(texture.pixels().to_vec())),
    }
}

pub(super) fn mapping(context: &Context<'_>, texture: &TextureMapping) -> MappingChunk {
    let id = match texture.source {
        TextureSource::Texture(id) => numbers::low_i32(id),
        TextureSource::Sensor(sensor) => context.file_handle(Some(sensor)),
    };
    let [u, v] = texture.repeat;
    let flags = u8::from(texture.interpolate) | u8::from(u) << 2 | u8::from(v) << 3;
    MappingChunk {
        // Older programs know one mode, as a flag.
        old_flags: Some(flags | u8::from(texture.apply_mode == ApplyMode::DECAL) << 1),
        flags: Some(flags),
        source: Some(([id, texture.mode.0], texture.scale)),
        projection: Some(texture.frame.into()),
        uv: Some(Rest(texture.coordinates.to_vec())),
        apply_mode: Some(numbers::low_i32(texture.apply_mode.0)),
    }
}
