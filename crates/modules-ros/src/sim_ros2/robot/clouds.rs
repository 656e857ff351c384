//! Pictures and depths of vision sensors as messages have them: the highest row first, and points in the frame of optics: x to the right, y down, z ahead.

use api_macro::api;

use super::{check_length, count, floats};
use crate::sim_ros2::{ApiFn, Cx, Result, functions};
use script::Bytes;

pub(super) const FUNCTIONS: &[ApiFn] = functions![flipped_rows, depth_image, cloud_of_depths];

/// How much of the far plane's distance is taken for nothing there.
const NOTHING: f32 = 1.0 - 1e-5;

/// The rows of a picture in the other order.
///
/// @param data rows of equal length
/// @param row bytes of a row
/// @return flipped
#[api("remote.ros2.robots.flippedRows")]
fn flipped_rows(_cx: &Cx, data: Bytes, row: i64) -> Result<Bytes> {
    let row = count(row)?;
    Ok(Bytes(data.0.chunks(row).rev().flatten().copied().collect()))
}

/// Depths in metres, the highest row first; infinite where nothing is.
///
/// @param depths 32-bit floats, the lowest row first
/// @param width columns
/// @param far where nothing is seen any more, metres
/// @return image 32-bit floats
#[api("remote.ros2.robots.depthImage")]
fn depth_image(_cx: &Cx, depths: Bytes, width: i64, far: f64) -> Result<Bytes> {
    let (row, end) = (count(width)? * 4, far as f32 * NOTHING);
    let rows = depths.0.chunks(row).rev();
    let image = rows
        .flat_map(floats)
        .map(|depth| if depth < end { depth } else { f32::INFINITY });
    Ok(Bytes(image.flat_map(f32::to_le_bytes).collect()))
}

/// The points of depths, a row after the other from the highest one: x, y, z, and the colour if there are any. Where nothing is they are no numbers.
///
/// @param depths 32-bit floats in metres, the lowest row first
/// @param colors red, green, blue of each pixel, the lowest row first; or an empty buffer
/// @param width columns
/// @param focalLength pixels
/// @param far where nothing is seen any more, metres
/// @return points
#[api("remote.ros2.robots.cloudOfDepths")]
fn cloud_of_depths(
    _cx: &Cx,
    depths: Bytes,
    colors: Bytes,
    width: i64,
    focal_length: f64,
    far: f64,
) -> Result<Bytes> {
    let width = count(width)?;
    let pixels = depths.0.len() / 4;
    if !colors.0.is_empty() {
        check_length("picture", &colors.0, pixels.checked_mul(3))?;
    }
    let height = pixels / width;
    let centre = |side: usize| (side as f64 - 1.0) / 2.0;
    let (cx, cy, end) = (centre(width), centre(height), far as f32 * NOTHING);
    let mut points = Vec::with_capacity(pixels * 16);
    for (row, line) in depths.0.chunks_exact(width * 4).rev().enumerate() {
        for (column, depth) in floats(line).enumerate() {
            let z = f64::from(if depth < end { depth } else { f32::NAN });
            let (x, y) = (
                (column as f64 - cx) / focal_length,
                (row as f64 - cy) / focal_length,
            );
            for coordinate in [x * z, y * z, z] {
                points.extend((coordinate as f32).to_le_bytes());
            }
            let at = ((height - 1 - row) * width + column) * 3;
            if let Some([red, green, blue]) = colors.0.get(at..at + 3) {
                points.extend([*blue, *green, *red, 0]);
            }
        }
    }
    Ok(Bytes(points))
}
