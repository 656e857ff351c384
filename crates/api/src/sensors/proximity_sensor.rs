//! `sim.*`: what proximity sensors detect.

// The reference takes the types of results from signatures.
#![expect(clippy::type_complexity)]

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use perception::detection::{Detected, DetectionMode};
use perception::entity::{Entity, Purpose};
use perception::items::Items;
use scene::sensor::Detection;
use scene::{Handle, Scene, SceneError, special};
use script::{Number, SimulationState};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    handle_proximity_sensor,
    read_proximity_sensor,
    check_proximity_sensor,
    check_proximity_sensor_ex,
    check_proximity_sensor_ex2,
    reset_proximity_sensor,
];

/// Result, distance, point, object and normal.
type Reading = (i64, f64, [f64; 3], i64, [f64; 3]);

/// Nothing detected; -1 stands for a sensor that has not measured.
const fn nothing(result: i64) -> Reading {
    (result, 0.0, [0.0; 3], -1, [0.0; 3])
}

fn reading(detection: Option<Detection>) -> Reading {
    detection.map_or(nothing(0), |found| reading_at(&found, found.distance()))
}

fn reading_at(found: &Detection, distance: f64) -> Reading {
    (1, distance, found.point, found.object.raw(), found.normal)
}

/// The proximity sensor a script means by a number, if it is one.
fn sensor(scene: &Scene, raw: i64) -> Option<Handle> {
    Handle::from_raw(raw).filter(|&handle| {
        scene
            .object(handle)
            .is_ok_and(|object| object.proximity_sensor().is_ok())
    })
}

/// Measures with a sensor that is tagged for explicit handling, or with all sensors. Scripts of a sensor that detects something are called
/// (`sysCall_trigger`), and the result is stored.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
/// @return result 1 if something is detected, 0 if not, -1 if the handle is no proximity sensor
/// @return distance from the sensor, metres; of several sensors the smallest
/// @return detectedPoint in the frame of the sensor
/// @return detectedObjectHandle -1 if nothing is detected
/// @return normalVector of the surface, in the frame of the sensor
#[api("sim.handleProximitySensor")]
fn handle_proximity_sensor(
    cx: &mut Cx,
    sensor_handle: Number,
) -> Result<(i64, f64, [f64; 3], i64, [f64; 3])> {
    if let special::ALL | special::ALL_EXCEPT_EXPLICIT = sensor_handle.0 {
        return Ok(reading(
            cx.handle_proximity_sensors(sensor_handle.0 == special::ALL),
        ));
    }
    let sensor = sensor(&cx.scene(), sensor_handle.0);
    sensor.map_or(Ok(nothing(-1)), |sensor| {
        cx.handle_proximity_sensor(sensor).map(reading)
    })
}

/// Result of the last handling of a sensor.
///
/// @param sensorHandle the sensor
/// @return result 1 if something was detected, 0 if not, -1 if it was not handled since the start of the simulation
/// @return distance from the sensor, metres
/// @return detectedPoint in the frame of the sensor
/// @return detectedObjectHandle -1 if nothing was detected
/// @return normalVector of the surface, in the frame of the sensor
#[api("sim.readProximitySensor")]
fn read_proximity_sensor(
    cx: &Cx,
    sensor_handle: Handle,
) -> Result<(i64, f64, [f64; 3], i64, [f64; 3])> {
    let scene = cx.scene();
    let sensor = scene.object(sensor_handle)?.proximity_sensor()?;
    let never = !sensor.handled && cx.clock().state() != SimulationState::Stopped;
    Ok(if never {
        nothing(-1)
    } else {
        reading(sensor.detection)
    })
}

/// Measures without storing the result and without calling scripts.
///
/// @param sensorHandle the sensor
/// @param entityHandle an object, whose detectable flag does not count, a collection, or sim.handle_all
/// @param mode 1: front faces, 2: back faces, 4: fast, 8: limited angle; negative: as the sensor is set
/// @param threshold nothing farther away is detected, metres; 0 for no limit
/// @param maxAngle between ray and normal, rad
/// @return result 1 if something is detected, else 0
/// @return distance from the sensor, metres
/// @return detectedPoint in the frame of the sensor
/// @return detectedObjectHandle -1 if nothing is detected
/// @return normalVector of the surface, in the frame of the sensor
#[api("sim.checkProximitySensor")]
fn check_proximity_sensor(
    cx: &Cx,
    sensor_handle: Number,
    entity_handle: Number,
    #[default(-1)] mode: Number,
    #[default(0.0)] threshold: f64,
    #[default(0.0)] max_angle: f64,
) -> Result<(i64, f64, [f64; 3], i64, [f64; 3])> {
    let (sensor, mode) = sensor_and_mode(cx, sensor_handle, mode, threshold, max_angle)?;
    let found = cx.query(|perception, scene| {
        let group = Entity::named_or_all(scene, entity_handle.0)?.group(scene, Purpose::Detection);
        perception.detect(scene, sensor, &group, mode)
    })?;
    Ok(found.map_or(
        nothing(0),
        |Detected {
             detection,
             distance,
         }| reading_at(&detection, distance),
    ))
}

/// The same with all parameters.
///
/// @param sensorHandle the sensor
/// @param entityHandle an object, a collection, or sim.handle_all
/// @param mode 1: front faces, 2: back faces, 4: fast, 8: limited angle; negative: as the sensor is set
/// @param threshold nothing farther away is detected, metres; 0 for no limit
/// @param maxAngle between ray and normal, rad
/// @return result 1 if something is detected, else 0
/// @return distance from the sensor, metres
/// @return detectedPoint in the frame of the sensor
/// @return detectedObjectHandle -1 if nothing is detected
/// @return normalVector of the surface, in the frame of the sensor
#[api("sim.checkProximitySensorEx")]
fn check_proximity_sensor_ex(
    cx: &Cx,
    sensor_handle: Number,
    entity_handle: Number,
    mode: Number,
    threshold: f64,
    max_angle: f64,
) -> Result<(i64, f64, [f64; 3], i64, [f64; 3])> {
    check_proximity_sensor(cx, sensor_handle, entity_handle, mode, threshold, max_angle)
}

/// Measures points, segments or triangles of a script. Rays see triangles only.
///
/// @param sensorHandle the sensor
/// @param vertices x, y, z of each, in the frame of the sensor
/// @param itemType 0: points, 1: segments, 2: triangles
/// @param itemCount how many
/// @param mode 1: front faces, 2: back faces, 4: fast, 8: limited angle; negative: as the sensor is set
/// @param threshold nothing farther away is detected, metres; 0 for no limit
/// @param maxAngle between ray and normal, rad
/// @return result 1 if something is detected, else 0
/// @return distance from the sensor, metres
/// @return detectedPoint in the frame of the sensor
/// @return normalVector in the frame of the sensor
#[api("sim.checkProximitySensorEx2")]
#[expect(clippy::too_many_arguments, reason = "the function has these")]
fn check_proximity_sensor_ex2(
    cx: &Cx,
    sensor_handle: Number,
    vertices: Vec<f64>,
    item_type: Number,
    item_count: Number,
    mode: Number,
    threshold: f64,
    max_angle: f64,
) -> Result<(i64, f64, [f64; 3], [f64; 3])> {
    let (sensor, mode) = sensor_and_mode(cx, sensor_handle, mode, threshold, max_angle)?;
    let items = Items::new(&vertices, item_type.0, item_count.0)?;
    let hit = cx.query(|perception, scene| perception.detect_items(scene, sensor, &items, mode))?;
    Ok(hit.map_or((0, 0.0, [0.0; 3], [0.0; 3]), |hit| {
        (1, hit.distance, hit.point, hit.normal)
    }))
}

/// The sensor, and how it is to look.
fn sensor_and_mode(
    cx: &Cx,
    raw: Number,
    mode: Number,
    threshold: f64,
    max_angle: f64,
) -> Result<(Handle, DetectionMode)> {
    let scene = cx.scene();
    let sensor = sensor(&scene, raw.0).ok_or(SceneError::InvalidProximitySensor)?;
    let mode = match mode.0 {
        ..0 => DetectionMode::of(scene.object(sensor)?.proximity_sensor()?),
        options => DetectionMode::from_options(options, max_angle),
    };
    Ok((sensor, mode.within(threshold)))
}

/// Forgets what a sensor that is tagged for explicit handling, or all sensors detected.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
/// @return result 1
#[api("sim.resetProximitySensor")]
fn reset_proximity_sensor(cx: &mut Cx, sensor_handle: Number) -> Result<i64> {
    match sensor_handle.0 {
        special::ALL => cx.reset_proximity_sensors(true),
        special::ALL_EXCEPT_EXPLICIT => cx.reset_proximity_sensors(false),
        raw => cx.reset_proximity_sensor(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)?,
    }
    Ok(1)
}
