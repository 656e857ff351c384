//! Compiled Lua functions.
//!
//! Lua does not check bytecode: wrong bytes corrupt memory. So [`Bytecode`] can only be made by Lua's compiler and by the rewriting in
//! this module, and only a `Bytecode` can be loaded without a check.

mod argument;
mod chunk;
mod probes;
mod statement;
mod stubs;
mod traps;

use std::collections::BTreeSet;
use std::ffi::{CStr, CString, c_int};

use mlua::chunk::ChunkMode;
use mlua::{Error, Function, Lua, LuaOptions, StdLib, ffi};

use super::calls::LuaError;
use super::stack::Stack;
use chunk::Chunk;
pub(crate) use chunk::Prototype;
pub(crate) use stubs::PassedFunction;
pub(crate) use traps::{FunctionTraps, Trap};

/// A function compiled by Lua.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Bytecode(Vec<u8>);

/// A function with probes, and the number of its upvalue for the table that they write to.
pub(crate) struct Instrumented {
    bytecode: Bytecode,
    upvalue: u8,
}

impl Bytecode {
    /// Compiles Lua text in a state of its own.
    pub(crate) fn compile(code: &[u8], chunk_name: &str) -> Result<Self, String> {
        let lua = Lua::new_with(StdLib::NONE, LuaOptions::default())
            .map_err(|error| error.to_string())?;
        let chunk = lua
            .load(code)
            .set_name(chunk_name.replace('\0', " "))
            .set_mode(ChunkMode::Text);
        match chunk.into_function() {
            Ok(function) => Ok(Self(function.dump(false))),
            Err(Error::SyntaxError { message, .. }) => Err(message),
            Err(other) => Err(other.to_string()),
        }
    }

    /// The main function; None for bytecode of another version of Lua.
    pub(crate) fn main_function(&self) -> Option<Prototype<'_>> {
        Some(Chunk::read(&self.0)?.main)
    }

    /// The functions that are made only to be passed to one of these globals, behind a name: `it('name', function() ... end)`.
    pub(crate) fn passed_functions(&self, callees: &[&str]) -> Vec<PassedFunction> {
        stubs::passed_functions(&self.0, callees)
    }

    /// The same with functions that do nothing in place of these, which are in the order of `passed_functions` of this very bytecode.
    pub(crate) fn with_stubs<'a>(
        &self,
        functions: impl Iterator<Item = &'a PassedFunction>,
    ) -> Self {
        Self(stubs::with_stubs(&self.0, functions))
    }

    /// The function with probes on these lines; None where there is no room for them.
    pub(crate) fn with_probes(&self, lines: &BTreeSet<u32>) -> Option<Instrumented> {
        let (bytes, upvalue) = probes::with_probes(&self.0, lines)?;
        Some(Instrumented {
            bytecode: Self(bytes),
            upvalue,
        })
    }

    /// The function with traps on these lines, which are not armed; None where there is no room for them.
    pub(crate) fn with_traps(
        &self,
        lines: &BTreeSet<u32>,
    ) -> Option<(Instrumented, FunctionTraps)> {
        let (bytes, upvalue, traps) = traps::with_traps(&self.0, lines)?;
        let bytecode = Self(bytes);
        Some((Instrumented { bytecode, upvalue }, traps))
    }
}

impl Stack<'_> {
    /// Compiles Lua text and pushes the chunk. Lua shows positions as `[string "name"]:line:` unless the name starts with `=` or `@`.
    pub(crate) fn load_text(self, code: &[u8], name: &str) -> Result<(), LuaError> {
        self.load(code, name, c"t")
    }

    /// Pushes a compiled chunk.
    pub(crate) fn load_bytecode(self, code: &Bytecode, name: &str) -> Result<(), LuaError> {
        self.load(&code.0, name, c"b")
    }

    /// Pops a table and makes it the `_ENV` of the chunk below it.
    pub(crate) fn set_environment(self) {
        // SAFETY: the table is on top, the chunk below. `lua_setupvalue` pops the value unless there is no such upvalue.
        if unsafe { ffi::lua_setupvalue(self.raw(), -2, 1) }.is_null() {
            self.pop(1);
        }
    }

    fn load(self, code: &[u8], name: &str, mode: &CStr) -> Result<(), LuaError> {
        let name = CString::new(name.replace('\0', " ")).unwrap_or_default();
        let _room = self.room();
        // SAFETY: `luaL_loadbufferx` reports errors as values; there is room for one. Bytecode comes from Lua's compiler.
        let status = unsafe {
            ffi::luaL_loadbufferx(
                self.raw(),
                code.as_ptr().cast(),
                code.len(),
                name.as_ptr(),
                mode.as_ptr(),
            )
        };
        if status == ffi::LUA_OK {
            Ok(())
        } else {
            Err(self.pop_error())
        }
    }

    /// The bytecode of the Lua function on top, which is popped; None for another value.
    pub(crate) fn dump(self) -> Option<Bytecode> {
        let function = self.to_mlua::<Function>(-1);
        self.pop(1);
        // The dump of a native function is empty.
        function
            .ok()
            .map(|function| function.dump(false))
            .filter(|bytes| !bytes.is_empty())
            .map(Bytecode)
    }

    /// Whether the function on top cannot have kept its argument when it has returned.
    pub(crate) fn forgets_its_argument(self) -> bool {
        self.push_value(-1);
        let code = self.dump();
        code.is_some_and(|code| {
            code.main_function()
                .is_some_and(|function| function.forgets_its_argument())
        })
    }

    /// Whether a call of the function on top does nothing at all: its body is empty, and the script has no hook that would see the call.
    pub(crate) fn does_nothing(self) -> bool {
        if super::api::lua_gethookmask(self) != 0 {
            return false;
        }
        self.push_value(-1);
        let code = self.dump();
        code.is_some_and(|code| {
            code.main_function()
                .is_some_and(|function| function.does_nothing())
        })
    }

    /// Whether the function that called the running one, by a field of this name, drops its results.
    pub(in crate::lua) fn caller_drops_results_of(self, field: &str) -> bool {
        let Some(line) = self.push_caller() else {
            return false;
        };
        let code = self.dump();
        code.is_some_and(|code| {
            code.main_function()
                .is_some_and(|function| function.drops_results_of(field, line))
        })
    }

    /// The name of the text of the function on top; None when that is no Lua function.
    pub(crate) fn chunk_name_of_function(self) -> Option<Vec<u8>> {
        // SAFETY: `lua_getinfo` takes the function it is asked about from the stack. `source` has `srclen` bytes and lives as long as the
        // function, which is still there.
        unsafe {
            if ffi::lua_isfunction(self.raw(), -1) == 0 || ffi::lua_iscfunction(self.raw(), -1) != 0
            {
                return None;
            }
            let mut record: ffi::lua_Debug = std::mem::zeroed();
            self.push_value(-1);
            ffi::lua_getinfo(self.raw(), c">S".as_ptr(), &raw mut record);
            Some(std::slice::from_raw_parts(record.source.cast::<u8>(), record.srclen).to_vec())
        }
    }

    /// Replaces the Lua function below the top by its instrumented form, which shares its upvalues. The table for the probes is on top and
    /// is popped.
    pub(crate) fn replace_function(self, function: &Instrumented) {
        let upvalues = c_int::from(function.upvalue);
        if self.load_bytecode(&function.bytecode, "=").is_err() {
            return self.pop(1);
        }
        // SAFETY: the old function, the table and the new function are on top. `lua_upvalueid` returns null for upvalues that do not exist.
        unsafe {
            let has =
                |function, upvalue| !ffi::lua_upvalueid(self.raw(), function, upvalue).is_null();
            let is_lua = ffi::lua_isfunction(self.raw(), -3) != 0
                && ffi::lua_iscfunction(self.raw(), -3) == 0;
            if !is_lua || (1..=upvalues).any(|i| !has(-1, i) || !has(-3, i)) {
                return self.pop(2);
            }
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
