//! The hook: every so many instructions it pre-empts coroutines and ends code that may not go on.

use std::ffi::c_int;
use std::panic::{AssertUnwindSafe, catch_unwind};

use mlua::ffi;

use super::interrupt::{answer_signal, place_of_interruption};
use super::listener;
use crate::lua::Stack;
use crate::lua::api::{self, Hook};
use crate::lua::calls::callback::panic_message;
use crate::lua::calls::guard::{Next, guarded, install};

/// Virtual machine instructions between two checks of the budget.
pub(crate) const HOOK_INTERVAL: c_int = 1000;
/// Instructions until an exhausted slice ends.
const SOON: c_int = 100;

/// Decides after every `HOOK_INTERVAL` instructions of code that has the hook. The argument is whether it may yield.
pub(crate) type OnCount = fn(Stack<'_>, bool) -> HookAction;

/// The decision function of the process: there is one host implementation, so a static suffices.
static ON_COUNT: std::sync::OnceLock<OnCount> = std::sync::OnceLock::new();

/// Makes `coroutine.create` and `coroutine.wrap` set the count hook of new coroutines. Code outside of coroutines runs without a hook,
/// at full speed, unless the state is watched.
pub(crate) fn install_coroutine_hooks(stack: Stack<'_>, on_count: OnCount) {
    ON_COUNT.get_or_init(|| on_count);
    stack.push_global("coroutine");
    install::<{ guarded::COROUTINE_CREATE }, _>(stack, "create", |_| {
        Next::OriginalThen(hook_created)
    });
    install::<{ guarded::COROUTINE_WRAP }, _>(stack, "wrap", |_| Next::OriginalThen(hook_wrapped));
    stack.pop(1);
    if stack.owner().is_watched {
        stack.push_running_coroutine();
        set_hook(stack, HOOK_INTERVAL);
        stack.pop(1);
    }
}

fn hook_created(stack: Stack<'_>) {
    set_hook(stack, HOOK_INTERVAL);
}

/// The function `coroutine.wrap` returns has its coroutine as first upvalue.
fn hook_wrapped(stack: Stack<'_>) {
    if stack.push_upvalue(-1, 1) {
        set_hook(stack, HOOK_INTERVAL);
        stack.pop(1);
    }
}

/// Switches the count hook of the running coroutine on or off. That of the main coroutine and of a watched state does not change.
pub(crate) fn set_count_hook(stack: Stack<'_>, on: bool) {
    set_interval(
        stack,
        if on || stack.owner().is_watched {
            HOOK_INTERVAL
        } else {
            0
        },
    );
}

/// Puts the count hook of the running coroutine back after an interruption: as of a new coroutine, where it may be a hook for nothing.
pub(super) fn restore_count_hook(stack: Stack<'_>) {
    let is_main = api::lua_pushthread(stack.room()) != 0;
    set_hook(
        stack,
        if is_main && !stack.owner().is_watched {
            0
        } else {
            HOOK_INTERVAL
        },
    );
    stack.pop(1);
}

/// Makes the count hook of the running coroutine come in a few instructions, until it is set again.
pub(crate) fn hasten_count_hook(stack: Stack<'_>) {
    set_interval(stack, SOON);
}

fn set_interval(stack: Stack<'_>, interval: c_int) {
    let is_main = api::lua_pushthread(stack.room()) != 0;
    if !is_main {
        set_hook(stack, interval);
    }
    stack.pop(1);
}

/// Sets the hook of the coroutine on top for every `interval` instructions; none with an interval of 0.
fn set_hook(stack: Stack<'_>, interval: c_int) {
    let mask = if interval > 0 { ffi::LUA_MASKCOUNT } else { 0 };
    if let Some(coroutine) = stack.coroutine(stack.slot(-1)) {
        api::lua_sethook(
            coroutine,
            (mask != 0).then_some(Hook::COUNT),
            mask,
            interval,
        );
    }
}

/// The action of the count hook.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum HookAction {
    Continue,
    Yield,
    /// Raises this text as an error.
    Fail(&'static str),
    /// Raises the error of an interruption.
    Interrupt,
}

/// The hook: yields without values, or raises an error, as the host decides.
pub(in crate::lua) unsafe extern "C-unwind" fn hook(
    raw: *mut ffi::lua_State,
    _: *mut ffi::lua_Debug,
) {
    // SAFETY: Lua calls the hook of a running coroutine. Yields and errors leave it by `longjmp`; nothing is owned here.
    unsafe {
        match next_step(Stack::from_raw(raw)) {
            Step::Continue => {}
            Step::Yield => drop(ffi::lua_yield(raw, 0)),
            Step::Raise => ffi::lua_error(raw),
        }
    }
}

/// The last act of the hook, when it owns nothing any more.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Step {
    Continue,
    Yield,
    /// The text is on the stack.
    Raise,
}

pub(super) fn next_step(stack: Stack<'_>) -> Step {
    let Some(on_count) = ON_COUNT.get() else {
        return Step::Continue;
    };
    let budget = stack.budget();
    let before = budget.enter(true);
    let step = step(stack, || {
        if listener::of_question(stack) {
            restore_count_hook(stack);
            return HookAction::Fail("ended by the debugger");
        }
        answer_signal(stack).unwrap_or_else(|| on_count(stack, api::lua_isyieldable(stack) != 0))
    });
    budget.leave(before);
    step
}

/// A panic must not unwind through Lua: it becomes an error of the script.
fn step(stack: Stack<'_>, action: impl FnOnce() -> HookAction) -> Step {
    match catch_unwind(AssertUnwindSafe(action)) {
        Ok(HookAction::Continue) => Step::Continue,
        Ok(HookAction::Yield) => Step::Yield,
        Ok(HookAction::Fail(text)) => {
            stack.push_bytes(text.as_bytes());
            Step::Raise
        }
        Ok(HookAction::Interrupt) => {
            let place = place_of_interruption().map(|place| format!(" at {place}"));
            stack.push_bytes(format!("interrupted{}.", place.unwrap_or_default()).as_bytes());
            Step::Raise
        }
        Err(panic) => {
            stack.push_bytes(panic_message(&*panic).as_bytes());
            Step::Raise
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{HookAction, Step, step};
    use crate::lua::tests::with_state;

    #[test]
    fn a_panic_of_the_host_is_an_error_of_the_script() {
        with_state(|state| {
            assert_eq!(step(state.stack(), || HookAction::Yield), Step::Yield);
            assert_eq!(step(state.stack(), || HookAction::Continue), Step::Continue);
            assert_eq!(step(state.stack(), || panic!("out of order")), Step::Raise);
            let text = String::from_utf8(state.stack().text(-1).unwrap_or_default());
            assert!(
                text.as_ref()
                    .is_ok_and(|text| text.ends_with("out of order")),
                "{text:?}"
            );
        });
    }
}
