//! `simIM.*`: creation of images, their formats and single pixels.

use api_macro::api;
use imaging::matrix::{Depth, Matrix, MatrixError, PixelFormat};

use super::arguments::Ints;
use super::objects::{images, unary};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::{Bytes, Number};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    create,
    create_from_data,
    destroy,
    size,
    get_format,
    convert,
    get,
    set
];

/// The formats that have names, `simIM.format._8UC1` first.
const FORMATS: [PixelFormat; 6] = [
    PixelFormat::new(Depth::Byte, 1),
    PixelFormat::new(Depth::Byte, 3),
    PixelFormat::new(Depth::Byte, 4),
    PixelFormat::new(Depth::Float, 1),
    PixelFormat::new(Depth::Float, 3),
    PixelFormat::new(Depth::Float, 4),
];
const FIRST_FORMAT: i64 = 3600;
/// `simIM.format._8UC3`.
const DEFAULT_FORMAT: i64 = 3601;

fn format_of(number: i64) -> Result<PixelFormat> {
    let at = number
        .checked_sub(FIRST_FORMAT)
        .and_then(|at| usize::try_from(at).ok());
    let format = at.and_then(|at| FORMATS.get(at)).copied();
    format.ok_or_else(|| refused(&format!("invalid format: {number}")))
}

pub(super) fn refused(why: &str) -> ApiError {
    ApiError::Other(why.into())
}

/// Width and height of an image.
///
/// # Errors
/// When one is not positive.
pub(super) fn sides(width: i64, height: i64) -> Result<[usize; 2]> {
    let side = |pixels: i64, name: &str| {
        usize::try_from(pixels)
            .ok()
            .filter(|side| *side > 0)
            .ok_or_else(|| refused(&format!("invalid {name}")))
    };
    Ok([side(width, "width")?, side(height, "height")?])
}

/// Creates an image. As in CoppeliaSim, width and height are exchanged: simIM.size returns height, width.
///
/// @param width of the image, which becomes its height
/// @param height of the image, which becomes its width
/// @param format simIM.format.*
/// @param initialValue of the first channel; the others are 0
/// @return handle
#[api("simIM.create")]
fn create(
    cx: &Cx,
    width: Number,
    height: Number,
    #[default(DEFAULT_FORMAT, "simIM.format._8UC3")] format: Number,
    #[default(0)] initial_value: Number,
) -> Result<String> {
    let [width, height] = sides(width.0, height.0)?;
    let image = Matrix::new(
        [height, width],
        format_of(format.0)?,
        initial_value.0 as f64,
    )?;
    images(cx).add(cx, image)
}

/// Creates an image from red, green, blue of each pixel. It is stored as blue, green, red; alpha is left out.
///
/// @param width columns
/// @param height rows
/// @param data bytes or 32-bit floats
/// @param format simIM.format.* of the data
/// @return handle
#[api("simIM.createFromData")]
fn create_from_data(
    cx: &Cx,
    width: Number,
    height: Number,
    data: Bytes,
    #[default(DEFAULT_FORMAT, "simIM.format._8UC3")] format: Number,
) -> Result<String> {
    let (size, format) = (sides(width.0, height.0)?, format_of(format.0)?);
    if format.channels == 1 {
        return Err(MatrixError::Format("an image from data").into());
    }
    let image = match format.depth {
        Depth::Byte => Matrix::from_bytes(size, 3, turned(&data.0, format.channels)),
        Depth::Float => {
            let floats: Vec<f32> = data
                .0
                .as_chunks()
                .0
                .iter()
                .map(|bytes| f32::from_le_bytes(*bytes))
                .collect();
            Matrix::from_floats(size, 3, turned(&floats, format.channels))
        }
    };
    let values = size[0]
        .saturating_mul(size[1])
        .saturating_mul(format.channels);
    let bytes = values.saturating_mul(if format.depth == Depth::Byte { 1 } else { 4 });
    if bytes != data.0.len() {
        return Err(refused(&format!(
            "invalid data size: {} bytes, expected {bytes}",
            data.0.len()
        )));
    }
    images(cx).add(cx, image?)
}

/// The first three channels in the opposite order.
pub(super) fn turned<T: Copy>(values: &[T], channels: usize) -> Vec<T> {
    values
        .chunks_exact(channels)
        .flat_map(|pixel| [pixel[2], pixel[1], pixel[0]])
        .collect()
}

/// Frees an image.
///
/// @param handle the image
#[api("simIM.destroy")]
fn destroy(cx: &Cx, handle: String) -> Result<()> {
    images(cx).remove(&handle)
}

/// The size of an image.
///
/// @param handle the image
/// @return size width and height
#[api("simIM.size")]
fn size(cx: &Cx, handle: String) -> Result<Vec<i64>> {
    Ok(images(cx)
        .get(&handle)?
        .size()
        .map(|side| side as i64)
        .to_vec())
}

/// The format of an image.
///
/// @param handle the image
/// @return format simIM.format.*
#[api("simIM.getFormat")]
fn get_format(cx: &Cx, handle: String) -> Result<i64> {
    let format = images(cx).get(&handle)?.format();
    let at = FORMATS.iter().position(|known| *known == format);
    at.map(|at| FIRST_FORMAT + at as i64).ok_or_else(|| {
        refused(&format!(
            "unhandled OpenCV format: {}",
            format.opencv_type()
        ))
    })
}

/// Converts bytes to floats, or floats to bytes, which saturate. The number of channels stays.
///
/// @param handle the image
/// @param format simIM.format.* with the type of the values
/// @param scale of the values
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.convert")]
fn convert(
    cx: &Cx,
    handle: String,
    format: Number,
    #[default(1.0)] scale: f64,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let depth = format_of(format.0)?.depth;
    unary(cx, handle, in_place, |image| {
        Ok(image.converted(depth, scale))
    })
}

/// The values of a pixel in stored order: blue, green, red for an image of a camera. As in CoppeliaSim, places are right for images of
/// three channels; with one channel it is the pixel in column 3x.
///
/// @param handle the image
/// @param coord column and row from 0
/// @return value
#[api("simIM.get")]
fn get(cx: &Cx, handle: String, coord: Ints<2>) -> Result<Vec<f64>> {
    let image = images(cx).get(&handle)?;
    let first = place(&image, coord.0)?;
    Ok((first..first + image.format().channels)
        .filter_map(|at| image.value(at))
        .collect())
}

/// Sets the values of a pixel, at the same place as simIM.get.
///
/// @param handle the image
/// @param coord column and row from 0
/// @param value one number for each channel
#[api("simIM.set")]
fn set(cx: &Cx, handle: String, coord: Ints<2>, value: Vec<f64>) -> Result<()> {
    images(cx).modify(&handle, |image| {
        if value.len() != image.format().channels {
            return Err(refused("invalid pixel size"));
        }
        let first = place(image, coord.0)?;
        value
            .iter()
            .enumerate()
            .for_each(|(channel, value)| image.set_value(first + channel, *value));
        Ok(())
    })?
}

/// The index of the first value of a pixel, as if the image had three channels.
fn place(image: &Matrix, [x, y]: [i64; 2]) -> Result<usize> {
    const ASSUMED_CHANNELS: usize = 3;
    let ([width, height], channels) = (image.size(), image.format().channels);
    let inside = |at: i64, size: usize| usize::try_from(at).ok().filter(|at| *at < size);
    let first = inside(x, width)
        .zip(inside(y, height))
        .map(|(x, y)| y * width * channels + ASSUMED_CHANNELS * x);
    let is_inside = |first: &usize| first + channels <= width * height * channels;
    first
        .filter(is_inside)
        .ok_or_else(|| refused("the pixel is not inside of the image"))
}
