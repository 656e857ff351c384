//! Running code from outside: coroutines, their functions and variables, and traps in functions.

mod code;
mod variables;

use std::ffi::c_int;

use mlua::ffi;

use super::api;
use super::stack::frame::{Facts, Frame};
use super::{Stack, Type};
pub(crate) use code::LiveCode;

/// More functions of one coroutine are not looked at: Lua's own limit is about as high.
const MAX_FRAMES: c_int = 200_000;
/// Coroutines that resume each other.
const MAX_COROUTINES: usize = 200;

/// A running function of Lua code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Call {
    /// The name it was called by, as far as Lua knows.
    pub name: Option<String>,
    /// The name of its text.
    pub chunk: Vec<u8>,
    /// The line it is at.
    pub line: u32,
    /// The first line of its text; 0 for the main function of a text.
    pub defined: u32,
    /// Whether it took the place of the function that called it.
    pub is_tail_call: bool,
}

impl Call {
    fn of(frame: &Frame<'_>) -> Self {
        Self {
            name: frame.name().map(|name| name.to_string_lossy().into_owned()),
            chunk: frame.source().to_bytes().to_vec(),
            line: u32::try_from(frame.line()).unwrap_or_default(),
            defined: u32::try_from(frame.defined_at()).unwrap_or_default(),
            is_tail_call: frame.is_tail_call(),
        }
    }
}

impl Stack<'_> {
    /// The number of functions that run in this coroutine.
    pub(crate) fn depth(self) -> c_int {
        let is_there = |level| self.frame(level, Facts::SOURCE).is_some();
        let mut end = 1;
        while end < MAX_FRAMES && is_there(end) {
            end *= 2;
        }
        let (mut low, mut high) = (0, end);
        while low < high {
            let middle = i32::midpoint(low, high);
            if is_there(middle) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The innermost running function of Lua code, from level `level` on, with its level.
    pub(crate) fn call_at(self, level: c_int) -> Option<(c_int, Call)> {
        for level in level..MAX_FRAMES {
            let frame = self.frame(level, Facts::EVERYTHING)?;
            if !frame.is_native() {
                return Some((level, Call::of(&frame)));
            }
        }
        None
    }

    /// Up to `count` running functions of Lua code, innermost first, each with the number of functions that run below it.
    pub(crate) fn calls(self, count: usize) -> Vec<(c_int, Call)> {
        let depth = self.depth();
        let frames =
            (0..depth).filter_map(|level| Some((level, self.frame(level, Facts::EVERYTHING)?)));
        frames
            .filter(|(_, frame)| !frame.is_native())
            .map(|(level, frame)| (depth - 1 - level, Call::of(&frame)))
            .take(count)
            .collect()
    }

    /// This coroutine, the one that it has resumed, and so on.
    pub(crate) fn resumed_coroutines(self) -> Vec<Self> {
        let mut chain = vec![self];
        while let Some(next) = chain[chain.len() - 1].resumed()
            && chain.len() < MAX_COROUTINES
        {
            chain.push(next);
        }
        chain
    }

    /// The coroutine that this one is waiting for.
    fn resumed(self) -> Option<Self> {
        super::hooks::interrupt::resumed_by(self).or_else(|| self.failed())
    }

    /// The coroutine whose error the function written in C on top of the calls is looking at.
    fn failed(self) -> Option<Self> {
        if !self.frame(0, Facts::SOURCE)?.is_native() {
            return None;
        }
        let coroutine = self.coroutine(api::Slot::FIRST)?;
        (coroutine.has_failed() && coroutine.frame(0, Facts::SOURCE).is_some()).then_some(coroutine)
    }

    /// An address that identifies this coroutine as long as it is alive.
    pub(crate) fn address(self) -> usize {
        self.raw() as usize
    }

    /// Pushes the main coroutine of the state.
    pub(crate) fn push_main_coroutine(self) {
        api::lua_rawgeti(self.room(), api::Table::REGISTRY, ffi::LUA_RIDX_MAINTHREAD);
    }

    /// Whether this coroutine has ended by an error: its functions are still there to be looked at.
    pub(crate) fn has_failed(self) -> bool {
        !matches!(api::lua_status(self), ffi::LUA_OK | ffi::LUA_YIELD)
    }

    /// Whether this coroutine has yielded.
    pub(crate) fn is_suspended(self) -> bool {
        api::lua_status(self) == ffi::LUA_YIELD
    }

    /// The coroutine at `index`.
    pub(crate) fn coroutine_at(self, index: c_int) -> Option<Self> {
        if self.kind(index) == Type::Thread {
            self.coroutine(self.slot(index))
        } else {
            None
        }
    }
}
