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
            while let Some(gone) = before.next_if(|known| known.id < script.id) {
                self.forget_script(gone, sink);
            }
            let known = before.next_if(|known| known.id == script.id);
            let seen = Seen::of(script);
            now.push(match known {
                Some(known) if known.seen == seen => known,
                known => self.look_at_script(script.id, seen, known, sink),
            });
        });
        for gone in before {
            self.forget_script(gone, sink);
        }
        self.scripts = now;
    }

    fn look_at_script(
        &mut self,
        id: i64,
        seen: Seen,
        known: Option<TrackedScript>,
        sink: Sink<'_>,
    ) -> TrackedScript {
        static KEY: Lazy<Key64> = Lazy::new(|| Key64::of_name(SCRIPT));
        let mut value = known.map_or(0, |known| known.value);
        self.bytes.int(seen.state);
        if let Some(place) = seen.random {
            self.random_place(place);
        }
        for word in seen.random_of_language.into_iter().flatten() {
            self.bytes.int(word.cast_signed());
        }
        let hash = self.bytes.take_hash(KEY.on(id));
        self.sum
            .replace(&mut value, changed(id, SCRIPT, hash), sink);
        TrackedScript { id, seen, value }
    }

    fn forget_script(&mut self, mut gone: TrackedScript, sink: Sink<'_>) {
        self.sum
            .replace(&mut gone.value, changed(gone.id, SCRIPT, 0), sink);
    }
}

/// The hash of a script, and what it is of.
pub(super) struct TrackedScript {
    id: i64,
    seen: Seen,
    value: u64,
}

/// What is hashed of a script: to compare it costs less than its hash.
#[derive(PartialEq, Eq)]
struct Seen {
    state: i64,
    random: Option<(u32, u64)>,
    random_of_language: Option<[u64; 4]>,
}

impl Seen {
    fn of(script: &Script) -> Self {
        let runtime = script.runtime.borrow();
        let runtime = runtime.as_ref();
        Self {
            state: script.state(),
            random: runtime.map(|runtime| runtime.env.random.borrow().place()),
            random_of_language: runtime.and_then(|runtime| runtime.interpreter.random_state()),
        }
    }
}
