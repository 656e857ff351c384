//! The state of Lua's random numbers, to read and to set.

use std::ffi::CStr;
use std::ptr::NonNull;

use mlua::ffi;

use super::Stack;

/// Keeps the state from being collected when a script removes `math.random`.
const RANDOM_STATE: &CStr = c"swanilda.random";

/// Where `math.random` has its state: four words in a userdata, which never moves and lives as long as the Lua state.
pub(super) struct RandomState(Option<NonNull<[u64; 4]>>);

/// The state after `math.randomseed(number)`, of an integer: xoshiro256**, of which the first numbers are dropped.
pub(crate) fn seeded(number: i64) -> [u64; 4] {
    let mut words = [number.cast_unsigned(), 0xff, 0, 0];
    for _ in 0..16 {
        let third = words[2] ^ words[0];
        let fourth = words[3] ^ words[1];
        words = [
            words[0] ^ fourth,
            words[1] ^ third,
            third ^ (words[1] << 17),
            fourth.rotate_left(45),
        ];
    }
    words
}

impl RandomState {
    /// Of a state whose libraries were just opened.
    pub(super) fn of(stack: Stack<'_>) -> Self {
        stack.push_global("math");
        stack.raw_get_field(-1, "random");
        let raw = stack.raw();
        // SAFETY: there is room for one more value above the two; the upvalue, if there is one, is taken off again. The words are read
        // only if the userdata has as many.
        let words = unsafe {
            if ffi::lua_getupvalue(raw, -1, 1).is_null() {
                None
            } else {
                let words = ffi::lua_touserdata(raw, -1).cast::<[u64; 4]>();
                let is_known = ffi::lua_rawlen(raw, -1) == size_of::<[u64; 4]>();
                stack.set_registry(RANDOM_STATE);
                NonNull::new(words).filter(|words| is_known && words.is_aligned())
            }
        };
        stack.pop(2);
        Self(words)
    }

    /// The four words now.
    pub(super) fn read(&self) -> Option<[u64; 4]> {
        // SAFETY: the registry keeps the userdata, and who holds this holds the state; no Lua code runs meanwhile.
        self.0.map(|words| unsafe { words.read() })
    }

    /// Sets the four words; false where they are not known.
    pub(super) fn write(&self, state: [u64; 4]) -> bool {
        let Some(words) = self.0 else { return false };
        // SAFETY: as in `read`; the userdata consists of these words.
        unsafe { words.write(state) };
        true
    }
}
