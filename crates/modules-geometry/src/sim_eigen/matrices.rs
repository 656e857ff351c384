//! `simEigen.mtx*`: making, reading and putting together. Numbers are listed by rows.

use api_macro::api;
use nalgebra::DMatrix;

use super::store::{HandleList, add, check_size, get, modify, refused, remove, replace};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    mtx_new,
    mtx_copy,
    mtx_destroy,
    mtx_lin_spaced,
    mtx_get_size,
    mtx_get_data,
    mtx_set_data,
    mtx_get_item,
    mtx_set_item,
    mtx_get_row_data,
    mtx_set_row_data,
    mtx_get_col_data,
    mtx_set_col_data,
    mtx_block,
    mtx_block_assign,
    mtx_reshaped,
    mtx_horz_cat,
    mtx_vert_cat,
    mtx_transpose,
    mtx_transposed,
];

type Matrix = DMatrix<f64>;

fn length(number: i64) -> Result<usize> {
    usize::try_from(number).map_err(|_| refused("sizes and counts must not be negative"))
}

fn index(at: i64, count: usize) -> Result<usize> {
    usize::try_from(at)
        .ok()
        .filter(|at| *at < count)
        .ok_or_else(|| refused("index out of range"))
}

fn check_count(data: &[f64], count: usize) -> Result<()> {
    if data.len() == count {
        Ok(())
    } else {
        Err(refused(&format!(
            "invalid number of elements: {count} are needed, not {}",
            data.len()
        )))
    }
}

fn by_rows(matrix: &Matrix) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// A new matrix.
///
/// @param rows number of rows
/// @param cols number of columns
/// @param initialData by rows; zeros without
/// @return handle
#[api("simEigen.mtxNew")]
fn mtx_new(
    cx: &Cx,
    rows: i64,
    cols: i64,
    #[default(Vec::new())] initial_data: Vec<f64>,
) -> Result<String> {
    let (rows, cols) = (length(rows)?, length(cols)?);
    let count = rows.saturating_mul(cols);
    check_size(cx, count)?;
    if initial_data.is_empty() {
        return add(cx, Matrix::zeros(rows, cols));
    }
    check_count(&initial_data, count)?;
    add(cx, Matrix::from_row_slice(rows, cols, &initial_data))
}

/// A copy.
///
/// @param handle the matrix
/// @return handle
#[api("simEigen.mtxCopy")]
fn mtx_copy(cx: &Cx, handle: String) -> Result<String> {
    add(cx, Matrix::clone(&*get(cx, &handle)?))
}

/// Ends a matrix.
///
/// @param handle the matrix
#[api("simEigen.mtxDestroy")]
fn mtx_destroy(cx: &Cx, handle: String) -> Result<()> {
    remove::<Matrix>(cx, &handle)
}

/// A column of evenly spaced numbers.
///
/// @param count how many
/// @param low the first
/// @param high the last; without it each is one more than the one before
/// @return handle
#[api("simEigen.mtxLinSpaced")]
fn mtx_lin_spaced(
    cx: &Cx,
    count: i64,
    #[default(1.0)] low: f64,
    #[default(None)] high: Option<f64>,
) -> Result<String> {
    let count = length(count)?;
    check_size(cx, count)?;
    let steps = count.saturating_sub(1).max(1) as f64;
    let step = high.map_or(1.0, |high| (high - low) / steps);
    let is_last = |i: usize| i + 1 == count && count > 1;
    add(
        cx,
        Matrix::from_fn(count, 1, |i, _| {
            high.filter(|_| is_last(i)).unwrap_or(low + step * i as f64)
        }),
    )
}

/// Rows and columns.
///
/// @param handle the matrix
/// @return rows
/// @return cols
#[api("simEigen.mtxGetSize")]
fn mtx_get_size(cx: &Cx, handle: String) -> Result<(i64, i64)> {
    let (rows, cols) = get::<Matrix>(cx, &handle)?.shape();
    Ok((rows as i64, cols as i64))
}

/// All numbers.
///
/// @param handle the matrix
/// @return data by rows
#[api("simEigen.mtxGetData")]
fn mtx_get_data(cx: &Cx, handle: String) -> Result<Vec<f64>> {
    Ok(by_rows(&*get(cx, &handle)?))
}

/// Sets all numbers.
///
/// @param handle the matrix
/// @param data by rows
#[api("simEigen.mtxSetData")]
fn mtx_set_data(cx: &Cx, handle: String, data: Vec<f64>) -> Result<()> {
    let (rows, cols) = get::<Matrix>(cx, &handle)?.shape();
    check_count(&data, rows * cols)?;
    replace(cx, &handle, Matrix::from_row_slice(rows, cols, &data))
}

/// One number.
///
/// @param handle the matrix
/// @param i row, from 0
/// @param j column, from 0
/// @return data
#[api("simEigen.mtxGetItem")]
fn mtx_get_item(cx: &Cx, handle: String, i: i64, j: i64) -> Result<f64> {
    let matrix = get::<Matrix>(cx, &handle)?;
    Ok(matrix[(index(i, matrix.nrows())?, index(j, matrix.ncols())?)])
}

/// Sets one number.
///
/// @param handle the matrix
/// @param i row, from 0
/// @param j column, from 0
/// @param data the number
#[api("simEigen.mtxSetItem")]
fn mtx_set_item(cx: &Cx, handle: String, i: i64, j: i64, data: f64) -> Result<()> {
    modify::<Matrix>(cx, &handle, |matrix| {
        let at = (index(i, matrix.nrows())?, index(j, matrix.ncols())?);
        matrix[at] = data;
        Ok(())
    })
}

/// The numbers of a row.
///
/// @param handle the matrix
/// @param i row, from 0
/// @return data
#[api("simEigen.mtxGetRowData")]
fn mtx_get_row_data(cx: &Cx, handle: String, i: i64) -> Result<Vec<f64>> {
    let matrix = get::<Matrix>(cx, &handle)?;
    Ok(matrix
        .row(index(i, matrix.nrows())?)
        .iter()
        .copied()
        .collect())
}

/// Sets the numbers of a row.
///
/// @param handle the matrix
/// @param i row, from 0
/// @param data as many as there are columns
#[api("simEigen.mtxSetRowData")]
fn mtx_set_row_data(cx: &Cx, handle: String, i: i64, data: Vec<f64>) -> Result<()> {
    modify::<Matrix>(cx, &handle, |matrix| {
        check_count(&data, matrix.ncols())?;
        let i = index(i, matrix.nrows())?;
        matrix
            .row_mut(i)
            .iter_mut()
            .zip(data)
            .for_each(|(place, value)| *place = value);
        Ok(())
    })
}

/// The numbers of a column.
///
/// @param handle the matrix
/// @param j column, from 0
/// @return data
#[api("simEigen.mtxGetColData")]
fn mtx_get_col_data(cx: &Cx, handle: String, j: i64) -> Result<Vec<f64>> {
    let matrix = get::<Matrix>(cx, &handle)?;
    Ok(matrix
        .column(index(j, matrix.ncols())?)
        .iter()
        .copied()
        .collect())
}

/// Sets the numbers of a column.
///
/// @param handle the matrix
/// @param j column, from 0
/// @param data as many as there are rows
#[api("simEigen.mtxSetColData")]
fn mtx_set_col_data(cx: &Cx, handle: String, j: i64, data: Vec<f64>) -> Result<()> {
    modify::<Matrix>(cx, &handle, |matrix| {
        check_count(&data, matrix.nrows())?;
        let j = index(j, matrix.ncols())?;
        matrix.column_mut(j).copy_from_slice(&data);
        Ok(())
    })
}

/// From where a block begins, and how long it is; -1: to the end.
fn span(start: i64, count: i64, all: usize) -> Result<(usize, usize)> {
    let start = usize::try_from(start).ok().filter(|start| *start <= all);
    let start = start.ok_or_else(|| refused("index out of range"))?;
    let count = if count == -1 {
        all - start
    } else {
        length(count)?
    };
    if count > all - start {
        return Err(refused("the block is larger than the matrix"));
    }
    Ok((start, count))
}

/// A part of a matrix, as a new one.
///
/// @param handle the matrix
/// @param i first row, from 0
/// @param j first column, from 0
/// @param p number of rows; -1: all that follow
/// @param q number of columns; -1: all that follow
/// @return handle
#[api("simEigen.mtxBlock")]
fn mtx_block(
    cx: &Cx,
    handle: String,
    #[default(0)] i: i64,
    #[default(0)] j: i64,
    #[default(-1)] p: i64,
    #[default(-1)] q: i64,
) -> Result<String> {
    let matrix = get::<Matrix>(cx, &handle)?;
    let ((i, p), (j, q)) = (span(i, p, matrix.nrows())?, span(j, q, matrix.ncols())?);
    add(cx, matrix.view((i, j), (p, q)).into_owned())
}

/// Puts a matrix into another.
///
/// @param handle the matrix that changes
/// @param handle2 the matrix that is put in
/// @param i first row, from 0
/// @param j first column, from 0
/// @param p number of rows; -1: all of `handle2`
/// @param q number of columns; -1: all of `handle2`
#[api("simEigen.mtxBlockAssign")]
fn mtx_block_assign(
    cx: &Cx,
    handle: String,
    handle2: String,
    #[default(0)] i: i64,
    #[default(0)] j: i64,
    #[default(-1)] p: i64,
    #[default(-1)] q: i64,
) -> Result<()> {
    let part = get::<Matrix>(cx, &handle2)?;
    let ((_, p), (_, q)) = (span(0, p, part.nrows())?, span(0, q, part.ncols())?);
    modify::<Matrix>(cx, &handle, |matrix| {
        let ((i, p), (j, q)) = (
            span(i, p as i64, matrix.nrows())?,
            span(j, q as i64, matrix.ncols())?,
        );
        matrix
            .view_mut((i, j), (p, q))
            .copy_from(&part.view((0, 0), (p, q)));
        Ok(())
    })
}

/// The same numbers, by rows, in another shape.
///
/// @param handle the matrix
/// @param rows number of rows; -1: what the number of columns asks for
/// @param cols number of columns; -1: what the number of rows asks for
/// @return handle
#[api("simEigen.mtxReshaped")]
fn mtx_reshaped(cx: &Cx, handle: String, rows: i64, cols: i64) -> Result<String> {
    let matrix = get::<Matrix>(cx, &handle)?;
    let (rows, cols) = match (rows, cols) {
        (-1, cols) if cols > 0 => (matrix.len() / length(cols)?, length(cols)?),
        (rows, -1) if rows > 0 => (length(rows)?, matrix.len() / length(rows)?),
        _ => (length(rows)?, length(cols)?),
    };
    let data = by_rows(&matrix);
    check_count(&data, rows.saturating_mul(cols))?;
    add(cx, Matrix::from_row_slice(rows, cols, &data))
}

fn joined(
    cx: &Cx,
    handles: &[String],
    place: fn(&Matrix) -> (usize, usize),
    is_wide: bool,
) -> Result<String> {
    let parts = handles
        .iter()
        .map(|handle| get::<Matrix>(cx, handle))
        .collect::<Result<Vec<_>>>()?;
    let across = parts.first().map_or(0, |part| place(part).0);
    if parts.iter().any(|part| place(part).0 != across) {
        return Err(refused("the sizes of the matrices do not fit"));
    }
    let along: usize = parts.iter().map(|part| place(part).1).sum();
    check_size(cx, across.saturating_mul(along))?;
    let mut result = if is_wide {
        Matrix::zeros(across, along)
    } else {
        Matrix::zeros(along, across)
    };
    let mut at = 0;
    for part in parts {
        let corner = if is_wide { (0, at) } else { (at, 0) };
        result.view_mut(corner, part.shape()).copy_from(&part);
        at += place(&part).1;
    }
    add(cx, result)
}

/// Matrices side by side.
///
/// @param handles matrices with as many rows
/// @return handle
#[api("simEigen.mtxHorzCat")]
fn mtx_horz_cat(cx: &Cx, handles: HandleList) -> Result<String> {
    joined(cx, &handles.0, |part| (part.nrows(), part.ncols()), true)
}

/// Matrices below each other.
///
/// @param handles matrices with as many columns
/// @return handle
#[api("simEigen.mtxVertCat")]
fn mtx_vert_cat(cx: &Cx, handles: HandleList) -> Result<String> {
    joined(cx, &handles.0, |part| (part.ncols(), part.nrows()), false)
}

/// Exchanges rows and columns.
///
/// @param handle the matrix that changes
#[api("simEigen.mtxTranspose")]
fn mtx_transpose(cx: &Cx, handle: String) -> Result<()> {
    let matrix = get::<Matrix>(cx, &handle)?;
    replace(cx, &handle, matrix.transpose())
}

/// With rows and columns exchanged.
///
/// @param handle the matrix
/// @return handle
#[api("simEigen.mtxTransposed")]
fn mtx_transposed(cx: &Cx, handle: String) -> Result<String> {
    add(cx, get::<Matrix>(cx, &handle)?.transpose())
}
