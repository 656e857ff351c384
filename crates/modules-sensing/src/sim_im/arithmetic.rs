//! `simIM.*`: arithmetic of the values of images.

use api_macro::api;
use imaging::matrix::{Bitwise, Comparison, Matrix};

use super::images::refused;
use super::objects::{binary, unary};
use crate::{ApiFn, Cx, Result, functions};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    abs,
    absdiff,
    absdiff_k,
    add,
    add_k,
    subtract,
    subtract_k,
    multiply,
    divide,
    divide_k,
    compare,
    compare_k,
    bitwise_and,
    bitwise_and_k,
    bitwise_or,
    bitwise_or_k,
    bitwise_xor,
    bitwise_xor_k,
    bitwise_not,
    exp,
    log,
    pow,
    sqrt,
];

/// `simIM.cmpOp.eq` and the others.
fn comparison(number: i64) -> Result<Comparison> {
    const FIRST: i64 = 5700;
    Ok(match number.wrapping_sub(FIRST) {
        0 => Comparison::Equal,
        1 => Comparison::Greater,
        2 => Comparison::GreaterOrEqual,
        3 => Comparison::Less,
        4 => Comparison::LessOrEqual,
        5 => Comparison::NotEqual,
        _ => return Err(refused(&format!("invalid operation: {number}"))),
    })
}

/// Absolute values.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.abs")]
fn abs(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, |image| Ok(image.abs()))
}

/// Absolute differences.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.absdiff")]
fn absdiff(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, Matrix::difference)
}

/// Absolute differences to numbers.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.absdiffK")]
fn absdiff_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| {
        image.difference_to_numbers(&k)
    })
}

/// Sums; bytes saturate.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.add")]
fn add(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, Matrix::add)
}

/// Sums with numbers; bytes saturate.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.addK")]
fn add_k(cx: &Cx, handle: String, k: Vec<f64>, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, |image| image.add_numbers(&k))
}

/// Differences; bytes saturate.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.subtract")]
fn subtract(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, Matrix::subtract)
}

/// Differences to numbers; bytes saturate.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.subtractK")]
fn subtract_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| image.subtract_numbers(&k))
}

/// Products; bytes saturate.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.multiply")]
fn multiply(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, Matrix::multiply)
}

/// Quotients; bytes by 0 are 0.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.divide")]
fn divide(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, Matrix::divide)
}

/// Numbers divided by the values of an image; by bytes of 0 they are 0.
///
/// @param k one number for each channel
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.divideK")]
fn divide_k(
    cx: &Cx,
    k: Vec<f64>,
    handle: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| image.divide_numbers(&k))
}

/// 255 where a comparison holds, else 0.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param op simIM.cmpOp.*
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.compare")]
fn compare(
    cx: &Cx,
    handle1: String,
    handle2: String,
    op: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let comparison = comparison(op.0)?;
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.compare(b, comparison)
    })
}

/// 255 where a comparison with a number holds, else 0.
///
/// @param handle the image
/// @param k one number for each channel
/// @param op simIM.cmpOp.*
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.compareK")]
fn compare_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    op: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let comparison = comparison(op.0)?;
    unary(cx, handle, in_place, |image| {
        image.compare_numbers(&k, comparison)
    })
}

/// Bits of both images, combined by and.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.bitwiseAnd")]
fn bitwise_and(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.bitwise(b, Bitwise::And)
    })
}

/// Bits of an image and of numbers, combined by and.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.bitwiseAndK")]
fn bitwise_and_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| {
        image.bitwise(&image.constant(&k)?, Bitwise::And)
    })
}

/// Bits of both images, combined by or.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.bitwiseOr")]
fn bitwise_or(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.bitwise(b, Bitwise::Or)
    })
}

/// Bits of an image and of numbers, combined by or.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.bitwiseOrK")]
fn bitwise_or_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| {
        image.bitwise(&image.constant(&k)?, Bitwise::Or)
    })
}

/// Bits of both images, combined by xor.
///
/// @param handle1 an image
/// @param handle2 an image of the same size and format
/// @param inPlace changes the first image instead of making a new one
/// @return handle
#[api("simIM.bitwiseXor")]
fn bitwise_xor(
    cx: &Cx,
    handle1: String,
    handle2: String,
    #[default(false)] in_place: bool,
) -> Result<String> {
    binary(cx, handle1, &handle2, in_place, |a, b| {
        a.bitwise(b, Bitwise::Xor)
    })
}

/// Bits of an image and of numbers, combined by xor.
///
/// @param handle the image
/// @param k one number for each channel
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.bitwiseXorK")]
fn bitwise_xor_k(
    cx: &Cx,
    handle: String,
    k: Vec<f64>,
    #[default(false)] in_place: bool,
) -> Result<String> {
    unary(cx, handle, in_place, |image| {
        image.bitwise(&image.constant(&k)?, Bitwise::Xor)
    })
}

/// Inverted bits.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.bitwiseNot")]
fn bitwise_not(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, |image| Ok(image.bitwise_not()))
}

/// Exponentials of floats.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.exp")]
fn exp(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::exp)
}

/// Natural logarithms of floats.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.log")]
fn log(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::log)
}

/// Powers. Bytes have whole powers only; of other powers the absolute value is taken.
///
/// @param handle the image
/// @param power of each value
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.pow")]
fn pow(cx: &Cx, handle: String, power: f64, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, |image| image.pow(power))
}

/// Square roots of floats.
///
/// @param handle the image
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.sqrt")]
fn sqrt(cx: &Cx, handle: String, #[default(false)] in_place: bool) -> Result<String> {
    unary(cx, handle, in_place, Matrix::sqrt)
}
