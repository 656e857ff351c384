//! `sim.*`: pictures of vision sensors as older scripts exchange them: lists of numbers, and options as bits of the handle.

use api_macro::api;

use crate::sensors::vision::{area, packed, unpacked};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::sensor::{Area, VisionSensor};
use scene::{Data, Handle, flag};
use script::{Bytes, Number, ObjectRef};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_vision_sensor_image,
    get_vision_sensor_char_image,
    get_vision_sensor_depth_buffer,
    set_vision_sensor_image,
    set_vision_sensor_char_image,
];

/// From 0 to 1 to a byte.
const LEVELS: f64 = 255.0001;

/// Reads the picture of a sensor.
fn read<R>(
    cx: &Cx,
    handle: ObjectRef,
    position: [f64; 2],
    size: [f64; 2],
    read: impl FnOnce(&VisionSensor, Area) -> R,
) -> Result<R> {
    let scene = cx.scene();
    let sensor = scene
        .object(handle.handle)
        .and_then(|object| object.vision_sensor());
    let sensor = sensor.map_err(|_| ApiError::Other("vision sensor does not exist.".into()))?;
    Ok(read(sensor, area(sensor, position, size)?))
}

/// The image of a vision sensor, from the lowest row, or a part of it. Add sim.handleflag_greyscale to the handle for a grey level per
/// pixel.
///
/// @param sensorHandle the sensor
/// @param posX left side of the part
/// @param posY lower side of the part
/// @param sizeX width of the part; 0 for the whole image
/// @param sizeY height of the part
/// @param returnType 0: a list of numbers, 0 to 1; 1: a string of bytes
/// @return imageBuffer red, green, blue or grey of each pixel
#[api("sim.getVisionSensorImage")]
fn get_vision_sensor_image(
    cx: &Cx,
    sensor_handle: ObjectRef,
    #[default(0.0)] pos_x: f64,
    #[default(0.0)] pos_y: f64,
    #[default(0.0)] size_x: f64,
    #[default(0.0)] size_y: f64,
    #[default(0)] return_type: Number,
) -> Result<Data> {
    let grey = sensor_handle.has(flag::GREYSCALE);
    let bytes = return_type.0 == 1;
    read(
        cx,
        sensor_handle,
        [pos_x, pos_y],
        [size_x, size_y],
        |sensor, area| {
            let image = sensor.image_part(area, grey && bytes, None);
            match (bytes, grey) {
                (true, _) => Data::Text(image),
                (false, true) => image.chunks_exact(3).map(mean).collect::<Vec<_>>().into(),
                (false, false) => image
                    .iter()
                    .map(|&level| f64::from(level) / 255.0)
                    .collect::<Vec<_>>()
                    .into(),
            }
        },
    )
}

/// Mean of the parts of a colour, 0 to 1.
fn mean(colour: &[u8]) -> f64 {
    colour.iter().map(|&part| f64::from(part)).sum::<f64>() / (3.0 * 255.0)
}

/// The image of a vision sensor, from the lowest row, or a part of it. Add sim.handleflag_greyscale to the handle for a grey level per
/// pixel.
///
/// @param sensorHandle the sensor
/// @param posX left side of the part
/// @param posY lower side of the part
/// @param sizeX width of the part; 0 for the whole image
/// @param sizeY height of the part
/// @param rgbaCutOff above 0: with an alpha channel, 255 up to that depth (0 near to 1 far) and 0 behind it
/// @return imageBuffer bytes
/// @return resolutionX of the sensor
/// @return resolutionY of the sensor
#[api("sim.getVisionSensorCharImage")]
fn get_vision_sensor_char_image(
    cx: &Cx,
    sensor_handle: ObjectRef,
    #[default(0.0)] pos_x: f64,
    #[default(0.0)] pos_y: f64,
    #[default(0.0)] size_x: f64,
    #[default(0.0)] size_y: f64,
    #[default(0.0)] rgba_cut_off: f64,
) -> Result<(Bytes, i64, i64)> {
    let alpha = (rgba_cut_off > 0.0).then_some(numbers::single(rgba_cut_off));
    read(
        cx,
        sensor_handle,
        [pos_x, pos_y],
        [size_x, size_y],
        |sensor, area| {
            let image = sensor.image_part(area, sensor_handle.has(flag::GREYSCALE), alpha);
            let [width, height] = sensor.view.resolution.map(i64::from);
            (Bytes(image), width, height)
        },
    )
}

/// The depths of a vision sensor, from the lowest row, or a part of them. Add sim.handleflag_depthbuffermeters to the handle for metres
/// instead of 0 (near) to 1 (far), sim.handleflag_codedstring for a string of 32-bit floats.
///
/// @param sensorHandle the sensor
/// @param posX left side of the part
/// @param posY lower side of the part
/// @param sizeX width of the part; 0 for the whole picture
/// @param sizeY height of the part
/// @return depthBuffer depth of each pixel
#[api("sim.getVisionSensorDepthBuffer")]
fn get_vision_sensor_depth_buffer(
    cx: &Cx,
    sensor_handle: ObjectRef,
    #[default(0.0)] pos_x: f64,
    #[default(0.0)] pos_y: f64,
    #[default(0.0)] size_x: f64,
    #[default(0.0)] size_y: f64,
) -> Result<Data> {
    read(
        cx,
        sensor_handle,
        [pos_x, pos_y],
        [size_x, size_y],
        |sensor, area| {
            let depth = sensor.depth_part(area, sensor_handle.has(flag::DEPTH_METRES));
            match sensor_handle.has(flag::PACKED) {
                true => Data::Text(packed(&depth)),
                false => depth.into_iter().map(f64::from).collect::<Vec<_>>().into(),
            }
        },
    )
}

/// Replaces the image of a vision sensor and calls the sensor's scripts. Bits of the handle: 0x400000 for a grey level per pixel, 0x800000
/// for depths instead of an image, 0x1000000 so that no script is called.
///
/// @param sensorHandle the sensor
/// @param image a list of numbers from 0 to 1, or a string of bytes (32-bit floats for depths)
/// @return result 1
#[api("sim.setVisionSensorImage")]
fn set_vision_sensor_image(cx: &mut Cx, sensor_handle: ObjectRef, image: Data) -> Result<i64> {
    match image {
        Data::Array(values) => {
            let numbers = values
                .iter()
                .map(|value| value.as_f64().ok_or(ApiError::ArgumentType));
            let numbers = numbers.collect::<Result<Vec<f64>>>()?;
            set_picture(cx, sensor_handle, &Pixels::Numbers(numbers))
        }
        Data::Map(_) => Err(ApiError::TableSize),
        Data::Text(bytes) | Data::Buffer(bytes) => {
            set_picture(cx, sensor_handle, &Pixels::Bytes(bytes))
        }
        _ => Err(ApiError::ArgumentType),
    }
}

/// Replaces the image of a vision sensor and calls the sensor's scripts. Bits of the handle as for `sim.setVisionSensorImage`.
///
/// @param sensorHandle the sensor
/// @param image bytes (32-bit floats for depths)
/// @return result 1
#[api("sim.setVisionSensorCharImage")]
fn set_vision_sensor_char_image(
    cx: &mut Cx,
    sensor_handle: ObjectRef,
    image: Bytes,
) -> Result<i64> {
    set_picture(cx, sensor_handle, &Pixels::Bytes(image.0))
}

/// A picture as a script passes it.
enum Pixels {
    /// From 0 to 1.
    Numbers(Vec<f64>),
    Bytes(Vec<u8>),
}

impl Pixels {
    /// The error when there are too few or too many.
    fn wrong_size(&self) -> ApiError {
        match self {
            Self::Numbers(_) => ApiError::TableSize,
            Self::Bytes(_) => ApiError::Other("incorrect buffer size.".into()),
        }
    }

    fn levels(&self) -> Vec<u8> {
        match self {
            Self::Numbers(numbers) => numbers
                .iter()
                .map(|&number| numbers::level(number * LEVELS))
                .collect(),
            Self::Bytes(bytes) => bytes.clone(),
        }
    }

    fn depths(&self) -> Vec<f32> {
        match self {
            Self::Numbers(numbers) => numbers
                .iter()
                .map(|&number| numbers::single(number))
                .collect(),
            Self::Bytes(bytes) if bytes.len().is_multiple_of(4) => unpacked(bytes),
            Self::Bytes(_) => Vec::new(),
        }
    }
}

fn set_picture(cx: &mut Cx, target: ObjectRef, pixels: &Pixels) -> Result<i64> {
    let handle: Handle = target.handle;
    cx.scene()
        .object(handle)
        .and_then(|object| object.vision_sensor().map(drop))?;
    let (grey, depth) = (target.has(flag::GREYSCALE), target.has(flag::DEPTH));
    let set = |sensor: &mut VisionSensor| {
        let whole = Area::whole(sensor.view.resolution);
        if depth {
            sensor.set_depth_part(whole, &pixels.depths())
        } else {
            sensor.set_image_part(whole, &pixels.levels(), grey)
        }
    };
    cx.change_picture(handle, set)
        .map_err(|_| pixels.wrong_size())?;
    if !target.has(flag::NO_CALLBACK) {
        cx.evaluate_set_picture(handle)?;
    }
    Ok(1)
}
