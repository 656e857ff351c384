//! Properties of force sensors.

use geometry::Finite;
use geometry::pose::pose_to_array;

use super::access::{Accessor, length, object_properties, refused};
use super::{PoseArray, Vector3};
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};
use scene::{Object, Pose, SceneResult};

pub(in crate::property) const FORCE_SENSOR: &[Accessor] = object_properties! {
    "sensorSize": f64, |o| o.force_sensor()?.size, Appearance |o, size| o.force_sensor_mut()?.size = length(size)?;
    "forceThresholdEnabled": bool, |o| o.force_sensor()?.force_threshold_enabled,
        Sensor |o, on| o.force_sensor_mut()?.force_threshold_enabled = on;
    "torqueThresholdEnabled": bool, |o| o.force_sensor()?.torque_threshold_enabled,
        Sensor |o, on| o.force_sensor_mut()?.torque_threshold_enabled = on;
    "filterType": i64, |o| o.force_sensor()?.filter as i64, Sensor |o, filter| set_filter(o, filter)?;
    "filterSampleSize": i64, |o| numbers::count(o.force_sensor()?.sample_size), Sensor |o, count| {
        let sensor = o.force_sensor_mut()?;
        sensor.sample_size = numbers::place_of(count.clamp(1, numbers::count(ForceSensor::MAX_SAMPLES)));
        sensor.samples.clear();
    };
    "consecutiveViolationsToTrigger": i64, |o| o.force_sensor()?.consecutive_violations.into(),
        Sensor |o, count| {
            o.force_sensor_mut()?.consecutive_violations = u32::try_from(count.max(1)).unwrap_or(u32::MAX);
        };
    "forceThreshold": f64, |o| o.force_sensor()?.force_threshold,
        Sensor |o, force| o.force_sensor_mut()?.force_threshold = force.finite().ok_or_else(refused)?.max(0.0);
    "torqueThreshold": f64, |o| o.force_sensor()?.torque_threshold,
        Sensor |o, torque| o.force_sensor_mut()?.torque_threshold = torque.finite().ok_or_else(refused)?.max(0.0);
    "sensorForce": Vector3, |o| Vector3(o.force_sensor()?.raw.unwrap_or_default().0);
    "sensorTorque": Vector3, |o| Vector3(o.force_sensor()?.raw.unwrap_or_default().1);
    "filterSensorForce": Vector3, |o| Vector3(o.force_sensor()?.filtered.unwrap_or_default().0);
    "filterSensorTorque": Vector3, |o| Vector3(o.force_sensor()?.filtered.unwrap_or_default().1);
    "intrinsicError": PoseArray, |o| PoseArray(pose_to_array(&o.force_sensor()?.error.unwrap_or_else(Pose::identity)));
};

fn set_filter(object: &mut Object, filter: i64) -> SceneResult<()> {
    let sensor = object.force_sensor_mut()?;
    sensor.filter = [ForceFilter::Average, ForceFilter::Median]
        .into_iter()
        .find(|f| *f as i64 == filter)
        .ok_or_else(refused)?;
    sensor.samples.clear();
    Ok(())
}
