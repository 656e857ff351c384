//! Threads that have no simulator: their calls are errors that say so.

use std::cell::OnceCell;
use std::rc::Rc;

use c_interface::{Attached, Callback, Host, attach, has_frame};
use scene::Data;

use crate::launch;

thread_local! {
    static ATTACHED: OnceCell<Attached> = const { OnceCell::new() };
}

/// Makes sure that errors of this thread's calls can be told.
pub(crate) fn attach_thread() {
    if !has_frame() {
        // A thread that ends is told nothing any more.
        let _ = ATTACHED.try_with(|attached| attached.set(attach(Rc::new(NoSimulator))));
    }
}

/// The host of a thread without a simulator.
struct NoSimulator;

impl Host for NoSimulator {
    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        if function == "sim.setStringParam"
            && let [Data::Int(parameter), Data::Text(value)] = args
            && launch::set_before_start(*parameter, value)
        {
            return Ok(Vec::new());
        }
        Err(launch::why_no_simulator())
    }

    fn call_script(&self, _: i64, _: &str, _: &[Data]) -> Result<Vec<Data>, String> {
        Err(launch::why_no_simulator())
    }

    fn execute(&self, _: i64, _: &[u8]) -> Result<Vec<Data>, String> {
        Err(launch::why_no_simulator())
    }

    fn register_function(&self, _: String, _: Callback) -> Result<bool, String> {
        Err(launch::why_no_simulator())
    }

    fn log(&self, origin: &str, _: i64, text: &str) {
        eprintln!("swanilda: {origin}: {text}");
    }
}
