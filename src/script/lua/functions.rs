//! Compiled functions: their source, and replacing them.

use std::ffi::c_int;

use mlua::ffi;

use super::Stack;

impl Stack<'_> {
    /// The name of the text of the function on top; None when that is no function of Lua's.
    pub(crate) fn chunk_name_of_function(self) -> Option<Vec<u8>> {
        // SAFETY: `lua_getinfo` takes the function it is asked about from the stack. `source` has `srclen` bytes and lives as long as the
        // function, which is still there.
        unsafe {
            if ffi::lua_isfunction(self.raw(), -1) == 0 || ffi::lua_iscfunction(self.raw(), -1) != 0 {
                return None;
            }
            let mut record: ffi::lua_Debug = std::mem::zeroed();
            self.push_value(-1);
            ffi::lua_getinfo(self.raw(), c">S".as_ptr(), &raw mut record);
            Some(std::slice::from_raw_parts(record.source.cast::<u8>(), record.srclen).to_vec())
        }
    }

    /// Puts the function of `bytecode` into the place of the Lua function below the top, with the same `upvalues` and one more, the value on top,
    /// which is popped.
    pub(crate) fn replace_function(self, bytecode: &[u8], upvalues: c_int) {
        if self.load(bytecode, "=", true).is_err() {
            return self.pop(1);
        }
        // SAFETY: the old function, the value and the new function are on top; both functions are Lua's and have these upvalues.
        unsafe {
            for i in 1..=upvalues {
                ffi::lua_upvaluejoin(self.raw(), -1, i, -3, i);
            }
            self.push_value(-2);
            ffi::lua_setupvalue(self.raw(), -2, upvalues + 1);
        }
        self.remove(-2);
        self.remove(-2);
    }
}
