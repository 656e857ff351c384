//! Ropes of the scene, moved by the crate `soft`.
//!
//! They move at the beginning of each sub-step, from where the bodies are. What they do to bodies that move is applied as forces in that sub-step. A body
//! resists with all that it is linked with: mechanisms are solved once without the ropes, which says where bodies would go and what an impulse changes.

mod coupling;
mod held;
mod search;

use std::collections::BTreeMap;

use nalgebra::Point3;
use rapier3d_f64::prelude::RigidBody;
use soft::{Contact, Material, Rod, Step, V3};

use crate::bodies::{Bodies, Tag};
use crate::contacts::{ContactResponse, Verdicts};
use crate::convert::to_vector;
use crate::plan::{FrictionRule, RopePlan};
use crate::world::World;
use coupling::Coupled;
use held::Held;
use scene::shape::rope::{Rope, RopeForm};
use scene::{Field, Handle, Scene};

pub(super) use coupling::Response;

/// Ropes that come nearer than this to each other are looked at, metres, beside what they move in a sub-step.
const MARGIN: f64 = 1e-3;

/// The ropes of a scene.
#[derive(Default)]
pub(super) struct Ropes {
    all: Vec<Placed>,
    /// In the order of `all`, as the solver takes them.
    rods: Vec<Rod>,
    contacts: Vec<Contact>,
    coupled: Coupled,
    /// Whether bodies have forces of ropes.
    pub have_pushed: bool,
}

/// A rope in the physics.
struct Placed {
    shape: Handle,
    plan: RopePlan,
    held: Vec<Held>,
}

/// What the ropes of a sub-step start from.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub verdicts: &'a Verdicts,
    pub gravity: [f64; 3],
    /// Seconds.
    pub step: f64,
    /// The part of the call that is over at the end of the sub-step.
    pub fraction: f64,
}

impl Ropes {
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Makes the ropes those of the plan; those that are the same go on as they are.
    pub(super) fn apply_plan(
        &mut self,
        plan: Vec<(Handle, RopePlan)>,
        bodies: &Bodies,
        world: &World,
        scene: &mut Scene,
    ) {
        let old = std::mem::take(&mut self.all).into_iter();
        let mut known: BTreeMap<Handle, (Placed, Rod)> = old
            .zip(std::mem::take(&mut self.rods))
            .map(|(placed, rod)| (placed.shape, (placed, rod)))
            .collect();
        for (shape, plan) in plan {
            let is_same = |placed: &Placed| placed.plan.is_same_rope(&plan);
            let before = known.remove(&shape).filter(|(placed, _)| is_same(placed));
            let is_put = scene
                .object(shape)
                .is_ok_and(|object| object.dynamics_reset);
            let (mut rod, before) = match before {
                Some((placed, mut rod)) => {
                    if is_put {
                        put(&mut rod, shape, scene);
                    }
                    (rod, Some(placed))
                }
                None => match new_rod(shape, &plan.rope, scene) {
                    Some(rod) => (rod, None),
                    None => continue,
                },
            };
            if is_put {
                // The object was just read.
                let _ = scene.modify(shape, Field::Dynamics, |object| {
                    object.dynamics_reset = false;
                });
            }
            if before
                .as_ref()
                .is_none_or(|placed| placed.plan.pins != plan.pins)
            {
                rod.forget_history();
            }
            let held = Held::all(
                &plan,
                &rod,
                before.map_or(Vec::new(), |placed| placed.held),
                bodies,
                world,
                scene,
            );
            self.all.push(Placed { shape, plan, held });
            self.rods.push(rod);
        }
        self.contacts.clear();
    }

    /// Whether a script has put a rope elsewhere.
    pub(super) fn were_touched(&self, scene: &Scene) -> bool {
        let is_put = |placed: &Placed| {
            let object = scene.object(placed.shape);
            object.is_ok_and(|object| object.dynamics_reset)
        };
        self.all.iter().any(is_put)
    }

    /// Reads where the objects are that hold the ropes, and do so at the end of the call.
    pub(super) fn follow(&mut self, scene: &Scene) {
        for held in self.all.iter_mut().flat_map(|placed| &mut placed.held) {
            held.follow(scene);
        }
    }

    /// Finds what the ropes touch and what holds them; whether bodies take part.
    pub(super) fn look_around(&mut self, bodies: &Bodies, world: &World, start: Start<'_>) -> bool {
        self.coupled.clear();
        for (placed, rod) in self.all.iter().zip(&mut self.rods) {
            rod.holds.clear();
            for held in &placed.held {
                let holds = held.hold(start.fraction, bodies, world, &mut self.coupled);
                rod.holds.extend(holds);
            }
        }
        let mut contacts = Vec::new();
        for (number, placed) in self.all.iter().enumerate() {
            let search = search::Search {
                number,
                placed,
                rod: &self.rods[number],
                bodies,
                world,
                start,
            };
            search.run(&mut contacts, &mut self.coupled);
        }
        contacts.extend(self.between(start));
        Contact::carry_on(&mut contacts, &mut self.contacts);
        self.contacts = contacts;
        !self.coupled.is_empty()
    }

    /// Where ropes touch each other and themselves.
    fn between(&self, start: Start<'_>) -> Vec<Contact> {
        if let [alone] = &self.all[..]
            && !alone.plan.rope.touches_itself
        {
            return Vec::new();
        }
        let fastest = self
            .rods
            .iter()
            .flat_map(|rod| (0..rod.len()).map(|i| rod.velocity(i).norm()));
        let margin = MARGIN + 2.0 * fastest.fold(0.0, f64::max) * start.step;
        soft::between(&self.rods, margin, |first, second| {
            let [a, b] = [first, second].map(|number| &self.all[number]);
            if first == second {
                return a
                    .plan
                    .rope
                    .touches_itself
                    .then(|| a.friction(b.plan.surface.friction));
            }
            let response = start.verdicts.response(a.tag(), b.tag());
            a.friction_in(response, b.plan.surface.friction)
        })
    }

    /// The shapes of bodies that take part.
    pub(super) fn coupled_shapes(&self) -> Vec<Handle> {
        self.coupled.shapes().collect()
    }

    /// Moves the ropes, and applies to the bodies what they do to them. `responses`: of the bodies, in the order of [`coupled_shapes`](Self::coupled_shapes).
    pub(super) fn solve(&mut self, responses: Vec<Response>, world: &mut World, start: Start<'_>) {
        let step = Step {
            gravity: V3::from(start.gravity),
            length: start.step,
        };
        let mut bodies: Vec<soft::Body> = responses.into_iter().map(Response::body).collect();
        let is_solved = soft::solve(&mut self.rods, &mut bodies, &mut self.contacts, step);
        self.have_pushed = is_solved && !bodies.is_empty();
        if !self.have_pushed {
            return;
        }
        for (rigid, body) in self.coupled.rigids().zip(&bodies) {
            if let Some(rigid) = world
                .bodies
                .get_mut(rigid)
                .filter(|rigid| rigid.is_dynamic())
            {
                push(rigid, body, start.step);
            }
        }
    }

    /// Tells the scene where the ropes are.
    pub(super) fn report(&self, scene: &mut Scene) {
        for (placed, rod) in self.all.iter().zip(&self.rods) {
            let edges = 0..rod.len() - 1;
            let form = RopeForm {
                points: rod.points().map(Into::into).collect(),
                tensions: rod.tensions().to_vec(),
                broken: edges.map(|edge| rod.is_broken(edge)).collect(),
                pin_forces: placed.held.iter().map(|held| held.force(rod)).collect(),
            };
            // The shape may have been removed in the meantime.
            let _ = scene.report_rope(placed.shape, Some(form));
        }
    }
}

fn push(rigid: &mut RigidBody, body: &soft::Body, step: f64) {
    let part = |first: usize| {
        let part = body.impulse.fixed_rows::<3>(first) / step;
        to_vector([part[0], part[1], part[2]])
    };
    rigid.add_force(part(0), true);
    rigid.add_torque(part(3), true);
}

/// A rope where its shape is.
fn new_rod(shape: Handle, rope: &Rope, scene: &Scene) -> Option<Rod> {
    let points = points_of(shape, scene)?;
    let material = Material {
        radius: rope.radius,
        line_density: rope.line_density,
        stretch: rope.stretch,
        bend: rope.bend,
        twist: rope.twist,
        damping: rope.damping,
        drag: rope.drag,
        strength: rope.strength,
    };
    let length = (rope.length > 0.0).then_some(rope.length);
    Rod::new(&points, length, rope.straight, material)
}

/// Puts a rope where a script has put it.
fn put(rod: &mut Rod, shape: Handle, scene: &Scene) {
    let Ok(form) = scene.rope_form(shape) else {
        return;
    };
    let points: Vec<V3> = form.points.iter().map(|point| V3::from(*point)).collect();
    let has_moved = rod
        .points()
        .zip(&points)
        .any(|(here, there)| here != *there);
    if has_moved {
        rod.set_motion(&points, &vec![V3::zeros(); points.len()]);
    }
    let broken = form
        .broken
        .iter()
        .enumerate()
        .filter(|(_, is_broken)| **is_broken);
    for (edge, _) in broken {
        if !rod.is_broken(edge) {
            rod.break_edge(edge);
        }
    }
}

fn points_of(shape: Handle, scene: &Scene) -> Option<Vec<V3>> {
    let form = scene.rope_form(shape).ok()?;
    let points = form.points.iter().map(|point| Point3::from(*point).coords);
    Some(points.collect())
}

impl Placed {
    fn tag(&self) -> Tag {
        Tag::new(self.shape, &self.plan.surface)
    }

    /// Friction between this rope and something with that friction.
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
