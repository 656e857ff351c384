//! Native plugins in Rust: a library that scripts load by `loadPlugin`, in Swanilda and in CoppeliaSim.
//!
//! The package of a plugin has `crate-type = ["cdylib"]`. [`plugin!`] lists its functions; `loadPlugin 'simName'` finds them in
//! `libsimName.so`.
//!
//! ```
//! use swanilda_plugin::{Call, Value, plugin};
//!
//! fn double(_: &Call, args: Vec<Value>) -> Result<Vec<Value>, String> {
//!     match args.as_slice() {
//!         [Value::Float(number)] => Ok(vec![Value::Float(2.0 * number)]),
//!         _ => Err("a number is needed.".to_owned()),
//!     }
//! }
//!
//! plugin! { version: 1, functions: [double] }
//! # fn main() {}
//! ```

#[expect(unsafe_code, reason = "an edge to C")]
mod interface;
mod stack;

use std::panic::{AssertUnwindSafe, catch_unwind};

use interface::Interface;
#[doc(hidden)]
pub use interface::{CallInfo, Callback, InitInfo};

/// A value of a script.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// `nil`.
    Nil,
    /// A boolean.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number that is no integer by its type.
    Float(f64),
    /// A string or a buffer of Lua: any bytes.
    Text(Vec<u8>),
    /// A table with the keys 1 to n.
    Array(Vec<Value>),
    /// Any other table.
    Map(Vec<(Value, Value)>),
}

/// A function for scripts: it gets the arguments and returns the results, or the text of an error.
pub type Function = fn(&Call, Vec<Value>) -> Result<Vec<Value>, String>;

/// The call of a plugin's function by a script.
#[derive(Debug)]
pub struct Call {
    script: i32,
    object: i32,
}

impl Call {
    /// The handle of the script.
    pub fn script(&self) -> i32 {
        self.script
    }

    /// The handle of the object that the script is attached to; None where it is attached to none.
    pub fn object(&self) -> Option<i32> {
        (self.object >= 0).then_some(self.object)
    }

    /// Calls a global function of a script: a handle, -1 for the sandbox, -2 for the main script.
    ///
    /// # Errors
    /// When there is no such script or function, or it fails.
    pub fn call_script(
        &self,
        script: i32,
        function: &str,
        args: &[Value],
    ) -> Result<Vec<Value>, String> {
        interface()?.call_script(script, function, args)
    }

    /// Writes a line to the log in the name of `origin`. Scripts' own lines have level 450, warnings 430, errors 420.
    ///
    /// # Errors
    /// When a text has a NUL in it.
    pub fn log(&self, origin: &str, level: i32, text: &str) -> Result<(), String> {
        interface()?.log(origin, level, text)
    }
}

/// The functions of the simulator; there from `simInit` on.
fn interface() -> Result<&'static Interface, String> {
    Interface::get().ok_or_else(|| "the plugin was not started.".to_owned())
}

/// Exports the entry points of a plugin: its version, and its functions under their Rust names.
#[macro_export]
macro_rules! plugin {
    (version: $version:expr, functions: [$($function:ident),* $(,)?] $(,)?) => {
        /// Called when the plugin is loaded; returns its version, or 0 where it cannot work.
        #[unsafe(no_mangle)]
        #[allow(non_snake_case, reason = "the name is that of the interface")]
        pub extern "C" fn simInit(info: $crate::InitInfo) -> i32 {
            $crate::start(&info, $version, &[$(
                (stringify!($function), {
                    extern "C" fn callback(call: $crate::CallInfo) {
                        $crate::answer(&call, $function);
                    }
                    callback
                }),
            )*])
        }

        /// Called before the plugin is unloaded.
        #[unsafe(no_mangle)]
        #[allow(non_snake_case, reason = "the name is that of the interface")]
        pub extern "C" fn simCleanup() {}
    };
}

/// What `simInit` does: the version, or 0 where the plugin cannot run.
#[doc(hidden)]
pub fn start(info: &InitInfo, version: i32, functions: &[(&str, Callback)]) -> i32 {
    let Some(interface) = Interface::find(info) else {
        return 0;
    };
    let all = functions
        .iter()
        .all(|&(name, callback)| interface.register(name, callback));
    if all { version } else { 0 }
}

/// What a function for scripts does around the plugin's own.
#[doc(hidden)]
pub fn answer(info: &CallInfo, function: Function) {
    let Some(interface) = Interface::get() else {
        return;
    };
    let (stack, call) = info.call();
    let args = stack::take(interface, stack);
    let results = catch_unwind(AssertUnwindSafe(|| function(&call, args)));
    match results.unwrap_or_else(|_| Err("the plugin's function has panicked.".to_owned())) {
        Ok(results) => results
            .iter()
            .for_each(|result| stack::push(interface, stack, result)),
        Err(error) => interface.set_error(&error),
    }
}
