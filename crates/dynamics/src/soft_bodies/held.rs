//! Where what is soft is held.

use std::collections::BTreeSet;

use nalgebra::Point3;
use rapier3d_f64::prelude::Collider;
use scene::shape::soft::Pin;
use scene::{Handle, Pose, Scene};
use soft::{Hold, Target, V3};

use super::coupling::Coupled;
use super::part::Part;
use crate::bodies::Bodies;
use crate::convert::{from_pose, to_vector};
use crate::plan::SoftPlan;
use crate::world::World;

/// Rings of nodes around a pin that do not touch the object that holds it, beside those within it.
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
    /// The shape that the object belongs to, if it collides: these nodes do not touch it.
    carrier: Option<Handle>,
    exempt: BTreeSet<usize>,
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
    fn new(pin: &Pin, part: &impl Part, object: &Pose) -> Option<Self> {
        let (node, edge, direction) = part.clamp(pin.point)?;
        let into = object.inverse();
        let along = into.rotation * (part.point(node) - part.point(pin.point));
        Some(Self {
            node,
            place: V3::from(pin.place) + along,
            edge,
            direction: into.rotation * direction,
        })
    }
}

impl Held {
    /// The pins of something soft. `before`: those that it had.
    pub(super) fn all(
        plan: &SoftPlan,
        part: &impl Part,
        before: Vec<Self>,
        bodies: &Bodies,
        world: &World,
        scene: &Scene,
    ) -> Vec<Self> {
        let is_there = |pin: &&Pin| pin.point < part.len();
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
                    || pin.clamped.then(|| Clamp::new(pin, part, &pose)).flatten(),
                    |held| held.clamp,
                ),
                carrier,
                exempt: known.map_or_else(
                    || {
                        let carrier = carrier.iter();
                        let nodes = carrier
                            .flat_map(|shape| exempt(pin.point, part, *shape, bodies, world));
                        nodes.collect()
                    },
                    |held| held.exempt.clone(),
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

    /// The force on what is held in the last sub-step, N: of both nodes of a clamped edge.
    pub(super) fn force(&self, part: &impl Part) -> [f64; 3] {
        let clamped = self.clamp.map(|clamp| clamp.node);
        let is_own = |hold: &&Hold| hold.node == self.pin.point || Some(hold.node) == clamped;
        let forces = part.held().iter().filter(is_own).map(|hold| hold.force);
        forces.sum::<V3>().into()
    }

    /// Whether a node is in or beside a shape that holds it.
    pub(super) fn exempts(&self, node: usize, shape: Handle) -> bool {
        self.carrier == Some(shape) && self.exempt.contains(&node)
    }
}

/// The nodes around a pinned one that do not touch the shape that holds it: those that begin within it, and some more.
fn exempt(
    pinned: usize,
    part: &impl Part,
    shape: Handle,
    bodies: &Bodies,
    world: &World,
) -> BTreeSet<usize> {
    let body = bodies.get(shape);
    let colliders = body.iter().flat_map(|body| &body.colliders);
    let colliders: Vec<_> = colliders
        .filter_map(|handle| world.colliders.get(*handle))
        .collect();
    let is_within = |node: usize| {
        let point = part.point(node);
        let point = to_vector([point.x, point.y, point.z]);
        let holds =
            |collider: &&Collider| collider.shape().contains_point(collider.position(), point);
        colliders.iter().any(holds)
    };
    let mut exempt = BTreeSet::from([pinned]);
    let mut rings = EXEMPT;
    if is_within(pinned) {
        rings += 1;
        let mut next = vec![pinned];
        while let Some(node) = next.pop() {
            let within = part
                .neighbours(node)
                .into_iter()
                .filter(|node| is_within(*node));
            next.extend(within.filter(|node| exempt.insert(*node)));
        }
    }
    for _ in 0..rings {
        let beside = exempt.iter().flat_map(|node| part.neighbours(*node));
        exempt = beside.collect();
    }
    exempt
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
