//! What sensors and queries perceive of the scene: proximity sensors, collisions, distances, pictures.
//!
//! Results are computed from the scene when they are asked for. [`Perception`] owns what makes that fast, such as prepared meshes; it is
//! derived from the scene and can be dropped at any time without a change of results.

pub(crate) mod vision;

use std::num::NonZero;

/// The state of all perception of one simulator.
pub(crate) struct Perception {
    pub vision: vision::Vision,
}

impl Perception {
    /// `render_threads`: how many threads draw pictures; None for as many as there are processor cores.
    pub(crate) fn new(render_threads: Option<NonZero<usize>>) -> Self {
        Self { vision: vision::Vision::new(render_threads) }
    }
}
