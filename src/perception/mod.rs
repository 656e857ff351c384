//! What sensors and queries perceive of the scene: proximity sensors, collisions, distances, pictures.
//!
//! Results are computed from the scene when they are asked for. [`Perception`] owns what makes that fast, such as prepared meshes; it is
//! derived from the scene and can be dropped at any time without a change of results.

/// The state of all perception of one simulator.
#[derive(Default)]
pub(crate) struct Perception {}
