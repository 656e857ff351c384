//! Restrictions of simulators that share their process with others: those with [`Limits`](crate::Limits).

use std::ffi::c_int;

use super::startup::load_module;
use crate::host::Sim;
use crate::log::console::OutputStream;
use crate::lua::{LuaError, Stack, push_callback};

/// Keeps a state from ending the process, and from writing between the lines of the others.
pub(super) fn install(sim: &Sim, stack: Stack<'_>) -> Result<(), LuaError> {
    load_module(stack, sim, "shared_process")?;
    push_callback(stack, write, 0);
    stack.protected_call(1, 0)
}

/// Gets the name of a stream, and what a script has written there.
fn write(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let sim = stack.env().sim.upgrade().ok_or("the simulator is gone.")?;
    let is_error = stack.with_bytes(1, |name| name == b"stderr") == Some(true);
    let stream = if is_error {
        OutputStream::Error
    } else {
        OutputStream::Output
    };
    let time = sim.clock.time();
    sim.log
        .write(&stack.bytes(2).unwrap_or_default(), stream, time);
    Ok(0)
}
