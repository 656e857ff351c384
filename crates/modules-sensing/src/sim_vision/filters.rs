//! `simVision.*`: filters of work images.

use api_macro::api;
use imaging::rgb::{Component, Kernel, RgbImage};

use super::checked::{Checked, wrong_size};
use super::images::{ImageSet, SensorArgument, with_images};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    horizontal_flip_work_img,
    vertical_flip_work_img,
    normalize_work_img,
    color_segmentation_on_work_img,
    intensity_scale_on_work_img,
    selective_color_on_work_img,
    scale_and_offset_work_img,
    edge_detection_on_work_img,
    sharpen_work_img,
    matrix3x3_on_work_img,
    matrix5x5_on_work_img,
    shift_work_img,
    circular_cut_work_img,
    rectangular_cut_work_img,
    resize_work_img,
    rotate_work_img,
];

/// Changes the work image of a sensor.
fn change(cx: &Cx, sensor: SensorArgument, change: impl FnOnce(&mut RgbImage)) -> Result<bool> {
    with_images(cx, sensor, |set| change(&mut set.work))?;
    Ok(false)
}

/// Changes the work image of a sensor; what was removed goes to the first buffer if it is wanted there.
fn cut(
    cx: &Cx,
    sensor: SensorArgument,
    to_buffer: bool,
    change: impl FnOnce(&mut RgbImage) -> RgbImage,
) -> Result<bool> {
    with_images(cx, sensor, |set: &mut ImageSet| {
        let removed = change(&mut set.work);
        if to_buffer {
            set.buffer_1 = Some(removed);
        }
    })?;
    Ok(false)
}

fn component(rgb: bool) -> Component {
    if rgb { Component::Rgb } else { Component::Hsl }
}

/// Mirrors the columns of the work image.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.horizontalFlipWorkImg")]
fn horizontal_flip_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    change(cx, vision_sensor_handle, RgbImage::flip_horizontally)
}

/// Mirrors the rows of the work image.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.verticalFlipWorkImg")]
fn vertical_flip_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    change(cx, vision_sensor_handle, RgbImage::flip_vertically)
}

/// Spreads the values of the work image over 0 to 1.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.normalizeWorkImg")]
fn normalize_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    change(cx, vision_sensor_handle, RgbImage::normalize)
}

/// Reduces the colours of the work image: each pixel takes the first colour that was found before and is near enough.
///
/// @param visionSensorHandle the sensor
/// @param maxColorColorDistance of red, green and blue as coordinates
/// @return trigger false
#[api("simVision.colorSegmentationOnWorkImg")]
fn color_segmentation_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    max_color_color_distance: Checked<f64>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.segment_colours(max_color_color_distance.0);
    })
}

/// Maps intensities of 0 to 1 to another range, as grey or as false colours: black, blue, red, yellow.
///
/// @param visionSensorHandle the sensor
/// @param start for intensity 0
/// @param end for intensity 1
/// @param greyScale grey instead of false colours
/// @return trigger false
#[api("simVision.intensityScaleOnWorkImg")]
fn intensity_scale_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    start: Checked<f64>,
    end: Checked<f64>,
    grey_scale: Checked<bool>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.scale_intensity(start.0, end.0, grey_scale.0);
    })
}

/// Keeps or removes the pixels of a colour; what is removed becomes black.
///
/// @param visionSensorHandle the sensor
/// @param color red, green and blue, or hue, saturation and lightness, each 0 to 1
/// @param colorTolerance the largest difference of each component; any hue is within 0.5
/// @param rgb the colour is red, green and blue
/// @param keep keeps the pixels of the colour, else the others
/// @param removedPartToBuffer1 puts what is removed into the first buffer, on black
/// @return trigger false
#[api("simVision.selectiveColorOnWorkImg")]
fn selective_color_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    color: Checked<[f64; 3]>,
    color_tolerance: Checked<[f64; 3]>,
    rgb: Checked<bool>,
    keep: Checked<bool>,
    removed_part_to_buffer1: Checked<bool>,
) -> Result<bool> {
    cut(
        cx,
        vision_sensor_handle,
        removed_part_to_buffer1.0,
        |image| image.select_colour(color.0, color_tolerance.0, component(rgb.0), keep.0),
    )
}

/// Computes `postOffset + (value + preOffset) * scaling` for each component, within 0 and 1.
///
/// @param visionSensorHandle the sensor
/// @param preOffset of each component
/// @param scaling of each component
/// @param postOffset of each component
/// @param rgb components are red, green and blue, else hue, saturation and lightness
/// @return trigger false
#[api("simVision.scaleAndOffsetWorkImg")]
fn scale_and_offset_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    pre_offset: Checked<[f64; 3]>,
    scaling: Checked<[f64; 3]>,
    post_offset: Checked<[f64; 3]>,
    rgb: Checked<bool>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.scale_and_offset(pre_offset.0, scaling.0, post_offset.0, component(rgb.0));
    })
}

/// Makes edges white and everything else black. The border of a bright image counts as an edge.
///
/// @param visionSensorHandle the sensor
/// @param threshold of 24 times the pixel less 3 times its eight neighbours
/// @return trigger false
#[api("simVision.edgeDetectionOnWorkImg")]
fn edge_detection_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    threshold: Checked<f64>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.detect_edges(threshold.0);
    })
}

/// Raises the differences between neighbours.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.sharpenWorkImg")]
fn sharpen_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    change(cx, vision_sensor_handle, RgbImage::sharpen)
}

/// Convolves the work image with a matrix of 3 by 3.
///
/// @param visionSensorHandle the sensor
/// @param passes how often
/// @param multiplier of the matrix
/// @param matrix row by row from the lower neighbours; nothing for a Gaussian with a standard deviation of 2 pixels
/// @return trigger false
#[api("simVision.matrix3x3OnWorkImg")]
fn matrix3x3_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    passes: Checked<Number>,
    multiplier: Checked<f64>,
    matrix: Option<Checked<Vec<f64>>>,
) -> Result<bool> {
    let kernel = kernel(matrix, 9, Kernel::gaussian_3x3)?.times(multiplier.0);
    convolve(cx, vision_sensor_handle, passes.0.0, &kernel)
}

/// Convolves the work image with a matrix of 5 by 5.
///
/// @param visionSensorHandle the sensor
/// @param passes how often
/// @param multiplier of the matrix
/// @param matrix row by row from the lower neighbours; nothing for a Gaussian with a standard deviation of 2 pixels
/// @return trigger false
#[api("simVision.matrix5x5OnWorkImg")]
fn matrix5x5_on_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    passes: Checked<Number>,
    multiplier: Checked<f64>,
    matrix: Option<Checked<Vec<f64>>>,
) -> Result<bool> {
    let kernel = kernel(matrix, 25, Kernel::gaussian_5x5)?.times(multiplier.0);
    convolve(cx, vision_sensor_handle, passes.0.0, &kernel)
}

/// The kernel of a matrix, which may be longer.
fn kernel(
    matrix: Option<Checked<Vec<f64>>>,
    count: usize,
    default: fn() -> Kernel,
) -> Result<Kernel> {
    let Some(Checked(mut weights)) = matrix else {
        return Ok(default());
    };
    weights.truncate(count);
    Kernel::new(weights).ok_or_else(|| wrong_size(4))
}

/// Passes of a kernel, then the limits. The program may end between two passes.
fn convolve(cx: &Cx, sensor: SensorArgument, passes: i64, kernel: &Kernel) -> Result<bool> {
    for _ in 0..passes {
        if cx.is_interrupted() {
            return Err(ApiError::Interrupted);
        }
        let before = with_images(cx, sensor, |set| {
            let next = set.work.convolved(kernel);
            std::mem::replace(&mut set.work, next)
        })?;
        // Further passes would change nothing.
        if with_images(cx, sensor, |set| set.work == before)? {
            break;
        }
    }
    change(cx, sensor, RgbImage::clamp)
}

/// Moves the content of the work image to higher columns and rows.
///
/// @param visionSensorHandle the sensor
/// @param shift by parts of the width and height
/// @param wrapAround what leaves the image comes back on the other side; else it is black there
/// @return trigger false
#[api("simVision.shiftWorkImg")]
fn shift_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    shift: Checked<[f64; 2]>,
    wrap_around: Checked<bool>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.shift(shift.0, wrap_around.0);
    })
}

/// Blackens what is outside of a circle around the centre.
///
/// @param visionSensorHandle the sensor
/// @param radius 1: half of the smaller side
/// @param copyToBuffer1 puts what is removed into the first buffer, on black
/// @return trigger false
#[api("simVision.circularCutWorkImg")]
fn circular_cut_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    radius: Checked<f64>,
    copy_to_buffer1: Checked<bool>,
) -> Result<bool> {
    cut(cx, vision_sensor_handle, copy_to_buffer1.0, |image| {
        image.cut_circle(radius.0)
    })
}

/// Blackens what is outside of a rectangle around the centre.
///
/// @param visionSensorHandle the sensor
/// @param sizes parts of the width and height
/// @param copyToBuffer1 puts what is removed into the first buffer, on black
/// @return trigger false
#[api("simVision.rectangularCutWorkImg")]
fn rectangular_cut_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    sizes: Checked<[f64; 2]>,
    copy_to_buffer1: Checked<bool>,
) -> Result<bool> {
    cut(cx, vision_sensor_handle, copy_to_buffer1.0, |image| {
        image.cut_rectangle(sizes.0)
    })
}

/// Magnifies the content of the work image about its centre.
///
/// @param visionSensorHandle the sensor
/// @param scaling of columns and rows
/// @return trigger false
#[api("simVision.resizeWorkImg")]
fn resize_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    scaling: Checked<[f64; 2]>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| image.resize(scaling.0))
}

/// Turns the content of the work image about its centre.
///
/// @param visionSensorHandle the sensor
/// @param rotationAngle rad, counter-clockwise with row 0 at the bottom
/// @return trigger false
#[api("simVision.rotateWorkImg")]
fn rotate_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    rotation_angle: Checked<f64>,
) -> Result<bool> {
    change(cx, vision_sensor_handle, |image| {
        image.rotate(rotation_angle.0);
    })
}
