//! Mechanisms in the making: links that hang together by bodies that move.

use std::collections::{BTreeMap, BTreeSet};

use articulation::{BodyProperties, JointProperties, Mechanism};
use geometry::partition;

use super::Linked;
use crate::bodies::Bodies;
use crate::links::Links;
use crate::mechanisms::linked_shape::{LinkedShape, properties};
use crate::plan::LinkPlan;
use crate::world::World;
use scene::Handle;
use scene::joint::JointSolver;

/// A mechanism in the making.
#[derive(Default)]
pub(in crate::mechanisms) struct Builder {
    bodies: Vec<BodyProperties>,
    pub shapes: Vec<LinkedShape>,
    places: BTreeMap<Handle, usize>,
    joints: Vec<JointProperties>,
    pub links: Vec<usize>,
    /// Whether a joint selects rapier's joints, and whether there is a screw, which rapier lacks.
    asks_rapier: bool,
    has_screw: bool,
}

/// A builder for each set of links that hang together by bodies that move, or whose bodies are joined. Links at the tips come first, which are eliminated first.
pub(in crate::mechanisms) fn builders(
    links: &Links,
    order: &[Handle],
    joined: &BTreeSet<[Handle; 2]>,
    bodies: &Bodies,
) -> Vec<Builder> {
    let plan = |&handle: &Handle| {
        links
            .place(handle)
            .map(|place| (place, &links.at(place).plan))
    };
    let plans: Vec<(usize, &LinkPlan)> = order.iter().rev().filter_map(plan).collect();
    let moving = |shape: Handle| {
        bodies
            .get(shape)
            .filter(|body| body.build.dynamic)
            .map(|_| shape)
    };
    let ends =
        |(_, plan): &(usize, &LinkPlan)| [plan.first, plan.second].into_iter().filter_map(moving);
    let of_plans = plans.iter().map(|plan| ends(plan).collect::<Vec<_>>());
    let of_joined = joined.iter().map(|ends| ends.to_vec());
    let numbers = partition(of_plans.chain(of_joined));
    let mut builders = Vec::new();
    builders.resize_with(
        numbers.iter().max().map_or(0, |last| last + 1),
        Builder::default,
    );
    for ((place, plan), number) in plans.into_iter().zip(numbers) {
        builders[number].add(place, plan, bodies);
    }
    builders
}

impl Builder {
    fn add(&mut self, link: usize, plan: &LinkPlan, bodies: &Bodies) {
        self.asks_rapier |= plan.solver == JointSolver::Impulse;
        self.has_screw |= plan.pitch != 0.0;
        if let (Some(first), Some(second)) = (
            self.body(plan.first, bodies),
            self.body(plan.second, bodies),
        ) {
            let LinkPlan {
                kind,
                base,
                tip,
                pitch,
                ..
            } = *plan;
            self.joints.push(JointProperties {
                kind: kind.joint(),
                bodies: [first, second],
                base,
                tip,
                pitch,
            });
            self.links.push(link);
        }
    }

    /// Index of the body of a shape.
    fn body(&mut self, shape: Handle, bodies: &Bodies) -> Option<usize> {
        let body = bodies.get(shape)?;
        Some(*self.places.entry(shape).or_insert_with(|| {
            self.bodies.push(properties(body));
            self.shapes.push(LinkedShape::new(shape, body));
            self.bodies.len() - 1
        }))
    }

    /// Whether the links are left to rapier alone.
    pub(in crate::mechanisms) fn is_for_rapier(&self) -> bool {
        self.asks_rapier && !self.has_screw
    }

    pub(in crate::mechanisms) fn build(self, bodies: &Bodies, world: &World) -> Linked {
        Linked::new(
            Mechanism::new(self.bodies, self.joints),
            self.shapes,
            self.links,
            bodies,
            world,
        )
    }
}
