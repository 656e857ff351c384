//! Where ropes are held.

use nalgebra::Point3;
use rapier3d_f64::prelude::Collider;
use scene::shape::rope::Pin;
use scene::{Handle, Pose, Scene};
use soft::{Hold, Rod, Target, V3};

use super::coupling::Coupled;
use crate::bodies::Bodies;
use crate::convert::{from_pose, to_vector};
use crate::plan::RopePlan;
use crate::world::World;

/// Nodes beside a pin that do not touch the object that holds it, beside those within it.
const EXEMPT: usize = 2;

/// A pin in the physics.
pub(super) struct Held {
    pin: Pin,
    /// The body that goes with the object, and the pose of the object in its frame.
    body: Option<(Handle, Pose)>,
    /// Poses of the object at the beginning and at the end of the call.
    way: [Pose; 2],
    /// In the frame of the object.
    clamp: Option<Clamp>,
    /// The shape that the object belongs to, if it collides: the rope does not touch it so many nodes from here.
    carrier: Option<Handle>,
    exempt: usize,
}

/// What is held of an edge beside the pinned node.
#[derive(Clone, Copy)]
struct Clamp {
    /// The other node, and its place.
    node: usize,
    place: V3,
    /// The node at which the edge begins, and its material direction.
    edge: usize,
    direction: V3,
}

impl Clamp {
    fn new(pin: &Pin, rod: &Rod, object: &Pose) -> Self {
        let last = rod.len() - 1;
        let edge = pin.point.min(last - 1);
        let node = if pin.point == last {
            last - 1
        } else {
            edge + 1
        };
        let into = object.inverse();
        let along = into.rotation * (rod.point(node) - rod.point(pin.point));
        Self {
            node,
            place: V3::from(pin.place) + along,
            edge,
            direction: into.rotation * rod.direction(edge),
        }
    }
}

impl Held {
    /// The pins of a rope. `before`: those that it had.
    pub(super) fn all(
        plan: &RopePlan,
        rod: &Rod,
        before: Vec<Self>,
        bodies: &Bodies,
        world: &World,
        scene: &Scene,
    ) -> Vec<Self> {
        let is_there = |pin: &&Pin| pin.point < plan.rope.points.len();
        let new = |pin: &Pin| {
            let pose = pose_of(pin, scene);
            let carrier = pin
                .holder
                .and_then(|holder| carrier_of(holder, bodies, scene));
            let is_moved =
                |shape: &Handle| bodies.get(*shape).is_some_and(|body| body.build.dynamic);
            let body = carrier.filter(is_moved);
            let known = before.iter().find(|held| held.pin == *pin);
            // What went with a body before goes on from where that is.
            let offset = body.map(|shape| {
                let same = known
                    .and_then(|held| held.body)
                    .filter(|(of, _)| *of == shape);
                let here = bodies.get(shape).and_then(|body| body.pose(world));
                let offset = here.map(|here| here.inverse() * pose);
                (
                    shape,
                    same.map_or(offset.unwrap_or(pose), |(_, offset)| offset),
                )
            });
            Self {
                pin: *pin,
                body: offset,
                way: known.map_or([pose; 2], |held| held.way),
                clamp: known.map_or_else(
                    || pin.clamped.then(|| Clamp::new(pin, rod, &pose)),
                    |held| held.clamp,
                ),
                carrier,
                exempt: known.map_or_else(
                    || carrier.map_or(0, |shape| exempt(pin.point, rod, shape, bodies, world)),
                    |held| held.exempt,
                ),
            }
        };
        plan.pins.iter().filter(is_there).map(new).collect()
    }

    /// A call begins: the object is where it is at the end of it.
    pub(super) fn follow(&mut self, scene: &Scene) {
        self.way = [self.way[1], pose_of(&self.pin, scene)];
    }

    /// What holds a rod in a sub-step that ends after `fraction` of the call.
    pub(super) fn hold(
        &self,
        fraction: f64,
        bodies: &Bodies,
        world: &World,
        coupled: &mut Coupled,
    ) -> Vec<Hold> {
        let moving = self.body.and_then(|(shape, offset)| {
            let body = bodies.get(shape)?;
            let com = world.bodies.get(body.rigid)?.center_of_mass();
            let pose = from_pose(world.bodies.get(body.rigid)?.position()) * offset;
            Some((
                coupled.add(shape, body.rigid),
                pose,
                V3::new(com.x, com.y, com.z),
            ))
        });
        let pose = moving.map_or_else(
            || geometry::pose::interpolate(&self.way[0], &self.way[1], fraction),
            |(_, pose, _)| pose,
        );
        let target = |place: V3| match moving {
            Some((body, _, com)) => Target::Body(body, place - com),
            None => Target::Place(place),
        };
        let place = |local: V3| (pose * Point3::from(local)).coords;
        let own = Hold::new(self.pin.point, target(place(self.pin.place.into())), None);
        let Some(clamp) = self.clamp else {
            return vec![own];
        };
        let mut holds = vec![own, Hold::new(clamp.node, target(place(clamp.place)), None)];
        for hold in holds.iter_mut().filter(|hold| hold.node == clamp.edge) {
            hold.direction = Some(pose.rotation * clamp.direction);
        }
        holds
    }

    /// The force on the rope in the last sub-step, N: of both nodes of a clamped edge.
    pub(super) fn force(&self, rod: &Rod) -> [f64; 3] {
        let clamped = self.clamp.map(|clamp| clamp.node);
        let is_own = |hold: &&Hold| hold.node == self.pin.point || Some(hold.node) == clamped;
        let forces = rod.holds.iter().filter(is_own).map(|hold| hold.force);
        forces.sum::<V3>().into()
    }

    /// Whether a node of the rope is in or beside a shape that holds it.
    pub(super) fn exempts(&self, node: usize, shape: Handle) -> bool {
        self.carrier == Some(shape) && node.abs_diff(self.pin.point) <= self.exempt
    }
}

/// Number of nodes from a pinned one on that do not touch the shape that holds it: those that begin within it, and some more.
fn exempt(pinned: usize, rod: &Rod, shape: Handle, bodies: &Bodies, world: &World) -> usize {
    let body = bodies.get(shape);
    let colliders = body.iter().flat_map(|body| &body.colliders);
    let colliders: Vec<_> = colliders
        .filter_map(|handle| world.colliders.get(*handle))
        .collect();
    let is_within = |&node: &usize| {
        let point = rod.point(node);
        let point = to_vector([point.x, point.y, point.z]);
        let holds =
            |collider: &&Collider| collider.shape().contains_point(collider.position(), point);
        colliders.iter().any(holds)
    };
    let after = (pinned..rod.len()).take_while(is_within).count();
    let before = (0..pinned).rev().take_while(is_within).count();
    EXEMPT + after.max(before)
}

fn pose_of(pin: &Pin, scene: &Scene) -> Pose {
    let pose = pin.holder.and_then(|holder| scene.world_pose(holder).ok());
    pose.unwrap_or_else(Pose::identity)
}

/// The shape that an object moves with and that physics knows: itself, or the nearest one above it.
fn carrier_of(object: Handle, bodies: &Bodies, scene: &Scene) -> Option<Handle> {
    let mut at = Some(object);
    while let Some(handle) = at {
        if bodies.get(handle).is_some() {
            return Some(handle);
        }
        at = scene.object(handle).ok()?.parent();
    }
    None
}
