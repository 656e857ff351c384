//! Modules and classes that scripts use without asking for them.
//!
//! A module's global is a proxy, which loads the module when it is used. As soon as a script requires one of them, the proxies go. Scripts up to
//! 4.7 used matrices without asking for them. Both are made when they are first looked up, except `sim`: few scripts need more.

use std::ffi::CStr;

use super::stand_ins::{go_on, push_iteration};
use crate::lua::{Outcome, Stack, Type, push_plain};

/// The metatable of proxies, which are tables with the name of their module; nil once there are no more.
const PROXY: &CStr = c"swanilda.proxy";
/// The metatable of the stand-ins for classes, and the key of their names.
const CLASS: &CStr = c"swanilda.class";

const MODULES: &[&str] = &[
    "sim",
    "simIK",
    "simUI",
    "simGeom",
    "simMujoco",
    "simAssimp",
    "simBubble",
    "simCHAI3D",
    "simMTB",
    "simOMPL",
    "simOpenMesh",
    "simQHull",
    "simRRS1",
    "simSDF",
    "simSubprocess",
    "simSurfRec",
    "simURDF",
    "simVision",
    "simWS",
    "simZMQ",
    "simIM",
    "simEigen",
    "simIGL",
    "simICP",
    "simROS",
    "simROS2",
];

const CLASSES: &[&str] = &[
    "Matrix",
    "Vector",
    "Vector3",
    "Vector4",
    "Vector7",
    "Matrix3x3",
    "Matrix4x4",
];

/// The file with what they do.
const FILE: &str = "swanilda.implicit";

/// Makes the proxies' metatable, and the proxy of `sim`.
pub(super) fn install(stack: Stack<'_>) {
    stack.new_table(0, 2);
    push_plain(stack, |stack| go_on(stack, FILE, "index"));
    stack.raw_set_field(-2, "__index");
    push_plain(stack, |stack| go_on(stack, FILE, "newIndex"));
    stack.raw_set_field(-2, "__newindex");
    stack.set_registry(PROXY);
    define(stack, "sim");
    stack.pop(1);
}

/// Pushes the metatable of proxies; nil once there are no more.
pub(super) fn push_proxies(stack: Stack<'_>) {
    stack.push_registry(PROXY);
}

/// Whether a global of that name, which is missing, may be made by [`define`].
pub(super) fn is_candidate(name: &[u8]) -> bool {
    [b"sim", b"Mat", b"Vec"]
        .iter()
        .any(|start| name.starts_with(*start))
}

/// Makes the global of that name, and pushes it; false, and nothing pushed, for other names.
pub(super) fn define(stack: Stack<'_>, name: &str) -> bool {
    let is_made = if MODULES.contains(&name) {
        push_proxy(stack, name)
    } else if CLASSES.contains(&name) {
        push_class(stack, name);
        true
    } else {
        false
    };
    if is_made {
        stack.push_value(-1);
        stack.set_global(name);
    }
    is_made
}

fn push_proxy(stack: Stack<'_>, name: &str) -> bool {
    if stack.push_registry(PROXY) != Type::Table {
        stack.pop(1);
        return false;
    }
    stack.new_table(1, 0);
    stack.push_bytes(name.as_bytes());
    stack.raw_set_index(-2, 1);
    stack.insert(-2);
    stack.set_metatable(-2);
    true
}

fn push_class(stack: Stack<'_>, name: &str) {
    stack.new_table(0, 1);
    if stack.push_registry(CLASS) != Type::Table {
        stack.pop(1);
        push_class_metatable(stack);
    }
    stack.push_value(-1);
    stack.push_bytes(name.as_bytes());
    stack.raw_set(-4);
    stack.set_metatable(-2);
}

fn push_class_metatable(stack: Stack<'_>) {
    stack.new_table(0, 2);
    push_plain(stack, |stack| go_on(stack, FILE, "indexClass"));
    stack.raw_set_field(-2, "__index");
    push_plain(stack, |stack| go_on(stack, FILE, "callClass"));
    stack.raw_set_field(-2, "__call");
    stack.push_value(-1);
    stack.set_registry(CLASS);
}

/// `pairs(_G)`: who iterates gets all names, used before or not.
pub(super) fn pairs_globals(stack: Stack<'_>) -> Outcome {
    for name in MODULES.iter().chain(CLASSES) {
        let is_missing = stack.push_global(name) == Type::Nil;
        stack.pop(1);
        if is_missing && define(stack, name) {
            stack.pop(1);
        }
    }
    stack.push_globals();
    push_iteration(stack)
}

/// `remove(name)`: whether `name` is that of a module with a proxy. Then they go.
pub(super) fn remove_proxies(stack: Stack<'_>) -> Outcome {
    let is_one = |name: &[u8]| MODULES.iter().any(|module| module.as_bytes() == name);
    let is_one =
        stack.with_bytes(1, is_one) == Some(true) && stack.push_registry(PROXY) == Type::Table;
    if is_one {
        let metatable = stack.top();
        MODULES
            .iter()
            .for_each(|name| remove_proxy(stack, name, metatable));
        stack.push_nil();
        stack.set_registry(PROXY);
    }
    stack.push_bool(is_one);
    Outcome::Results(1)
}

fn remove_proxy(stack: Stack<'_>, name: &str, metatable: i32) {
    let top = stack.top();
    let is_table = stack.push_global(name) == Type::Table;
    if is_table && stack.push_metatable(-1) && stack.same(-1, metatable) {
        stack.push_nil();
        stack.set_global(name);
    }
    stack.set_top(top);
}
