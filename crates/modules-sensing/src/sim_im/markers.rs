//! `simIM.*`: square markers.

use api_macro::api;
use imaging::markers::Dictionary;
use imaging::matrix::{Matrix, MatrixError};

use super::images::refused;
use super::objects::images;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_marker_dictionary,
    draw_marker,
    detect_markers,
    get_marker_bit_size
];

/// `simIM.dict_type.*`: four sizes of 4 x 4 to 7 x 7 bits, then the others.
const FIRST: i64 = 9500;
const LAST: i64 = 9520;
const ARUCO_ORIGINAL: i64 = 9516;
/// The dictionary is the same for everybody, so that its handle is its number.
const ORIGINAL_HANDLE: &str = "252c:cv.aruco.Dictionary";

/// Names of the types, in order.
const NAMES: [&str; 21] = [
    "_4X4_50",
    "_4X4_100",
    "_4X4_250",
    "_4X4_1000",
    "_5X5_50",
    "_5X5_100",
    "_5X5_250",
    "_5X5_1000",
    "_6X6_50",
    "_6X6_100",
    "_6X6_250",
    "_6X6_1000",
    "_7X7_50",
    "_7X7_100",
    "_7X7_250",
    "_7X7_1000",
    "_ARUCO_ORIGINAL",
    "_APRILTAG_16h5",
    "_APRILTAG_25h9",
    "_APRILTAG_36h10",
    "_APRILTAG_36h11",
];

fn index_of(number: i64) -> Result<usize> {
    let is_type = (FIRST..=LAST).contains(&number);
    if is_type {
        Ok((number - FIRST) as usize)
    } else {
        Err(refused("invalid dictionary type"))
    }
}

fn dictionary(handle: &str) -> Result<Dictionary> {
    if handle == ORIGINAL_HANDLE {
        Ok(Dictionary::aruco_original())
    } else {
        Err(refused("invalid object handle"))
    }
}

/// A dictionary of markers. Only that of the original ArUco is here: the others are tables that OpenCV and AprilTag own.
///
/// @param type simIM.dict_type._ARUCO_ORIGINAL
/// @return handle
#[api("simIM.getMarkerDictionary")]
fn get_marker_dictionary(_cx: &Cx, r#type: Number) -> Result<String> {
    let name = NAMES[index_of(r#type.0)?];
    if r#type.0 != ARUCO_ORIGINAL {
        return Err(ApiError::NotImplemented(format!(
            "simIM.dict_type.{name}; there is _ARUCO_ORIGINAL"
        )));
    }
    Ok(ORIGINAL_HANDLE.to_owned())
}

/// Draws a marker with a black border.
///
/// @param dictionaryHandle the dictionary
/// @param markerId its number in it
/// @param size pixels of each side
/// @param handle the image to change; nothing for a new one
/// @param borderSize of the border, in bits
/// @return handle an image of bytes with one channel
#[api("simIM.drawMarker")]
fn draw_marker(
    cx: &Cx,
    dictionary_handle: String,
    marker_id: Number,
    size: Number,
    #[default(String::new())] handle: String,
    #[default(1)] border_size: Number,
) -> Result<String> {
    let dictionary = dictionary(&dictionary_handle)?;
    let id =
        usize::try_from(marker_id.0).map_err(|_| MatrixError::Range("the number of a marker"))?;
    let side = usize::try_from(size.0).map_err(|_| MatrixError::Size)?;
    let border =
        usize::try_from(border_size.0).map_err(|_| MatrixError::Range("the border of a marker"))?;
    let image: Matrix = dictionary.draw(id, side, border)?;
    if handle.is_empty() {
        return images(cx).add(cx, image);
    }
    images(cx).replace(&handle, image)?;
    Ok(handle)
}

/// Finds markers.
///
/// @param handle an image of bytes
/// @param dictionaryHandle the dictionary
/// @return corners column and row of the four corners of each marker, clockwise from its upper left one
/// @return markerIds
/// @return rejectedCandidates corners of squares that are no markers
#[api("simIM.detectMarkers")]
fn detect_markers(
    cx: &Cx,
    handle: String,
    dictionary_handle: String,
) -> Result<(Vec<f64>, Vec<i64>, Vec<f64>)> {
    let image = images(cx).get(&handle)?;
    let found = dictionary(&dictionary_handle)?.detect(&image)?;
    let corners = found
        .markers
        .iter()
        .flat_map(|marker| marker.corners)
        .flatten()
        .collect();
    let ids = found
        .markers
        .iter()
        .map(|marker| marker.id as i64)
        .collect();
    Ok((
        corners,
        ids,
        found.rejected.into_iter().flatten().flatten().collect(),
    ))
}

/// The bits of a side of a dictionary's markers; as in CoppeliaSim 6 for those of the original ArUco, which have 5.
///
/// @param dictType simIM.dict_type.*
/// @return size
#[api("simIM.getMarkerBitSize")]
fn get_marker_bit_size(_cx: &Cx, dict_type: Number) -> Result<i64> {
    const OTHERS: [i64; 5] = [6, 4, 5, 6, 6];
    Ok(match index_of(dict_type.0)? {
        at @ 0..16 => 4 + at as i64 / 4,
        at => OTHERS[at - 16],
    })
}
