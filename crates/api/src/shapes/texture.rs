//! `sim.*`: textures of shapes. Vision sensors and the viewer draw them.

use std::rc::Rc;

use api_macro::api;
use geometry::pose::euler::rotation_from_euler;
use geometry::{Finite, PrimitiveKind};

use crate::display::images::{failure, read_file};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::picture::{Layout, Picture};
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{
    ApplyMode, MappingMode, TextureMapping, TextureOptions, TextureSource, no_texture,
};
use scene::numbers;
use scene::shape::options::MeshOptions;
use scene::shape::{Part, Shape};
use scene::{Data, Handle, Kind, Pose, Scene, SceneError};
use script::{Bytes, IntPair, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_texture,
    get_texture_id,
    get_shape_texture_id,
    set_shape_texture,
    read_texture,
    write_texture
];

/// Default size of a new texture in pixels.
const DEFAULT_SIDE: f64 = 256.0;
const WHITE: u8 = 255;
/// The name of what is from no file.
const NAME: &str = "texture";

/// A new plane with an image on it, from a file or white.
///
/// @param fileName PNG, JPEG, BMP or TGA; an empty text for a new image
/// @param options 1: pixels are not interpolated, 2: applied as a decal, 4: repeated along u, 8: repeated along v
/// @param planeSizes of the plane, metres; default: one metre wide, with the aspect ratio of the image
/// @param scalingUV size of the image, metres; nothing for that of the plane
/// @param xy_g placement of the image on the plane: x, y and optionally an angle, metres and radians
/// @param fixedResolution 1: the image of a file is brought to the resolution too
/// @param resolution of a new image, pixels; 256 times 256 by default
/// @return shapeHandle the plane
/// @return textureId of the image
/// @return resolution pixels
#[api("sim.createTexture")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn create_texture(
    cx: &mut Cx,
    file_name: String,
    options: Number,
    #[default(None)] plane_sizes: Option<[f64; 2]>,
    #[default(None)]
    #[name("scalingUV")]
    scaling_uv: Option<[f64; 2]>,
    #[default(None)]
    #[name("xy_g")]
    xy_g: Option<Vec<f64>>,
    #[default(0)] fixed_resolution: Number,
    #[default(None)] resolution: Option<[f64; 2]>,
) -> Result<(Handle, i64, IntPair)> {
    let is_of_file = !file_name.is_empty();
    let texture = if is_of_file {
        of_file(
            cx,
            &file_name,
            resolution.filter(|_| fixed_resolution.0 != 0),
        )?
    } else {
        blank(resolution.unwrap_or([DEFAULT_SIDE; 2]))?
    };
    let [width, height] = texture.size();
    let plane = plane_sizes.unwrap_or([1.0, f64::from(height) / f64::from(width)]);
    let shape = Shape::primitive(
        PrimitiveKind::Plane,
        [plane[0], plane[1], 0.0],
        Default::default(),
    )?;
    let [x, y, angle] = std::array::from_fn(|i| {
        xy_g.as_ref()
            .and_then(|xy_g| xy_g.get(i))
            .copied()
            .unwrap_or(0.0)
    });
    let (scale, frame) = (
        scaling_uv
            .unwrap_or(plane)
            .finite()
            .ok_or(SceneError::InvalidData)?,
        frame([x, y, 0.0], [0.0, 0.0, angle])?,
    );
    let id = if is_of_file {
        cx.scene_mut().textures_mut().add(texture)?
    } else {
        // Scripts draw on it.
        cx.scene_mut().textures_mut().add_new(texture)?
    };
    let options = TextureOptions::from_bits_retain(options.0);
    let mapping = TextureMapping {
        scale,
        frame,
        ..TextureMapping::new(TextureSource::Texture(id)).with_options(options)
    };
    let handle = cx
        .scene_mut()
        .add(PrimitiveKind::Plane.alias(), Kind::Shape(Box::new(shape)))?;
    cx.scene_mut().set_shape_texture(handle, Some(mapping))?;
    cx.notify_created(&[handle]);
    Ok((handle, id, IntPair([width.into(), height.into()])))
}

fn blank(resolution: [f64; 2]) -> Result<Texture> {
    let refused = || ApiError::Other("invalid arguments.".into());
    let side = |side: f64| u32::try_from(numbers::truncated(side)).map_err(|_| refused());
    let [width, height] = resolution;
    let size = [side(width)?, side(height)?];
    let bytes = u64::from(size[0]) * u64::from(size[1]) * 3;
    let bytes = usize::try_from(bytes)
        .ok()
        .filter(|_| size.iter().all(|side| *side <= Texture::MAX_SIDE));
    Texture::new(NAME, size, false, &vec![WHITE; bytes.ok_or_else(refused)?]).ok_or_else(refused)
}

/// The image of a file, named after it; files begin with the top row.
fn of_file(cx: &Cx, name: &str, resolution: Option<[f64; 2]>) -> Result<Texture> {
    let picture =
        Picture::decode(&read_file(cx, name.as_bytes())?, Layout::Rgba).map_err(failure)?;
    let picture = match resolution {
        Some(size) => picture
            .scaled(size.map(numbers::truncated), false, Layout::Rgba)
            .map_err(failure)?,
        None => picture,
    };
    let stem = std::path::Path::new(name)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    of_picture(&stem, picture.flipped(false, true), true)
}

fn of_picture(name: &str, picture: Picture, has_alpha: bool) -> Result<Texture> {
    let size = picture
        .resolution()
        .map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    Texture::new(name, size, has_alpha, &picture.into_bytes()).ok_or(SceneError::InvalidData.into())
}

fn frame(position: [f64; 3], orientation: [f64; 3]) -> Result<Pose> {
    [position, orientation]
        .finite()
        .ok_or(SceneError::InvalidData)?;
    Ok(Pose::from_parts(
        position.into(),
        rotation_from_euler(&orientation),
    ))
}

/// The texture with a name: that of its file, without folder and ending.
///
/// @param textureName the first one with that name counts
/// @return textureId an error where there is none
/// @return resolution pixels
#[api("sim.getTextureId")]
fn get_texture_id(cx: &Cx, texture_name: String) -> Result<(i64, IntPair)> {
    let scene = cx.scene();
    let found = scene
        .textures()
        .iter()
        .find(|(_, texture)| texture.name == texture_name);
    let (id, texture) = found.ok_or_else(no_texture)?;
    Ok((id, IntPair(texture.size().map(i64::from))))
}

/// The texture on a shape.
///
/// @param shapeHandle the shape; of a compound the first mesh counts
/// @return textureId a texture, the handle of a vision sensor whose picture it is, or -1
#[api("sim.getShapeTextureId")]
fn get_shape_texture_id(cx: &Cx, shape_handle: Handle) -> Result<i64> {
    let scene = cx.scene();
    let first = scene.object(shape_handle)?.shape()?.parts.first();
    Ok(first
        .and_then(|part| part.texture.as_ref())
        .map_or(-1, |texture| texture.source.raw()))
}

/// Puts an image on all meshes of a shape.
///
/// @param shapeHandle the shape
/// @param textureId a texture, or a vision sensor whose image is used; -1 removes the texture
/// @param mappingMode sim.texturemap_*
/// @param options 1: pixels are not interpolated, 2: applied as a decal, 4: repeated along u, 8: repeated along v
/// @param uvScaling size of the image, metres
/// @param position of the projection
/// @param orientation of the projection, Euler angles
/// @return result 1
#[api("sim.setShapeTexture")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn set_shape_texture(
    cx: &mut Cx,
    shape_handle: Handle,
    texture_id: Number,
    mapping_mode: Number,
    options: Number,
    uv_scaling: [f64; 2],
    #[default(None)] position: Option<[f64; 3]>,
    #[default(None)] orientation: Option<[f64; 3]>,
) -> Result<i64> {
    if texture_id.0 == -1 {
        cx.scene_mut().set_shape_texture(shape_handle, None)?;
        return Ok(1);
    }
    let source = TextureSource::from_raw(texture_id.0).ok_or(SceneError::InvalidArgument)?;
    let mapping = TextureMapping {
        mode: MappingMode::from_raw(mapping_mode.0).ok_or(SceneError::InvalidArgument)?,
        scale: uv_scaling.finite().ok_or(SceneError::InvalidData)?,
        frame: frame(
            position.unwrap_or_default(),
            orientation.unwrap_or_default(),
        )?,
        ..TextureMapping::new(source).with_options(TextureOptions::from_bits_retain(options.0))
    };
    cx.scene_mut()
        .set_shape_texture(shape_handle, Some(mapping))?;
    Ok(1)
}

/// Reads a part of a texture.
///
/// @param textureId the texture
/// @param options not used
/// @param posX first column
/// @param posY first row, from the bottom
/// @param sizeX columns; 0 for the whole texture
/// @param sizeY rows; 0 for the whole texture
/// @return textureData red, green, blue of each pixel, the bottom row first
#[api("sim.readTexture")]
fn read_texture(
    cx: &Cx,
    texture_id: i64,
    options: i64,
    #[default(0)] pos_x: Number,
    #[default(0)] pos_y: Number,
    #[default(0)] size_x: Number,
    #[default(0)] size_y: Number,
) -> Result<Bytes> {
    let _ = options;
    let scene = cx.scene();
    let texture = scene.textures().get(texture_id)?;
    let part = texture.rectangle([pos_x.0, pos_y.0], [size_x.0, size_y.0])?;
    Ok(Bytes(texture.read(part)))
}

/// Writes a part of a texture, on all shapes it is on.
///
/// @param textureId the texture
/// @param options not used
/// @param textureData red, green, blue of each pixel, the bottom row first
/// @param posX first column
/// @param posY first row, from the bottom
/// @param sizeX columns; 0 for the whole texture
/// @param sizeY rows; 0 for the whole texture
/// @param interpol how much of the old colours stays, 0 to 1
/// @return result 1
#[api("sim.writeTexture")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn write_texture(
    cx: &mut Cx,
    texture_id: i64,
    options: i64,
    texture_data: Bytes,
    #[default(0)] pos_x: Number,
    #[default(0)] pos_y: Number,
    #[default(0)] size_x: Number,
    #[default(0)] size_y: Number,
    #[default(0.0)] interpol: f64,
) -> Result<i64> {
    let _ = options;
    cx.scene_mut().modify_texture(texture_id, |texture| {
        let part = texture.rectangle([pos_x.0, pos_y.0], [size_x.0, size_y.0])?;
        texture.write(part, &texture_data.0, interpol)
    })?;
    Ok(1)
}

/// The texture of `sim.createShape`: two coordinates for each of `corners` corners, and the pixels of an image.
pub(crate) fn of_mesh(
    cx: &mut Cx,
    options: MeshOptions,
    coordinates: &[f64],
    corners: usize,
    pixels: Vec<u8>,
    resolution: [f64; 2],
) -> Result<TextureMapping> {
    let coordinates = coordinates.get(..2 * corners).ok_or(ApiError::TableSize)?;
    let coordinates: Rc<[f32]> = single_precision(coordinates)?;
    let layout = if options.contains(MeshOptions::TEXTURE_HAS_ALPHA) {
        Layout::Rgba
    } else {
        Layout::Rgb
    };
    let picture =
        Picture::new(pixels, resolution.map(numbers::truncated), layout).map_err(failure)?;
    let picture = picture.flipped(
        options.contains(MeshOptions::FLIP_TEXTURE_X),
        !options.contains(MeshOptions::TEXTURE_FROM_BOTTOM),
    );
    let id = cx.scene_mut().textures_mut().add(of_picture(
        NAME,
        picture,
        options.contains(MeshOptions::TEXTURE_HAS_ALPHA),
    )?)?;
    Ok(TextureMapping {
        interpolate: !options.contains(MeshOptions::TEXTURE_NOT_INTERPOLATED),
        apply_mode: ApplyMode::decal_if(options.contains(MeshOptions::TEXTURE_AS_DECAL)),
        coordinates,
        ..TextureMapping::new(TextureSource::Texture(id))
    })
}

fn single_precision(numbers: &[f64]) -> Result<Rc<[f32]>> {
    let singles: Rc<[f32]> = numbers.iter().map(|n| numbers::single(*n)).collect();
    if singles.is_finite() {
        Ok(singles)
    } else {
        Err(SceneError::InvalidData.into())
    }
}

/// The texture of a mesh as `sim.getShapeViz` returns it; nothing without a texture or image.
pub(crate) fn viz(scene: &Scene, part: &Part) -> Option<Data> {
    let mapping = part.texture.as_deref()?;
    let texture = scene.textures().get(mapping.source.raw()).ok()?;
    let [u, v] = mapping.repeat;
    let options = i64::from(u) | i64::from(v) << 1 | i64::from(mapping.interpolate) << 2;
    let coordinates: Vec<f64> = mapping.coordinates.iter().copied().map(f64::from).collect();
    Some(Data::map([
        ("texture", Data::Buffer(texture.rgba())),
        ("resolution", texture.size().map(i64::from).into()),
        ("coordinates", coordinates.into()),
        ("applyMode", mapping.apply_mode.0.into()),
        ("options", options.into()),
        ("id", mapping.source.raw().into()),
    ]))
}
