//! `simIM.*`: weighted sums, vectors in two images, distances.

use api_macro::api;
use imaging::matrix::{DistanceType, MaskSize, Matrix};

use super::images::refused;
use super::objects::{binary, images, unary};
use crate::{ApiFn, Cx, Result, functions};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    add_weighted,
    scale_add,
    magnitude,
    phase,
    cart2polar,
    polar2cart,
    distance_transform
];

/// `simIM.dist.*`.
const L1: i64 = 10_500;
const L2: i64 = 10_501;
const CHESSBOARD: i64 = 10_502;
/// `simIM.maskSize.*`.
const MASK_3X3: i64 = 10_600;
const MASK_5X5: i64 = 10_601;
const PRECISE: i64 = 10_602;

/// `handle1 * alpha + handle2 * beta + gamma`; bytes saturate.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param alpha of the first image
/// @param beta of the second image
/// @param gamma is added
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.addWeighted")]
fn add_weighted(
    cx: &Cx,
    handle1: String,
    handle2: String,
    alpha: f64,
    beta: f64,
    gamma: f64,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.add_weighted(b, [alpha, beta, gamma])
    })
}

/// `handle1 * alpha + handle2`; bytes saturate.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param alpha of the first image
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.scaleAdd")]
fn scale_add(
    cx: &Cx,
    handle1: String,
    handle2: String,
    alpha: f64,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.add_weighted(b, [alpha, 1.0, 0.0])
    })
}

/// Lengths of vectors.
///
/// @param handle1 x coordinates, floats
/// @param handle2 y coordinates
/// @return handle
#[api("simIM.magnitude")]
fn magnitude(cx: &Cx, handle1: String, handle2: String) -> Result<String> {
    binary(cx, handle1, &handle2, false, Matrix::magnitude)
}

/// Angles of vectors, from 0 to a full turn.
///
/// @param handle1 x coordinates, floats
/// @param handle2 y coordinates
/// @param angleInDegrees degrees instead of rad
/// @return handle
#[api("simIM.phase")]
fn phase(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] angle_in_degrees: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, false, |x, y| {
        x.phase(y, angle_in_degrees)
    })
}

/// Lengths and angles of vectors.
///
/// @param handle1 x coordinates, floats
/// @param handle2 y coordinates
/// @param angleInDegrees degrees instead of rad
/// @return handle1 lengths
/// @return handle2 angles
#[api("simIM.cart2polar")]
fn cart2polar(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] angle_in_degrees: bool,
) -> Result<(String, String)> {
    let images = images(cx);
    let (x, y) = (images.get(&handle1)?, images.get(&handle2)?);
    let (lengths, angles) = (x.magnitude(&y)?, x.phase(&y, angle_in_degrees)?);
    Ok((images.add(cx, lengths)?, images.add(cx, angles)?))
}

/// As in CoppeliaSim the same as simIM.cart2polar: lengths and angles of vectors.
///
/// @param handle1 x coordinates, floats
/// @param handle2 y coordinates
/// @param angleInDegrees degrees instead of rad
/// @return handle1 lengths
/// @return handle2 angles
#[api("simIM.polar2cart")]
fn polar2cart(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] angle_in_degrees: bool,
) -> Result<(String, String)> {
    cart2polar(cx, handle1, handle2, angle_in_degrees)
}

/// The distance of each pixel to the nearest one that is 0, as floats.
///
/// @param handle an image of bytes with one channel
/// @param distanceType simIM.dist.*
/// @param maskSize simIM.maskSize.*: how L2 is found
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.distanceTransform")]
fn distance_transform(
    cx: &Cx,
    handle: String,
    #[default(L2, "simIM.dist.L2")] distance_type: Number,
    #[default(PRECISE, "simIM.maskSize._precise")] mask_size: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let distance = match distance_type.0 {
        L1 => DistanceType::Manhattan,
        L2 => DistanceType::Euclidean,
        CHESSBOARD => DistanceType::Chessboard,
        other => return Err(refused(&format!("invalid distance type: {other}"))),
    };
    let mask = match mask_size.0 {
        MASK_3X3 => MaskSize::Three,
        MASK_5X5 => MaskSize::Five,
        PRECISE => MaskSize::Precise,
        other => return Err(refused(&format!("invalid mask size: {other}"))),
    };
    unary(cx, handle, in_place, |image| {
        image.distance_transform(distance, mask)
    })
}
