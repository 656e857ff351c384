//! `sim.*`: the time slice of threads. Stepping and waiting are in `lua/library/sim/thread.lua`.

use api_macro::api;
use scene::numbers;

use crate::{ApiFn, Cx, Result, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![set_auto_yield_delay, get_auto_yield_delay];

/// Longest slice of a thread, milliseconds.
const MAX_DELAY_MS: f64 = 10_000.0;

/// Sets how long a thread runs before it is pre-empted. A slice is measured in Lua instructions, so that results do not depend on
/// the machine; a second is a fixed number of them.
///
/// @param delay seconds, rounded to milliseconds
#[api("sim.setAutoYieldDelay")]
fn set_auto_yield_delay(cx: &mut Cx, delay: f64) -> Result<()> {
    cx.env().yields.delay_ms.set(numbers::truncated_u32(
        (delay * 1000.0).clamp(0.0, MAX_DELAY_MS),
    ));
    Ok(())
}

/// The time slice of a thread before it is pre-empted.
///
/// @return delay milliseconds, as in CoppeliaSim 4.10
#[api("sim.getAutoYieldDelay")]
fn get_auto_yield_delay(cx: &Cx) -> Result<f64> {
    Ok(f64::from(cx.env().yields.delay_ms.get()))
}
