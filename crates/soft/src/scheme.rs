//! How rods are integrated in time: in second order while nothing is near them, otherwise in first order.

use crate::V3;
use crate::assembly::Equations;
use crate::rod::{Node, Rod};

/// How a rod is integrated over a step: its places are `places` + `factor` times their velocities at the end of the step.
pub(crate) struct Scheme {
    pub factor: f64,
    pub places: Vec<Node>,
    velocities: Vec<Node>,
}

impl Scheme {
    pub(crate) fn new(rod: &Rod, step: f64) -> Self {
        let is_calm = rod.calm_steps > 0 && (!rod.looked_back || rod.last_step == step);
        let both = |weights: [f64; 2], now: &[Node], before: &[Node]| {
            let pairs = now.iter().zip(before);
            pairs
                .map(|(now, before)| now * weights[0] - before * weights[1])
                .collect()
        };
        let (now, before) = (&rod.now, &rod.before);
        match (rod.looked_back, is_calm) {
            (true, true) => Self {
                factor: step * 2.0 / 3.0,
                places: both([4.0 / 3.0, 1.0 / 3.0], &now.places, &before.places),
                velocities: both([4.0 / 3.0, 1.0 / 3.0], &now.velocities, &before.velocities),
            },
            // It begins as if the velocity had been the same before: what is kept of momentum from now on is what there is.
            (false, true) => Self {
                factor: step * 2.0 / 3.0,
                places: both([1.0, -step / 3.0], &now.places, &now.velocities),
                velocities: now.velocities.clone(),
            },
            // It ends with the velocity that goes with the momentum that was kept.
            (true, false) => Self {
                factor: step,
                places: now.places.clone(),
                velocities: both([1.5, 0.5], &now.velocities, &before.velocities),
            },
            (false, false) => Self {
                factor: step,
                places: now.places.clone(),
                velocities: now.velocities.clone(),
            },
        }
    }

    pub(crate) fn looks_back(&self, step: f64) -> bool {
        self.factor < step
    }

    /// The potential of inertia, weight and drag, for displacements from where the nodes were.
    pub(crate) fn potential(&self, rod: &Rod, trial: &[Node], gravity: &V3) -> f64 {
        let inverse = 1.0 / self.factor;
        let weight = gravity.push(0.0);
        let of_node = |node: usize| {
            let moved = trial[node] - self.places[node];
            let square = moved * (0.5 * inverse * (inverse + rod.material.drag));
            let linear = square - self.velocities[node] * inverse - weight;
            rod.masses[node].component_mul(&moved).dot(&linear)
        };
        (0..rod.len()).map(of_node).sum()
    }

    /// Adds inertia, weight and drag.
    pub(crate) fn add_inertia(
        &self,
        rod: &Rod,
        trial: &[Node],
        gravity: &V3,
        equations: &mut Equations,
    ) {
        let inverse = 1.0 / self.factor;
        let weight = gravity.push(0.0);
        for (node, mass) in rod.masses.iter().enumerate() {
            let velocity = (trial[node] - self.places[node]) * inverse;
            let rate = (velocity - self.velocities[node]) * inverse + velocity * rod.material.drag
                - weight;
            let stiffness = inverse * (inverse + rod.material.drag);
            for axis in 0..4 {
                let row = 4 * node + axis;
                equations.gradient[row] += mass[axis] * rate[axis];
                equations.matrix.add(row, row, mass[axis] * stiffness);
            }
        }
    }
}
