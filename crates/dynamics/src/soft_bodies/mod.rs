//! Ropes, cloths and volumes of the scene, moved by the crate `soft`.
//!
//! They move at the beginning of each sub-step, from where the bodies are. What they do to bodies that move is applied as forces in that sub-step. A body
//! resists with all that it is linked with: mechanisms are solved once without them, which says where bodies would go and what an impulse changes. Ropes that touch no
//! cloth or volume are solved first, then cloths and volumes with the ropes that touch them, with the bodies as the first ones leave them.

mod between;
mod coupling;
mod group;
mod held;
mod obstacle;
mod part;
mod seen;
mod touches;

use std::rc::Rc;

use nalgebra::Vector6;
use rapier3d_f64::prelude::RigidBody;
use scene::shape::soft::Soft;
use scene::{Handle, Scene};
use soft::fem::{self, Deformable};
use soft::{Contact, Rod, SoftSystem, Step, V3, solve_system};

use crate::bodies::{Bodies, Tag};
use crate::contacts::{ContactResponse, Verdicts};
use crate::convert::to_vector;
use crate::plan::{FrictionRule, SoftPlan};
use crate::world::World;
use coupling::Coupled;
use group::Group;
use held::Held;
use obstacle::Sides;

pub(super) use coupling::Response;

/// Velocity that a body may have beside the expected one, by 1 m/s more than that.
const EXPECTED: f64 = 2e-3;

/// What is soft in a scene.
#[derive(Default)]
pub(super) struct SoftBodies {
    ropes: Group<Rod>,
    bodies: Group<Deformable>,
    coupled: Coupled,
    /// The impulses that coupled bodies have received in this sub-step, and the velocities that they get by them.
    impulses: Vec<Vector6<f64>>,
    expected: Vec<Vector6<f64>>,
    /// Whether rigid bodies have forces of soft ones.
    pub have_pushed: bool,
}

/// A rope, cloth or volume in the physics.
struct Placed {
    shape: Handle,
    plan: SoftPlan,
    held: Vec<Held>,
    sides: Sides,
}

/// What soft bodies start from in a sub-step.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub verdicts: &'a Verdicts,
    pub gravity: [f64; 3],
    /// Seconds.
    pub step: f64,
    /// The part of the call that is over at the end of the sub-step.
    pub fraction: f64,
}

impl SoftBodies {
    pub(super) fn is_empty(&self) -> bool {
        self.ropes.is_empty() && self.bodies.is_empty()
    }

    /// What a text says, if a shape is known by it.
    pub(super) fn known(&self, shape: Handle, text: &str) -> Option<Rc<Soft>> {
        let placed = self
            .ropes
            .placed(shape)
            .or_else(|| self.bodies.placed(shape));
        placed?.plan.known(text)
    }

    /// Makes the soft bodies those of the plan; those that are the same go on as they are.
    pub(super) fn apply_plan(
        &mut self,
        plan: Vec<(Handle, SoftPlan)>,
        bodies: &Bodies,
        world: &World,
        scene: &mut Scene,
    ) {
        let is_rope = |(_, plan): &(Handle, SoftPlan)| matches!(*plan.soft, Soft::Rope(_));
        let (ropes, others) = plan.into_iter().partition(is_rope);
        self.ropes.apply_plan(ropes, bodies, world, scene);
        self.bodies.apply_plan(others, bodies, world, scene);
    }

    /// Whether a script has put one of them elsewhere.
    pub(super) fn were_touched(&self, scene: &Scene) -> bool {
        self.ropes.were_touched(scene) || self.bodies.were_touched(scene)
    }

    /// Reads where the objects are that hold them, and do so at the end of the call.
    pub(super) fn follow(&mut self, scene: &Scene) {
        self.ropes.follow(scene);
        self.bodies.follow(scene);
    }

    /// Finds what they touch and what holds them; whether rigid bodies take part.
    pub(super) fn look_around(&mut self, bodies: &Bodies, world: &World, start: Start<'_>) -> bool {
        self.coupled.clear();
        self.impulses.clear();
        let coupled = &mut self.coupled;
        self.ropes.hold(bodies, world, start, coupled);
        self.bodies.hold(bodies, world, start, coupled);
        let mut contacts = self.ropes.search(bodies, world, start, coupled);
        contacts.extend(between::ropes(&self.ropes, start));
        Contact::carry_on(&mut contacts, &mut self.ropes.contacts);
        self.ropes.contacts = contacts;
        let mut contacts = self.bodies.search(bodies, world, start, coupled);
        contacts.extend(between::touching(&self.bodies, &self.ropes, start));
        fem::Contact::carry_on(&mut contacts, &mut self.bodies.contacts);
        self.bodies.contacts = contacts;
        !self.coupled.is_empty()
    }

    /// The shapes of rigid bodies that take part.
    pub(super) fn coupled_shapes(&self) -> Vec<Handle> {
        self.coupled.shapes().collect()
    }

    /// Moves them, and applies to the rigid bodies what they do to them. `responses`: of these, with what was applied in this sub-step before, in the order of
    /// [`coupled_shapes`](Self::coupled_shapes).
    pub(super) fn solve(&mut self, responses: Vec<Response>, world: &mut World, start: Start<'_>) {
        let step = Step {
            gravity: V3::from(start.gravity),
            length: start.step,
        };
        let mut rigid: Vec<soft::Body> = responses.into_iter().map(Response::body).collect();
        let applied = std::mem::take(&mut self.impulses);
        for (body, applied) in rigid.iter_mut().zip(&applied) {
            body.velocity -= body.response * applied;
        }
        if !rigid.is_empty() {
            self.ropes.remember();
            self.bodies.remember();
        }
        self.impulses = self.move_parts(&mut rigid, step);
        self.have_pushed = !rigid.is_empty();
        let applied = applied
            .into_iter()
            .chain(std::iter::repeat(Vector6::zeros()));
        for ((handle, impulse), applied) in self.coupled.rigids().zip(&self.impulses).zip(applied) {
            let rigid = world.bodies.get_mut(handle);
            if let Some(rigid) = rigid.filter(|rigid| rigid.is_dynamic()) {
                push(rigid, &(impulse - applied), start.step);
            }
        }
        self.expected = rigid.into_iter().map(|body| body.velocity).collect();
    }

    /// The impulses on rigid bodies, which have their velocities after these.
    fn move_parts(&mut self, rigid: &mut [soft::Body], step: Step) -> Vec<Vector6<f64>> {
        let all = SoftSystem {
            rods: &mut self.ropes.parts,
            rod_contacts: &mut self.ropes.contacts,
            parts: &mut self.bodies.parts,
            contacts: &mut self.bodies.contacts,
        };
        solve_system(all, rigid, step)
    }

    /// Whether coupled bodies get the velocities with which the soft ones were solved; None: what nothing but impulses changes.
    pub(super) fn are_expected(
        &self,
        velocities: impl Iterator<Item = Option<Vector6<f64>>>,
    ) -> bool {
        let mut pairs = self.expected.iter().zip(velocities);
        pairs.all(|(expected, velocity)| {
            velocity.is_none_or(|velocity| {
                let missing = (velocity - expected).fixed_rows::<3>(0).norm();
                missing < EXPECTED * (1.0 + expected.fixed_rows::<3>(0).norm())
            })
        })
    }

    /// The soft bodies move as before they were solved; the rigid ones keep the forces, which the next solution replaces.
    pub(super) fn go_back(&mut self) {
        self.ropes.go_back();
        self.bodies.go_back();
    }

    /// Tells the scene where they are.
    pub(super) fn report(&self, scene: &mut Scene) {
        self.ropes.report(scene);
        self.bodies.report(scene);
    }
}

fn push(rigid: &mut RigidBody, impulse: &Vector6<f64>, step: f64) {
    let part = |first: usize| {
        let part = impulse.fixed_rows::<3>(first) / step;
        to_vector([part[0], part[1], part[2]])
    };
    rigid.add_force(part(0), true);
    rigid.add_torque(part(3), true);
}

impl Placed {
    fn tag(&self) -> Tag {
        Tag::new(self.shape, &self.plan.surface)
    }

    /// Friction with something with that friction.
    fn friction(&self, other: f64) -> f64 {
        let own = self.plan.surface.friction;
        match self.plan.surface.friction_rule {
            FrictionRule::Product => own * other,
            FrictionRule::Largest => own.max(other),
        }
    }

    /// The same, if scripts and masks let them touch.
    fn friction_in(&self, response: ContactResponse, other: f64) -> Option<f64> {
        match response {
            ContactResponse::NoCollision => None,
            ContactResponse::Collide { friction, .. } => Some(friction),
            ContactResponse::Default => Some(self.friction(other)),
        }
    }
}
