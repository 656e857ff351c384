//! Mechanisms with loops: a system with a row of blocks for each joint.
//!
//! With the Jacobian `J` of the active rows of all joints and the masses `M` it is `(J M^-1 J^T + C) lambda = b - J v`. Its factor `L` also tells
//! how bodies answer impulses while all joints hold: `M^-1 - (L^-1 J M^-1)^T (L^-1 J M^-1)`.

use std::ops::Range;

use nalgebra::{Matrix6, Vector6};

use crate::block_cholesky::{Block, Matrix, Pattern, Place, Segment};
use crate::jacobian::{InverseMass, Jacobian};
use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::system::System;
use crate::tree::Tree;

/// Compliance of the rows as a fraction of their own response: makes systems with redundant rows, such as flat loops, solvable.
const COMPLIANCE: f64 = 1e-9;

/// The system of all joints.
pub(crate) struct Rows {
    couplings: Vec<Coupling>,
    pattern: Pattern,
    matrix: Matrix,
    joints: Vec<JointRows>,
    /// Responses of the bodies to impulses.
    inverse_masses: Vec<InverseMass>,
    /// A segment for each joint, reused by each solution.
    impulses: Vec<Segment>,
    /// For each touching body: its response to the joints next to it, carried along the factor. By column.
    carried: Vec<Vec<Option<Block>>>,
}

/// The rows of a joint.
struct JointRows {
    /// The Jacobians of the active rows; other rows are zero.
    active: [Jacobian; 2],
    /// The same times the inverse masses of the bodies: the halves of the inverse effective mass.
    active_inverse_mass: [Jacobian; 2],
}

/// Two joints, or one with itself, at a body that moves: each by index and side, the column no greater than the row.
struct Coupling {
    row: (usize, usize),
    column: (usize, usize),
    /// Of the block of the system that they share.
    place: Place,
}

impl Rows {
    /// Lays out the system. Joints are eliminated in their order: with those at the tips of a tree first, there is no fill-in.
    pub(crate) fn new(bodies: &[LinkedBody], joints: &[Joint]) -> Self {
        let pairs = coupled_pairs(bodies, joints);
        let pattern = Pattern::new(
            joints.len(),
            pairs.iter().map(|(row, column)| (row.0, column.0)),
        );
        let place = |row: (usize, usize), column: (usize, usize)| pattern.place(row.0, column.0);
        let couplings = pairs.into_iter().map(|(row, column)| Coupling {
            row,
            column,
            place: place(row, column),
        });
        Self {
            couplings: couplings.collect(),
            pattern,
            matrix: Matrix::default(),
            joints: Vec::new(),
            inverse_masses: Vec::new(),
            impulses: Vec::new(),
            carried: Vec::new(),
        }
    }

    /// Forms the inverse effective mass of the active rows.
    fn assemble(&mut self, joints: &[Joint]) {
        self.matrix.clear(&self.pattern);
        for Coupling { row, column, place } in &self.couplings {
            let (own, other) = (&self.joints[row.0], &self.joints[column.0]);
            match *place {
                Place::Diagonal(index) => {
                    let mass = &self.inverse_masses[joints[row.0].body(row.1)];
                    let (rows, scaled) = (&own.active[row.1], &own.active_inverse_mass[row.1]);
                    let active = joints[row.0].active_rows();
                    rows.add_own_product(scaled, mass, &active, &mut self.matrix.diagonal[index]);
                }
                Place::Below(index) => {
                    let below = &mut self.matrix.below[index];
                    own.active_inverse_mass[row.1].add_product(&other.active[column.1], below);
                }
            }
        }
        for (diagonal, joint) in self.matrix.diagonal.iter_mut().zip(joints) {
            if let Some((row, inertia)) = joint.soft_row() {
                diagonal[(row, row)] += 1.0 / inertia;
            }
            for row in 0..6 {
                let response = diagonal[(row, row)];
                diagonal[(row, row)] = if response > 0.0 {
                    response * (1.0 + COMPLIANCE)
                } else {
                    1.0
                };
            }
        }
    }

    /// Changes the velocities of the bodies by an impulse along the rows of a joint.
    fn apply_impulse(&self, joint: &Joint, bodies: &mut [LinkedBody], impulse: &Segment) {
        for side in 0..2 {
            let body = joint.body(side);
            let impulse = joint.jacobian(side).impulse(impulse);
            bodies[body].joint_impulse += impulse;
            bodies[body].velocity += self.inverse_masses[body].times(&impulse);
        }
    }
}

impl System for Rows {
    fn set_guests(&mut self, _: Range<usize>) {}

    fn factorize(&mut self, joints: &[Joint], bodies: &[LinkedBody]) -> bool {
        self.inverse_masses.clear();
        self.inverse_masses
            .extend(bodies.iter().map(LinkedBody::inverse_mass));
        self.joints.clear();
        self.joints.extend(
            joints
                .iter()
                .map(|joint| JointRows::new(joint, &self.inverse_masses)),
        );
        self.assemble(joints);
        self.matrix.factorize(&self.pattern)
    }

    fn is_factor(&self) -> bool {
        self.matrix.is_factor()
    }

    fn as_tree(&mut self) -> Option<&mut Tree> {
        None
    }

    fn find_impulses(&mut self, joints: &mut [Joint], bodies: &mut [LinkedBody]) {
        for (body, mass) in bodies.iter_mut().zip(&self.inverse_masses) {
            body.joint_impulse = Vector6::zeros();
            body.velocity = body.free_velocity() + mass.times(&body.known_impulse());
        }
        for joint in joints.iter().filter(|joint| joint.known_impulse() != 0.0) {
            self.apply_impulse(joint, bodies, &joint.known_rows());
        }
        let mut impulses = std::mem::take(&mut self.impulses);
        impulses.clear();
        impulses.extend(joints.iter().map(|joint| joint.missing_velocity(bodies)));
        self.matrix.solve(&self.pattern, &mut impulses);
        for (joint, impulse) in joints.iter_mut().zip(&impulses) {
            joint.impulse = *impulse;
            self.apply_impulse(joint, bodies, impulse);
        }
        self.impulses = impulses;
    }

    fn displace(&mut self, joints: &[Joint], bodies: &mut [LinkedBody], errors: &mut [Segment]) {
        self.matrix.solve(&self.pattern, errors);
        let mut impulses = vec![Vector6::zeros(); bodies.len()];
        for ((joint, rows), multiplier) in joints.iter().zip(&self.joints).zip(errors) {
            for side in 0..2 {
                impulses[joint.body(side)] -= rows.active[side].impulse(multiplier);
            }
        }
        for ((body, mass), impulse) in bodies.iter_mut().zip(&self.inverse_masses).zip(impulses) {
            if body.is_dynamic() {
                body.displace(&mass.times(&impulse));
            }
        }
    }

    fn find_corrections(&mut self, joints: &mut [Joint], bodies: &[LinkedBody]) {
        let mut impulses = std::mem::take(&mut self.impulses);
        impulses.clear();
        impulses.extend(joints.iter().map(|joint| joint.corrected(bodies)));
        self.matrix.solve(&self.pattern, &mut impulses);
        for (joint, impulse) in joints.iter_mut().zip(&impulses) {
            joint.correction = *impulse;
        }
        self.impulses = impulses;
    }

    fn responses(&mut self, joints: &[Joint], touching: &[usize]) -> Vec<Matrix6<f64>> {
        self.carried.resize_with(touching.len(), Vec::new);
        for (&body, blocks) in touching.iter().zip(&mut self.carried) {
            blocks.clear();
            blocks.resize(joints.len(), None);
            for ((joint, rows), block) in joints.iter().zip(&self.joints).zip(blocks.iter_mut()) {
                for side in (0..2).filter(|&side| joint.body(side) == body) {
                    *block.get_or_insert_with(Block::zeros) +=
                        rows.active_inverse_mass[side].dense();
                }
            }
            self.matrix.carry(&self.pattern, blocks);
        }
        let of = |i: usize, j: usize| {
            let own = if i == j {
                self.inverse_masses[touching[i]].dense()
            } else {
                Matrix6::zeros()
            };
            let pairs = self.carried[i].iter().zip(&self.carried[j]);
            let shared = pairs.filter_map(|(a, b)| Some(a.as_ref()?.tr_mul(b.as_ref()?)));
            shared.fold(own, |sum, product| sum - product)
        };
        (0..touching.len())
            .flat_map(|i| (0..touching.len()).map(move |j| of(i, j)))
            .collect()
    }
}

impl JointRows {
    fn new(joint: &Joint, inverse_masses: &[InverseMass]) -> Self {
        let rows = joint.active_rows();
        let active = [0, 1].map(|side| joint.jacobian(side).with_rows(&rows));
        let active_inverse_mass =
            [0, 1].map(|side| active[side].times(&inverse_masses[joint.body(side)]));
        Self {
            active,
            active_inverse_mass,
        }
    }
}

/// The pairs of joints that share a body that moves: index and side of the later one, then of the other.
fn coupled_pairs(bodies: &[LinkedBody], joints: &[Joint]) -> Vec<((usize, usize), (usize, usize))> {
    let mut at_body: Vec<Vec<(usize, usize)>> = vec![Vec::new(); bodies.len()];
    for (index, joint) in joints.iter().enumerate() {
        for side in (0..2).filter(|&side| bodies[joint.body(side)].is_dynamic()) {
            at_body[joint.body(side)].push((index, side));
        }
    }
    let mut pairs = Vec::new();
    for ends in at_body {
        for (i, &row) in ends.iter().enumerate() {
            pairs.extend(ends[..=i].iter().map(|&column| (row, column)));
        }
    }
    pairs
}
