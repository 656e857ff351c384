//! `simIM.*`: channels and colours.

use api_macro::api;
use imaging::matrix::Matrix;

use super::arguments::HandleList;
use super::images::refused;
use super::objects::{images, unary};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    rgb2gray,
    gray2rgb,
    rgb2hsv,
    hsv2rgb,
    rgb2hls,
    hls2rgb,
    split,
    merge,
    mix_channels
];

/// Grey of an image. The first channel counts as red: of an image of a camera it is blue.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.rgb2gray")]
fn rgb2gray(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::grey_from_rgb)
}

/// Three equal channels of one.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.gray2rgb")]
fn gray2rgb(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::rgb_from_grey)
}

/// Hue, saturation and value. The first channel counts as red. Hue is 0 to 179 in bytes, 0 to 360 in floats.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.rgb2hsv")]
fn rgb2hsv(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::hsv_from_rgb)
}

/// The colours of hue, saturation and value; the first channel is red.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.hsv2rgb")]
fn hsv2rgb(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::rgb_from_hsv)
}

/// Hue, lightness and saturation. The first channel counts as red. Hue is 0 to 179 in bytes, 0 to 360 in floats.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.rgb2hls")]
fn rgb2hls(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::hls_from_rgb)
}

/// The colours of hue, lightness and saturation; the first channel is red.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.hls2rgb")]
fn hls2rgb(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::rgb_from_hls)
}

/// The channels of an image as images of their own.
///
/// @param handle the image
/// @return handles
#[api("simIM.split")]
fn split(cx: &Cx, handle: String) -> Result<Vec<String>> {
    let images = images(cx);
    let image = images.get(&handle)?;
    if image.format().channels < 2 {
        return Err(refused("not a multichannel image"));
    }
    image
        .split()
        .into_iter()
        .map(|channel| images.add(cx, channel))
        .collect()
}

/// An image of the channels of others.
///
/// @param handles at least two images
/// @return handle
#[api("simIM.merge")]
fn merge(cx: &Cx, handles: HandleList) -> Result<String> {
    if handles.0.len() < 2 {
        return Err(refused("invalid number of channels"));
    }
    let parts = all(cx, &handles)?;
    images(cx).add(cx, Matrix::merge(&parts)?)
}

/// Copies channels of images to channels of others.
///
/// @param inputHandles images to read
/// @param outputHandles images to change
/// @param fromTo pairs of channels, counted from 0 over all images of a list; a negative source clears
#[api("simIM.mixChannels")]
fn mix_channels(
    cx: &Cx,
    input_handles: HandleList,
    output_handles: HandleList,
    from_to: Vec<i64>,
) -> Result<()> {
    let (inputs, mut outputs) = (all(cx, &input_handles)?, all(cx, &output_handles)?);
    let (pairs, rest) = from_to.as_chunks();
    if !rest.is_empty() {
        return Err(refused("fromTo has a number without a partner"));
    }
    Matrix::mix_channels(&inputs, &mut outputs, pairs)?;
    let images = images(cx);
    output_handles
        .0
        .iter()
        .zip(outputs)
        .try_for_each(|(handle, image)| images.replace(handle, image))
}

fn all(cx: &Cx, handles: &HandleList) -> Result<Vec<Matrix>> {
    let images = images(cx);
    handles
        .0
        .iter()
        .map(|handle| images.get(handle).map(|image| Matrix::clone(&image)))
        .collect()
}
