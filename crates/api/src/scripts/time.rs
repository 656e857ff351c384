//! `sim.*`: wall clock, random numbers, source position of a script.

use api_macro::api;

use super::script::script_of;
use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::special;
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_system_time,
    get_system_time_in_ms,
    get_random,
    get_stack_traceback
];

/// Time by the wall clock, from a moment before the simulator started.
///
/// @return systemTime seconds
#[api("sim.getSystemTime")]
fn get_system_time(cx: &Cx) -> Result<f64> {
    Ok(cx.clock().wall_seconds())
}

/// Time by the wall clock in milliseconds.
///
/// @param previousTime what an earlier call returned: the difference is returned; negative: the time itself
/// @return systemTimeOrTimeDiff
#[api("sim.getSystemTimeInMs")]
fn get_system_time_in_ms(cx: &Cx, previous_time: Number) -> Result<i64> {
    let now = numbers::truncated(cx.clock().wall_seconds() * 1000.0);
    Ok(if previous_time.0 < 0 {
        now
    } else {
        now.saturating_sub(previous_time.0)
    })
}

/// A random number of this script's own sequence, which restarts with each start of the script.
///
/// @param seed begins another sequence
/// @return randomValue 0 to 1, 1 excluded
#[api("sim.getRandom")]
fn get_random(cx: &mut Cx, #[default(None)] seed: Option<Number>) -> Result<f64> {
    let mut random = cx.env().random.borrow_mut();
    if let Some(Number(seed)) = seed {
        random.restart(numbers::low_u32(seed));
    }
    Ok(random.next())
}

/// The stack traceback of a script that is running now.
///
/// @param scriptHandle the script
/// @return stackTraceback
#[api("sim.getStackTraceback")]
fn get_stack_traceback(
    cx: &Cx,
    #[default(special::SELF, "sim.handle_self")] script_handle: Number,
) -> Result<String> {
    let script = script_of(cx, script_handle.0)?;
    cx.traceback(&script)
}
