//! `simVision.*`: what work images show, as packets for the result of a vision sensor: buffers of 32-bit floats.

use api_macro::api;
use imaging::rgb::RgbImage;
use imaging::rgb::moments::{Expected, Moments};
use imaging::rgb::points::{Grid, Opening, Optics, Point, colours, coordinates, scan_lines};
use nalgebra::Point3;

use super::checked::{Checked, wrong, wrong_size};
use super::images::{SensorArgument, not_initialized, of_sensor, with_images};
use crate::{ApiFn, Cx, Result, functions};
use scene::sensor::View;
use script::Bytes;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    binary_work_img,
    blob_detection_on_work_img,
    changed_pixels_on_work_img,
    coordinates_from_work_img,
    velodyne_data_from_work_img,
];

/// `sim.handleflag_abscoords`.
const IN_WORLD: i64 = 0x80_0000;
/// Points of one packet.
const MAX_POINTS: i64 = 1 << 24;

/// 32-bit floats as bytes.
pub(super) fn packet(values: impl IntoIterator<Item = f64>) -> Bytes {
    Bytes(
        values
            .into_iter()
            .flat_map(|value| (value as f32).to_le_bytes())
            .collect(),
    )
}

/// Makes the bright pixels of the work image white and the others black, and compares what is white with an expectation.
///
/// @param visionSensorHandle the sensor
/// @param threshold the least mean of red, green and blue of white pixels
/// @param oneProportion the expected share of white pixels
/// @param oneTol its tolerance
/// @param xCenter the expected centre of white pixels, 0 to 1
/// @param xCenterTol its tolerance
/// @param yCenter the same for y
/// @param yCenterTol its tolerance
/// @param orient the expected angle of the long axis, rad
/// @param orientTol its tolerance
/// @param roundness the largest roundness, 0 (line) to 1 (disc)
/// @param enableTrigger compares
/// @param overlayColor draws the axis
/// @return trigger everything is as expected
/// @return packedDataPacket proportion, x, y, angle, roundness
#[api("simVision.binaryWorkImg")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn binary_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    threshold: Checked<f64>,
    one_proportion: Checked<f64>,
    one_tol: Checked<f64>,
    x_center: Checked<f64>,
    x_center_tol: Checked<f64>,
    y_center: Checked<f64>,
    y_center_tol: Checked<f64>,
    orient: Checked<f64>,
    orient_tol: Checked<f64>,
    roundness: Checked<f64>,
    enable_trigger: Checked<bool>,
    overlay_color: Option<Checked<[f64; 3]>>,
) -> Result<(bool, Bytes)> {
    let expected = Expected {
        moments: Moments {
            proportion: one_proportion.0,
            centre: [x_center.0, y_center.0],
            orientation: orient.0,
            roundness: roundness.0,
        },
        proportion_tolerance: one_tol.0,
        centre_tolerance: [x_center_tol.0, y_center_tol.0],
        orientation_tolerance: orient_tol.0,
    };
    let found = with_images(cx, vision_sensor_handle, |set| {
        let found = set.work.make_binary(threshold.0);
        if let Some(colour) = overlay_color {
            set.work.draw_axis(&found, colour.0);
        }
        found
    })?;
    let [x, y] = found.centre;
    let numbers = [found.proportion, x, y, found.orientation, found.roundness];
    Ok((
        enable_trigger.0 && expected.matches(&found),
        packet(numbers),
    ))
}

/// Finds connected bright regions in the work image. Those that are too small are blackened.
///
/// @param visionSensorHandle the sensor
/// @param threshold the least mean of red, green and blue of bright pixels
/// @param minBlobSize the least share of the image
/// @param modifyWorkImage shows each blob in a colour of its own on black
/// @param overlayColor draws the boxes
/// @return trigger false
/// @return packedDataPacket number of blobs, 6, then of each: share of the image, angle, x, y, width, height of its box
#[api("simVision.blobDetectionOnWorkImg")]
fn blob_detection_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    threshold: Checked<f64>,
    min_blob_size: Checked<f64>,
    modify_work_image: Checked<bool>,
    overlay_color: Option<Checked<[f64; 3]>>,
) -> Result<(bool, Bytes)> {
    let (size, blobs) = with_images(cx, vision_sensor_handle, |set| {
        let blobs = set
            .work
            .detect_blobs(threshold.0, min_blob_size.0, modify_work_image.0);
        if let Some(colour) = overlay_color {
            set.work.draw_boxes(&blobs, colour.0);
        }
        (set.work.size().map(|side| side as f64), blobs)
    })?;
    let of_blob = blobs.iter().flat_map(|blob| {
        let share = blob.count as f64 / (size[0] * size[1]);
        let [x, y] = [0, 1].map(|i| (blob.centre[i] + 0.5) / size[i]);
        [
            share,
            blob.orientation,
            x,
            y,
            blob.extent[0] / size[0],
            blob.extent[1] / size[1],
        ]
    });
    Ok((
        false,
        packet([blobs.len() as f64, 6.0].into_iter().chain(of_blob)),
    ))
}

/// Finds the pixels of the work image that became brighter or darker, compared with the second buffer, which takes their new values. The
/// work image shows them white and black on grey.
///
/// @param visionSensorHandle the sensor
/// @param threshold the least change, as a part of the brightness before
/// @return trigger false
/// @return packedDataPacket of each pixel: 1 (brighter) or -1, column, row; nothing without a change
#[api("simVision.changedPixelsOnWorkImg")]
fn changed_pixels_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    threshold: Checked<f64>,
) -> Result<(bool, Option<Bytes>)> {
    let changes = with_images(cx, vision_sensor_handle, |set| {
        let (work, reference) = set.with_buffer_2();
        work.detect_changes(reference, threshold.0)
    })?;
    let numbers = changes.iter().flat_map(|change| {
        let sign = if change.is_brighter { 1.0 } else { -1.0 };
        [sign, change.column as f64, change.row as f64]
    });
    Ok((false, (!changes.is_empty()).then(|| packet(numbers))))
}

/// Points in space from depths in the work image, on a grid, in the frame of the sensor.
///
/// @param visionSensorHandle the sensor; with sim.handleflag_abscoords points are in the frame of the world
/// @param xyPointCount columns and rows of points
/// @param evenlySpacedInAngularSpace equal steps of the angle, else of the image
/// @param returnColorData returns the colours of the points in the first buffer, if something is there
/// @return trigger false
/// @return packedDataPacket columns, rows, then of each point, row by row: x, y, z, distance
/// @return colorData red, green and blue of each point as bytes
#[api("simVision.coordinatesFromWorkImg")]
fn coordinates_from_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    xy_point_count: Checked<Vec<i64>>,
    evenly_spaced_in_angular_space: Checked<bool>,
    #[default(false)] return_color_data: Checked<bool>,
) -> Result<(bool, Bytes, Option<Bytes>)> {
    let grid = if evenly_spaced_in_angular_space.0 {
        Grid::Angles
    } else {
        Grid::Image
    };
    points(
        cx,
        vision_sensor_handle,
        &xy_point_count.0,
        return_color_data.0,
        |depth, optics, counts| coordinates(depth, optics, counts, grid),
    )
}

/// Points in space from depths in the work image, as a scanner of lines sees them, in the frame of the sensor.
///
/// @param visionSensorHandle the sensor; with sim.handleflag_abscoords points are in the frame of the world
/// @param xyPointCount columns and rows of points
/// @param vAngle from the lowest to the highest row, rad
/// @param returnColorData returns the colours of the points in the first buffer, if something is there
/// @return trigger false
/// @return packedDataPacket columns, rows, then of each point, column by column: x, y, z, distance
/// @return colorData red, green and blue of each point as bytes
#[api("simVision.velodyneDataFromWorkImg")]
fn velodyne_data_from_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    xy_point_count: Checked<Vec<i64>>,
    v_angle: Checked<f64>,
    #[default(false)] return_color_data: Checked<bool>,
) -> Result<(bool, Bytes, Option<Bytes>)> {
    points(
        cx,
        vision_sensor_handle,
        &xy_point_count.0,
        return_color_data.0,
        |depth, optics, counts| scan_lines(depth, optics, counts, v_angle.0),
    )
}

/// How a sensor sees.
fn optics(view: &View) -> Optics {
    let [near, far] = view.clipping;
    let opening = match view.perspective {
        true => Opening::Perspective(view.angle),
        false => Opening::Orthographic(view.ortho_size),
    };
    Optics { near, far, opening }
}

/// The packets of points that are taken from the work image.
fn points(
    cx: &Cx,
    sensor: SensorArgument,
    counts: &[i64],
    with_colours: bool,
    take: impl FnOnce(&RgbImage, &Optics, [usize; 2]) -> Vec<Point>,
) -> Result<(bool, Bytes, Option<Bytes>)> {
    let &[columns, rows, ..] = counts else {
        return Err(wrong_size(2));
    };
    if columns < 1
        || rows < 1
        || columns
            .checked_mul(rows)
            .is_none_or(|count| count > MAX_POINTS)
    {
        return Err(wrong(2));
    }
    let seen = of_sensor(cx, sensor, |sensor| Some(optics(&sensor.view)));
    let (handle, optics) = seen.map_err(|_| not_initialized())?;
    let (points, colours) = with_images(cx, sensor, |set| {
        let points = take(&set.work, &optics, [columns as usize, rows as usize]);
        let colours = set
            .buffer_1
            .as_ref()
            .filter(|_| with_colours)
            .map(|image| Bytes(colours(&points, image)));
        (points, colours)
    })?;
    let pose = match sensor.0.0 & IN_WORLD {
        0 => None,
        _ => Some(cx.scene().world_pose(handle)?),
    };
    let numbers = points.iter().flat_map(|point| {
        let position = Point3::from(point.position);
        let [x, y, z]: [f64; 3] = pose.map_or(position, |pose| pose * position).into();
        [x, y, z, point.distance]
    });
    Ok((
        false,
        packet([columns as f64, rows as f64].into_iter().chain(numbers)),
        colours,
    ))
}
