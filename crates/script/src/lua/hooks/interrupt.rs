//! Stopping Lua code in the middle of what it does, from a signal handler of its thread.
//!
//! Code outside of coroutines runs without a hook, at full speed. The handler sets one, which Lua allows at any time (`lua_sethook`), and
//! notes the line the code is at. From then on every instruction raises an error, also in code that catches errors, until the innermost call
//! from outside has ended. A function written in C runs to its end first. The line is read while the thread stands still, from the
//! records of its calls; nothing is written there.

use std::cell::Cell;
use std::ffi::c_int;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicU8, AtomicU64, AtomicUsize, Ordering};

use mlua::ffi;

use super::count::restore_count_hook;
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
    /// Where the innermost call into Lua on this thread was made; null while there is none.
    static RUNNING: Cell<*mut ffi::lua_State> = const { Cell::new(null_mut()) };
    /// The code that runs is to stop.
    static REQUESTED: Cell<bool> = const { Cell::new(false) };
    /// The place was read while Lua had not stored its line: the hook reads it again.
    static IS_ROUGH: Cell<bool> = const { Cell::new(false) };
}

static CALLS: AtomicU64 = AtomicU64::new(0);
static PLACE: [AtomicU8; MAX_PLACE_LENGTH] = [const { AtomicU8::new(0) }; MAX_PLACE_LENGTH];
static PLACE_LENGTH: AtomicUsize = AtomicUsize::new(0);

/// A call into Lua from outside. Nested ones end in reverse order.
pub(in crate::lua) struct Running {
    outer: *mut ffi::lua_State,
}

impl Running {
    pub(in crate::lua) fn begin(stack: Stack<'_>) -> Self {
        let outer = RUNNING.replace(stack.raw());
        if outer.is_null() {
            REQUESTED.set(false);
            CALLS.fetch_add(1, Ordering::Relaxed);
        }
        Self { outer }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        RUNNING.set(self.outer);
        // The interrupted function has ended; its caller may clean up.
        REQUESTED.set(false);
    }
}

/// How many calls into Lua have begun, those inside of others not counted. While the number stays, the same call runs.
pub fn calls_begun() -> u64 {
    CALLS.load(Ordering::Relaxed)
}

/// Where code was when it was last interrupted: the function written in C that it waits for, chunks and lines.
pub fn place_of_interruption() -> Option<String> {
    let length = PLACE_LENGTH.load(Ordering::Acquire);
    let bytes: Vec<u8> = PLACE[..length]
        .iter()
        .map(|byte| byte.load(Ordering::Relaxed))
        .collect();
    (length > 0).then(|| String::from_utf8_lossy(&bytes).into_owned())
}

/// Stops the Lua code of this thread. For signal handlers: it neither allocates nor waits.
pub fn interrupt_running_code() {
    let running = RUNNING.get();
    if running.is_null() {
        return;
    }
    // SAFETY: the state is being called on this very thread, which stands still meanwhile. Setting a hook is what Lua allows a signal
    // handler to do; the other functions only read.
    let mut coroutine = unsafe { Stack::from_raw(running) };
    REQUESTED.set(true);
    IS_ROUGH.set(true);
    for _ in 0..MAX_COROUTINES {
        api::lua_sethook(coroutine, Some(Hook::COUNT), ffi::LUA_MASKCOUNT, 1);
        note_place(coroutine);
        match resumed_by(coroutine) {
            Some(resumed) => coroutine = resumed,
            None => return,
        }
    }
}

/// Whether the running code is to stop; the hook calls. An interruption that is over leaves nothing behind.
pub(super) fn is_requested(stack: Stack<'_>) -> bool {
    let is_requested = REQUESTED.get();
    if !is_requested && api::lua_gethookcount(stack) == 1 {
        restore_count_hook(stack);
    }
    if is_requested && IS_ROUGH.take() {
        note_place(stack);
    }
    is_requested
}

/// The coroutine that the function written in C on top of the calls has resumed: its first argument, or what it was made for.
fn resumed_by(coroutine: Stack<'_>) -> Option<Stack<'_>> {
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
