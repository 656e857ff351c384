//! Perception of the scene by sensors and queries: proximity sensors, collisions, distances, pictures.
//!
//! Results are computed from the scene when they are asked for. [`Perception`] owns what makes that fast, such as prepared meshes; it is
//! derived from the scene, and whether it is new or old makes no difference to a result. Only the generator of random numbers has a memory.

pub mod collision;
pub mod detection;
pub(crate) mod distance;
pub mod entity;
mod index;
pub mod items;
mod pairs;
pub mod vision;
mod volume;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::num::NonZero;
use std::rc::Rc;

use rand_mt::Mt;

use index::Index;
use scene::{Handle, Scene};
use volume::SearchVolume;

/// The state of all perception of one simulator.
pub struct Perception {
    /// What draws pictures.
    pub vision: vision::Vision,
    index: Index,
    /// The volumes of sensors that were asked.
    volumes: BTreeMap<Handle, Rc<SearchVolume>>,
    seed: u32,
    /// Made with the first random ray.
    random: Option<Box<Mt>>,
}

impl Perception {
    /// Perceives nothing yet. The seed is that of randomised sensors; `render_threads`: how many threads draw pictures; None for as many
    /// as there are processor cores.
    pub fn new(seed: u32, render_threads: Option<NonZero<usize>>) -> Self {
        let vision = vision::Vision::new(render_threads);
        Self {
            vision,
            index: Index::default(),
            volumes: BTreeMap::new(),
            seed,
            random: None,
        }
    }

    /// Begins the random numbers again.
    pub fn set_seed(&mut self, seed: u32) {
        self.seed = seed;
        self.random = None;
    }

    /// The index, up to date with the scene.
    fn index(&mut self, scene: &Scene) -> &Index {
        self.index.update(scene);
        &self.index
    }

    /// The next random number in [0, 1).
    fn random(&mut self) -> f64 {
        let generator = self
            .random
            .get_or_insert_with(|| Box::new(Mt::new(self.seed)));
        f64::from(generator.next_u32()) / 4_294_967_296.0
    }
}
