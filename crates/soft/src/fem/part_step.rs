//! One cloth or volume in a step.

use super::Deformable;
use super::gas::{volume_gradient, volume_of};
use super::system::Joined;
use crate::{Step, V3};

impl Deformable {
    /// The potential of inertia, weight, drag, elasticity and gas.
    pub(super) fn potential(&self, places: &[V3], step: Step) -> f64 {
        let sum = self.inertia_potential(places, step)
            + self.elastic_potential(places, self.material.damping / step.length);
        let gas = self.gas.map(|gas| {
            // Nothing goes on through where the volume would be none.
            let potential = gas.potential(volume_of(&self.surface, places));
            potential.unwrap_or(f64::INFINITY)
        });
        sum + gas.unwrap_or(0.0)
    }

    fn inertia_potential(&self, places: &[V3], step: Step) -> f64 {
        let inverse = 1.0 / step.length;
        let of_node = |node: usize| {
            let moved = places[node] - self.places[node];
            let square = moved * (0.5 * inverse * (inverse + self.material.drag));
            let linear = square - self.velocities[node] * inverse - step.gravity;
            self.masses[node] * moved.dot(&linear)
        };
        (0..self.len()).map(of_node).sum()
    }

    /// Writes the stiffness, adds the gradient of the potential, and says what the gas adds to the stiffness of nodes that begin at `start`.
    pub(super) fn linearize(
        &mut self,
        places: &[V3],
        step: Step,
        start: usize,
        gradient: &mut [V3],
    ) -> Option<Joined> {
        self.assemble(places, self.material.damping / step.length, gradient);
        self.add_inertia(places, step, gradient);
        self.add_gas(start, places, gradient)
    }

    fn add_inertia(&mut self, places: &[V3], step: Step, gradient: &mut [V3]) {
        let inverse = 1.0 / step.length;
        for (node, mass) in self.masses.iter().enumerate() {
            let velocity = (places[node] - self.places[node]) * inverse;
            let rate = (velocity - self.velocities[node]) * inverse + velocity * self.material.drag
                - step.gravity;
            gradient[node] += rate * *mass;
            let stiffness = mass * inverse * (inverse + self.material.drag);
            self.blocks.add_to_diagonal(node, stiffness);
        }
    }

    /// Adds the pressure of the gas within.
    fn add_gas(&self, start: usize, places: &[V3], gradient: &mut [V3]) -> Option<Joined> {
        let gas = self.gas?;
        let volume = volume_of(&self.surface, places);
        let along = volume_gradient(&self.surface, places);
        let pressure = gas.pressure(volume);
        for (sum, part) in gradient.iter_mut().zip(&along) {
            *sum -= part * pressure;
        }
        Some(Joined {
            start,
            gradient: along,
            stiffness: gas.stiffness(volume),
        })
    }

    /// The end of a step.
    pub(super) fn move_to(&mut self, ends: &[V3], step: f64) {
        for ((place, velocity), end) in self.places.iter_mut().zip(&mut self.velocities).zip(ends) {
            *velocity = (end - *place) / step;
            *place = *end;
        }
        self.tear_weakest();
    }

    /// Mass, and moment of inertia about an end.
    pub(super) fn scale(&self) -> [f64; 2] {
        let mass: f64 = self.masses.iter().sum();
        let from = self.places[0];
        let sizes = self
            .places
            .iter()
            .map(|place| (place - from).norm_squared());
        let size = sizes.fold(self.shortest * self.shortest, f64::max);
        [mass, mass * size]
    }
}
