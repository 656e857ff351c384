//! Clocks, and the node itself.

use api_macro::api;
use capture::Tape;

use super::node::{node, running};
use super::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;
use scene::numbers;
use script::wall_clock;

pub(super) const FUNCTIONS: &[ApiFn] = functions![get_time, spin_some];

const ROS: i64 = 4872;
const SYSTEM: i64 = 4873;
const STEADY: i64 = 4874;

/// The time of a clock. The clock of ROS is the system's, as that of any node without simulated time.
///
/// @param clock_type simROS2.clock_type.ros, system or steady
/// @return time {sec, nanosec}
#[api("simROS2.getTime", snake_case)]
fn get_time(cx: &Cx, #[default(4872, "simROS2.clock_type.ros")] clock_type: i64) -> Result<Data> {
    match clock_type {
        ROS | SYSTEM => Ok(to_data(ros_time(cx.permissions().tape()))),
        STEADY => Ok(to_data(cx.clock().wall_seconds())),
        _ => Err(ApiError::Other(format!("unknown clock_type: {clock_type}"))),
    }
}

/// Calls the callbacks for what has arrived, without waiting.
#[api("simROS2.spinSome")]
fn spin_some(cx: &mut Cx) -> Result<()> {
    running(cx)?;
    node(cx).spin();
    Ok(())
}

/// Seconds since 1970.
pub(super) fn ros_time(tape: &Tape) -> f64 {
    let now = tape.input("the time of ROS", wall_clock::unix_seconds);
    now.unwrap_or_default()
}

/// As messages have times.
pub(super) fn to_data(seconds: f64) -> Data {
    let whole = seconds.floor();
    let nanoseconds = ((seconds - whole) * 1e9).floor().min(999_999_999.0);
    Data::map([
        ("sec", Data::Int(numbers::truncated(whole))),
        ("nanosec", Data::Int(numbers::truncated(nanoseconds))),
    ])
}
