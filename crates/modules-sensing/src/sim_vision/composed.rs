//! `simVision.*`: images of vision sensors that are composed of those of others.

use api_macro::api;
use imaging::rgb::{RgbImage, mean, sphere};

use super::checked::{Checked, wrong_size};
use super::images::{SensorArgument, of_sensor, size_of};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Field, Handle};
use script::Number;

pub(super) const FUNCTIONS: &[ApiFn] = functions![handle_anaglyph_stereo, handle_spherical];

/// Red for the left eye, cyan for the right one.
const RED_CYAN: [f64; 6] = [1.0, 0.0, 0.0, 0.0, 1.0, 1.0];

/// Properties that composed sensors must have in common.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub handle: Handle,
    pub size: [usize; 2],
    pub is_explicit: bool,
    pub clipping: [f64; 2],
}

/// A sensor that takes part.
///
/// # Errors
/// When it is no vision sensor.
pub(super) fn part(cx: &Cx, sensor: i64) -> Result<Part> {
    let read = |sensor: &scene::sensor::VisionSensor| {
        Some((size_of(sensor), sensor.explicit, sensor.view.clipping))
    };
    let (handle, (size, is_explicit, clipping)) = of_sensor(cx, Checked(Number(sensor)), read)
        .map_err(|_| refused("Invalid handles, or handles are not vision sensor handles."))?;
    Ok(Part {
        handle,
        size,
        is_explicit,
        clipping,
    })
}

/// The sensors of a list, which may be longer; `position` is that of the argument.
///
/// # Errors
/// When it is shorter, or has something else.
pub(super) fn parts<const N: usize>(cx: &Cx, sensors: &[i64], position: i64) -> Result<[Part; N]> {
    let sensors: &[i64; N] = sensors.first_chunk().ok_or_else(|| wrong_size(position))?;
    let parts = sensors
        .iter()
        .map(|sensor| part(cx, *sensor))
        .collect::<Result<Vec<_>>>()?;
    parts.try_into().map_err(|_| wrong_size(position))
}

pub(super) fn refused(why: &str) -> ApiError {
    ApiError::Other(why.into())
}

/// Takes two pictures side by side, and composes them for coloured glasses.
///
/// @param passiveVisionSensorHandle the sensor with the result
/// @param activeVisionSensorHandles the left and the right sensor
/// @param leftAndRightColors red, green, blue of the left and of the right one; nothing for red and cyan
/// @return result 1
#[api("simVision.handleAnaglyphStereo")]
fn handle_anaglyph_stereo(
    cx: &mut Cx,
    passive_vision_sensor_handle: SensorArgument,
    active_vision_sensor_handles: Checked<Vec<i64>>,
    left_and_right_colors: Option<Checked<[f64; 6]>>,
) -> Result<i64> {
    let passive = part(cx, passive_vision_sensor_handle.0.0)?;
    let [left, right]: [Part; 2] = parts(cx, &active_vision_sensor_handles.0, 2)?;
    if ![passive, left, right].iter().all(|part| part.is_explicit) {
        return Err(refused("Vision sensors should be explicitely handled."));
    }
    if left.size != passive.size || right.size != passive.size {
        return Err(refused("Invalid vision sensor resolutions."));
    }
    let colours = left_and_right_colors.map_or(RED_CYAN, |colours| colours.0);
    let (left, right) = (picture(cx, left)?, picture(cx, right)?);
    let mut image = left.clone();
    for (pixel, (left, right)) in image
        .pixels_mut()
        .iter_mut()
        .zip(left.pixels().iter().zip(right.pixels()))
    {
        let (left, right) = (mean(*left), mean(*right));
        *pixel = [0, 1, 2].map(|i| left * colours[i] + right * colours[i + 3]);
    }
    cx.set_vision_image(passive.handle, image.to_bytes())?;
    Ok(1)
}

/// A new picture of a sensor.
fn picture(cx: &mut Cx, part: Part) -> Result<RgbImage> {
    cx.handle_vision_sensor(part.handle)?;
    let scene = cx.scene();
    let sensor = scene.object(part.handle)?.vision_sensor()?;
    RgbImage::from_bytes(part.size, &sensor.image())
        .ok_or_else(|| refused("Invalid vision sensor resolutions."))
}

/// Takes pictures in six directions, and composes a picture of all directions of them.
///
/// @param passiveVisionSensorHandleForRGB the sensor for the resulting image, or -1
/// @param activeVisionSensorHandles front, top, back, bottom, left, right, which are square and see 90 degrees
/// @param horizontalAngle that the picture spans, rad
/// @param verticalAngle that the picture spans, rad
/// @param passiveVisionSensorHandleForDepth the sensor for the resulting depths, or -1
/// @return result 1
#[api("simVision.handleSpherical")]
fn handle_spherical(
    cx: &mut Cx,
    #[name("passiveVisionSensorHandleForRGB")] passive_vision_sensor_handle_for_rgb: Checked<
        Number,
    >,
    active_vision_sensor_handles: Checked<Vec<i64>>,
    horizontal_angle: Checked<f64>,
    vertical_angle: Checked<f64>,
    #[default(Number(-1))] passive_vision_sensor_handle_for_depth: Checked<Number>,
) -> Result<i64> {
    let passive = |cx: &Cx, sensor: Number| {
        if sensor.0 == -1 {
            Ok(None)
        } else {
            part(cx, sensor.0).map(Some)
        }
    };
    let colour = passive(cx, passive_vision_sensor_handle_for_rgb.0)?;
    let depth = passive(cx, passive_vision_sensor_handle_for_depth.0)?;
    let faces: [Part; sphere::FACES] = parts(cx, &active_vision_sensor_handles.0, 2)?;
    let size = common_size(colour, depth)?;
    let side = square_side(&faces)?;
    let sources = sphere::sources(size, [horizontal_angle.0, vertical_angle.0], side);
    for face in faces {
        see_no_highlights(cx, face.handle)?;
        cx.handle_vision_sensor(face.handle)?;
    }
    if let Some(depth) = depth {
        let depths = all_depths(cx, &faces, &sources)?;
        cx.set_vision_depth(depth.handle, depths)?;
    }
    if let Some(colour) = colour {
        let colours = all_colours(cx, &faces, &sources)?;
        cx.set_vision_image(colour.handle, colours)?;
    }
    Ok(1)
}

/// Highlights are where the viewer is: they would not fit at the borders of pictures in different directions.
fn see_no_highlights(cx: &mut Cx, sensor: Handle) -> Result<()> {
    let is_new = !cx.scene().object(sensor)?.vision_sensor()?.ignore_specular;
    if is_new {
        cx.scene_mut().try_modify(sensor, Field::Sensor, |object| {
            object.vision_sensor_mut()?.ignore_specular = true;
            Ok(())
        })?;
    }
    Ok(())
}

/// The resolution of the resulting picture.
fn common_size(colour: Option<Part>, depth: Option<Part>) -> Result<[usize; 2]> {
    match (colour, depth) {
        (None, None) => Err(refused(
            "Invalid handles, or handles are not vision sensor handles.",
        )),
        (Some(colour), Some(depth)) if colour.size != depth.size => Err(refused(
            "Invalid vision sensor resolution for the RGB or depth component.",
        )),
        (Some(part), _) | (None, Some(part)) => Ok(part.size),
    }
}

/// The side of the square pictures.
fn square_side(faces: &[Part]) -> Result<usize> {
    let [width, height] = faces[0].size;
    if !faces.iter().all(|face| face.is_explicit) {
        return Err(refused(
            "Active vision sensors should be explicitely handled.",
        ));
    }
    if width != height || faces.iter().any(|face| face.size != [width, height]) {
        return Err(refused("Invalid vision sensor resolutions."));
    }
    Ok(width)
}

fn all_colours(cx: &Cx, faces: &[Part], sources: &[sphere::Source]) -> Result<Vec<u8>> {
    let scene = cx.scene();
    let mut images = Vec::new();
    for face in faces {
        images.push(scene.object(face.handle)?.vision_sensor()?.image());
    }
    let colour = |source: &sphere::Source| {
        images[source.face]
            .as_chunks::<3>()
            .0
            .get(source.pixel)
            .copied()
    };
    Ok(sources
        .iter()
        .flat_map(|source| colour(source).unwrap_or_default())
        .collect())
}

fn all_depths(cx: &Cx, faces: &[Part], sources: &[sphere::Source]) -> Result<Vec<f32>> {
    let scene = cx.scene();
    let mut depths = Vec::new();
    for face in faces {
        depths.push(scene.object(face.handle)?.vision_sensor()?.depth());
    }
    let of_ray = |source: &sphere::Source| {
        let depth = depths[source.face]
            .get(source.pixel)
            .copied()
            .unwrap_or(1.0);
        sphere::ray_depth(depth, source.stretch, faces[0].clipping)
    };
    Ok(sources.iter().map(of_ray).collect())
}
