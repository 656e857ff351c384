//! `sim.*`: vision sensors: handling them, and their pictures.

use api_macro::api;

use crate::parameters::param::sensors_are_handled;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::sensor::{Area, Entity, VisionSensor};
use scene::{Data, Handle, Kind, Object, SceneError, special};
use script::{Bytes, IntPair, Number, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    handle_vision_sensor,
    handle_sensors,
    check_vision_sensor,
    check_vision_sensor_ex,
    read_vision_sensor,
    reset_vision_sensor,
    get_vision_sensor_img,
    get_vision_sensor_depth,
    set_vision_sensor_img,
    get_vision_sensor_res,
];

/// `sim.boolparam_vision_sensor_handling_enabled`.
const HANDLING_ENABLED: i64 = 10;

/// Packets that results have at least: those that are missing are empty.
const MIN_PACKETS: usize = 2;

/// Bits of the options of pictures.
mod option {
    pub const GREY: i64 = 1;
    pub const ALPHA: i64 = 2;
    pub const METRES: i64 = 1;
    pub const DEPTH: i64 = 2;
    pub const NO_CALLBACK: i64 = 4;
}

/// Takes pictures with vision sensors and lets their scripts look at them (`sysCall_vision`). A sensor alone must be handled explicitly.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
/// @return result, packets number of sensors that were triggered, and the packets of numbers of a single sensor, at least two
#[api("sim.handleVisionSensor")]
fn handle_vision_sensor(cx: &mut Cx, sensor_handle: Number) -> Result<Results> {
    let (count, mut packets) = take_pictures(cx, sensor_handle)?;
    if sensor_handle.0 < 0 {
        packets.clear();
    }
    Ok(Results(results(count, packets)))
}

/// Measures with all proximity sensors and takes pictures with all vision sensors that are not handled explicitly. For the usual main
/// script, which has no use for the results.
#[api("sim._handleSensors")]
fn handle_sensors(cx: &mut Cx) -> Result<()> {
    if cx.scene().has_sensors() {
        cx.handle_proximity_sensors(false);
        take_pictures(cx, Number(special::ALL_EXCEPT_EXPLICIT))?;
    }
    Ok(())
}

/// The number of sensors that were triggered, and the packets of the last one.
fn take_pictures(cx: &mut Cx, sensor_handle: Number) -> Result<(i64, Vec<Vec<f32>>)> {
    let (mut count, mut packets) = (0, Vec::new());
    let handled = sensors(cx, sensor_handle)?;
    let handled = if sensors_are_handled(cx, HANDLING_ENABLED) {
        handled
    } else {
        Vec::new()
    };
    for sensor in handled {
        // The scripts of another sensor may have removed it.
        if let Ok(reading) = cx.handle_vision_sensor(sensor) {
            count += i64::from(reading.triggered);
            packets = reading.packets;
        }
    }
    Ok((count, packets))
}

/// Takes a picture of an entity with a vision sensor and lets its scripts look at it. The picture and the results of the sensor stay as
/// they are.
///
/// @param sensorHandle the sensor
/// @param entityHandle an object, which need not be renderable, a collection, or sim.handle_all
/// @return result, packets 1: triggered, 0: not; then the packets of numbers, at least two
#[api("sim.checkVisionSensor")]
fn check_vision_sensor(
    cx: &mut Cx,
    sensor_handle: Handle,
    entity_handle: Number,
) -> Result<Results> {
    let (reading, _) = cx.check_vision_sensor(sensor_handle, entity(cx, entity_handle)?)?;
    Ok(Results(results(reading.triggered.into(), reading.packets)))
}

/// The picture of an entity that a vision sensor takes. The picture and the results of the sensor stay as they are.
///
/// @param sensorHandle the sensor
/// @param entityHandle an object, which need not be renderable, a collection, or sim.handle_all
/// @param returnImage whether it is the image, otherwise the depths
/// @return theBuffer numbers from 0 to 1: red, green, blue of each pixel, or its depth, from the lowest row
#[api("sim.checkVisionSensorEx")]
fn check_vision_sensor_ex(
    cx: &mut Cx,
    sensor_handle: Handle,
    entity_handle: Number,
    return_image: bool,
) -> Result<Vec<f64>> {
    let (_, sensor) = cx.check_vision_sensor(sensor_handle, entity(cx, entity_handle)?)?;
    Ok(match return_image {
        true => sensor
            .image()
            .iter()
            .map(|&level| f64::from(level) / 255.0)
            .collect(),
        false => sensor
            .depth()
            .iter()
            .map(|&depth| f64::from(depth))
            .collect(),
    })
}

/// Entity for the handle of a script.
fn entity(cx: &Cx, handle: Number) -> Result<Entity> {
    let scene = cx.scene();
    let entity = Entity::from_raw(if handle.0 == special::ALL {
        Entity::ALL.raw()
    } else {
        handle.0
    });
    let known = match entity.object() {
        _ if entity == Entity::ALL => true,
        Some(object) => scene.exists(object),
        None => scene.collections().get(entity.raw()).is_ok(),
    };
    if known {
        Ok(entity)
    } else {
        Err(ApiError::Other("entity does not exist.".into()))
    }
}

/// The results of the last handling: whether a script found what it looks for, and packets of numbers. The first packet has the smallest,
/// the largest and the mean values of intensity, red, green, blue and depth, 0 to 1.
///
/// @param sensorHandle the sensor
/// @return result, packets 1: triggered, 0: not; -1 and no packet: not handled yet
#[api("sim.readVisionSensor")]
fn read_vision_sensor(cx: &Cx, sensor_handle: Handle) -> Result<Results> {
    let scene = cx.scene();
    let reading = scene
        .object(sensor_handle)?
        .vision_sensor()?
        .reading
        .as_ref();
    Ok(Results(reading.map_or_else(
        || vec![Data::Int(-1)],
        |reading| results(reading.triggered.into(), reading.packets.clone()),
    )))
}

/// Result and packets as scripts receive them.
fn results(result: i64, mut packets: Vec<Vec<f32>>) -> Vec<Data> {
    packets.resize(packets.len().max(MIN_PACKETS), Vec::new());
    let packets = packets
        .into_iter()
        .map(|packet| packet.into_iter().map(f64::from).collect::<Vec<_>>());
    std::iter::once(Data::Int(result))
        .chain(packets.map(Data::from))
        .collect()
}

/// Clears the results of vision sensors.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
/// @return result 1
#[api("sim.resetVisionSensor")]
fn reset_vision_sensor(cx: &mut Cx, sensor_handle: Number) -> Result<i64> {
    for sensor in sensors(cx, sensor_handle)? {
        cx.reset_vision_sensor(sensor);
    }
    Ok(1)
}

/// The sensor, which must be handled explicitly, or all.
fn sensors(cx: &Cx, handle: Number) -> Result<Vec<Handle>> {
    let scene = cx.scene();
    let explicit_too = match handle.0 {
        special::ALL => true,
        special::ALL_EXCEPT_EXPLICIT => false,
        raw => {
            let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
            return match scene.object(handle)?.vision_sensor()?.explicit {
                true => Ok(vec![handle]),
                false => Err(ApiError::Other(
                    "object not tagged for explicit handling.".into(),
                )),
            };
        }
    };
    if !scene.has_sensors() {
        return Ok(Vec::new());
    }
    let is_meant = |o: &&Object| matches!(&o.kind, Kind::VisionSensor(sensor) if explicit_too || !sensor.explicit);
    Ok(scene
        .objects()
        .filter(is_meant)
        .map(Object::handle)
        .collect())
}

/// The part of a sensor's picture that a script means.
pub(crate) fn area(sensor: &VisionSensor, position: [f64; 2], size: [f64; 2]) -> Result<Area> {
    Area::part(
        sensor.view.resolution,
        position.map(numbers::truncated),
        size.map(numbers::truncated),
    )
    .ok_or_else(|| ApiError::Other("invalid arguments.".into()))
}

/// The image of a vision sensor, from the lowest row, or a part of it.
///
/// @param sensorHandle the sensor
/// @param options 1: a byte of grey per pixel instead of red, green, blue; 2: with an alpha channel
/// @param rgbaCutOff alpha is 255 up to that depth (0 near to 1 far), and 0 behind it
/// @param pos lower left corner of the part
/// @param size width and height of the part; nothing for the whole image
/// @return image bytes
/// @return resolution of the sensor
#[api("sim.getVisionSensorImg")]
fn get_vision_sensor_img(
    cx: &Cx,
    sensor_handle: Handle,
    #[default(0)] options: Number,
    #[default(0.0)] rgba_cut_off: f64,
    #[default([0.0; 2])] pos: [f64; 2],
    #[default([0.0; 2])] size: [f64; 2],
) -> Result<(Bytes, IntPair)> {
    let scene = cx.scene();
    let sensor = scene.object(sensor_handle)?.vision_sensor()?;
    let alpha = (options.0 & option::ALPHA != 0).then_some(numbers::single(rgba_cut_off));
    let image = sensor.image_part(
        area(sensor, pos, size)?,
        options.0 & option::GREY != 0,
        alpha,
    );
    Ok((Bytes(image), IntPair(sensor.view.resolution.map(i64::from))))
}

/// The depths of a vision sensor, from the lowest row, or a part of them. A depth is measured along the axis of the sensor.
///
/// @param sensorHandle the sensor
/// @param options 1: metres instead of 0 (near clipping plane) to 1 (far clipping plane)
/// @param pos lower left corner of the part
/// @param size width and height of the part; nothing for the whole picture
/// @return depth 32-bit floats
/// @return resolution of the sensor
#[api("sim.getVisionSensorDepth")]
fn get_vision_sensor_depth(
    cx: &Cx,
    sensor_handle: Handle,
    #[default(0)] options: Number,
    #[default([0.0; 2])] pos: [f64; 2],
    #[default([0.0; 2])] size: [f64; 2],
) -> Result<(Bytes, IntPair)> {
    let scene = cx.scene();
    let sensor = scene.object(sensor_handle)?.vision_sensor()?;
    let depth = sensor.depth_part(area(sensor, pos, size)?, options.0 & option::METRES != 0);
    Ok((
        Bytes(packed(&depth)),
        IntPair(sensor.view.resolution.map(i64::from)),
    ))
}

/// 32-bit floats as bytes.
pub(crate) fn packed(values: &[f32]) -> Vec<u8> {
    let values = values.iter().map(|value| value.to_le_bytes());
    values.collect::<Vec<_>>().into_flattened()
}

/// 32-bit floats from bytes.
pub(crate) fn unpacked(bytes: &[u8]) -> Vec<f32> {
    bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect()
}

/// Replaces the image of a vision sensor, or a part of it, and calls the sensor's scripts (`sysCall_vision`).
///
/// @param sensorHandle the sensor
/// @param image red, green, blue of each pixel, from the lowest row
/// @param options 1: a byte of grey per pixel; 2: depths instead, as 32-bit floats from 0 (near) to 1 (far); 4: scripts are not called
/// @param pos lower left corner of the part
/// @param size width and height of the part; nothing for the whole image
/// @return result 1
#[api("sim.setVisionSensorImg")]
fn set_vision_sensor_img(
    cx: &mut Cx,
    sensor_handle: Handle,
    image: Bytes,
    #[default(0)] options: Number,
    #[default([0.0; 2])] pos: [f64; 2],
    #[default([0.0; 2])] size: [f64; 2],
) -> Result<i64> {
    let part = area(
        cx.scene().object(sensor_handle)?.vision_sensor()?,
        pos,
        size,
    )?;
    let has = |bit: i64| options.0 & bit != 0;
    cx.change_picture(sensor_handle, |sensor| match has(option::DEPTH) {
        true => image.0.len().is_multiple_of(4) && sensor.set_depth_part(part, &unpacked(&image.0)),
        false => sensor.set_image_part(part, &image.0, has(option::GREY)),
    })?;
    if !has(option::NO_CALLBACK) {
        cx.evaluate_set_picture(sensor_handle)?;
    }
    Ok(1)
}

/// Resolution of a vision sensor.
///
/// @param sensorHandle the sensor
/// @return resolution pixels along x and y
#[api("sim.getVisionSensorRes")]
fn get_vision_sensor_res(cx: &Cx, sensor_handle: Handle) -> Result<Vec<i64>> {
    Ok(cx
        .scene()
        .object(sensor_handle)?
        .vision_sensor()?
        .view
        .resolution
        .map(i64::from)
        .to_vec())
}
