//! The contacts of a dynamics call, for scripts that read them later.
//!
//! Every sub-step adds its impulses to the log. The log stores one record per point; forces are computed when they are read. Contacts of
//! sleeping bodies are stored once, as long as they sleep.

use std::ops::Range;
use std::rc::Rc;

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::prelude::{
    ColliderHandle, ContactManifold, ContactManifoldData, ContactPair, RigidBodyHandle,
};

use super::bodies::Tag;
use super::convert::from_vector;
use super::mechanisms::exact_contacts::ExactContacts;
use super::mechanisms::points::Point;
use super::world::{World, parts_of_impulse};
use scene::Handle;

/// A point where two shapes touched in one sub-step. World axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Index of the sub-step, from 0.
    pub sub_step: u32,
    /// The shapes that touched.
    pub shapes: [Handle; 2],
    /// Metres.
    pub point: [f64; 3],
    /// Force of the second shape on the first, newtons.
    pub force: [f64; 3],
    /// Points to the first shape.
    pub normal: [f64; 3],
}

impl Contact {
    /// The contact as seen from `shape`: it comes first.
    pub fn seen_from(mut self, shape: Handle) -> Self {
        if self.shapes[0] != shape {
            self.shapes.swap(0, 1);
            self.force = self.force.map(|x| -x);
            self.normal = self.normal.map(|x| -x);
        }
        self
    }
}

/// A point at which something soft touches something. World axes.
pub(super) struct SoftTouch {
    /// What is soft comes first.
    pub shapes: [Handle; 2],
    pub place: Vector,
    /// Points to the first shape.
    pub normal: Vector,
    /// On the first shape, N s.
    pub impulse: Vector,
}

/// The contacts of the sub-steps of one call.
#[derive(Default)]
pub(super) struct ContactLog {
    awake: Batch,
    sub_steps: Vec<SubStepContacts>,
    resting: Resting,
}

/// One sub-step: its contacts of bodies that are awake, and those of sleepers.
struct SubStepContacts {
    /// In `awake`.
    touches: Range<usize>,
    resting: Rc<Batch>,
}

/// Contacts among sleepers and with what they lie on: they stay as they were when the bodies fell asleep.
#[derive(Default)]
struct Resting {
    contacts: Rc<Batch>,
    /// Those of them that were not rapier's.
    exact: Vec<Point>,
    /// The bodies that were awake when this was found out; None when it has to be found out.
    awake: Option<Vec<RigidBodyHandle>>,
    /// By index of the collider. Looking a collider up costs more than all else that is kept of a contact.
    colliders: Vec<Option<Known>>,
}

/// Properties of a collider.
#[derive(Clone, Copy)]
struct Known {
    handle: ColliderHandle,
    shape: Handle,
    awake: bool,
}

/// Contacts of sub-steps of one length.
#[derive(Default)]
struct Batch {
    /// Seconds.
    step: f64,
    touches: Vec<Touch>,
    points: Vec<TouchPoint>,
}

/// Points of two shapes with one normal and one friction.
struct Touch {
    shapes: [Handle; 2],
    /// Points to the first shape.
    normal: Vector,
    /// Impulse of the friction at each point: rapier solves it as one, so that the points have equal shares.
    friction: Vector,
    /// In `points`.
    points: Range<usize>,
}

struct TouchPoint {
    place: Vector,
    /// Impulse along the normal.
    impulse: f64,
}

impl ContactLog {
    pub(super) fn clear(&mut self) {
        self.awake.touches.clear();
        self.awake.points.clear();
        self.sub_steps.clear();
    }

    /// Bodies came or went.
    pub(super) fn forget_resting(&mut self) {
        self.resting.awake = None;
    }

    /// Adds the contacts of the sub-step of `step` seconds the engine has just made, and those of what is soft.
    pub(super) fn add_sub_step(
        &mut self,
        world: &World,
        ground: &ExactContacts,
        soft: &[SoftTouch],
        step: f64,
    ) {
        self.resting.follow(world, ground, step);
        let first = self.awake.touches.len();
        self.awake.step = step;
        if self.resting.is_anybody_awake() {
            self.awake
                .add_pairs(world, |pair| self.resting.shapes(pair, true));
        }
        let awake = ground.points().iter();
        self.awake
            .add_points(awake.filter(|point| self.resting.is_awake(point.colliders) == Some(true)));
        for touch in soft {
            let (normal, impulse) = (touch.normal, touch.impulse);
            self.awake
                .add_touch(touch.shapes, touch.place, normal, impulse);
        }
        let touches = first..self.awake.touches.len();
        self.sub_steps.push(SubStepContacts {
            touches,
            resting: self.resting.contacts.clone(),
        });
    }

    /// All contacts, in the order of the sub-steps.
    pub(super) fn iter(&self) -> impl Iterator<Item = Contact> {
        (0..)
            .zip(&self.sub_steps)
            .flat_map(move |(number, sub_step)| {
                let awake = self.awake.contacts(sub_step.touches.clone(), number);
                awake.chain(
                    sub_step
                        .resting
                        .contacts(0..sub_step.resting.touches.len(), number),
                )
            })
    }
}

impl Resting {
    /// Updates the set of sleeping bodies if it has changed.
    fn follow(&mut self, world: &World, ground: &ExactContacts, step: f64) {
        if self
            .awake
            .as_ref()
            .is_some_and(|awake| world.awake().eq(awake.iter().copied()))
        {
            return;
        }
        self.awake = Some(world.awake().collect());
        self.know_colliders(world);
        let mut contacts = Batch {
            step,
            ..Batch::default()
        };
        contacts.add_pairs(world, |pair| self.shapes(pair, false));
        let mut exact = std::mem::take(&mut self.exact);
        exact.extend_from_slice(ground.points());
        exact.retain(|point| self.is_awake(point.colliders) == Some(false));
        contacts.add_points(exact.iter());
        self.exact = exact;
        self.contacts = Rc::new(contacts);
    }

    fn know_colliders(&mut self, world: &World) {
        self.colliders.clear();
        for (handle, collider) in world.colliders.iter() {
            let index = index_of(handle);
            self.colliders
                .resize(self.colliders.len().max(index + 1), None);
            let shape = Tag::unpack(collider.user_data).shape;
            self.colliders[index] = Some(Known {
                handle,
                shape,
                awake: false,
            });
        }
        for rigid in world.awake().filter_map(|handle| world.bodies.get(handle)) {
            for &collider in rigid.colliders() {
                if let Some(Some(known)) = self.colliders.get_mut(index_of(collider)) {
                    known.awake = true;
                }
            }
        }
    }

    fn is_anybody_awake(&self) -> bool {
        self.awake.as_ref().is_some_and(|awake| !awake.is_empty())
    }

    /// Whether one of two colliders is awake; None when one is gone.
    fn is_awake(&self, [first, second]: [ColliderHandle; 2]) -> Option<bool> {
        let known = |handle| {
            let known = self.colliders.get(index_of(handle)).copied().flatten();
            known.filter(|known| known.handle == handle)
        };
        Some(known(first)?.awake || known(second)?.awake)
    }

    /// The shapes of a pair, if whether one of them is awake is as asked.
    fn shapes(&self, pair: &ContactPair, awake: bool) -> Option<[Handle; 2]> {
        let [a, b] =
            [pair.collider1, pair.collider2].map(|collider| self.colliders.get(index_of(collider)));
        let (a, b) = ((*a?)?, (*b?)?);
        ((a.awake || b.awake) == awake).then_some([a.shape, b.shape])
    }
}

fn index_of(collider: ColliderHandle) -> usize {
    collider.into_raw_parts().0 as usize
}

impl Batch {
    /// Adds the contacts of the pairs of which `shapes` tells the shapes.
    fn add_pairs(&mut self, world: &World, shapes: impl Fn(&ContactPair) -> Option<[Handle; 2]>) {
        for pair in world.narrow_phase.contact_pairs() {
            let Some(shapes) = shapes(pair) else { continue };
            for manifold in pair
                .solver_manifolds()
                .iter()
                .filter(|manifold| !manifold.data.solver_contacts.is_empty())
            {
                self.add_manifold(world, manifold, shapes);
            }
        }
    }

    /// Adds the contacts that mechanisms solve.
    fn add_points<'a>(&mut self, points: impl Iterator<Item = &'a Point>) {
        for point in points {
            self.add_touch(point.shapes, point.place(), point.normal, point.impulse);
        }
    }

    /// Adds a point with the impulse on the first shape, to which the normal points; none where nothing is pressed.
    fn add_touch(&mut self, shapes: [Handle; 2], place: Vector, normal: Vector, impulse: Vector) {
        let pressed = impulse.dot(normal);
        if pressed == 0.0 || !impulse.is_finite() {
            return;
        }
        let first = self.points.len();
        self.points.push(TouchPoint {
            place,
            impulse: pressed,
        });
        self.touches.push(Touch {
            shapes,
            normal,
            friction: impulse - normal * pressed,
            points: first..first + 1,
        });
    }

    fn add_manifold(&mut self, world: &World, manifold: &ContactManifold, shapes: [Handle; 2]) {
        let first = self.touches.len();
        let sides = Sides::new(world, &manifold.data);
        // rapier's normal points from the first shape to the second.
        let normal = -manifold.data.normal;
        let share = parts_of_impulse(manifold) / manifold.data.solver_contacts.len() as f64;
        for contact in &manifold.data.solver_contacts {
            let Some(found) = manifold.points.get(contact.contact_indices()[0] as usize) else {
                continue;
            };
            let (impulse, tangent) = (found.data.impulse, found.data.warmstart_tangent_world);
            if impulse == 0.0 || !impulse.is_finite() || !tangent.is_finite() {
                continue;
            }
            self.points.push(TouchPoint {
                place: sides.middle(contact.anchor1, contact.anchor2),
                impulse,
            });
            let (friction, end) = (tangent * share, self.points.len());
            match self.touches[first..]
                .last_mut()
                .filter(|touch| touch.friction == friction)
            {
                Some(touch) => touch.points.end = end,
                None => self.touches.push(Touch {
                    shapes,
                    normal,
                    friction,
                    points: end - 1..end,
                }),
            }
        }
    }

    fn contacts(&self, touches: Range<usize>, sub_step: u32) -> impl Iterator<Item = Contact> {
        self.touches[touches]
            .iter()
            .flat_map(move |touch| self.contacts_of(touch, sub_step))
    }

    fn contacts_of(&self, touch: &Touch, sub_step: u32) -> impl Iterator<Item = Contact> {
        self.points[touch.points.clone()]
            .iter()
            .map(move |point| Contact {
                sub_step,
                shapes: touch.shapes,
                point: from_vector(point.place),
                force: from_vector((touch.normal * point.impulse + touch.friction) / self.step),
                normal: from_vector(touch.normal),
            })
    }
}

/// Where the two sides of a manifold are: what rapier's `solver_contact_world_points` looks up for every point.
struct Sides([Option<(EnginePose, Vector)>; 2]);

impl Sides {
    fn new(world: &World, data: &ContactManifoldData) -> Self {
        let side = |handle: Option<RigidBodyHandle>, is_world: bool| {
            let rigid = world.bodies.get(handle.filter(|_| !is_world)?)?;
            Some((
                *rigid.position(),
                rigid.mass_properties().local_mprops.local_com,
            ))
        };
        Self([
            side(data.rigid_body1, data.relative_dominance > 0),
            side(data.rigid_body2, data.relative_dominance < 0),
        ])
    }

    /// Halfway between the two surfaces; anchors are relative to the centres of mass of bodies that move.
    fn middle(&self, first: Vector, second: Vector) -> Vector {
        let place = |side: &Option<(EnginePose, Vector)>, anchor: Vector| match side {
            Some((pose, com)) => *pose * (*com + anchor),
            None => anchor,
        };
        (place(&self.0[0], first) + place(&self.0[1], second)) * 0.5
    }
}
