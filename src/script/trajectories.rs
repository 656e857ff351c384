//! The trajectories of one script, by handle.

use std::collections::BTreeMap;

use crate::scene::ruckig::Trajectory;

/// Trajectories in use. Handles rise and are never given out twice.
#[derive(Default)]
pub(crate) struct Trajectories {
    last: i64,
    by_handle: BTreeMap<i64, Trajectory>,
}

impl Trajectories {
    pub(crate) fn add(&mut self, trajectory: Trajectory) -> i64 {
        self.last += 1;
        self.by_handle.insert(self.last, trajectory);
        self.last
    }

    pub(crate) fn get_mut(&mut self, handle: i64) -> Option<&mut Trajectory> {
        self.by_handle.get_mut(&handle)
    }

    pub(crate) fn remove(&mut self, handle: i64) -> Option<Trajectory> {
        self.by_handle.remove(&handle)
    }
}
