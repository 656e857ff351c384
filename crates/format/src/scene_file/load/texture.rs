//! Textures and their mapping on meshes (spec: scene-files 7.1).

use std::collections::BTreeMap;

use super::HandleMap;
use crate::ttt::chunks::{Texture as Chunk, TextureMapping as MappingChunk};
use crate::ttt::{Rest, Text};
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{ApplyMode, MappingMode, TextureMapping, TextureSource};
use scene::{Field, Handle, Scene, SceneResult};

/// Larger numbers are textures, smaller ones handles of vision sensors.
const LAST_OBJECT: i32 = 999_999;
const INTERPOLATE: u8 = 0x1;
/// A bit of files from before there were apply modes.
const DECAL: u8 = 0x2;
const REPEAT_U: u8 = 0x4;
const REPEAT_V: u8 = 0x8;
const HAS_ALPHA: u8 = 0x1;

/// From numbers in the file to those of the scene.
pub(super) type TextureMap = BTreeMap<i64, i64>;

/// Adds the images of a file. Those without all of their pixels are left out.
pub(super) fn add(scene: &mut Scene, chunks: &[Chunk]) -> SceneResult<TextureMap> {
    let images = chunks
        .iter()
        .filter_map(|chunk| Some((i64::from(chunk.id_and_size?[0]), image(chunk)?)));
    images
        .map(|(id, image)| Ok((id, scene.textures_mut().add(image)?)))
        .collect()
}

fn image(chunk: &Chunk) -> Option<Texture> {
    let [_, width, height] = chunk.id_and_size?;
    let size = [u32::try_from(width).ok()?, u32::try_from(height).ok()?];
    let name = chunk.name.as_ref().map(Text::decode).unwrap_or_default();
    Texture::new(
        &name,
        size,
        chunk.flags.unwrap_or(0) & HAS_ALPHA != 0,
        &chunk.pixels.as_ref()?.0,
    )
}

/// The mapping; where the image comes from is said by numbers of the file.
pub(super) fn mapping(chunk: &MappingChunk) -> Option<TextureMapping> {
    let ([id, mode], scale) = chunk.source?;
    let source = if id > LAST_OBJECT {
        TextureSource::Texture(id.into())
    } else {
        TextureSource::Sensor(Handle::from_raw(id.into())?)
    };
    let old = chunk.old_flags.unwrap_or(0);
    let flags = chunk.flags.unwrap_or(old);
    Some(TextureMapping {
        source,
        mode: MappingMode(mode),
        scale,
        frame: chunk
            .projection
            .and_then(|frame| frame.pose())
            .unwrap_or_default(),
        interpolate: flags & INTERPOLATE != 0,
        repeat: [flags & REPEAT_U != 0, flags & REPEAT_V != 0],
        apply_mode: chunk.apply_mode.map_or_else(
            || ApplyMode::decal_if(old & DECAL != 0),
            |mode| ApplyMode(mode.into()),
        ),
        coordinates: chunk
            .uv
            .as_ref()
            .map(|Rest(uv)| uv.as_slice().into())
            .unwrap_or_default(),
    })
}

/// Assigns the scene's images to the meshes of an object. Missing ones are removed.
pub(super) fn connect(
    scene: &mut Scene,
    handle: Handle,
    textures: &TextureMap,
    map: &HandleMap,
) -> SceneResult<()> {
    let known = |source: TextureSource| match source {
        TextureSource::Texture(id) => textures.get(&id).copied().map(TextureSource::Texture),
        TextureSource::Sensor(sensor) => map
            .get(&sensor.0.cast_signed())
            .copied()
            .map(TextureSource::Sensor),
    };
    scene.try_modify(handle, Field::Texture, |object| {
        for part in &mut object.shape_mut()?.parts {
            part.texture = part.texture.take().and_then(|mut texture| {
                texture.source = known(texture.source)?;
                Some(texture)
            });
        }
        Ok(())
    })
}
