//! The nodes of everything that is solved at once.

use super::coupled_rod::CoupledRod;
use super::islands::Members;
use super::system::Vector;
use crate::V3;

/// Nodes of all parts, and after these of all rods.
#[derive(Default)]
pub(super) struct Nodes {
    /// Where those of each part, and of each rod, begin.
    pub starts: Vec<usize>,
    pub masses: Vec<f64>,
    /// Of each part and rod.
    pub radii: Vec<f64>,
    /// Places at the beginning of the step and in the trial.
    pub before: Vec<V3>,
    pub now: Vec<V3>,
    pub rods: Vec<CoupledRod>,
    /// Angles of the edges of rods in the trial.
    pub angles: Vec<f64>,
}

impl Nodes {
    /// The trial goes on as all of them move, for `step` seconds.
    pub(super) fn new(members: &mut Members, step: f64) -> Self {
        let mut all = Self::default();
        for part in &members.parts {
            let places = part.places.iter().copied();
            let moved = places.zip(part.velocities.iter().copied());
            all.add(moved, &part.masses, part.material.radius, step);
        }
        for rod in &mut members.rods {
            let rod_in_step = CoupledRod::new(rod, all.now.len(), all.angles.len(), step);
            all.rods.push(rod_in_step);
            let moved = rod.now.places.iter().zip(&rod.now.velocities);
            let angle = moved
                .clone()
                .map(|(place, velocity)| place.w + velocity.w * step);
            all.angles.extend(angle);
            let masses: Vec<f64> = rod.masses.iter().map(|mass| mass.x).collect();
            let moved = moved.map(|(place, velocity)| (place.xyz(), velocity.xyz()));
            all.add(moved, &masses, rod.material.radius, step);
        }
        all
    }

    /// Adds those of a part, with their places and velocities.
    fn add(
        &mut self,
        moved: impl Iterator<Item = (V3, V3)>,
        masses: &[f64],
        radius: f64,
        step: f64,
    ) {
        self.starts.push(self.before.len());
        self.masses.extend(masses);
        self.radii.push(radius);
        for (place, velocity) in moved {
            self.before.push(place);
            self.now.push(place + velocity * step);
        }
    }

    /// Zero for each unknown of them and of so many bodies.
    pub(super) fn zeros(&self, bodies: usize) -> Vector {
        Vector::zeros(self.now.len(), self.angles.len(), bodies)
    }
}
