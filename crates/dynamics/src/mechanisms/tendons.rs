//! Which mechanism a tendon belongs to: one that has all that moves and that the tendon is over.

use super::Mechanisms;
use crate::bodies::Bodies;
use crate::links::Links;
use crate::tendons::{Tendon, Tendons};
use crate::world::World;
use scene::Handle;

impl Mechanisms {
    /// Lets mechanisms that a tendon is over be one.
    pub(super) fn join_by_tendons(&mut self, links: &Links, tendons: &Tendons) {
        let linked = |shape: &Handle| {
            let mut all = links.iter();
            all.any(|(_, link)| [link.plan.first, link.plan.second].contains(shape))
        };
        for tendon in tendons.iter() {
            let shapes: Vec<Handle> = shapes(tendon, links).into_iter().filter(linked).collect();
            let pairs = shapes.windows(2).map(|pair| [pair[0], pair[1]]);
            self.joined.extend(pairs.filter(|[a, b]| a != b));
        }
    }

    /// The number of the mechanism that solves a tendon.
    pub(super) fn host_of(&self, tendon: &Tendon, links: &Links, bodies: &Bodies) -> Option<usize> {
        let moves = |shape: &Handle| bodies.get(*shape).is_some_and(|body| body.build.dynamic);
        let moving = shapes(tendon, links).into_iter().filter(moves);
        let mut numbers = moving.map(|shape| Some(self.places.get(&shape)?.0));
        let first = numbers.next()??;
        numbers.all(|number| number == Some(first)).then_some(first)
    }

    /// Gives the mechanisms the tendons that they have in this sub-step.
    pub(super) fn add_tendons(
        &mut self,
        tendons: &Tendons,
        links: &Links,
        bodies: &Bodies,
        world: &World,
    ) {
        for tendon in tendons.iter().filter(|tendon| tendon.is_linked) {
            let Some(number) = self.host_of(tendon, links, bodies) else {
                continue;
            };
            let layout = tendon.layout(bodies, links, world);
            let places = &self.places;
            let index = |shape: Handle| {
                let place = places.get(&shape).filter(|place| place.0 == number);
                place.map(|place| place.1)
            };
            let carried = layout.rate_of(bodies, world, |shape| index(shape).is_none());
            self.all[number].add_tendon(tendon, &layout, index, carried, links);
        }
    }
}

/// The shapes that a tendon is over: those of its points, and those that its joints move.
fn shapes(tendon: &Tendon, links: &Links) -> Vec<Handle> {
    let points = tendon.plan.points.iter().filter_map(|point| point.body);
    let joints = tendon.plan.joints.iter();
    let moved = joints.filter_map(|part| Some(links.get(part.joint)?.plan.second));
    points.chain(moved).collect()
}
