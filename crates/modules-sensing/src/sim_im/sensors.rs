//! `simIM.*`: images of vision sensors and textures. There is no camera library, so no video device can be opened.

use api_macro::api;
use imaging::matrix::Matrix;

use super::images::{refused, turned};
use super::objects::images;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Handle;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    read_from_vision_sensor,
    write_to_vision_sensor,
    write_to_texture,
    open_video_capture,
    read_from_video_capture,
    close_video_capture,
];

/// Copies the image of a vision sensor. Row 0 is its lowest row.
///
/// @param sensorHandle the sensor
/// @param handle the image to change; nothing for a new one
/// @return handle an image of bytes: blue, green, red
#[api("simIM.readFromVisionSensor")]
fn read_from_vision_sensor(
    cx: &Cx,
    sensor_handle: Handle,
    #[default(String::new())] handle: String,
) -> Result<String> {
    let image = {
        let scene = cx.scene();
        let sensor = scene.object(sensor_handle)?.vision_sensor()?;
        let size = sensor.view.resolution.map(|side| side as usize);
        Matrix::from_bytes(size, 3, turned(&sensor.image(), 3))?
    };
    if handle.is_empty() {
        return images(cx).add(cx, image);
    }
    images(cx).replace(&handle, image)?;
    Ok(handle)
}

/// Makes an image that of a vision sensor; row 0 becomes its lowest row. Outside of sysCall_vision this calls the scripts of the sensor.
///
/// @param handle an image of bytes: blue, green, red
/// @param sensorHandle the sensor
#[api("simIM.writeToVisionSensor")]
fn write_to_vision_sensor(cx: &mut Cx, handle: String, sensor_handle: Handle) -> Result<()> {
    let image = images(cx).get(&handle)?;
    let [width, height] = image.size();
    let [columns, rows] = cx
        .scene()
        .object(sensor_handle)?
        .vision_sensor()?
        .view
        .resolution
        .map(|side| side as usize);
    if [width, height] != [columns, rows] {
        let sizes = format!(
            "sensor resolution ({columns}x{rows}) does not match image size ({width}x{height})"
        );
        return Err(refused(&sizes));
    }
    cx.set_vision_image(sensor_handle, rgb(&image)?)
}

/// Makes an image that of a texture; row 0 becomes its lowest row.
///
/// @param handle an image of bytes: blue, green, red, of the size of the texture
/// @param textureId the texture
#[api("simIM.writeToTexture")]
fn write_to_texture(cx: &mut Cx, handle: String, texture_id: i64) -> Result<()> {
    let image = images(cx).get(&handle)?;
    let bytes = rgb(&image)?;
    Ok(cx.scene_mut().modify_texture(texture_id, |texture| {
        let whole = texture.rectangle([0; 2], [0; 2])?;
        texture.write(whole, &bytes, 0.0)
    })?)
}

/// Red, green, blue of an image of bytes with three channels.
fn rgb(image: &Matrix) -> Result<Vec<u8>> {
    match image.bytes() {
        Some(bytes) if image.format().channels == 3 => Ok(turned(bytes, 3)),
        _ => Err(refused("image must be 8UC3")),
    }
}

/// Opens a camera. There are none here: it always fails.
///
/// @param deviceIndex the camera
#[api("simIM.openVideoCapture")]
fn open_video_capture(_cx: &Cx, device_index: i64) -> Result<()> {
    let _ = device_index;
    Err(refused("failed to open device"))
}

/// Reads an image of a camera. There are none here: it always fails.
///
/// @param deviceIndex the camera
/// @param handle the image to change; nothing for a new one
/// @return handle
#[api("simIM.readFromVideoCapture")]
fn read_from_video_capture(
    _cx: &Cx,
    device_index: i64,
    #[default(String::new())] handle: String,
) -> Result<String> {
    let _ = (device_index, handle);
    Err(no_device())
}

/// Closes a camera. There are none here: it always fails.
///
/// @param deviceIndex the camera
#[api("simIM.closeVideoCapture")]
fn close_video_capture(_cx: &Cx, device_index: i64) -> Result<()> {
    let _ = device_index;
    Err(no_device())
}

fn no_device() -> ApiError {
    refused("invalid device. did you call simIM.openVideoCapture() first?")
}
