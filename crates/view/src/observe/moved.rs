//! World poses of objects that may have moved, and of all below them.

use std::collections::BTreeSet;

use geometry::pose::pose_to_array;

use scene::{Handle, Object, Scene};

/// Finds out who moved, without looking at an object twice.
#[derive(Default)]
pub(super) struct Moved {
    /// For each handle the last round in which it was looked at.
    rounds: Vec<u32>,
    round: u32,
    found: Vec<Handle>,
}

impl Moved {
    /// Poses of `moved` and what is below, or of all objects. In the order of handles.
    pub(super) fn poses(
        &mut self,
        scene: &Scene,
        moved: &BTreeSet<Handle>,
        all: bool,
    ) -> Vec<(i64, [f32; 7])> {
        self.found.clear();
        if all {
            self.found.extend(scene.objects().map(Object::handle));
        } else {
            self.find(scene, moved);
        }
        self.found.sort_unstable();
        let pose = |handle: &Handle| {
            let pose = scene.world_pose(*handle).ok()?;
            Some((
                handle.raw(),
                pose_to_array(&pose).map(|number| number as f32),
            ))
        };
        self.found.iter().filter_map(pose).collect()
    }

    fn find(&mut self, scene: &Scene, moved: &BTreeSet<Handle>) {
        self.round = self.round.wrapping_add(1);
        if self.round == 0 {
            self.rounds.clear();
            self.round = 1;
        }
        for &handle in moved {
            let mut next = self.found.len();
            self.visit(scene, handle);
            while let Some(&handle) = self.found.get(next) {
                let children = scene.object(handle).map_or(&[][..], Object::children);
                children.iter().for_each(|child| self.visit(scene, *child));
                next += 1;
            }
        }
    }

    fn visit(&mut self, scene: &Scene, handle: Handle) {
        let at = handle.0 as usize;
        if self.rounds.len() <= at {
            self.rounds.resize(at + 1, 0);
        }
        if self.rounds[at] != self.round && scene.exists(handle) {
            self.rounds[at] = self.round;
            self.found.push(handle);
        }
    }
}
