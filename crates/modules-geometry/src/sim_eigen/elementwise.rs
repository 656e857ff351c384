//! `simEigen.mtxOp`, `mtxOpK`: functions of each number.

use api_macro::api;
use nalgebra::DMatrix;

use super::store::{finish, get, refused};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![mtx_op, mtx_op_k];

/// The first of `simEigen.op`, in the order of `UNARY` and then `BINARY`.
const FIRST: i64 = 540;

const UNARY: &[fn(f64) -> f64] = &[
    |x| -x,
    f64::abs,
    libm::acos,
    libm::asin,
    libm::atan,
    f64::ceil,
    libm::cos,
    f64::to_degrees,
    libm::exp,
    f64::floor,
    libm::log,
    libm::log2,
    libm::log10,
    f64::to_radians,
    libm::sin,
    f64::sqrt,
    libm::tan,
];

/// The last two are as Lua's `//` and `%`.
const BINARY: &[fn(f64, f64) -> f64] = &[
    |a, b| a + b,
    |a, b| a - b,
    |a, b| a * b,
    |a, b| a / b,
    |a, b| (a / b).floor(),
    |a, b| a - (a / b).floor() * b,
    f64::min,
    f64::max,
];

fn place(op: i64) -> Option<usize> {
    usize::try_from(op.checked_sub(FIRST)?).ok()
}

fn unary(op: i64) -> Result<fn(f64) -> f64> {
    place(op)
        .and_then(|place| UNARY.get(place))
        .copied()
        .ok_or_else(|| refused("invalid operation for one matrix"))
}

fn binary(op: i64) -> Result<fn(f64, f64) -> f64> {
    let operation = place(op).and_then(|place| BINARY.get(place.checked_sub(UNARY.len())?));
    operation
        .copied()
        .ok_or_else(|| refused("invalid operation for two operands"))
}

/// A function of each number of a matrix, or of each pair of numbers of two.
///
/// @param handle the matrix
/// @param op one of simEigen.op
/// @param handle2 the second matrix, for operations with two
/// @param inplace changes the first matrix instead of making a new one
/// @return handle nothing if it was changed
#[api("simEigen.mtxOp")]
fn mtx_op(
    cx: &Cx,
    handle: String,
    op: i64,
    #[default(None)] handle2: Option<String>,
    #[default(true)] inplace: bool,
) -> Result<Option<String>> {
    let a = get::<DMatrix<f64>>(cx, &handle)?;
    let Some(handle2) = handle2 else {
        return finish(cx, &handle, a.map(unary(op)?), inplace);
    };
    let b = get::<DMatrix<f64>>(cx, &handle2)?;
    if a.shape() != b.shape() {
        return Err(refused("the sizes of the matrices do not fit"));
    }
    finish(cx, &handle, a.zip_map(&b, binary(op)?), inplace)
}

/// A function of each number of a matrix and another number.
///
/// @param handle the matrix
/// @param op one of simEigen.op
/// @param k the second operand
/// @param inplace changes the matrix instead of making a new one
/// @return handle nothing if it was changed
#[api("simEigen.mtxOpK")]
fn mtx_op_k(
    cx: &Cx,
    handle: String,
    op: i64,
    k: f64,
    #[default(true)] inplace: bool,
) -> Result<Option<String>> {
    let operation = binary(op)?;
    finish(
        cx,
        &handle,
        get::<DMatrix<f64>>(cx, &handle)?.map(|x| operation(x, k)),
        inplace,
    )
}
