//! All links at once: the forces that joints, motors, stops and force sensors exert when nothing touches the bodies.
//!
//! rapier's own solver visits one link after the other, and a chain under load wants hundreds of visits. The links of a scene form
//! a sparse system, mostly trees, that can be solved exactly in a time proportional to their number (D. Baraff, Linear-Time Dynamics
//! using Lagrange Multipliers, 1996). So before each sub-step the impulses are found here, for the velocities bodies would have
//! after gravity, scripts' forces and the contacts of the sub-step before, and given to the bodies as forces. rapier then finds its
//! joints satisfied, and its sweeps only answer what contacts change.
//!
//! A motor that cannot reach its velocity gives its full force, a stop only pushes: which of them act is found by trying.

mod axis;
mod block_cholesky;
mod mover;
mod node;
mod rotor;
mod settle;
mod taut;

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Vector3, Vector6};

use block_cholesky::{Matrix, Pattern, Segment};
use mover::Mover;
use node::Node;

use super::bodies::Bodies;
use super::contacts;
use super::links::Links;
use super::world::World;
use crate::scene::Handle;

/// How often the set of acting motors and stops may be corrected in a sub-step.
const ROUNDS: usize = 8;
/// Compliance of the rows as a fraction of their own response: makes systems with redundant rows, such as flat loops, solvable.
const COMPLIANCE: f64 = 1e-9;
/// Sweeps of rapier's solver over linked bodies that touch something, on top of the usual ones: what a contact changes has to find its
/// way along the chain.
const SHARED_SWEEPS: usize = 48;

/// The links of a scene and the order they are solved in.
#[derive(Default)]
pub(super) struct Articulation {
    movers: Vec<Mover>,
    /// Index of the mover of a shape.
    places: BTreeMap<Handle, usize>,
    nodes: Vec<Node>,
    meetings: Vec<Meeting>,
    pattern: Pattern,
    matrix: Matrix,
}

/// Two links, or one with itself, at a body that moves: each by index and side.
struct Meeting {
    row: (usize, usize),
    column: (usize, usize),
}

impl Articulation {
    /// Lays out the system for the links there are. `order`: base-to-tip.
    pub(super) fn follow(&mut self, links: &Links, order: &[Handle], bodies: &Bodies, world: &mut World) {
        self.moving().for_each(|mover| mover.leave_gyration_to_rapier(true, world));
        *self = Self::default();
        for handle in order.iter().rev() {
            let Some(link) = links.get(handle) else { continue };
            if let (Some(first), Some(second)) =
                (self.mover(link.plan.first, bodies), self.mover(link.plan.second, bodies))
            {
                self.nodes.push(Node::new(*handle, link.plan.kind, [first, second]));
            }
        }
        self.meetings = self.meetings();
        self.pattern =
            Pattern::new(self.nodes.len(), self.meetings.iter().map(|meeting| (meeting.row.0, meeting.column.0)));
        self.group();
        self.moving().for_each(|mover| mover.leave_gyration_to_rapier(false, world));
    }

    fn mover(&mut self, shape: Handle, bodies: &Bodies) -> Option<usize> {
        let body = bodies.get(shape)?;
        Some(*self.places.entry(shape).or_insert_with(|| {
            self.movers.push(Mover::new(shape, body));
            self.movers.len() - 1
        }))
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

    /// Gives bodies that are linked the same group.
    fn group(&mut self) {
        for (index, mover) in self.movers.iter_mut().enumerate() {
            mover.group = index;
        }
        loop {
            let mut changed = false;
            for node in &self.nodes {
                let [a, b] = node.ends.map(|end| &self.movers[end]);
                if !a.moves() || !b.moves() || a.group == b.group {
                    continue;
                }
                let group = a.group.min(b.group);
                for end in node.ends {
                    self.movers[end].group = group;
                }
                changed = true;
            }
            if !changed {
                return;
            }
        }
    }

    /// Lets rapier hold the links of bodies that touch something, and only those: where nothing touches there is nothing to add.
    fn share(&self, links: &mut Links, world: &mut World) {
        let near = contacts::shapes_near(world);
        let groups: BTreeSet<usize> =
            self.moving().filter(|mover| near.contains(&mover.shape)).map(|mover| mover.group).collect();
        for mover in self.moving() {
            if let Some(rigid) = world.bodies.get_mut(mover.rigid) {
                let sweeps = if groups.contains(&mover.group) { SHARED_SWEEPS } else { 0 };
                rigid.set_additional_pgs_iterations(sweeps);
            }
        }
        for node in &self.nodes {
            let ends = node.ends.iter().map(|&end| &self.movers[end]);
            let touches = ends.filter(|end| end.moves()).any(|end| groups.contains(&end.group));
            if let Some(link) = links.get_mut(&node.link) {
                link.share(touches, world);
            }
        }
    }

    fn moving(&self) -> impl Iterator<Item = &Mover> {
        self.movers.iter().filter(|mover| mover.moves())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Finds the impulses for a sub-step of `step` seconds and gives them to the bodies as forces, and to the links to be read.
    pub(super) fn act(&mut self, links: &mut Links, world: &mut World, gravity: [f64; 3], step: f64) {
        self.movers.iter_mut().for_each(|mover| mover.place(world));
        for node in &mut self.nodes {
            if let Some(link) = links.get(&node.link) {
                node.place(link, &self.movers);
                node.axis.iter_mut().for_each(|axis| axis.expect(link, step));
            }
        }
        self.steady(step);
        self.movers.iter_mut().for_each(|mover| mover.predict(world, gravity, step));
        self.foresee(world);
        if self.solve(links, step) {
            self.share(links, world);
            self.give(links, world, step);
        }
    }

    /// Adds what contacts are expected to do.
    fn foresee(&mut self, world: &World) {
        for push in contacts::expected(world, |shape| self.places.contains_key(&shape)) {
            for (shape, sign) in [(push.shapes[0], 1.0), (push.shapes[1], -1.0)] {
                if let Some(&place) = self.places.get(&shape) {
                    let mover = &mut self.movers[place];
                    let impulse = Vector3::from(push.impulse) * sign;
                    let lever = Vector3::from(push.point) - mover.com;
                    mover.push += spatial(impulse, lever.cross(&impulse));
                }
            }
        }
    }

    /// Solves with the set of motors and stops that turns out to act; false when there is no solution.
    fn solve(&mut self, links: &Links, step: f64) -> bool {
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
            if !changed || round + 1 == ROUNDS {
                break;
            }
        }
        self.nodes.iter().all(|node| node.impulse.iter().all(|impulse| impulse.is_finite()))
    }

    fn assemble(&mut self) {
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

    fn give(&self, links: &mut Links, world: &mut World, step: f64) {
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

fn spatial(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}
