//! `simVision.*`: images between sensors, work images and buffers.

use api_macro::api;
use imaging::rgb::RgbImage;

use super::checked::Checked;
use super::images::{
    SensorArgument, of_sensor, remove_unbuffered, set_work_image, size_of, with_handle, with_images,
};
use crate::{ApiFn, Cx, Result, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    sensor_img_to_work_img,
    sensor_depth_map_to_work_img,
    work_img_to_sensor_img,
    work_img_to_sensor_depth_map,
    uniform_img_to_work_img,
    work_img_to_buffer1,
    work_img_to_buffer2,
    buffer1_to_work_img,
    buffer2_to_work_img,
    swap_buffers,
    swap_work_img_with_buffer1,
    add_work_img_to_buffer1,
    add_buffer1_to_work_img,
    subtract_work_img_from_buffer1,
    subtract_buffer1_from_work_img,
    multiply_work_img_with_buffer1,
];

/// Copies the image of a vision sensor to its work image, on which the filters work. Values are 0 to 1.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.sensorImgToWorkImg")]
fn sensor_img_to_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    let image = of_sensor(cx, vision_sensor_handle, |sensor| {
        RgbImage::from_bytes(size_of(sensor), &sensor.image())
    });
    let (handle, image) = image?;
    set_work_image(cx, handle, image);
    Ok(false)
}

/// Copies the depths of a vision sensor to its work image, as grey values: 0 near to 1 far.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.sensorDepthMapToWorkImg")]
fn sensor_depth_map_to_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    let image = of_sensor(cx, vision_sensor_handle, |sensor| {
        RgbImage::from_values(size_of(sensor), &sensor.depth())
    });
    let (handle, image) = image?;
    set_work_image(cx, handle, image);
    Ok(false)
}

/// Makes the work image the image of the vision sensor. Outside of sysCall_vision this calls the scripts of the sensor.
///
/// @param visionSensorHandle the sensor
/// @param removeBuffer frees the work image if nothing is in a buffer
/// @return trigger false
#[api("simVision.workImgToSensorImg")]
fn work_img_to_sensor_img(
    cx: &mut Cx,
    vision_sensor_handle: SensorArgument,
    #[default(true)] remove_buffer: Checked<bool>,
) -> Result<bool> {
    let (handle, bytes) = with_handle(cx, vision_sensor_handle, |handle, set| {
        (handle, set.work.to_bytes())
    })?;
    if remove_buffer.0 {
        remove_unbuffered(cx, handle);
    }
    cx.set_vision_image(handle, bytes)?;
    Ok(false)
}

/// Makes the work image the depths of the vision sensor: the mean of red, green and blue, 0 near to 1 far.
///
/// @param visionSensorHandle the sensor
/// @param removeBuffer frees the work image if nothing is in a buffer
/// @return trigger false
#[api("simVision.workImgToSensorDepthMap")]
fn work_img_to_sensor_depth_map(
    cx: &mut Cx,
    vision_sensor_handle: SensorArgument,
    #[default(true)] remove_buffer: Checked<bool>,
) -> Result<bool> {
    let (handle, values) = with_handle(cx, vision_sensor_handle, |handle, set| {
        (handle, set.work.to_values())
    })?;
    if remove_buffer.0 {
        remove_unbuffered(cx, handle);
    }
    cx.set_vision_depth(handle, values)?;
    Ok(false)
}

/// Makes the work image one colour.
///
/// @param visionSensorHandle the sensor
/// @param color red, green, blue
/// @return trigger false
#[api("simVision.uniformImgToWorkImg")]
fn uniform_img_to_work_img(
    cx: &Cx,
    vision_sensor_handle: SensorArgument,
    color: Checked<[f64; 3]>,
) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| set.work.fill(color.0))?;
    Ok(false)
}

/// Copies the work image to the first buffer.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.workImgToBuffer1")]
fn work_img_to_buffer1(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        set.buffer_1 = Some(set.work.clone());
    })?;
    Ok(false)
}

/// Copies the work image to the second buffer.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.workImgToBuffer2")]
fn work_img_to_buffer2(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        set.buffer_2 = Some(set.work.clone());
    })?;
    Ok(false)
}

/// Copies the first buffer to the work image; it is black if nothing was put there.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.buffer1ToWorkImg")]
fn buffer1_to_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        work.clone_from(buffer);
    })?;
    Ok(false)
}

/// Copies the second buffer to the work image; it is black if nothing was put there.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.buffer2ToWorkImg")]
fn buffer2_to_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_2();
        work.clone_from(buffer);
    })?;
    Ok(false)
}

/// Exchanges the two buffers.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.swapBuffers")]
fn swap_buffers(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        set.with_buffer_1();
        set.with_buffer_2();
        std::mem::swap(&mut set.buffer_1, &mut set.buffer_2);
    })?;
    Ok(false)
}

/// Exchanges the work image and the first buffer.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.swapWorkImgWithBuffer1")]
fn swap_work_img_with_buffer1(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        std::mem::swap(work, buffer);
    })?;
    Ok(false)
}

/// Adds the work image to the first buffer; values are at most 1.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.addWorkImgToBuffer1")]
fn add_work_img_to_buffer1(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        buffer.add(work);
    })?;
    Ok(false)
}

/// Adds the first buffer to the work image; values are at most 1.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.addBuffer1ToWorkImg")]
fn add_buffer1_to_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        work.add(buffer);
    })?;
    Ok(false)
}

/// Subtracts the work image from the first buffer; values are at least 0.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.subtractWorkImgFromBuffer1")]
fn subtract_work_img_from_buffer1(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        buffer.subtract(work);
    })?;
    Ok(false)
}

/// Subtracts the first buffer from the work image; values are at least 0.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.subtractBuffer1FromWorkImg")]
fn subtract_buffer1_from_work_img(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        work.subtract(buffer);
    })?;
    Ok(false)
}

/// Multiplies the work image with the first buffer; values are at most 1.
///
/// @param visionSensorHandle the sensor
/// @return trigger false
#[api("simVision.multiplyWorkImgWithBuffer1")]
fn multiply_work_img_with_buffer1(cx: &Cx, vision_sensor_handle: SensorArgument) -> Result<bool> {
    with_images(cx, vision_sensor_handle, |set| {
        let (work, buffer) = set.with_buffer_1();
        work.multiply(buffer);
    })?;
    Ok(false)
}
