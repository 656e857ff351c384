//! The seed of all random numbers, anew.

use std::rc::Rc;

use super::{ScriptError, Sim};

impl Sim {
    /// All random numbers begin again as with this seed: those of scripts that run, of scripts to come, of properties and of sensors.
    /// Those of scripts in Python begin with the script only.
    ///
    /// # Errors
    /// When the generator of a script refuses; the others have begun again.
    pub fn set_seed(self: &Rc<Self>, seed: u32) -> Result<(), ScriptError> {
        self.scripts.seed.set(seed);
        self.app.borrow_mut().random.restart(seed);
        self.perception.borrow_mut().set_seed(seed);
        let mut result = Ok(());
        self.scripts.for_each(|script| {
            if let Some(runtime) = &*script.runtime.borrow() {
                runtime.env.random.borrow_mut().restart(seed);
                let seeded = runtime.interpreter.seed_random(seed);
                if result.is_ok() {
                    result = seeded;
                }
            }
        });
        result
    }
}
