//! What no journal records: the clock, parameters of the application, random numbers, the states of scripts.

use std::rc::Rc;

use heap::Lazy;

use super::bytes::Key64;
use super::hashes::{Hashes, Sink, changed};
use crate::host::{Script, Sim};
use scene::special;

/// What is hashed of scripts.
const SCRIPT: &str = "state and random numbers of the script";

impl Hashes {
    pub(super) fn look_at_unrecorded(&mut self, sim: &Rc<Sim>, sink: Sink<'_>) {
        self.bytes.float(sim.clock.time());
        self.set_single(special::SCENE, "simulationTime", sink);
        self.bytes.int(sim.clock.steps().cast_signed());
        self.set_single(special::SCENE, "stepCount", sink);
        self.bytes.int(sim.clock.state() as i64);
        self.set_single(special::SCENE, "simulationState", sink);
        let app = sim.app.borrow();
        for (name, value) in &app.named_params {
            self.bytes.text(name.as_bytes());
            self.bytes.text(value);
        }
        self.set_single(special::APP, "namedParam", sink);
        self.random_place(app.random.place());
        self.set_single(special::APP, "randomFloat", sink);
        drop(app);
        self.look_at_scripts(sim, sink);
    }

    fn random_place(&mut self, (seed, drawn): (u32, u64)) {
        self.bytes.int(i64::from(seed));
        self.bytes.int(drawn.cast_signed());
    }

    /// Both lists of scripts rise by their handles.
    fn look_at_scripts(&mut self, sim: &Rc<Sim>, sink: Sink<'_>) {
        let mut before = std::mem::take(&mut self.scripts).into_iter().peekable();
        let mut now = Vec::with_capacity(before.len());
        sim.scripts.for_each(|script| {
            while let Some((id, mut value)) = before.next_if(|(id, _)| *id < script.id) {
                self.set_script(id, &mut value, 0, sink);
            }
            let old = before.next_if(|(id, _)| *id == script.id);
            let mut value = old.map_or(0, |(_, value)| value);
            let hash = self.hash_of_script(script);
            self.set_script(script.id, &mut value, hash, sink);
            now.push((script.id, value));
        });
        for (id, mut value) in before {
            self.set_script(id, &mut value, 0, sink);
        }
        self.scripts = now;
    }

    fn set_script(&mut self, id: i64, value: &mut u64, hash: u64, sink: Sink<'_>) {
        self.sum.replace(value, changed(id, SCRIPT, hash), sink);
    }

    fn hash_of_script(&mut self, script: &Script) -> u64 {
        static KEY: Lazy<Key64> = Lazy::new(|| Key64::of_name(SCRIPT));
        self.bytes.int(script.state());
        if let Some(runtime) = script.current_runtime() {
            self.random_place(runtime.env.random.borrow().place());
            for word in runtime.interpreter.random_state().into_iter().flatten() {
                self.bytes.int(word.cast_signed());
            }
        }
        self.bytes.take_hash(KEY.on(script.id))
    }
}
