//! What scripts see of contacts of soft bodies: pairs that may touch, before a sub-step, and contacts after it.

use std::collections::BTreeSet;

use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d_f64::prelude::QueryFilter;
use scene::Handle;
use soft::{Surface, Touch, V3, fem};

use super::obstacle::place;
use super::part::Part;
use super::{Placed, SoftBodies, touches};
use crate::bodies::Tag;
use crate::contact_log::SoftTouch;
use crate::contacts::masks_overlap;
use crate::world::World;

/// Distance at which scripts are asked about what may touch, beside what moves in a sub-step, metres.
const MARGIN: f64 = 2e-3;

impl SoftBodies {
    /// The contacts of the last sub-step, without those of something soft with itself.
    pub(crate) fn touches(&self, world: &World) -> Vec<SoftTouch> {
        let all = self.all();
        let collider = |key: u64| {
            let index = touches::collider_of(key);
            let (collider, _) = world.colliders.get_unknown_gen(index)?;
            Some(Tag::unpack(collider.user_data).shape)
        };
        let bodies = self.bodies.contacts.iter().filter_map(|contact| {
            let other = match contact.surface {
                fem::Surface::Soft(other, _) => Some(all[other].shape),
                fem::Surface::Body(_) | fem::Surface::Obstacle(_) => collider(contact.key),
            };
            seen([all[contact.part].shape, other?], &contact.touch)
        });
        let ropes = &all[self.bodies.all.len()..];
        let ropes = self.ropes.contacts.iter().filter_map(|contact| {
            let other = match contact.surface {
                Surface::Rod(other, ..) => Some(ropes[other].shape),
                Surface::Body(_) | Surface::Obstacle(_) => collider(contact.key),
            };
            seen([ropes[contact.rod].shape, other?], &contact.touch)
        });
        ropes.chain(bodies).collect()
    }

    /// Cloths and volumes, and then ropes.
    fn all(&self) -> Vec<&Placed> {
        self.bodies.all.iter().chain(&self.ropes.all).collect()
    }

    /// Pairs of shapes of which one is soft and that may touch in a sub-step of `step` seconds, by their boxes; what is soft comes first.
    pub(crate) fn pairs_near(&self, world: &World, step: f64) -> Vec<(Handle, Handle)> {
        let bodies = self.bodies.parts.iter().map(|part| around(part, step));
        let ropes = self.ropes.parts.iter().map(|part| around(part, step));
        let (all, boxes) = (self.all(), bodies.chain(ropes).collect::<Vec<_>>());
        let mut pairs = Vec::new();
        for (number, own) in all.iter().enumerate() {
            let Some(bounds) = boxes[number] else {
                continue;
            };
            pairs.extend(rigid_pairs(own, bounds, world));
            let later = all.iter().zip(&boxes).skip(number + 1);
            let near = later.filter(|(other, around)| {
                around.is_some_and(|around| around.intersects(&bounds))
                    && masks_overlap(own.tag(), other.tag())
            });
            pairs.extend(near.map(|(other, _)| (own.shape, other.shape)));
        }
        pairs
    }
}

fn seen(shapes: [Handle; 2], touch: &Touch) -> Option<SoftTouch> {
    (shapes[0] != shapes[1] && touch.impulse != V3::zeros()).then(|| SoftTouch {
        shapes,
        place: place(touch.point),
        normal: place(touch.normal),
        impulse: place(touch.impulse),
    })
}

/// The box of something soft, with what it moves in a sub-step; None where it is nowhere.
fn around(part: &impl Part, step: f64) -> Option<Aabb> {
    let points = (0..part.len()).map(|node| place(part.point(node)));
    let points: Vec<Vector> = points.collect();
    let reach = part.radius() + MARGIN + part.fastest() * step;
    let is_somewhere = points.iter().all(|point| point.is_finite());
    is_somewhere.then(|| Aabb::from_points(points).loosened(reach))
}

/// Pairs with shapes that are not soft.
fn rigid_pairs(own: &Placed, bounds: Aabb, world: &World) -> Vec<(Handle, Handle)> {
    let query = world.broad_phase.as_query_pipeline(
        world.narrow_phase.query_dispatcher(),
        &world.bodies,
        &world.colliders,
        QueryFilter::default(),
    );
    let found = query.intersect_aabb_conservative(bounds);
    let tags = found.map(|(_, collider)| Tag::unpack(collider.user_data));
    let touching = tags.filter(|tag| masks_overlap(own.tag(), *tag));
    // A shape may have several colliders.
    let others: BTreeSet<Handle> = touching.map(|tag| tag.shape).collect();
    others.into_iter().map(|other| (own.shape, other)).collect()
}
