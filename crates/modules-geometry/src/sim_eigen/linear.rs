//! `simEigen.mtx*`: products, determinant, singular values.
//!
//! Products are sums in the order of their terms: nalgebra's fast ones differ between processors.

use api_macro::api;
use nalgebra::{DMatrix, SVD};

use super::store::{add, check_size, get, refused, replace};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    mtx_mul,
    mtx_i_mul,
    mtx_kron,
    mtx_dot,
    mtx_cross,
    mtx_determinant,
    mtx_svd,
    mtx_p_inv
];

type Matrix = DMatrix<f64>;

/// A method that does not converge by then never will.
const MAX_ITERATIONS: usize = 10_000;

fn misfit() -> crate::ApiError {
    refused("the sizes of the matrices do not fit")
}

/// # Errors
/// When the first has not as many columns as the second has rows.
pub(super) fn product(a: &Matrix, b: &Matrix) -> Result<Matrix> {
    if a.ncols() != b.nrows() {
        return Err(misfit());
    }
    let mut result = Matrix::zeros(a.nrows(), b.ncols());
    for j in 0..b.ncols() {
        for k in 0..a.ncols() {
            let factor = b[(k, j)];
            result
                .column_mut(j)
                .iter_mut()
                .zip(a.column(k).iter())
                .for_each(|(sum, x)| *sum += x * factor);
        }
    }
    Ok(result)
}

/// The product of two matrices.
///
/// @param handle the first
/// @param handle2 the second
/// @return handle
#[api("simEigen.mtxMul")]
fn mtx_mul(cx: &Cx, handle: String, handle2: String) -> Result<String> {
    let (a, b) = (get::<Matrix>(cx, &handle)?, get::<Matrix>(cx, &handle2)?);
    check_size(cx, a.nrows().saturating_mul(b.ncols()))?;
    add(cx, product(&a, &b)?)
}

/// Multiplies a matrix by another.
///
/// @param handle the matrix that changes
/// @param handle2 the second
#[api("simEigen.mtxIMul")]
fn mtx_i_mul(cx: &Cx, handle: String, handle2: String) -> Result<()> {
    let (a, b) = (get::<Matrix>(cx, &handle)?, get::<Matrix>(cx, &handle2)?);
    check_size(cx, a.nrows().saturating_mul(b.ncols()))?;
    replace(cx, &handle, product(&a, &b)?)
}

/// The Kronecker product.
///
/// @param handle the first
/// @param handle2 the second
/// @return handle
#[api("simEigen.mtxKron")]
fn mtx_kron(cx: &Cx, handle: String, handle2: String) -> Result<String> {
    let (a, b) = (get::<Matrix>(cx, &handle)?, get::<Matrix>(cx, &handle2)?);
    check_size(cx, a.len().saturating_mul(b.len()))?;
    add(cx, a.kronecker(&b))
}

/// The scalar product of two vectors.
///
/// @param handle the first
/// @param handle2 the second
/// @return result
#[api("simEigen.mtxDot")]
fn mtx_dot(cx: &Cx, handle: String, handle2: String) -> Result<f64> {
    let (a, b) = (get::<Matrix>(cx, &handle)?, get::<Matrix>(cx, &handle2)?);
    let is_vector = |m: &Matrix| m.nrows() == 1 || m.ncols() == 1;
    if a.len() != b.len() || !is_vector(&a) || !is_vector(&b) {
        return Err(misfit());
    }
    Ok(a.iter().zip(b.iter()).map(|(x, y)| x * y).sum())
}

/// The vector product of two vectors of length 3.
///
/// @param handle the first
/// @param handle2 the second
/// @return handle
#[api("simEigen.mtxCross")]
fn mtx_cross(cx: &Cx, handle: String, handle2: String) -> Result<String> {
    let (a, b) = (get::<Matrix>(cx, &handle)?, get::<Matrix>(cx, &handle2)?);
    let (&[ax, ay, az], &[bx, by, bz]) = (a.as_slice(), b.as_slice()) else {
        return Err(misfit());
    };
    let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    add(cx, Matrix::from_column_slice(a.nrows(), a.ncols(), &cross))
}

/// The determinant of a square matrix.
///
/// @param handle the matrix
/// @return result
#[api("simEigen.mtxDeterminant")]
fn mtx_determinant(cx: &Cx, handle: String) -> Result<f64> {
    let matrix = get::<Matrix>(cx, &handle)?;
    if matrix.is_square() {
        Ok(matrix.determinant())
    } else {
        Err(refused("the matrix is not square"))
    }
}

/// The parts of a matrix: `u * diagonal(values) * v_t`, the largest value first.
struct Singular {
    u: Matrix,
    values: Vec<f64>,
    v_t: Matrix,
}

impl Singular {
    fn of(matrix: &Matrix) -> Result<Self> {
        if matrix.is_empty() || !matrix.iter().all(|x| x.is_finite()) {
            return Err(refused(
                "the matrix is empty, or a number in it is not finite",
            ));
        }
        let svd = SVD::try_new(matrix.clone(), true, true, f64::EPSILON, MAX_ITERATIONS);
        let parts = svd.and_then(|svd| Some((svd.u?, svd.singular_values, svd.v_t?)));
        let (u, values, v_t) =
            parts.ok_or_else(|| refused("the singular values were not found"))?;
        Ok(Self {
            u,
            values: values.iter().copied().collect(),
            v_t,
        })
    }

    /// The pseudo-inverse. With a damping d each value s counts as (s² + d²) / s; those that are rounding errors do not count.
    fn inverse(&self, damping: f64) -> Result<Matrix> {
        let largest = self.values.first().copied().unwrap_or_default();
        let size = self.u.nrows().max(self.v_t.ncols()) as f64;
        let mut scaled = self.v_t.transpose();
        for (mut column, s) in scaled.column_iter_mut().zip(&self.values) {
            let is_zero = *s <= largest * size * f64::EPSILON;
            let factor = if is_zero {
                0.0
            } else {
                s / (s * s + damping * damping)
            };
            column.iter_mut().for_each(|x| *x *= factor);
        }
        product(&scaled, &self.u.transpose())
    }
}

fn solution(cx: &Cx, inverse: &Matrix, b: Option<&String>) -> Result<Option<String>> {
    let Some(b) = b else { return Ok(None) };
    add(cx, product(inverse, &*get(cx, b)?)?).map(Some)
}

/// Singular value decomposition: m = u * diagonal(s) * transposed v.
///
/// @param m the matrix
/// @param computeThinU whether u is wanted; else it is empty
/// @param computeThinV whether v is wanted; else it is empty
/// @param b right sides of m * x = b
/// @return s column of the singular values, the largest first
/// @return u
/// @return v
/// @return x the solution with the smallest error, if there is b
#[api("simEigen.mtxSVD")]
fn mtx_svd(
    cx: &Cx,
    m: String,
    #[default(true)] compute_thin_u: bool,
    #[default(true)] compute_thin_v: bool,
    #[default(None)] b: Option<String>,
) -> Result<(String, String, String, Option<String>)> {
    let parts = Singular::of(&*get(cx, &m)?)?;
    let x = solution(cx, &parts.inverse(0.0)?, b.as_ref())?;
    let wanted = |is_wanted: bool, matrix: Matrix| {
        if is_wanted {
            matrix
        } else {
            Matrix::zeros(0, 0)
        }
    };
    let s = add(
        cx,
        Matrix::from_column_slice(parts.values.len(), 1, &parts.values),
    )?;
    let u = add(cx, wanted(compute_thin_u, parts.u))?;
    Ok((
        s,
        u,
        add(cx, wanted(compute_thin_v, parts.v_t.transpose()))?,
        x,
    ))
}

/// The pseudo-inverse.
///
/// @param m the matrix
/// @param b right sides of m * x = b
/// @param damping d: each singular value s counts as (s² + d²) / s
/// @return m the inverse
/// @return x the inverse times b, if there is b
#[api("simEigen.mtxPInv")]
fn mtx_p_inv(
    cx: &Cx,
    m: String,
    #[default(None)] b: Option<String>,
    #[default(0.0)] damping: f64,
) -> Result<(String, Option<String>)> {
    let inverse = Singular::of(&*get(cx, &m)?)?.inverse(damping)?;
    let x = solution(cx, &inverse, b.as_ref())?;
    Ok((add(cx, inverse)?, x))
}
