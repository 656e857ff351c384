//! Lua's `debug` library sees Lua functions, not native ones.
//!
//! Native functions trust their upvalues, their frames and the metatables of userdata: a script that changed them could have any address
//! called or freed. So natives have no upvalues and no locals for `debug`, userdata keep their metatables, a metatable with `__metatable`
//! is hidden from `debug.getmetatable` too, and the registry is a copy of what is public in it.

use std::ffi::{CStr, c_int};

use mlua::ffi;

use super::beside::keep_watch;
use crate::lua::api::{self, Slot};
use crate::lua::calls::guard::{Next, guarded, install};
use crate::lua::stack::frame::Facts;
use crate::lua::{Outcome, Stack, Type, push_plain};

/// What scripts get as the registry.
const PUBLIC_REGISTRY: &CStr = c"swanilda.registry";

/// Replaces the functions of `debug` that reach into native functions.
pub(crate) fn restrict_debug(stack: Stack<'_>) {
    stack.push_global("debug");
    install::<{ guarded::GET_LOCAL }, _>(stack, "getlocal", get_local);
    install::<{ guarded::SET_LOCAL }, _>(stack, "setlocal", set_local);
    install::<{ guarded::GET_METATABLE }, _>(stack, "getmetatable", get_metatable);
    install::<{ guarded::SET_METATABLE }, _>(stack, "setmetatable", set_metatable);
    install::<{ guarded::GET_UPVALUE }, _>(stack, "getupvalue", access_upvalue);
    install::<{ guarded::SET_UPVALUE }, _>(stack, "setupvalue", access_upvalue);
    if stack.owner().is_watched {
        keep_watch(stack);
    }
    push_plain(stack, get_registry);
    stack.raw_set_field(-2, "getregistry");
    stack.pop(1);
}

/// The public part of the registry: modules and their loaders. It is made when it is first asked for.
fn get_registry(stack: Stack<'_>) -> Outcome {
    if stack.push_registry(PUBLIC_REGISTRY) != Type::Table {
        stack.new_table(0, 3);
        stack.push_globals();
        stack.raw_set_index(-2, ffi::LUA_RIDX_GLOBALS);
        for name in ["_LOADED", "_PRELOAD"] {
            stack.push_named_registry(name);
            stack.raw_set_field(-2, name);
        }
        stack.push_value(-1);
        stack.set_registry(PUBLIC_REGISTRY);
    }
    Outcome::Results(1)
}

fn access_upvalue(stack: Stack<'_>) -> Next {
    if api::lua_iscfunction(stack, stack.slot(1)) != 0 {
        Next::Return(0)
    } else {
        Next::Original
    }
}

fn get_metatable(stack: Stack<'_>) -> Next {
    if stack.kind(1) == Type::UserData && stack.push_metatable(1) {
        if stack.raw_get_field(-1, "__metatable") != Type::Nil {
            return Next::Return(1);
        }
        stack.pop(2);
    }
    Next::Original
}

fn set_metatable(stack: Stack<'_>) -> Next {
    if stack.kind(1) == Type::UserData {
        Next::Refuse(c"userdata keep their metatables")
    } else {
        Next::Original
    }
}

fn get_local(stack: Stack<'_>) -> Next {
    let looks = &stack.owner().looks_at_locals;
    looks.set(looks.get() + 1);
    nil_if(
        stack,
        Local::from_arguments(stack).is_some_and(|local| local.is_native),
    )
}

fn set_local(stack: Stack<'_>) -> Next {
    nil_if(
        stack,
        Local::from_arguments(stack).is_some_and(|local| local.is_native || local.is_temporary),
    )
}

fn nil_if(stack: Stack<'_>, refused: bool) -> Next {
    if !refused {
        return Next::Original;
    }
    stack.push_nil();
    Next::Return(1)
}

/// A local variable by level and number.
struct Local {
    /// It is a slot of a native function.
    is_native: bool,
    /// It has no name: the virtual machine relies on what is in there.
    is_temporary: bool,
}

impl Local {
    /// The one whose level and number are in the arguments; None where Lua's function finds none either.
    fn from_arguments(stack: Stack<'_>) -> Option<Self> {
        let first = if stack.kind(1) == Type::Thread { 2 } else { 1 };
        let level = argument(stack, first)?;
        let number = argument(stack, first + 1)?;
        let coroutine = if first == 2 {
            stack.coroutine(Slot::FIRST)?
        } else {
            stack
        };
        let frame = coroutine.frame(level, Facts::SOURCE)?;
        let name = coroutine.reserve(1).then(|| frame.local_name(number))?;
        let is_temporary = number > 0 && name.is_some_and(|name| name.to_bytes().starts_with(b"("));
        Some(Self {
            is_native: frame.is_native(),
            is_temporary,
        })
    }
}

/// An argument as Lua's function reads it.
fn argument(stack: Stack<'_>, index: c_int) -> Option<c_int> {
    let mut is_integer = 0;
    let integer = api::lua_tointegerx(stack, stack.slot(index), Some(&mut is_integer));
    (is_integer != 0).then_some(numbers::low_i32(integer))
}
