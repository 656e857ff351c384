//! The hash of a step, by which a replay is compared with its capture.

use std::rc::Rc;

use twox_hash::XxHash3_64;

use crate::host::Sim;

impl Sim {
    /// A hash of what the step has led to: the state that scripts can observe, and all lines of the console so far.
    pub(super) fn taped_hash(self: &Rc<Self>) -> u64 {
        XxHash3_64::oneshot_with_seed(self.log.hash(), &self.state_hash().to_le_bytes())
    }
}
