//! The hash of a step, by which a replay is compared with its capture.

use std::cell::Cell;
use std::rc::Rc;

use twox_hash::XxHash3_64;

use crate::host::Sim;

/// Values of the state that are hashed in a step on average. Where more of them change, the state is hashed in some steps only, so that a
/// capture costs little.
const VALUES_PER_STEP: usize = 32;
/// Most steps from one hash of the state to the next.
const MAX_INTERVAL: usize = 32;

/// When the state is hashed. It depends on nothing but the run, so that a replay hashes it in the same steps.
#[derive(Default)]
struct Schedule {
    /// Steps without a hash of the state that come next.
    left: Cell<usize>,
    /// All values were hashed once: the first time says nothing about how many of them change.
    has_begun: Cell<bool>,
}

impl Sim {
    /// A hash of what the step has led to: all lines of the console so far, and, every so many steps, the state that scripts can observe.
    pub(super) fn taped_hash(self: &Rc<Self>) -> u64 {
        let schedule = self.modules.states.get::<Schedule>();
        let state = match schedule.left.get().checked_sub(1) {
            Some(left) => {
                schedule.left.set(left);
                0
            }
            None => {
                let (hash, changed) = self.state_hash_and_changes();
                if schedule.has_begun.replace(true) {
                    // What scripts draw at random is read of each of them.
                    let read = changed + self.scripts.len() / 2;
                    let left = (read / VALUES_PER_STEP).min(MAX_INTERVAL);
                    schedule.left.set(left);
                }
                hash
            }
        };
        XxHash3_64::oneshot_with_seed(self.log.hash(), &state.to_le_bytes())
    }
}
