//! A simulator as programs call it by the C interface.

use std::rc::Rc;

use c_interface::{Callback, Host};
use heap::{Handle, enter_and_copy};
use scene::Data;

use super::Simulator;
use super::caller::{Link, reason};

/// Does not keep the simulator alive. Calls are in the name of the sandbox, in the memory of the simulator; results are copied out.
struct CHost {
    sim: Link,
    heap: Option<Handle>,
}

impl Simulator {
    /// The simulator as the host of a program's calls, also while scripts run.
    pub fn c_host(&self) -> Rc<dyn Host> {
        let heap = {
            let _inside = self.inside();
            Handle::current()
        };
        Rc::new(CHost {
            sim: Rc::clone(&self.link),
            heap,
        })
    }
}

impl CHost {
    fn with<T: Clone>(
        &self,
        work: impl FnOnce(&dyn Host) -> Result<T, String>,
    ) -> Result<T, String> {
        let sim = self.sim.upgrade().ok_or("the simulator has ended")?;
        enter_and_copy(self.heap, || work(&*sim.c_host()))
    }
}

impl Host for CHost {
    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let results = self.with(|host| host.call(function, args));
        results.map_err(|error| reason(&error).to_owned())
    }

    fn call_script(&self, script: i64, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        self.with(|host| host.call_script(script, function, args))
    }

    fn execute(&self, script: i64, text: &[u8]) -> Result<Vec<Data>, String> {
        self.with(|host| host.execute(script, text))
    }

    fn register_function(&self, name: String, callback: Callback) -> Result<bool, String> {
        self.with(|host| host.register_function(name.clone(), callback))
    }

    fn log(&self, origin: &str, level: i64, text: &str) {
        // A simulator that has ended has no log.
        let _ = self.with(|host| {
            host.log(origin, level, text);
            Ok(())
        });
    }
}
