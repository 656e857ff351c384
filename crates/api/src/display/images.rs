//! `sim.*`: images in memory and in files.

use std::path::Path;

use api_macro::api;
use scene::numbers;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use format::picture::{Layout, Picture, PictureError};
use format::scene_file::write_whole;
use script::{Bytes, IntPair, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    load_image,
    save_image,
    get_scaled_image,
    transform_image,
    combine_rgb_images
];

/// Default quality of JPEG files.
const QUALITY: u8 = 90;

/// Bits of the options.
mod option {
    pub const RGBA: i64 = 1;
    pub const RGBA_OUT: i64 = 2;
    pub const KEEP_ASPECT: i64 = 4;
    pub const FLIP_X: i64 = 2;
    pub const FLIP_Y: i64 = 4;
}

/// `sim.imgcomb_*`.
mod combination {
    pub const VERTICAL: i64 = 0;
    pub const HORIZONTAL: i64 = 1;
}

pub(crate) fn failure(error: PictureError) -> ApiError {
    ApiError::Other(error.to_string())
}

fn layout(rgba: bool) -> Layout {
    if rgba { Layout::Rgba } else { Layout::Rgb }
}

/// Reads an image: PNG, JPEG, BMP or TGA.
///
/// @param options 1: with an alpha channel
/// @param filename name of the file, or its content
/// @return image, resolution the top row first
#[api("sim.loadImage")]
fn load_image(cx: &Cx, options: i64, filename: Bytes) -> Result<(Bytes, IntPair)> {
    let file = match Picture::is_file(&filename.0) {
        true => filename.0,
        false => read_file(cx, &filename.0)?,
    };
    let picture = Picture::decode(&file, layout(options & option::RGBA != 0)).map_err(failure)?;
    let resolution = IntPair(picture.resolution());
    Ok((Bytes(picture.into_bytes()), resolution))
}

pub(crate) fn read_file(cx: &Cx, name: &[u8]) -> Result<Vec<u8>> {
    let name = String::from_utf8_lossy(name);
    cx.permissions().check_read(Path::new(&*name))?;
    cx.permissions()
        .read_checked(Path::new(&*name))
        .map_err(|error| ApiError::Other(format!("cannot read {name}: {error}.")))
}

/// Writes an image to a file.
///
/// @param image rows of pixels, the top row first
/// @param resolution width and height
/// @param options 0: red, green, blue; 1: with an alpha channel; 2: grey
/// @param filename its extension selects the format: png, jpg, bmp, tga. An extension alone (`.png`) makes the function return the content of the file
/// @param quality of JPEG, 1 to 100; -1 for the default one
/// @return serializedImage
#[api("sim.saveImage")]
fn save_image(
    cx: &Cx,
    image: Bytes,
    resolution: [f64; 2],
    options: i64,
    filename: String,
    #[default(-1)] quality: i64,
) -> Result<Option<Bytes>> {
    let layout = match options {
        0 => Layout::Rgb,
        1 => Layout::Rgba,
        2 => Layout::Grey,
        _ => return Err(ApiError::Other("invalid options.".into())),
    };
    let picture = Picture::new(image.0, whole(resolution), layout).map_err(failure)?;
    let (stem, extension) = filename.rsplit_once('.').unwrap_or((&filename, ""));
    let quality = u8::try_from(quality)
        .ok()
        .filter(|quality| (1..=100).contains(quality))
        .unwrap_or(QUALITY);
    let file = picture
        .encode(&extension.to_lowercase(), quality)
        .map_err(failure)?;
    if stem.is_empty() {
        return Ok(Some(Bytes(file)));
    }
    write_file(cx, &filename, &file)?;
    Ok(None)
}

fn write_file(cx: &Cx, name: &str, content: &[u8]) -> Result<()> {
    cx.permissions().check_write(Path::new(name))?;
    let path = Path::new(name);
    cx.permissions()
        .write(path, || write_whole(path, content))
        .map_err(|error| ApiError::Other(format!("cannot write {name}: {error}.")))
}

/// An image in another size.
///
/// @param imageIn rows of pixels
/// @param resolutionIn width and height
/// @param desiredResolutionOut desired width and height
/// @param options 1: the image has an alpha channel; 2: the result has one; 4: keep the proportions
/// @return imageOut, effectiveResolutionOut
#[api("sim.getScaledImage")]
fn get_scaled_image(
    _cx: &Cx,
    image_in: Bytes,
    resolution_in: [f64; 2],
    desired_resolution_out: [f64; 2],
    options: i64,
) -> Result<(Bytes, IntPair)> {
    let has = |bit: i64| options & bit != 0;
    let picture = Picture::new(image_in.0, whole(resolution_in), layout(has(option::RGBA)))
        .map_err(failure)?;
    let wished = whole(desired_resolution_out);
    let scaled = picture
        .scaled(
            wished,
            has(option::KEEP_ASPECT),
            layout(has(option::RGBA_OUT)),
        )
        .map_err(failure)?;
    let resolution = IntPair(scaled.resolution());
    Ok((Bytes(scaled.into_bytes()), resolution))
}

/// A mirrored image. Sensors have the bottom row first, files the top one: flip along y in between.
///
/// @param image rows of pixels
/// @param resolution width and height
/// @param options 1: the image has an alpha channel; 2: flip along x; 4: flip along y
/// @return newImage
#[api("sim.transformImage")]
fn transform_image(_cx: &Cx, image: Bytes, resolution: [f64; 2], options: i64) -> Result<Bytes> {
    let has = |bit: i64| options & bit != 0;
    let picture =
        Picture::new(image.0, whole(resolution), layout(has(option::RGBA))).map_err(failure)?;
    Ok(Bytes(
        picture
            .flipped(has(option::FLIP_X), has(option::FLIP_Y))
            .into_bytes(),
    ))
}

/// Two images in one.
///
/// @param img1 red, green, blue of each pixel
/// @param img1Res width and height
/// @param img2 the second image: to the right of the first one, or with its rows after those of the first one
/// @param img2Res width and height
/// @param operation sim.imgcomb_horizontal or sim.imgcomb_vertical
/// @return outImg
#[api("sim.combineRgbImages")]
fn combine_rgb_images(
    _cx: &Cx,
    img1: Bytes,
    img1_res: [f64; 2],
    img2: Bytes,
    img2_res: [f64; 2],
    operation: Number,
) -> Result<Bytes> {
    let first = Picture::new(img1.0, whole(img1_res), Layout::Rgb).map_err(failure)?;
    let second = Picture::new(img2.0, whole(img2_res), Layout::Rgb).map_err(failure)?;
    let is_horizontal = match operation.0 {
        combination::HORIZONTAL => true,
        combination::VERTICAL => false,
        _ => return Err(ApiError::Other("invalid operation.".into())),
    };
    let both = first.beside(&second, is_horizontal).map_err(failure)?;
    Ok(Bytes(both.into_bytes()))
}

fn whole(resolution: [f64; 2]) -> [i64; 2] {
    resolution.map(numbers::truncated)
}
