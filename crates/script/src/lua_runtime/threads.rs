//! Yield levels and pre-emption (spec: threads).
//!
//! A thread is pre-empted after a fixed number of Lua instructions in place of the original's two milliseconds, so that results do
//! not depend on the machine. Whether the running coroutine may be pre-empted at all is written into its count hook: a coroutine that
//! set a level above 0 runs without one, at full speed.

use std::ffi::CStr;

use crate::host::Env;
use crate::lua::{HOOK_INTERVAL, HookAction, Stack, Type, hasten_count_hook, set_count_hook};

/// Weak table from coroutine to its own pre-emption level.
const LEVELS: &CStr = c"swanilda.levels";

/// Called by the count hook every `HOOK_INTERVAL` instructions: decides whether the code continues, and whether its time slice is used up.
pub(crate) fn on_count(stack: Stack<'_>, can_yield: bool) -> HookAction {
    let env = stack.env();
    if let Some(error) = env.interruption(|| stack.traceback_from(0)) {
        return HookAction::Fail(error);
    }
    if can_yield && slice_is_used_up(stack, env) {
        HookAction::Yield
    } else {
        HookAction::Continue
    }
}

fn slice_is_used_up(stack: Stack<'_>, env: &Env) -> bool {
    let yields = &env.yields;
    if yields.hastened.take() {
        set_count_hook(stack, true);
    }
    if env.is_interruptible() && auto_level(stack) != 0 {
        return false;
    }
    yields
        .used
        .set(yields.used.get().saturating_add(HOOK_INTERVAL as u64));
    if yields.overall.get() != 0 || yields.used.get() < budget(env) || auto_level(stack) != 0 {
        return false;
    }
    yields.used.set(0);
    true
}

/// Ends the slice of the running thread in a few instructions, unless it forbids that before: what it has done takes longer than a slice
/// in the original.
pub(crate) fn end_time_slice(stack: Stack<'_>) {
    if stack.is_main_coroutine() || auto_level(stack) != 0 {
        return;
    }
    let yields = &stack.env().yields;
    yields.used.set(u64::MAX);
    yields.hastened.set(true);
    hasten_count_hook(stack);
}

/// Instructions in a slice.
fn budget(env: &Env) -> u64 {
    let per_ms = env
        .sim
        .upgrade()
        .map_or(u64::MAX, |sim| sim.options.instructions_per_ms);
    u64::from(env.yields.delay_ms.get().max(1)).saturating_mul(per_ms)
}

/// Prepares a state for levels per coroutine.
pub(crate) fn install(stack: Stack<'_>) {
    stack.new_table(0, 0);
    stack.new_table(0, 1);
    stack.push_bytes(b"k");
    stack.raw_set_field(-2, "__mode");
    stack.set_metatable(-2);
    stack.set_registry(LEVELS);
}

/// Level of the running coroutine: 0 means it may be pre-empted.
pub(crate) fn auto_level(stack: Stack<'_>) -> i64 {
    let own = own_level(stack);
    own.unwrap_or_else(|| stack.env().yields.auto.get())
}

fn own_level(stack: Stack<'_>) -> Option<i64> {
    if stack.is_main_coroutine() {
        return None;
    }
    stack.push_registry(LEVELS);
    stack.push_running_coroutine();
    stack.raw_get(-2);
    let level = (stack.kind(-1) == Type::Number).then(|| stack.integer(-1).unwrap_or_default());
    stack.pop(2);
    level
}

/// Sets the level of the running coroutine. Outside of coroutines it is the one new coroutines begin with.
pub(crate) fn set_auto_level(stack: Stack<'_>, level: i64) {
    if stack.is_main_coroutine() {
        return stack.env().yields.auto.set(level);
    }
    stack.push_registry(LEVELS);
    stack.push_running_coroutine();
    stack.push_int(level);
    stack.raw_set(-3);
    stack.pop(1);
    set_count_hook(stack, level == 0);
}
