//! `simEigen.mtx*`: one number of all.

use api_macro::api;
use nalgebra::DMatrix;

use super::store::{add, get, refused, replace};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    mtx_sum,
    mtx_prod,
    mtx_mean,
    mtx_min_coeff,
    mtx_max_coeff,
    mtx_trace,
    mtx_norm,
    mtx_squared_norm,
    mtx_normalize,
    mtx_normalized,
];

type Matrix = DMatrix<f64>;

fn sum(matrix: &Matrix) -> f64 {
    matrix.iter().sum()
}

fn squared_norm(matrix: &Matrix) -> f64 {
    matrix.iter().map(|x| x * x).sum()
}

/// The first number with `is_better` than all before.
fn best(matrix: &Matrix, is_better: fn(&f64, &f64) -> bool) -> Result<f64> {
    let best = matrix
        .iter()
        .copied()
        .reduce(|best, x| if is_better(&x, &best) { x } else { best });
    best.ok_or_else(|| refused("the matrix is empty"))
}

/// The sum of all numbers.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxSum")]
fn mtx_sum(cx: &Cx, handle: String) -> Result<f64> {
    Ok(sum(&*get(cx, &handle)?))
}

/// The product of all numbers.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxProd")]
fn mtx_prod(cx: &Cx, handle: String) -> Result<f64> {
    Ok(get::<Matrix>(cx, &handle)?.iter().product())
}

/// The mean of all numbers.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxMean")]
fn mtx_mean(cx: &Cx, handle: String) -> Result<f64> {
    let matrix = get::<Matrix>(cx, &handle)?;
    if matrix.is_empty() {
        Err(refused("the matrix is empty"))
    } else {
        Ok(sum(&matrix) / matrix.len() as f64)
    }
}

/// The smallest number.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxMinCoeff")]
fn mtx_min_coeff(cx: &Cx, handle: String) -> Result<f64> {
    best(&*get(cx, &handle)?, |x, best| x < best)
}

/// The largest number.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxMaxCoeff")]
fn mtx_max_coeff(cx: &Cx, handle: String) -> Result<f64> {
    best(&*get(cx, &handle)?, |x, best| x > best)
}

/// The sum of the diagonal.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxTrace")]
fn mtx_trace(cx: &Cx, handle: String) -> Result<f64> {
    let matrix = get::<Matrix>(cx, &handle)?;
    Ok((0..matrix.nrows().min(matrix.ncols()))
        .map(|i| matrix[(i, i)])
        .sum())
}

/// The root of the sum of squares.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxNorm")]
fn mtx_norm(cx: &Cx, handle: String) -> Result<f64> {
    Ok(squared_norm(&*get(cx, &handle)?).sqrt())
}

/// The sum of squares.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxSquaredNorm")]
fn mtx_squared_norm(cx: &Cx, handle: String) -> Result<f64> {
    Ok(squared_norm(&*get(cx, &handle)?))
}

/// With the norm 1; zeros stay zeros.
fn normalized(matrix: &Matrix) -> Matrix {
    let norm = squared_norm(matrix).sqrt();
    if norm > 0.0 {
        matrix.map(|x| x / norm)
    } else {
        matrix.clone()
    }
}

/// Divides a matrix by its norm.
///
/// @param handle the matrix that changes
#[api("simEigen.mtxNormalize")]
fn mtx_normalize(cx: &Cx, handle: String) -> Result<()> {
    let matrix = get::<Matrix>(cx, &handle)?;
    replace(cx, &handle, normalized(&matrix))
}

/// A matrix divided by its norm.
///
/// @param handle the matrix
/// @return handle
#[api("simEigen.mtxNormalized")]
fn mtx_normalized(cx: &Cx, handle: String) -> Result<String> {
    add(cx, normalized(&*get(cx, &handle)?))
}
