//! The scene's physics, by rapier. The only place that names rapier.

/// The physics world that belongs to a scene.
#[derive(Default)]
pub(crate) struct Dynamics;

impl Dynamics {
    /// Forgets the world: it is built anew at the next step.
    pub(crate) fn reset(&mut self) {}
}
