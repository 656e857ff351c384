//! The smallest distance of two entities (spec: sensors 2).

use proximity::Closest;

use super::Perception;
use super::entity::{Entity, Purpose};
use super::index::Body;
use super::pairs::Pairs;
use scene::{Handle, Scene};

/// The closest points of two entities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shortest {
    /// One of each entity.
    pub objects: [Handle; 2],
    /// On their surfaces, in the world (m).
    pub points: [[f64; 3]; 2],
    /// Between the points, metres.
    pub distance: f64,
}

impl Perception {
    /// The closest points of two entities, if they are nearer than `below` (m).
    pub fn distance(
        &mut self,
        scene: &Scene,
        entities: [Entity; 2],
        below: f64,
    ) -> Option<Shortest> {
        let pairs = Pairs::of(scene, Purpose::Distance, entities);
        let index = self.index(scene);
        let mut shortest: Option<Shortest> = None;
        for (object, body) in pairs.first(index) {
            let limit = shortest.map_or(below, |found| found.distance);
            pairs.nearest_first(
                (scene, index),
                (object, body),
                limit,
                |other, other_body, limit| {
                    let Some(Closest { points, distance }) = closest(body, other_body, limit)
                    else {
                        return limit;
                    };
                    shortest = Some(Shortest {
                        objects: [object, other],
                        points,
                        distance,
                    });
                    distance
                },
            );
        }
        shortest
    }
}

/// The closest points of two bodies, if they are nearer than `below` (m).
fn closest(body: &Body, other: &Body, mut below: f64) -> Option<Closest> {
    let mut found = None;
    for (a, bounds) in body.parts() {
        for (b, other_bounds) in other.parts() {
            if bounds.distance(other_bounds) < below
                && let Some(closest) = proximity::distance(a, b, below)
            {
                (found, below) = (Some(closest), closest.distance);
            }
        }
    }
    found
}
