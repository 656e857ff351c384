//! Rods that touch cloths or volumes, as parts of the equations of these.
//!
//! Their nodes are unknowns like those of a mesh; the angles of their edges are unknowns of their own. Their matrix is banded: its factors precondition conjugate
//! gradients exactly but for what couples a rod with something else. They are integrated by the implicit Euler method, as everything that is touched.

use nalgebra::{Matrix3, Vector6};

use super::system::{Coupling, Held, Vector};
use crate::V3;
use crate::assembly::Equations;
use crate::banded::Banded;
use crate::bound::{Bodies, TwistHold};
use crate::elastic::{Elastic, Shape, elastic_potential, strains};
use crate::rod::{Node, Rod};
use crate::scheme::Scheme;
use crate::{Step, newton};

/// How many times stiffer than its surroundings a held node is for the preconditioner.
const HELD_STIFFNESS: f64 = 1e6;

/// A rod in a step.
pub(super) struct CoupledRod {
    /// Where its nodes begin among all nodes.
    pub start: usize,
    /// Where its angles begin among all angles.
    first_angle: usize,
    scheme: Scheme,
    equations: Equations,
    turnings: Vec<Turning>,
}

/// A body that an edge turns with about its axis.
struct Turning {
    /// The angle of the edge, among all.
    angle: usize,
    body: usize,
    /// How the angle goes with the displacement of the body.
    about: Vector6<f64>,
    /// N m
    stiffness: f64,
}

/// The matrix of a rod.
#[derive(Clone, Copy)]
pub(super) struct RodMatrix<'a> {
    start: usize,
    first_angle: usize,
    matrix: &'a Banded,
    turnings: &'a [Turning],
}

impl CoupledRod {
    pub(super) fn new(rod: &mut Rod, start: usize, first_angle: usize, step: f64) -> Self {
        // What touches something does not look back.
        rod.calm_steps = 0;
        Self {
            start,
            first_angle,
            scheme: Scheme::new(rod, step),
            equations: Equations::default(),
            turnings: Vec::new(),
        }
    }

    /// The unknowns of its nodes.
    pub(super) fn trial(&self, rod: &Rod, places: &[V3], angles: &[f64]) -> Vec<Node> {
        let places = &places[self.start..self.start + rod.len()];
        let angles = &angles[self.first_angle..];
        let pairs = places.iter().zip(angles);
        pairs.map(|(place, angle)| place.push(*angle)).collect()
    }

    pub(super) fn potential(&self, rod: &Rod, trial: &[Node], step: Step, bodies: &Bodies) -> f64 {
        let shape = strains(trial, &rod.shape, &rod.directions);
        let holds = twist_holds(rod, &shape, bodies);
        let held: f64 = holds.iter().map(TwistHold::potential).sum();
        self.scheme.potential(rod, trial, &step.gravity)
            + elastic_potential(rod, &shape, rod.material.damping / step.length)
            + held
    }

    /// Writes the stiffness, and adds the gradient of the potential.
    pub(super) fn linearize(
        &mut self,
        rod: &Rod,
        trial: &[Node],
        step: Step,
        bodies: &Bodies,
        gradient: &mut Vector,
    ) {
        let shape = strains(trial, &rod.shape, &rod.directions);
        self.equations.clear(rod.len());
        self.scheme
            .add_inertia(rod, trial, &step.gravity, &mut self.equations);
        let elastic = Elastic {
            shape: &shape,
            viscous: rod.material.damping / step.length,
            is_guess: false,
            inverse_square: 1.0 / (step.length * step.length),
        };
        elastic.add_forces(rod, &mut self.equations);
        self.turnings.clear();
        for hold in twist_holds(rod, &shape, bodies) {
            self.add_twist_hold(&hold, gradient);
        }
        let rows = self.equations.gradient.chunks(4).enumerate();
        for (node, part) in rows {
            gradient.nodes[self.start + node] += V3::new(part[0], part[1], part[2]);
            gradient.angles[self.first_angle + node] += part[3];
        }
    }

    fn add_twist_hold(&mut self, hold: &TwistHold, gradient: &mut Vector) {
        let torque = hold.stiffness * hold.excess;
        self.equations
            .add_spring(4 * hold.edge + 3, &[1.0], torque, hold.stiffness);
        if let Some(body) = hold.body {
            let about = hold.about();
            gradient.bodies[body] -= about * torque;
            self.turnings.push(Turning {
                angle: self.first_angle + hold.edge,
                body,
                about,
                stiffness: hold.stiffness,
            });
        }
    }

    pub(super) fn matrix(&self) -> RodMatrix<'_> {
        RodMatrix {
            start: self.start,
            first_angle: self.first_angle,
            matrix: &self.equations.matrix,
            turnings: &self.turnings,
        }
    }

    /// The end of a step; `gradient`: what holds have to balance.
    pub(super) fn finish(
        self,
        rod: &mut Rod,
        trial: Vec<Node>,
        step: f64,
        bodies: &Bodies,
        gradient: &Vector,
    ) {
        let shape = strains(&trial, &rod.shape, &rod.directions);
        let mut holds = std::mem::take(&mut rod.holds);
        for hold in &mut holds {
            hold.force = gradient.nodes[self.start + hold.node];
            let twist = TwistHold::new(hold, rod, &shape, bodies);
            hold.torque = twist.map_or(V3::zeros(), |twist| twist.torque());
        }
        rod.holds = holds;
        newton::move_on(rod, &self.scheme, trial, step);
    }
}

fn twist_holds(rod: &Rod, shape: &Shape, bodies: &Bodies) -> Vec<TwistHold> {
    let holds = rod.holds.iter();
    holds
        .filter_map(|hold| TwistHold::new(hold, rod, shape, bodies))
        .collect()
}

impl RodMatrix<'_> {
    fn len(&self) -> usize {
        self.matrix.len() / 4
    }

    /// The number of a node among its own; None if it is another's.
    fn own(&self, node: usize) -> Option<usize> {
        let own = node.checked_sub(self.start)?;
        (own < self.len()).then_some(own)
    }

    fn gather(&self, vector: &Vector) -> Vec<f64> {
        let nodes = &vector.nodes[self.start..self.start + self.len()];
        let angles = &vector.angles[self.first_angle..];
        let pairs = nodes.iter().zip(angles);
        pairs
            .flat_map(|(node, angle)| [node.x, node.y, node.z, *angle])
            .collect()
    }

    fn write(&self, values: &[f64], vector: &mut Vector) {
        for (node, part) in values.chunks(4).enumerate() {
            vector.nodes[self.start + node] = V3::new(part[0], part[1], part[2]);
            vector.angles[self.first_angle + node] = part[3];
        }
    }

    /// Writes its part of the product with a vector, and adds what couples it with bodies.
    pub(super) fn multiply(&self, vector: &Vector, product: &mut Vector) {
        let mut values = vec![0.0; 4 * self.len()];
        self.matrix.multiply(&self.gather(vector), &mut values);
        self.write(&values, product);
        for turning in self.turnings {
            let with_body = turning.stiffness * turning.about.dot(&vector.bodies[turning.body]);
            product.angles[turning.angle] -= with_body;
            let torque = with_body - turning.stiffness * vector.angles[turning.angle];
            product.bodies[turning.body] += turning.about * torque;
        }
    }

    /// Adds its bodies' part to the blocks on the diagonal.
    pub(super) fn add_to_bodies(&self, bodies: &mut [nalgebra::Matrix6<f64>]) {
        for turning in self.turnings {
            bodies[turning.body] += turning.about * turning.about.transpose() * turning.stiffness;
        }
    }

    /// The block of a node on the diagonal.
    pub(super) fn diagonals(&self) -> impl Iterator<Item = Matrix3<f64>> + '_ {
        let block = |node: usize| {
            Matrix3::from_fn(|row, column| self.matrix.get(4 * node + row, 4 * node + column))
        };
        (0..self.len()).map(block)
    }

    /// Factors of its matrix with what couplings add to its nodes, and with nodes that are held so stiffly that they stay; None if it is not positive definite.
    pub(super) fn factors(&self, couplings: &[Coupling], held: &[Held]) -> Option<Banded> {
        let mut factors = self.matrix.clone();
        for coupling in couplings {
            for (node, weight) in coupling.nodes {
                if let Some(own) = self.own(node).filter(|_| weight != 0.0) {
                    factors.add_block(4 * own, &(coupling.stiffness * (weight * weight)));
                }
            }
        }
        for own in held.iter().filter_map(|held| self.own(held.node)) {
            let largest = (0..3).map(|axis| factors.get(4 * own + axis, 4 * own + axis));
            let fixed = HELD_STIFFNESS * largest.fold(0.0, f64::max);
            factors.add_block(4 * own, &Matrix3::from_diagonal_element(fixed));
        }
        factors.factorize().then_some(factors)
    }

    /// Writes its part of the solution with its factors.
    pub(super) fn solve(&self, factors: &Banded, right: &Vector, solution: &mut Vector) {
        let mut values = self.gather(right);
        factors.solve(&mut values);
        self.write(&values, solution);
    }
}
