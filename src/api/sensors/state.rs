//! `sim.*`: proximity sensors.
//!
//! They exist as data; they do not measure yet. Handling all of them, as the main script does, logs that once.

use api_macro::api;

use crate::api::{ApiFn, Cx, Result, functions};
use crate::scene::Kind;
use crate::script::log::verbosity;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![handle_proximity_sensor, reset_proximity_sensor,];

/// Handles proximity sensors. They detect nothing yet.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
/// @return result number of detections
#[api("sim.handleProximitySensor")]
fn handle_proximity_sensor(cx: &mut Cx, sensor_handle: i64) -> Result<i64> {
    let _ = sensor_handle;
    warn_if_any(cx, "proximity sensors", |kind| matches!(kind, Kind::ProximitySensor(_)));
    Ok(0)
}

fn warn_if_any(cx: &Cx, what: &str, is: impl Fn(&Kind) -> bool) {
    if cx.scene().has_sensors() && cx.scene().objects().any(|object| is(&object.kind)) {
        let text = format!("{what} measure nothing: not implemented in Swanilda.");
        cx.log(verbosity::WARNINGS | verbosity::ONCE, &text);
    }
}

/// Clears the results of proximity sensors.
///
/// @param sensorHandle a sensor, sim.handle_all or sim.handle_all_except_explicit
#[api("sim.resetProximitySensor")]
fn reset_proximity_sensor(cx: &mut Cx, sensor_handle: i64) -> Result<()> {
    let _ = (cx, sensor_handle);
    Ok(())
}
