//! Functions that every script has and few use: their code, in Lua files, is loaded at the first call.
//!
//! In their place are native functions without values, which take no memory of a state. A call goes on in the Lua function, which may yield.

use std::ffi::CStr;

use super::library_globals;
use crate::lua::{Outcome, Stack, Type, push_plain};

/// The function of `base.lua` that loads a file and calls a function of it.
const GO_ON: &CStr = c"swanilda.go_on";

/// The file with what is too small for one of its own.
const EXTENSIONS: &str = "swanilda.extensions";

macro_rules! stand_ins {
    ($($module:literal: $($name:ident)*;)*) => {
        /// Defines the global functions. At its first call each is replaced by what it stands for.
        fn define(stack: Stack<'_>) {
            $($({
                fn stand_in(stack: Stack<'_>) -> Outcome {
                    replace(stack, stand_in, $module, stringify!($name))
                }
                push_plain(stack, stand_in);
                stack.set_global(stringify!($name));
            })*)*
        }
    };
}

stand_ins! {
    "swanilda.display": print printf printToConsole getAsString getAsDisplayString;
    "functional.functions": map filter foreach reduce range zip any all sum prod partial apply iter identity negate reify;
    "swanilda.console": help printBytes hexdump _evalExec _evalExecRet _getCompletion _getCalltip;
    "swanilda.plugins": loadPlugin unloadPlugin;
    "swanilda.modload": import rerequire;
    "swanilda.extensions": wrap;
    "var.functions": getvar setvar getlocals f;
}

macro_rules! text_operators {
    ($($event:literal)*) => {
        /// Defines the arithmetic of texts in the metatable on top.
        fn define_text_operators(stack: Stack<'_>) {
            $(
                push_plain(stack, |stack| go_on(stack, "swanilda.arithmetic", $event));
                stack.raw_set_field(-2, concat!("__", $event));
            )*
        }
    };
}

text_operators! {
    "add" "sub" "mul" "div" "mod" "pow" "unm" "idiv" "band" "bor" "bxor" "shl" "shr" "bnot"
}

/// Puts them into a fresh state.
pub(super) fn install(stack: Stack<'_>) {
    define(stack);
    stack.push_bytes(b"");
    if stack.push_metatable(-1) {
        define_text_operators(stack);
        stack.pop(1);
    }
    stack.pop(1);
    extend(stack, "string", |stack| go_on(stack, EXTENSIONS, "string"));
    extend(stack, "table", |stack| go_on(stack, EXTENSIONS, "table"));
    extend(stack, "math", |stack| go_on(stack, EXTENSIONS, "math"));
    define_table(stack, "operator", |stack| {
        go_on(stack, EXTENSIONS, "operator")
    });
    define_table(stack, "simRemoteApi", |stack| {
        go_on(stack, EXTENSIONS, "remoteApi")
    });
    define_table(stack, "_S", |stack| go_on(stack, EXTENSIONS, "interface"));
    push_plain(stack, |stack| go_on(stack, EXTENSIONS, "randomseed"));
    stack.push_global("math");
    stack.insert(-2);
    stack.raw_set_field(-2, "randomseed");
    stack.pop(1);
}

/// Pops the function of `base.lua` that calls.
pub(super) fn set_caller(stack: Stack<'_>) {
    stack.set_registry(GO_ON);
}

/// Goes on in function `name` of a file, with the arguments on the stack.
pub(super) fn go_on(stack: Stack<'_>, module: &str, name: &str) -> Outcome {
    stack.push_nil();
    call(stack, module, name)
}

/// The same; the global `name` becomes that function, if it still is `stand_in`.
fn replace(
    stack: Stack<'_>,
    stand_in: impl Fn(Stack<'_>) -> Outcome + Copy + 'static,
    module: &str,
    name: &str,
) -> Outcome {
    push_plain(stack, stand_in);
    call(stack, module, name)
}

/// What is replaced is on top of the arguments.
fn call(stack: Stack<'_>, module: &str, name: &str) -> Outcome {
    stack.insert(1);
    stack.push_bytes(name.as_bytes());
    stack.insert(1);
    stack.push_bytes(module.as_bytes());
    stack.insert(1);
    stack.push_registry(GO_ON);
    stack.insert(1);
    Outcome::Call
}

/// A library of the standard whose extensions are copied in when the first missing name is asked for.
fn extend(stack: Stack<'_>, library: &str, index: impl Fn(Stack<'_>) -> Outcome + Copy + 'static) {
    stack.push_global(library);
    set_index(stack, index);
    stack.pop(1);
}

/// A global table that finds its content when it is asked for.
fn define_table(
    stack: Stack<'_>,
    name: &str,
    index: impl Fn(Stack<'_>) -> Outcome + Copy + 'static,
) {
    stack.new_table(0, 0);
    set_index(stack, index);
    stack.set_global(name);
}

/// Gives the table on top a metatable.
fn set_index(stack: Stack<'_>, index: impl Fn(Stack<'_>) -> Outcome + Copy + 'static) {
    stack.new_table(0, 1);
    push_plain(stack, index);
    stack.raw_set_field(-2, "__index");
    stack.set_metatable(-2);
}

/// The hook of a script's initialization: begins its thread, if it has one.
pub(super) fn begin_thread(stack: Stack<'_>) -> Outcome {
    if stack.push_global("sysCall_thread") != Type::Function {
        return Outcome::Results(0);
    }
    stack.set_top(0);
    go_on(stack, "swanilda.thread", "begin")
}

/// `pairs` of a table: Lua's function `next` and the table, which is on top.
pub(super) fn push_iteration(stack: Stack<'_>) -> Outcome {
    library_globals::push(stack, "next");
    stack.insert(-2);
    Outcome::Results(2)
}
