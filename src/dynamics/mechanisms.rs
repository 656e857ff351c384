//! All links at once: the forces that joints, motors, stops and force sensors exert when nothing touches the bodies.
//!
//! rapier's own solver visits one link after the other, and a chain under load wants hundreds of visits. The links of a scene form
//! sparse systems, mostly trees, that can be solved exactly in a time proportional to their number (D. Baraff, Linear-Time Dynamics
//! using Lagrange Multipliers, 1996). So before each sub-step the impulses are found here, for the velocities bodies would have
//! after gravity, scripts' forces and the contacts of the sub-step before, and given to the bodies as forces. rapier then finds its
//! joints satisfied, and its sweeps only answer what contacts change.
//!
//! Links that hang together by bodies that move are a [`Chain`], a system of its own: what one does costs the others nothing.

mod axis;
mod block_cholesky;
mod chain;
mod mover;
mod node;
mod rotor;
mod settle;
mod taut;

use std::collections::BTreeMap;

use nalgebra::{Vector3, Vector6};

use chain::Chain;
use geometry::partition;

use super::bodies::Bodies;
use super::contacts;
use super::links::Links;
use super::plan::LinkPlan;
use super::world::World;
use crate::scene::Handle;

/// The links of a scene and the order they are solved in.
#[derive(Default)]
pub(super) struct Articulation {
    chains: Vec<Chain>,
    /// The chain of a body that moves.
    chain_of: BTreeMap<Handle, usize>,
}

impl Articulation {
    /// Lays out the systems for the links there are; chains of which a joint asks for it are left to rapier. `order`: base-to-tip.
    pub(super) fn follow(&mut self, links: &mut Links, order: &[Handle], bodies: &Bodies, world: &mut World) {
        self.chains.iter().for_each(|chain| chain.leave_gyration_to_rapier(true, world));
        let plan = |handle: &Handle| links.get(handle).map(|link| (*handle, &link.plan));
        let plans: Vec<(Handle, &LinkPlan)> = order.iter().rev().filter_map(plan).collect();
        let moving = |shape: Handle| bodies.get(shape).filter(|body| body.build.dynamic).map(|_| shape);
        let ends = |(_, plan): &(Handle, &LinkPlan)| [plan.first, plan.second].into_iter().filter_map(moving);
        let numbers = partition(plans.iter().map(ends));
        let mut chains = Vec::new();
        chains.resize_with(numbers.iter().max().map_or(0, |last| last + 1), Chain::default);
        for ((handle, plan), number) in plans.into_iter().zip(numbers) {
            chains[number].add(handle, plan, bodies);
        }
        let (rapiers, exact): (Vec<Chain>, Vec<Chain>) = chains.into_iter().partition(Chain::is_rapiers);
        rapiers.iter().for_each(|chain| chain.share(true, links, world));
        self.chains = exact;
        self.chains.iter_mut().for_each(Chain::lay_out);
        self.chains.iter().for_each(|chain| chain.leave_gyration_to_rapier(false, world));
        let shapes =
            |(index, chain): (usize, &Chain)| chain.moving_shapes().map(|shape| (shape, index)).collect::<Vec<_>>();
        self.chain_of = self.chains.iter().enumerate().flat_map(shapes).collect();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.chains.is_empty()
    }

    /// Finds the impulses for a sub-step of `step` seconds and gives them to the bodies as forces, and to the links to be read.
    pub(super) fn act(&mut self, links: &mut Links, world: &mut World, gravity: [f64; 3], step: f64) {
        self.chains.iter_mut().for_each(|chain| chain.begin(links, world, gravity, step));
        self.foresee(world);
        let near = contacts::shapes_near(world);
        for chain in &mut self.chains {
            let solved = chain.solve(links, step);
            chain.share(!solved || chain.touches(&near), links, world);
            if solved {
                chain.give(links, world, step);
            }
        }
    }

    /// Adds what contacts are expected to do.
    fn foresee(&mut self, world: &World) {
        for push in contacts::expected(world, |shape| self.chain_of.contains_key(&shape)) {
            for (shape, sign) in [(push.shapes[0], 1.0), (push.shapes[1], -1.0)] {
                if let Some(&chain) = self.chain_of.get(&shape) {
                    self.chains[chain].push(shape, Vector3::from(push.impulse) * sign, push.point.into());
                }
            }
        }
    }

    /// Puts the bodies back where the links want them, after a sub-step.
    pub(super) fn settle(&mut self, links: &Links, world: &mut World, step: f64) {
        self.chains.iter_mut().for_each(|chain| chain.settle(links, world, step));
    }
}

fn spatial(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}
