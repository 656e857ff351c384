//! `sim.*`: force sensors as objects. What they measure is read with the functions of the dynamics.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};
use scene::{Handle, Kind};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![create_force_sensor];

/// A new force sensor at the world's origin: a rigid link that measures its load.
///
/// @param options 1: with a force threshold, 2: with a torque threshold
/// @param intParams filter (0: average, 1: median), number of samples, consecutive violations, 0, 0
/// @param floatParams size in metres, force threshold in N, torque threshold in N m, 0, 0
/// @return sensorHandle the sensor
#[api("sim.createForceSensor")]
fn create_force_sensor(
    cx: &mut Cx,
    options: Number,
    int_params: Vec<i64>,
    float_params: Vec<f64>,
) -> Result<Handle> {
    let [filter, samples, consecutive, _, _] =
        int_params.first_chunk().ok_or(ApiError::TableSize)?;
    let [size, force, torque, _, _] = float_params.first_chunk().ok_or(ApiError::TableSize)?;
    let sensor = ForceSensor {
        size: *size,
        filter: if *filter == 1 {
            ForceFilter::Median
        } else {
            ForceFilter::Average
        },
        sample_size: usize::try_from(*samples)
            .unwrap_or(0)
            .clamp(1, ForceSensor::MAX_SAMPLES),
        consecutive_violations: u32::try_from(*consecutive).unwrap_or(0).max(1),
        force_threshold: *force,
        force_threshold_enabled: options.0 & 1 != 0,
        torque_threshold: *torque,
        torque_threshold_enabled: options.0 & 2 != 0,
        ..ForceSensor::default()
    };
    cx.add_object("forceSensor", Kind::ForceSensor(Box::new(sensor)))
}
