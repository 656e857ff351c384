//! CoppeliaSim's C interface, from the side of the simulator.
//!
//! Two kinds of programs call it. Native plugins are shared libraries with the entry points `simInit`, `simCleanup` and `simMsg`
//! ([`Plugins`]): they open another library, whose path they get, and look up the functions of the simulator there. Programs load
//! `libcoppeliaSim.so` and drive the simulator themselves ([`attach`]).
//!
//! What both open is generated: `build.rs` makes a C function for each row of a table of symbols. It passes its parameters to
//! [`Interface::perform`], which makes values of them and calls the function that the row names. Which simulator is meant follows from
//! the thread (`current`). [`folder`] writes what programs take for an installation.
//!
//! This layer knows values, and of the simulator what is in [`Host`]. Scripts and the scene are above it.

mod buffers;
mod current;
mod dispatch;
#[expect(unsafe_code, reason = "an edge to C")]
mod ffi;
pub mod folder;
mod functions;
mod own_library;
mod plugins;
mod registration;
mod scene_functions;
mod signature;
mod stacks;

pub use current::{Attached, Frame, attach, has_frame};
pub use dispatch::{Call, Interface, interface_41, interface_410, plugin_interface};
pub use ffi::{Callback, Value};
pub use functions::{Answer, Function};
pub use plugins::{Moment, Plugin, Plugins, Variable};
pub use signature::{Param, Size, Symbol};

/// The shared library that programs load which were made for CoppeliaSim 4.1; empty where they are not supported. It needs the
/// simulator's library beside it.
pub const LIBRARY_41: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/libcoppeliaSim_41.so"));

/// The same for CoppeliaSim 4.10.
pub const LIBRARY_410: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/libcoppeliaSim_410.so"));

/// The numbers by which these libraries call their interfaces.
pub const INTERFACE_41: u32 = number(env!("INTERFACE_41"));
/// The same for CoppeliaSim 4.10.
pub const INTERFACE_410: u32 = number(env!("INTERFACE_410"));

const fn number(text: &str) -> u32 {
    match u32::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("the build script has written a number"),
    }
}

use scene::Data;

/// What plugins need of the simulator, in the name of the script on whose behalf they run.
pub trait Host {
    /// Calls a function of the API.
    ///
    /// # Errors
    /// The reason, as scripts get it.
    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String>;

    /// Calls a global function of a script: its handle, -1 for the sandbox, -2 for the main script.
    ///
    /// # Errors
    /// When there is no such script or function, or it fails, which is logged.
    fn call_script(&self, script: i64, function: &str, args: &[Data]) -> Result<Vec<Data>, String>;

    /// The values of an expression in a script, or what a text returns there.
    ///
    /// # Errors
    /// When there is no such script, or the text fails.
    fn execute(&self, script: i64, text: &[u8]) -> Result<Vec<Data>, String>;

    /// A function of the calling program for scripts, as a global of that name, where dots make tables. Whether it is new.
    ///
    /// # Errors
    /// When there is no simulator.
    fn register_function(&self, name: String, callback: Callback) -> Result<bool, String>;

    /// Writes a line to the log, in the name of `origin`, with a verbosity of `sim.verbosity_*`.
    fn log(&self, origin: &str, level: i64, text: &str);
}
