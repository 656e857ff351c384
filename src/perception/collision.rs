//! Which objects collide, and along which lines (spec: sensors 2).

use proximity::{intersection_segments, intersects};

use super::Perception;
use super::entity::{Entity, Purpose};
use super::index::Body;
use super::pairs::Pairs;
use crate::scene::{Handle, Scene};

impl Perception {
    /// The first pair of objects that collide.
    pub(crate) fn collision(&mut self, scene: &Scene, entities: [Entity; 2]) -> Option<[Handle; 2]> {
        let pairs = Pairs::of(scene, Purpose::Collision, entities);
        let index = self.index(scene);
        pairs.first(index).find_map(|object| {
            let mut others = pairs.overlapping(index, object);
            others.find(|(_, other)| collide(object.1, other)).map(|(other, _)| [object.0, other])
        })
    }

    /// The segments (world, metres) in which the surfaces of the entities intersect.
    pub(crate) fn intersections(&mut self, scene: &Scene, entities: [Entity; 2]) -> Vec<[[f64; 3]; 2]> {
        let pairs = Pairs::of(scene, Purpose::Collision, entities);
        let index = self.index(scene);
        let mut segments = Vec::new();
        for object in pairs.first(index) {
            for (_, other) in pairs.overlapping(index, object) {
                parts(object.1, other).for_each(|[a, b]| segments.extend(intersection_segments(a, b)));
            }
        }
        segments
    }
}

fn collide(body: &Body, other: &Body) -> bool {
    parts(body, other).any(|[a, b]| intersects(a, b))
}

/// The pairs of parts whose boxes overlap.
fn parts<'a>(body: &'a Body, other: &'a Body) -> impl Iterator<Item = [proximity::Placed<'a>; 2]> {
    body.parts().flat_map(move |(a, bounds)| {
        other.parts().filter(|(_, other)| bounds.overlaps(other)).map(move |(b, _)| [a, b])
    })
}
