//! The linear equations of an iteration, and their solution by conjugate gradients.
//!
//! Nodes and rigid bodies are unknowns side by side. A node that is held goes with what holds it: it is no unknown of its own.

use nalgebra::{Cholesky, Const, Matrix3, Matrix3x6, Matrix6, Vector6};

use super::blocks::Blocks;
use super::coupled_rod::RodMatrix;
use super::sparse::Sparse;
use crate::V3;
use crate::assembly::lever_map;
use crate::banded::Banded;

/// Part of the residual that is left.
const TOLERANCE: f64 = 1e-2;
/// Most iterations of a solution.
const MAX_ITERATIONS: usize = 400;

/// A value for each unknown: three for each node, one for each angle of rods, six for each body.
#[derive(Debug, Clone)]
pub(super) struct Vector {
    pub nodes: Vec<V3>,
    pub angles: Vec<f64>,
    pub bodies: Vec<Vector6<f64>>,
}

impl Vector {
    pub(super) fn zeros(nodes: usize, angles: usize, bodies: usize) -> Self {
        Self {
            nodes: vec![V3::zeros(); nodes],
            angles: vec![0.0; angles],
            bodies: vec![Vector6::zeros(); bodies],
        }
    }

    fn zeros_like(&self) -> Self {
        Self::zeros(self.nodes.len(), self.angles.len(), self.bodies.len())
    }

    fn dot(&self, other: &Self) -> f64 {
        let nodes = self.nodes.iter().zip(&other.nodes);
        let angles = self.angles.iter().zip(&other.angles);
        let bodies = self.bodies.iter().zip(&other.bodies);
        nodes.map(|(a, b)| a.dot(b)).sum::<f64>()
            + angles.map(|(a, b)| a * b).sum::<f64>()
            + bodies.map(|(a, b)| a.dot(b)).sum::<f64>()
    }

    /// This times one factor and another vector times another factor.
    fn combine(&mut self, own: f64, other: &Self, factor: f64) {
        for (a, b) in self.nodes.iter_mut().zip(&other.nodes) {
            *a = *a * own + *b * factor;
        }
        for (a, b) in self.angles.iter_mut().zip(&other.angles) {
            *a = *a * own + *b * factor;
        }
        for (a, b) in self.bodies.iter_mut().zip(&other.bodies) {
            *a = *a * own + *b * factor;
        }
    }

    /// The vector that points the other way.
    pub(super) fn negated(&self) -> Self {
        let mut negated = self.zeros_like();
        negated.combine(1.0, self, -1.0);
        negated
    }
}

/// A spring between points of nodes, with their weights, and a body or something that no force moves.
pub(super) struct Coupling {
    pub nodes: [(usize, f64); 6],
    pub body: Option<(usize, Matrix3x6<f64>)>,
    pub stiffness: Matrix3<f64>,
}

/// A node that is held: by a body, with the lever from its centre of mass, or by something that no force moves.
#[derive(Clone, Copy)]
pub(super) struct Held {
    pub node: usize,
    pub body: Option<(usize, V3)>,
}

/// Something that resists one combination of the displacements of many nodes.
pub(super) struct Joined {
    /// The first of those nodes.
    pub start: usize,
    pub gradient: Vec<V3>,
    pub stiffness: f64,
}

/// The matrix.
pub(super) struct System<'a> {
    /// For each part where its nodes begin, and its matrices: of blocks, and of numbers for all directions.
    pub parts: Vec<(usize, &'a Blocks, &'a Sparse)>,
    /// Their nodes come after those of all parts.
    pub rods: Vec<RodMatrix<'a>>,
    pub couplings: Vec<Coupling>,
    pub joined: Vec<Joined>,
    pub bodies: Vec<Matrix6<f64>>,
    pub held: &'a [Held],
}

/// Inverses of the blocks on the diagonal, as factors.
struct Preconditioner {
    nodes: Vec<Matrix3<f64>>,
    /// The whole matrices of rods, as factors.
    rods: Vec<Banded>,
    bodies: Vec<Cholesky<f64, Const<6>>>,
}

impl System<'_> {
    /// Solves for a right side; None if the matrix is not positive definite or not of finite numbers.
    pub(super) fn solve(&self, mut residual: Vector) -> Option<Vector> {
        self.contract(&mut residual);
        let preconditioner = self.preconditioner()?;
        let mut solution = residual.zeros_like();
        let mut product = residual.zeros_like();
        let mut scaled = self.scaled(&preconditioner, &residual);
        let mut direction = scaled.clone();
        let mut size = residual.dot(&scaled);
        let enough = size * TOLERANCE * TOLERANCE;
        for _ in 0..MAX_ITERATIONS {
            if size <= enough {
                break;
            }
            self.multiply(&mut direction, &mut product);
            let resistance = direction.dot(&product);
            if resistance.is_nan() || resistance <= 0.0 {
                return None;
            }
            let part = size / resistance;
            solution.combine(1.0, &direction, part);
            residual.combine(1.0, &product, -part);
            scaled = self.scaled(&preconditioner, &residual);
            let before = std::mem::replace(&mut size, residual.dot(&scaled));
            direction.combine(size / before, &scaled, 1.0);
        }
        size.is_finite().then_some(solution)
    }

    /// What is held gets the displacement of what holds it.
    fn expand(&self, vector: &mut Vector) {
        for held in self.held {
            let moved = held
                .body
                .map(|(body, lever)| lever_map(&lever) * vector.bodies[body]);
            vector.nodes[held.node] = moved.unwrap_or_default();
        }
    }

    /// What holds gets the forces on what is held.
    fn contract(&self, vector: &mut Vector) {
        for held in self.held {
            let force = std::mem::take(&mut vector.nodes[held.node]);
            if let Some((body, lever)) = held.body {
                vector.bodies[body] += lever_map(&lever).transpose() * force;
            }
        }
    }

    fn multiply(&self, vector: &mut Vector, product: &mut Vector) {
        self.expand(vector);
        for (start, blocks, bending) in &self.parts {
            let nodes = *start..*start + blocks.len();
            let (own, sums) = (&vector.nodes[nodes.clone()], &mut product.nodes[nodes]);
            blocks.multiply(own, sums);
            for (row, sum) in sums.iter_mut().enumerate().take(bending.len()) {
                *sum += bending.row_times(row, own);
            }
        }
        for (body, matrix) in self.bodies.iter().enumerate() {
            product.bodies[body] = matrix * vector.bodies[body];
        }
        for rod in &self.rods {
            rod.multiply(vector, product);
        }
        for coupling in &self.couplings {
            coupling.multiply(vector, product);
        }
        for joined in &self.joined {
            joined.multiply(&vector.nodes, &mut product.nodes);
        }
        self.contract(product);
    }

    fn preconditioner(&self) -> Option<Preconditioner> {
        let mut nodes = Vec::new();
        for (_, blocks, bending) in &self.parts {
            let bending = (0..bending.len()).map(|node| bending.diagonal(node));
            let bending = bending
                .chain(std::iter::repeat(0.0))
                .map(Matrix3::from_diagonal_element);
            nodes.extend(
                (0..blocks.len())
                    .zip(bending)
                    .map(|(node, own)| blocks.diagonal(node) + own),
            );
        }
        nodes.extend(self.rods.iter().flat_map(RodMatrix::diagonals));
        let mut bodies = self.bodies.clone();
        for rod in &self.rods {
            rod.add_to_bodies(&mut bodies);
        }
        for coupling in &self.couplings {
            for (node, weight) in coupling.nodes {
                nodes[node] += coupling.stiffness * (weight * weight);
            }
            if let Some((body, map)) = &coupling.body {
                bodies[*body] += map.transpose() * coupling.stiffness * map;
            }
        }
        for held in self.held {
            if let Some((body, lever)) = held.body {
                let map = lever_map(&lever);
                bodies[body] += map.transpose() * nodes[held.node] * map;
            }
        }
        let inverse = |block: Matrix3<f64>| block.cholesky().map(|factors| factors.inverse());
        let rods = self.rods.iter();
        Some(Preconditioner {
            rods: rods
                .map(|rod| rod.factors(&self.couplings, self.held))
                .collect::<Option<_>>()?,
            nodes: nodes.into_iter().map(inverse).collect::<Option<_>>()?,
            bodies: bodies
                .into_iter()
                .map(Cholesky::new)
                .collect::<Option<_>>()?,
        })
    }

    fn scaled(&self, preconditioner: &Preconditioner, vector: &Vector) -> Vector {
        let nodes = preconditioner.nodes.iter().zip(&vector.nodes);
        let bodies = preconditioner.bodies.iter().zip(&vector.bodies);
        let mut scaled = Vector {
            nodes: nodes.map(|(inverse, part)| inverse * part).collect(),
            angles: vec![0.0; vector.angles.len()],
            bodies: bodies.map(|(factors, part)| factors.solve(part)).collect(),
        };
        for (rod, factors) in self.rods.iter().zip(&preconditioner.rods) {
            rod.solve(factors, vector, &mut scaled);
        }
        scaled
    }
}

impl Coupling {
    fn multiply(&self, vector: &Vector, product: &mut Vector) {
        let mut apart = V3::zeros();
        for (node, weight) in self.nodes {
            apart += vector.nodes[node] * weight;
        }
        if let Some((body, map)) = &self.body {
            apart -= map * vector.bodies[*body];
        }
        let force = self.stiffness * apart;
        for (node, weight) in self.nodes {
            product.nodes[node] += force * weight;
        }
        if let Some((body, map)) = &self.body {
            product.bodies[*body] -= map.transpose() * force;
        }
    }
}

impl Joined {
    fn multiply(&self, vector: &[V3], product: &mut [V3]) {
        let own = self.start..self.start + self.gradient.len();
        let pairs = self.gradient.iter().zip(&vector[own.clone()]);
        let along: f64 = pairs.map(|(a, b)| a.dot(b)).sum();
        for (out, gradient) in product[own].iter_mut().zip(&self.gradient) {
            *out += gradient * (along * self.stiffness);
        }
    }
}
