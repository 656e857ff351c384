//! The state hash: 64 bits that are equal when two simulators are in the same state, as far as scripts can observe it.
//!
//! Every value has a hash of its own (xxh3), seeded with its name and its owner; the hash of the state is their sum. So it can be kept up
//! to date: the journal of the scene says which objects changed in which respect, and only their values are hashed again. Those hashes
//! also name *what* differs. Without a first request nothing is followed.
//!
//! Hashed are poses, velocities, joints, readings and pictures of sensors, meshes, all properties with a state of their own, custom data,
//! signals, the tree, the selection, named parameters, time and state of the simulation, the states of scripts and their random numbers.
//! Not hashed is what scripts know only themselves (variables), their texts, what outlives the run (persistent data), and what distinguishes
//! runs that are the same: files, paths, identifiers of the session.

mod bytes;
mod hashes;
mod news;
mod readers;
mod slots;
mod stored;
mod unrecorded;

use std::cell::RefCell;
use std::rc::Rc;

use crate::host::Sim;
pub use hashes::ChangedValue;
use hashes::Hashes;

/// The hashes of a simulator that was asked for them.
#[derive(Default)]
struct StateHash {
    hashes: RefCell<Hashes>,
    /// What changed since the last time that somebody asked for it; None before the first time.
    unreported: RefCell<Option<Vec<(i64, String, u64)>>>,
}

impl Sim {
    /// The hash of what scripts can observe now.
    pub fn state_hash(self: &Rc<Self>) -> u64 {
        self.state_hash_and_changes().0
    }

    /// The same, and how many values have another hash than the last time.
    pub(crate) fn state_hash_and_changes(self: &Rc<Self>) -> (u64, usize) {
        let known = self.modules.states.get::<StateHash>();
        let mut unreported = known.unreported.borrow_mut();
        let mut changes = 0;
        let hash = known.hashes.borrow_mut().update(self, &mut |value| {
            changes += 1;
            if let Some(unreported) = unreported.as_mut() {
                unreported.push((value.target, value.name.to_owned(), value.hash));
            }
        });
        (hash, changes)
    }

    /// The same; `sink` gets the values that changed since the last call of this function, all of them at the first one.
    pub fn state_hash_with(self: &Rc<Self>, mut sink: impl FnMut(ChangedValue<'_>)) -> u64 {
        let known = self.modules.states.get::<StateHash>();
        let unreported = known.unreported.borrow_mut().replace(Vec::new());
        let mut hashes = known.hashes.borrow_mut();
        match unreported {
            Some(unreported) => unreported.iter().for_each(|(target, name, hash)| {
                sink(ChangedValue {
                    target: *target,
                    name,
                    hash: *hash,
                });
            }),
            None => *hashes = Hashes::default(),
        }
        hashes.update(self, &mut sink)
    }

    /// The same without what is known from before, to check that.
    pub fn state_hash_anew(self: &Rc<Self>) -> u64 {
        Hashes::default().update(self, &mut |_| ())
    }
}
