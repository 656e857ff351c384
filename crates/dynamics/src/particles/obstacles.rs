//! What particles may hit in a sub-step.

use rapier3d_f64::math::Vector;
use rapier3d_f64::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d_f64::prelude::{
    Collider, ColliderHandle, QueryFilter, QueryPipeline, RigidBody, RigidBodyHandle,
};

use super::{Particle, Tag, World, to_vector};

/// Part of the radius that is near enough to touch.
const SKIN: f64 = 1e-3;
/// Largest number of steps along a way towards a surface.
const MAX_MARCHES: usize = 32;

/// The colliders of the world, as particles with a mask find them.
pub(super) struct Surroundings<'a> {
    query: QueryPipeline<'a>,
    world: &'a World,
    mask: u8,
    /// Seconds.
    pub step: f64,
}

/// Something that a particle may hit.
pub(super) struct Obstacle<'a> {
    pub collider: &'a Collider,
    pub rigid: &'a RigidBody,
    pub body: RigidBodyHandle,
}

/// Where a sphere touches an obstacle.
pub(super) struct Hit<'a> {
    pub obstacle: Obstacle<'a>,
    /// Away from the surface.
    pub normal: Vector,
    /// Part of the way that the centre has gone.
    pub part: f64,
}

/// The nearest point of a surface.
pub(super) struct Near {
    /// Away from the surface.
    pub normal: Vector,
    /// Negative inside.
    pub distance: f64,
}

impl<'a> Surroundings<'a> {
    /// What is around all these particles; None if nothing is.
    pub(super) fn of(items: &[Particle], mask: u8, world: &'a World, step: f64) -> Option<Self> {
        let query = world.broad_phase.as_query_pipeline(
            world.narrow_phase.query_dispatcher(),
            &world.bodies,
            &world.colliders,
            QueryFilter::default(),
        );
        let around = Self {
            query,
            world,
            mask,
            step,
        };
        let reach = |particle: &Particle| {
            let speed = to_vector(particle.velocity).length();
            particle.size + 2.0 * (speed + world.gravity().length() * step) * step
        };
        let reach = items.iter().map(reach).fold(0.0, f64::max);
        let places = items.iter().map(|particle| to_vector(particle.position));
        let bounds = Aabb::from_points(places).loosened(reach);
        (mask != 0 && !around.in_box(bounds).is_empty()).then_some(around)
    }

    /// What a sphere may touch on its way, in the order of the colliders.
    pub(super) fn on_way(&self, from: Vector, way: Vector, radius: f64) -> Vec<Obstacle<'a>> {
        let swept = Aabb::from_points([from, from + way]);
        self.in_box(swept.loosened(radius * (1.0 + 2.0 * SKIN)))
    }

    fn in_box(&self, bounds: Aabb) -> Vec<Obstacle<'a>> {
        let found = self.query.intersect_aabb_conservative(bounds);
        let mut found: Vec<ColliderHandle> = found.map(|(handle, _)| handle).collect();
        found.sort_unstable_by_key(|handle| handle.into_raw_parts());
        let obstacles = found.into_iter().filter_map(|handle| self.obstacle(handle));
        obstacles.collect()
    }

    fn obstacle(&self, handle: ColliderHandle) -> Option<Obstacle<'a>> {
        let collider = self.world.colliders.get(handle)?;
        let body = collider.parent()?;
        let global_mask = (Tag::unpack(collider.user_data).mask >> 8) as u8;
        let collides = global_mask & self.mask != 0 && collider.is_enabled();
        Some(Obstacle {
            collider,
            rigid: self.world.bodies.get(body).filter(|_| collides)?,
            body,
        })
    }
}

impl<'a> Obstacle<'a> {
    /// The point of the surface nearest to a point.
    pub(super) fn nearest(&self, point: Vector) -> Option<Near> {
        let shape = self.collider.shape();
        let found = shape.project_point(self.collider.position(), point, false);
        let apart = point - found.point;
        let distance = apart.length();
        if distance < 1e-12 || !distance.is_finite() {
            return None;
        }
        let sign = if found.is_inside { -1.0 } else { 1.0 };
        Some(Near {
            normal: apart * (sign / distance),
            distance: distance * sign,
        })
    }

    /// Where a sphere touches it on its way, if it moves towards it there: no step along the way is longer than the distance from the surface.
    pub(super) fn hit(self, from: Vector, way: Vector, radius: f64) -> Option<Hit<'a>> {
        let length = way.length();
        let mut gone = 0.0;
        for _ in 0..MAX_MARCHES {
            let part = if length > 0.0 { gone / length } else { 0.0 };
            let near = self.nearest(from + way * part)?;
            let gap = near.distance - radius;
            if gap <= SKIN * radius {
                let approaches = way.dot(near.normal) < -1e-9 * length;
                return approaches.then_some(Hit {
                    obstacle: self,
                    normal: near.normal,
                    part,
                });
            }
            gone += gap;
            if gone > length {
                return None;
            }
        }
        None
    }
}
