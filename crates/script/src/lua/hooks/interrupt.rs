//! Stopping Lua code in the middle of what it does, from a signal handler of its thread.
//!
//! Code outside of coroutines runs without a hook, at full speed. The handler sets one, which Lua allows at any time (`lua_sethook`), and
//! notes the line the code is at. From then on every instruction raises an error, also in code that catches errors, until the innermost call
//! from outside has ended. A function written in C runs to its end first. The line is read while the thread stands still, from the
//! records of its calls; nothing is written there.

use std::cell::Cell;
use std::ffi::c_int;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicUsize, Ordering};

use mlua::ffi;

use super::count::{HookAction, restore_count_hook};
use super::running::{current_coroutine, innermost};
use crate::lua::Stack;
use crate::lua::api::{self, Hook, Slot};
use crate::lua::stack::frame::Facts;

/// Nested coroutines that are examined.
const MAX_COROUTINES: usize = 250;
/// Levels of the call stack that are searched for a call with a line.
const MAX_LEVELS: c_int = 50;
/// Most lines of calls in a place.
const MAX_LINES: usize = 6;
/// Most bytes of a place.
const MAX_PLACE_LENGTH: usize = 512;

thread_local! {
    /// The code that runs is to stop.
    static REQUESTED: Cell<bool> = const { Cell::new(false) };
    /// The place was read while Lua had not stored its line: the hook reads it again.
    static IS_ROUGH: Cell<bool> = const { Cell::new(false) };
}

/// The hook has read the place.
static IS_EXACT: AtomicBool = AtomicBool::new(false);
/// The next signal only asks where the code is.
static ONLY_ASKS: AtomicBool = AtomicBool::new(false);
static PLACE: [AtomicU8; MAX_PLACE_LENGTH] = [const { AtomicU8::new(0) }; MAX_PLACE_LENGTH];
static PLACE_LENGTH: AtomicUsize = AtomicUsize::new(0);

/// The next signal does not stop the code: it only notes where it is, for [`place_of_interruption`].
pub fn only_ask() {
    PLACE_LENGTH.store(0, Ordering::Relaxed);
    IS_EXACT.store(false, Ordering::Relaxed);
    ONLY_ASKS.store(true, Ordering::Release);
}

/// No code is to stop any more.
pub(super) fn forget_request() {
    REQUESTED.set(false);
}

/// Where code was when a signal last came: the function written in C that it waits for, chunks and lines.
pub fn place_of_interruption() -> Option<String> {
    let length = PLACE_LENGTH.load(Ordering::Acquire);
    let bytes: Vec<u8> = PLACE[..length]
        .iter()
        .map(|byte| byte.load(Ordering::Relaxed))
        .collect();
    (length > 0).then(|| String::from_utf8_lossy(&bytes).into_owned())
}

/// Whether the hook has read the place: not in the middle of a function written in C.
pub fn place_is_exact() -> bool {
    IS_EXACT.load(Ordering::Acquire)
}

/// Stops the Lua code of this thread, or notes where it is after [`only_ask`]. For signal handlers: it neither allocates nor waits.
pub fn interrupt_running_code() {
    let running = innermost();
    if running.is_null() {
        return;
    }
    IS_ROUGH.set(true);
    if ONLY_ASKS.swap(false, Ordering::Acquire) {
        return ask_coroutine();
    }
    // SAFETY: the state is being called on this very thread, which stands still meanwhile. Setting a hook is what Lua allows a signal
    // handler to do; the other functions only read.
    let mut coroutine = unsafe { Stack::from_raw(running) };
    REQUESTED.set(true);
    for _ in 0..MAX_COROUTINES {
        api::lua_sethook(coroutine, Some(Hook::COUNT), ffi::LUA_MASKCOUNT, 1);
        note_place(coroutine);
        match resumed_by(coroutine) {
            Some(resumed) => coroutine = resumed,
            None => return,
        }
    }
}

/// Lets the hook note the place. Nothing is read here: the stack may be on its way to another place.
fn ask_coroutine() {
    // SAFETY: as in `interrupt_running_code`, which has seen that a call runs: then there is a coroutine that does.
    let coroutine = unsafe { Stack::from_raw(current_coroutine()) };
    // A hook that is there comes soon enough, and must not come at another time than without the question.
    if api::lua_gethookcount(coroutine) == 0 {
        api::lua_sethook(coroutine, Some(Hook::COUNT), ffi::LUA_MASKCOUNT, 1);
    }
}

/// What the hook does for a signal; None where it came by itself. An interruption that is over, and a question, leave nothing behind.
pub(super) fn answer_signal(stack: Stack<'_>) -> Option<HookAction> {
    if IS_ROUGH.take() {
        note_place(stack);
        IS_EXACT.store(true, Ordering::Release);
    }
    if REQUESTED.get() {
        return Some(HookAction::Interrupt);
    }
    (api::lua_gethookcount(stack) == 1).then(|| {
        restore_count_hook(stack);
        HookAction::Continue
    })
}

/// The coroutine that the function written in C on top of the calls has resumed: its first argument, or what it was made for.
pub(in crate::lua) fn resumed_by(coroutine: Stack<'_>) -> Option<Stack<'_>> {
    if !coroutine.frame(0, Facts::SOURCE)?.is_native() {
        return None;
    }
    let candidates = [Slot::FIRST, Slot::NUMBER]
        .into_iter()
        .filter_map(|slot| coroutine.coroutine(slot));
    candidates.into_iter().find(|candidate| {
        candidate.raw() != coroutine.raw()
            && api::lua_status(*candidate) == ffi::LUA_OK
            && candidate.frame(0, Facts::SOURCE).is_some()
    })
}

/// Notes the lines of the innermost calls, up to a few: the first may be in the library.
fn note_place(coroutine: Stack<'_>) {
    let mut place = Place { length: 0 };
    let mut lines = 0;
    for level in 0..MAX_LEVELS {
        let Some(frame) = coroutine
            .frame(level, Facts::ALL)
            .filter(|_| lines < MAX_LINES)
        else {
            break;
        };
        if frame.line() > 0 {
            place.push(if lines > 0 { b", called from " } else { b"" });
            place.push(frame.chunk().to_bytes());
            place.push(b":");
            place.push_number(frame.line());
            lines += 1;
        } else if let Some(name) = frame.name().filter(|_| level == 0) {
            place.push(b"function '");
            place.push(name.to_bytes());
            place.push(b"', called from ");
        }
    }
    if lines > 0 {
        PLACE_LENGTH.store(place.length, Ordering::Release);
    }
}

/// A text that grows in `PLACE`.
struct Place {
    length: usize,
}

impl Place {
    fn push(&mut self, bytes: &[u8]) {
        for (slot, &byte) in PLACE[self.length..].iter().zip(bytes) {
            slot.store(byte, Ordering::Relaxed);
            self.length += 1;
        }
    }

    #[expect(clippy::cast_sign_loss, reason = "a digit")]
    fn push_number(&mut self, number: c_int) {
        let mut divisor = 1;
        while number / divisor >= 10 {
            divisor *= 10;
        }
        while divisor > 0 {
            self.push(&[b'0' + (number / divisor % 10) as u8]);
            divisor /= 10;
        }
    }
}
