//! Bodies whose motion ran out of numbers: huge forces, huge speeds. They stay where they last were, as static ones, until a script
//! puts them elsewhere or resets them.

use std::collections::BTreeMap;

use scene::{Handle, Pose, Scene, Uid};

/// The shapes that are held.
#[derive(Default)]
pub(super) struct Frozen {
    /// With their poses in the parents' frames.
    shapes: BTreeMap<Handle, (Uid, Pose)>,
    unreported: Vec<Handle>,
}

impl Frozen {
    pub(super) fn contains(&self, shape: Handle) -> bool {
        self.shapes.contains_key(&shape)
    }

    /// Holds a shape where the scene has it.
    pub(super) fn hold(&mut self, shape: Handle, scene: &Scene) {
        if let Ok(object) = scene.object(shape) {
            self.shapes.insert(shape, (object.uid(), object.pose()));
            self.unreported.push(shape);
        }
    }

    /// Lets those go that a script moved, reset or removed; whether there were any.
    pub(super) fn release(&mut self, scene: &Scene) -> bool {
        let count = self.shapes.len();
        self.shapes.retain(|&shape, (uid, pose)| {
            scene
                .object(shape)
                .is_ok_and(|o| o.uid() == *uid && o.pose() == *pose && !o.dynamics_reset)
        });
        self.shapes.len() < count
    }

    /// Those held since the last time this was asked.
    pub(super) fn take_unreported(&mut self) -> Vec<Handle> {
        std::mem::take(&mut self.unreported)
    }
}
