//! `simIM.*`: other sizes, regions, mirrored images.

use api_macro::api;
use imaging::matrix::{Flip, Interpolation, MatrixError, Reduction};

use super::arguments::Ints;
use super::images::{refused, sides};
use super::objects::{images, unary};
use crate::{ApiFn, Cx, Result, functions};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![resize, copy, flip, repeat, reduce];

/// `simIM.interp.*`, `simIM.reduceOp.*`, `simIM.flipOp.*`.
mod constant {
    pub const NEAREST: i64 = 1200;
    pub const LINEAR: i64 = 1201;
    pub const AREA: i64 = 1202;
    pub const CUBIC: i64 = 1203;
    pub const LANCZOS: i64 = 1204;
    pub const SUM: i64 = 6700;
    pub const AVERAGE: i64 = 6701;
    pub const LARGEST: i64 = 6702;
    pub const SMALLEST: i64 = 6703;
    pub const FLIP_X: i64 = 8900;
    pub const FLIP_BOTH: i64 = 8902;
}

/// An image in another size.
///
/// @param handle the image
/// @param width columns
/// @param height rows
/// @param interpolation simIM.interp.*
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.resize")]
fn resize(
    cx: &Cx,
    handle: String,
    width: Number,
    height: Number,
    #[default(1201, "simIM.interp.linear")] interpolation: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let interpolation = match interpolation.0 {
        constant::NEAREST => Interpolation::Nearest,
        constant::LINEAR => Interpolation::Linear,
        constant::AREA => Interpolation::Area,
        constant::CUBIC => Interpolation::Cubic,
        constant::LANCZOS => Interpolation::Lanczos,
        other => return Err(refused(&format!("invalid interpolation: {other}"))),
    };
    let size = sides(width.0, height.0)?;
    unary(cx, handle, in_place, |image| {
        image.resized(size, interpolation)
    })
}

/// Copies a region of an image to another.
///
/// @param srcHandle the image to read
/// @param srcOffset column and row
/// @param dstHandle the image to change, of the same format
/// @param dstOffset column and row
/// @param size columns and rows
#[api("simIM.copy")]
fn copy(
    cx: &Cx,
    src_handle: String,
    src_offset: Ints<2>,
    dst_handle: String,
    dst_offset: Ints<2>,
    size: Ints<2>,
) -> Result<()> {
    let images = images(cx);
    let source = images.get(&src_handle)?;
    Ok(images.modify(&dst_handle, |image| {
        image.copy_from(&source, src_offset.0, dst_offset.0, size.0)
    })??)
}

/// A mirrored image.
///
/// @param handle the image
/// @param op simIM.flipOp.x mirrors columns, simIM.flipOp.both columns and rows, everything else rows
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.flip")]
fn flip(
    cx: &Cx,
    handle: String,
    #[default(0)] op: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let flip = match op.0 {
        constant::FLIP_X => Flip::Columns,
        constant::FLIP_BOTH => Flip::Both,
        _ => Flip::Rows,
    };
    unary(cx, handle, in_place, |image| Ok(image.flipped(flip)))
}

/// An image beside itself.
///
/// @param handle the image
/// @param nx how often side by side
/// @param ny how often one below the other
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.repeat")]
fn repeat(
    cx: &Cx,
    handle: String,
    nx: Number,
    ny: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let count = |number: i64| usize::try_from(number).map_err(|_| MatrixError::Range("a count"));
    let counts = [count(nx.0)?, count(ny.0)?];
    unary(cx, handle, in_place, |image| image.repeated(counts))
}

/// Combines the rows of an image to one, or its columns.
///
/// @param handle the image
/// @param dim 0: one row, 1: one column
/// @param op simIM.reduceOp.*; bytes have no sum
/// @param inPlace changes the image instead of making a new one
/// @return handle
#[api("simIM.reduce")]
fn reduce(
    cx: &Cx,
    handle: String,
    dim: Number,
    op: Number,
    #[default(false)] in_place: bool,
) -> Result<String> {
    let reduction = match op.0 {
        constant::SUM => Reduction::Sum,
        constant::AVERAGE => Reduction::Average,
        constant::LARGEST => Reduction::Largest,
        constant::SMALLEST => Reduction::Smallest,
        other => return Err(refused(&format!("invalid operation: {other}"))),
    };
    let to_row = match dim.0 {
        0 => true,
        1 => false,
        _ => return Err(MatrixError::Range("the dimension").into()),
    };
    unary(cx, handle, in_place, |image| {
        image.reduced(to_row, reduction)
    })
}
