//! Particles: small spheres that scripts emit and the physics moves (spec: dynamics 12). They are seen as drawing objects are, and are no objects of the tree: handles of their own,
//! not saved, gone with their script; the end of a simulation removes the particles.

mod container;
pub mod options;

use std::collections::VecDeque;
use std::f64::consts::PI;

use super::{DrawingObject, DrawingStyle};
use crate::Pose;
use crate::appearance::colour::Colour;
pub use container::Particles;
use options::{Parameters, ParticleFlags, ParticleKind};

/// What all particles of an object have.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleStyle {
    /// How they are drawn.
    pub kind: ParticleKind,
    /// What they collide with, and how they are stored and drawn.
    pub flags: ParticleFlags,
    /// Diameter, metres.
    pub size: f64,
    /// kg/m³
    pub density: f64,
    /// Of the physics.
    pub parameters: Parameters,
    /// How long a particle is there, seconds; 0 for ever.
    pub life_time: f64,
    /// Capacity; see [`ParticleFlags::CYCLIC`] for what a full object does.
    pub max_items: usize,
    /// Colour of particles without a colour of their own.
    pub colour: Colour,
}

/// A sphere in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Its centre, metres.
    pub position: [f64; 3],
    /// Its velocity, m/s.
    pub velocity: [f64; 3],
    /// Diameter, metres.
    pub size: f64,
    /// kg
    pub mass: f64,
    colour: Option<[f64; 3]>,
    /// Seconds since it was emitted.
    age: f64,
}

/// A source of particles, and those that it has emitted.
#[derive(Debug, Clone, PartialEq)]
pub struct ParticleObject {
    style: ParticleStyle,
    /// The script whose end removes it.
    owner: i64,
    /// The oldest first.
    items: VecDeque<Particle>,
    drawing: DrawingObject,
    /// Whether the drawing is that of an earlier moment.
    is_stale: bool,
}

impl ParticleObject {
    /// Largest capacity, whatever a script asks for.
    const MAX_ITEMS: usize = 1_000_000;
    /// Smallest and largest diameter (metres), and density (kg/m³).
    const BOUNDS: [[f64; 2]; 2] = [[1e-6, 1e3], [1e-6, 1e6]];

    fn new(mut style: ParticleStyle, owner: i64) -> Self {
        style.max_items = style.max_items.clamp(1, Self::MAX_ITEMS);
        [style.size, style.density] = Self::usable([style.size, style.density]);
        let drawing = DrawingStyle {
            kind: style.kind.drawing(),
            flags: style.flags.drawing(),
            size: match style.kind {
                ParticleKind::Points(pixels) => pixels.into(),
                ParticleKind::Spheres => style.size,
            },
            duplicate_tolerance: 0.0,
            parent: None,
            max_items: style.max_items,
            colour: style.colour,
        };
        Self {
            drawing: DrawingObject::new(drawing, None),
            style,
            owner,
            items: VecDeque::new(),
            is_stale: false,
        }
    }

    /// What all its particles have.
    pub fn style(&self) -> &ParticleStyle {
        &self.style
    }

    /// The particles, the oldest first.
    pub fn items(&self) -> impl ExactSizeIterator<Item = &Particle> {
        self.items.iter()
    }

    /// The same, to be moved.
    pub fn items_mut(&mut self) -> &mut [Particle] {
        self.is_stale = true;
        self.items.make_contiguous()
    }

    /// Numbers per item: position and velocity, then size, density and colour where the type has them.
    pub fn item_len(&self) -> usize {
        let has = |flag: ParticleFlags| usize::from(self.style.flags.contains(flag));
        let numbers = has(ParticleFlags::ITEM_SIZES) + has(ParticleFlags::ITEM_DENSITIES);
        6 + numbers + 3 * has(ParticleFlags::ITEM_COLOURS)
    }

    /// Emits the particle at the beginning of `numbers`. False when there is no room, or these are no numbers of a particle.
    pub fn add(&mut self, numbers: &[f64]) -> bool {
        let Some(particle) = self.particle(numbers) else {
            return false;
        };
        if self.items.len() >= self.style.max_items {
            if !self.style.flags.contains(ParticleFlags::CYCLIC) {
                return false;
            }
            self.items.pop_front();
        }
        self.items.push_back(particle);
        self.is_stale = true;
        true
    }

    fn particle(&self, numbers: &[f64]) -> Option<Particle> {
        let numbers = numbers.get(..self.item_len())?;
        if !numbers.iter().all(|number| number.is_finite()) {
            return None;
        }
        let (motion, mut rest) = numbers.split_at(6);
        let mut next = |flag: ParticleFlags, usual: f64| match rest.split_first() {
            Some((number, after)) if self.style.flags.contains(flag) => {
                rest = after;
                *number
            }
            _ => usual,
        };
        let size = next(ParticleFlags::ITEM_SIZES, self.style.size);
        let density = next(ParticleFlags::ITEM_DENSITIES, self.style.density);
        let [size, density] = Self::usable([size, density]);
        Some(Particle {
            position: *motion.first_chunk()?,
            velocity: *motion.last_chunk()?,
            size,
            mass: density * PI / 6.0 * size.powi(3),
            colour: rest.first_chunk().copied(),
            age: 0.0,
        })
    }

    fn usable(numbers: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| numbers[i].max(Self::BOUNDS[i][0]).min(Self::BOUNDS[i][1]))
    }

    /// Removes all particles.
    pub fn clear(&mut self) {
        self.is_stale |= !self.items.is_empty();
        self.items.clear();
    }

    /// Lets `step` seconds pass, and removes what has lived its time, and what `is_lost`.
    pub fn age(&mut self, step: f64, is_lost: impl Fn(&Particle) -> bool) {
        let life_time = self.style.life_time;
        let count = self.items.len();
        self.items.retain_mut(|particle| {
            particle.age += step;
            let is_over = life_time > 0.0 && particle.age >= life_time - step / 2.0;
            !is_over && !is_lost(particle)
        });
        self.is_stale |= self.items.len() != count;
    }

    /// What is seen of it; None if nothing ever is.
    fn drawn(&self) -> Option<&DrawingObject> {
        let is_hidden = self.style.flags.contains(ParticleFlags::INVISIBLE);
        (!is_hidden).then_some(&self.drawing)
    }

    /// Draws the particles where they are, as the change of that number.
    fn draw(&mut self, change: u64) {
        self.is_stale = false;
        self.drawing.changed_at = change;
        self.drawing.clear();
        for particle in &self.items {
            let mut item = particle.position.to_vec();
            item.extend(particle.colour.into_iter().flatten());
            if self.style.flags.contains(ParticleFlags::ITEM_SIZES) {
                item.push(particle.size);
            }
            self.drawing.add(&item, &Pose::identity());
        }
    }
}

#[cfg(test)]
mod tests;
