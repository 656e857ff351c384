//! Which objects collide, and along which lines (spec: sensors 2).

use proximity::{intersection_segments, intersects};

use super::Perception;
use super::entity::{Entity, Purpose};
use super::index::{Body, Index};
use super::pairs::Pairs;
use scene::{Handle, Scene};

impl Perception {
    /// The first pair of objects that collide.
    pub fn collision(&mut self, scene: &Scene, entities: [Entity; 2]) -> Option<[Handle; 2]> {
        let pairs = Pairs::of(scene, Purpose::Collision, entities);
        first_collision(&pairs, scene, self.index(scene))
    }

    /// Prepares a test of whether any of some pairs of entities collide when `displaced` objects stand elsewhere. It holds for as long as
    /// no object comes or goes or gets another parent, flag or collection.
    pub fn collision_test(
        &mut self,
        scene: &Scene,
        entities: &[[Entity; 2]],
        displaced: impl IntoIterator<Item = Handle>,
    ) -> CollisionTest {
        let pairs = entities
            .iter()
            .map(|&entities| Pairs::of(scene, Purpose::Collision, entities));
        CollisionTest {
            pairs: pairs.collect(),
            displaced: self.index(scene).bodies_below(scene, displaced),
        }
    }

    /// Whether any pair of a test collides, with objects displaced as the test has it. The journal need not mention that.
    pub fn collides(&mut self, scene: &Scene, test: &CollisionTest) -> bool {
        self.index.place_displaced(scene, &test.displaced);
        test.pairs
            .iter()
            .any(|pairs| first_collision(pairs, scene, &self.index).is_some())
    }

    /// The segments (world, metres) in which the surfaces of the entities intersect.
    pub fn intersections(&mut self, scene: &Scene, entities: [Entity; 2]) -> Vec<[[f64; 3]; 2]> {
        let pairs = Pairs::of(scene, Purpose::Collision, entities);
        let index = self.index(scene);
        let mut segments = Vec::new();
        for object in pairs.first(index) {
            for (_, other) in pairs.overlapping((scene, index), object) {
                parts(object.1, other)
                    .for_each(|[a, b]| segments.extend(intersection_segments(a, b)));
            }
        }
        segments
    }
}

/// Pairs of entities, and what moves with the objects that are displaced.
pub struct CollisionTest {
    pairs: Vec<Pairs>,
    displaced: Vec<Handle>,
}

fn first_collision(pairs: &Pairs, scene: &Scene, index: &Index) -> Option<[Handle; 2]> {
    pairs.first(index).find_map(|object| {
        let mut others = pairs.overlapping((scene, index), object);
        others
            .find(|(_, other)| collide(object.1, other))
            .map(|(other, _)| [object.0, other])
    })
}

fn collide(body: &Body, other: &Body) -> bool {
    parts(body, other).any(|[a, b]| intersects(a, b))
}

/// The pairs of parts whose boxes overlap.
fn parts<'a>(body: &'a Body, other: &'a Body) -> impl Iterator<Item = [proximity::Placed<'a>; 2]> {
    body.parts().flat_map(move |(a, bounds)| {
        other
            .parts()
            .filter(|(_, other)| bounds.overlaps(other))
            .map(move |(b, _)| [a, b])
    })
}
