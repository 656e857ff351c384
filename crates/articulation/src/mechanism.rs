//! Links that hang together by bodies that move: one system, with a row of blocks for each link.
//!
//! A motor that cannot reach its velocity gives its full force, a stop only pushes: which of them act is found by trying.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Vector3, Vector6};

use super::block_cholesky::{Matrix, Pattern, Segment};
use super::mover::Mover;
use super::node::Node;
use super::spatial;
use crate::dynamics::bodies::Bodies;
use crate::dynamics::links::Links;
use crate::dynamics::plan::LinkPlan;
use crate::dynamics::world::World;
use crate::scene::Handle;
use crate::scene::joint::JointSolver;

/// How often the set of acting motors and stops may be corrected in a sub-step.
const ROUNDS: usize = 8;
/// Compliance of the rows as a fraction of their own response: makes systems with redundant rows, such as flat loops, solvable.
const COMPLIANCE: f64 = 1e-9;
/// Sweeps of rapier's solver over linked bodies that touch something, on top of the usual ones: what a contact changes has to find its
/// way along the chain.
const SHARED_SWEEPS: usize = 48;

/// Links that hang together, and their bodies.
#[derive(Default)]
pub(super) struct Chain {
    pub movers: Vec<Mover>,
    /// Index of the mover of a shape.
    places: BTreeMap<Handle, usize>,
    pub nodes: Vec<Node>,
    meetings: Vec<Meeting>,
    pub pattern: Pattern,
    pub matrix: Matrix,
    /// Whether a joint asks for rapier's joints, and whether there is a screw, which rapier does not know.
    asks_rapier: bool,
    has_screw: bool,
}

/// Two links, or one with itself, at a body that moves: each by index and side.
struct Meeting {
    row: (usize, usize),
    column: (usize, usize),
}

impl Chain {
    /// Adds a link; those added first are eliminated first.
    pub(super) fn add(&mut self, link: Handle, plan: &LinkPlan, bodies: &Bodies) {
        self.asks_rapier |= plan.solver == JointSolver::Impulse;
        self.has_screw |= plan.pitch != 0.0;
        if let (Some(first), Some(second)) = (self.mover(plan.first, bodies), self.mover(plan.second, bodies)) {
            self.nodes.push(Node::new(link, plan.kind, [first, second]));
        }
    }

    /// Whether the links are left to rapier alone.
    pub(super) fn is_rapiers(&self) -> bool {
        self.asks_rapier && !self.has_screw
    }

    fn mover(&mut self, shape: Handle, bodies: &Bodies) -> Option<usize> {
        let body = bodies.get(shape)?;
        Some(*self.places.entry(shape).or_insert_with(|| {
            self.movers.push(Mover::new(shape, body));
            self.movers.len() - 1
        }))
    }

    /// Lays out the system for the links that were added.
    pub(super) fn lay_out(&mut self) {
        self.meetings = self.meetings();
        let pairs = self.meetings.iter().map(|meeting| (meeting.row.0, meeting.column.0));
        self.pattern = Pattern::new(self.nodes.len(), pairs);
    }

    fn meetings(&self) -> Vec<Meeting> {
        let mut ends: Vec<Vec<(usize, usize)>> = vec![Vec::new(); self.movers.len()];
        for (index, node) in self.nodes.iter().enumerate() {
            for side in (0..2).filter(|&side| self.movers[node.ends[side]].moves()) {
                ends[node.ends[side]].push((index, side));
            }
        }
        let mut meetings = Vec::new();
        for ends in ends {
            for (i, &row) in ends.iter().enumerate() {
                meetings.extend(ends[..=i].iter().map(|&column| Meeting { row, column }));
            }
        }
        meetings
    }

    pub(super) fn leave_gyration_to_rapier(&self, on: bool, world: &mut World) {
        self.moving().for_each(|mover| mover.leave_gyration_to_rapier(on, world));
    }

    fn moving(&self) -> impl Iterator<Item = &Mover> {
        self.movers.iter().filter(|mover| mover.moves())
    }

    /// A tree has as many links as bodies at most.
    pub(super) fn has_loops(&self) -> bool {
        self.nodes.len() > self.moving().count()
    }

    pub(super) fn moving_shapes(&self) -> impl Iterator<Item = Handle> {
        self.moving().map(|mover| mover.shape)
    }

    /// Whether one of these shapes is a body of the chain.
    pub(super) fn touches(&self, near: &BTreeSet<Handle>) -> bool {
        self.moving().any(|mover| near.contains(&mover.shape))
    }

    /// Lets rapier hold the links as well, or not: where nothing touches the chain there is nothing to add.
    pub(super) fn share(&self, with_engine: bool, links: &mut Links, world: &mut World) {
        let sweeps = if with_engine { SHARED_SWEEPS } else { 0 };
        for mover in self.moving() {
            if let Some(rigid) = world.bodies.get_mut(mover.rigid) {
                rigid.set_additional_pgs_iterations(sweeps);
            }
        }
        for node in &self.nodes {
            if let Some(link) = links.get_mut(&node.link) {
                link.share(with_engine, world);
            }
        }
    }

    /// Reads where bodies and links are, and what will push the bodies.
    pub(super) fn begin(&mut self, links: &Links, world: &World, gravity: [f64; 3], step: f64) {
        self.movers.iter_mut().for_each(|mover| mover.place(world));
        for node in &mut self.nodes {
            if let Some(link) = links.get(&node.link) {
                node.place(link, &self.movers);
                node.axis.iter_mut().for_each(|axis| axis.expect(link, step));
            }
        }
        self.steady(step);
        self.movers.iter_mut().for_each(|mover| mover.predict(world, gravity, step));
    }

    /// Adds an impulse on a body to what will push it.
    pub(super) fn push(&mut self, shape: Handle, impulse: Vector3<f64>, point: Vector3<f64>) {
        if let Some(&place) = self.places.get(&shape) {
            let mover = &mut self.movers[place];
            let lever = point - mover.com;
            mover.push += spatial(impulse, lever.cross(&impulse));
        }
    }

    /// Solves with the set of motors and stops that turns out to act; false when there is no solution.
    pub(super) fn solve(&mut self, links: &Links, step: f64) -> bool {
        for round in 0..ROUNDS {
            self.assemble();
            if !self.matrix.factorize(&self.pattern) {
                return false;
            }
            self.find_impulses();
            let mut changed = round + 1 < ROUNDS && self.steady_more(step);
            for node in &mut self.nodes {
                if let Some(link) = links.get(&node.link) {
                    changed |= node.correct(link, &self.movers, step);
                }
            }
            if !changed {
                break;
            }
        }
        self.nodes.iter().all(|node| node.impulse.iter().all(|impulse| impulse.is_finite()))
    }

    pub(super) fn assemble(&mut self) {
        self.matrix.clear(&self.pattern);
        self.nodes.iter_mut().for_each(|node| node.weigh(&self.movers));
        for Meeting { row, column } in &self.meetings {
            let block = self.nodes[row.0].weighted[row.1] * self.nodes[column.0].acting[column.1].transpose();
            self.matrix.add(&self.pattern, row.0, column.0, &block);
        }
        for diagonal in &mut self.matrix.diagonal {
            for row in 0..6 {
                let response = diagonal[(row, row)];
                diagonal[(row, row)] = if response > 0.0 { response * (1.0 + COMPLIANCE) } else { 1.0 };
            }
        }
    }

    /// Solves for the impulses and moves the bodies by them.
    fn find_impulses(&mut self) {
        for mover in &mut self.movers {
            mover.velocity = mover.free + mover.response * mover.push;
        }
        for node in &self.nodes {
            node.push(&mut self.movers, &node.spent());
        }
        let mut impulses: Vec<Segment> = self.nodes.iter().map(|node| node.lacking(&self.movers)).collect();
        self.matrix.solve(&self.pattern, &mut impulses);
        for (node, impulse) in self.nodes.iter_mut().zip(impulses) {
            node.impulse = impulse;
            node.push(&mut self.movers, &impulse);
        }
    }

    /// Gives the bodies what was found as forces, and the links to be read.
    pub(super) fn give(&self, links: &mut Links, world: &mut World, step: f64) {
        let mut impulses = vec![Vector6::zeros(); self.movers.len()];
        for node in &self.nodes {
            let total = node.impulse + node.spent();
            for side in 0..2 {
                impulses[node.ends[side]] += node.jacobians[side].transpose() * total;
            }
            if let Some(link) = links.get_mut(&node.link) {
                link.take_exact(&(total / step), node.motor_impulse() / step, world);
            }
        }
        for (mover, impulse) in self.movers.iter().zip(impulses).filter(|(mover, _)| mover.moves()) {
            mover.give(&impulse, world, step);
        }
    }
}
