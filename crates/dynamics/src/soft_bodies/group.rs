//! All ropes, or all cloths and volumes.

use std::collections::BTreeMap;

use nalgebra::Point3;
use scene::shape::soft::SoftForm;
use scene::{Field, Handle, Scene};
use soft::V3;

use super::coupling::Coupled;
use super::held::Held;
use super::obstacle::{Found, Search, Sides};
use super::part::Part;
use super::{Placed, Start};
use crate::bodies::Bodies;
use crate::plan::SoftPlan;
use crate::world::World;

/// Soft bodies of one kind.
pub(super) struct Group<P: Part> {
    pub all: Vec<Placed>,
    /// In the order of `all`, as the solver takes them.
    pub parts: Vec<P>,
    pub contacts: Vec<P::Contact>,
    /// How the parts moved and what their contacts were before they were solved.
    start: Option<Beginning<P>>,
}

/// How parts move, and their contacts.
type Beginning<P> = (Vec<<P as Part>::State>, Vec<<P as Part>::Contact>);

impl<P: Part> Default for Group<P> {
    fn default() -> Self {
        Self {
            all: Vec::new(),
            parts: Vec::new(),
            contacts: Vec::new(),
            start: None,
        }
    }
}

impl<P: Part> Group<P> {
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(super) fn placed(&self, shape: Handle) -> Option<&Placed> {
        self.all.iter().find(|placed| placed.shape == shape)
    }

    pub(super) fn apply_plan(
        &mut self,
        plan: Vec<(Handle, SoftPlan)>,
        bodies: &Bodies,
        world: &World,
        scene: &mut Scene,
    ) {
        let old = std::mem::take(&mut self.all).into_iter();
        let mut known: BTreeMap<Handle, (Placed, P)> = old
            .zip(std::mem::take(&mut self.parts))
            .map(|(placed, part)| (placed.shape, (placed, part)))
            .collect();
        for (shape, plan) in plan {
            let is_same = |placed: &Placed| placed.plan.is_same(&plan);
            let before = known.remove(&shape).filter(|(placed, _)| is_same(placed));
            let is_put = scene
                .object(shape)
                .is_ok_and(|object| object.dynamics_reset);
            let (mut part, before) = match before {
                Some((placed, mut part)) => {
                    if is_put && let Ok(form) = scene.soft_form(shape) {
                        part.put(&form);
                    }
                    (part, Some(placed))
                }
                None => match new_part(shape, &plan, scene) {
                    Some(part) => (part, None),
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
                part.forget_history();
            }
            let (known_pins, sides) = before.map_or_else(Default::default, |placed| {
                (
                    placed.held,
                    if is_put { Sides::new() } else { placed.sides },
                )
            });
            let held = Held::all(&plan, &part, known_pins, bodies, world, scene);
            self.all.push(Placed {
                shape,
                plan,
                held,
                sides,
            });
            self.parts.push(part);
        }
        self.contacts.clear();
    }

    pub(super) fn were_touched(&self, scene: &Scene) -> bool {
        let is_put = |placed: &Placed| {
            let object = scene.object(placed.shape);
            object.is_ok_and(|object| object.dynamics_reset)
        };
        self.all.iter().any(is_put)
    }

    pub(super) fn follow(&mut self, scene: &Scene) {
        for held in self.all.iter_mut().flat_map(|placed| &mut placed.held) {
            held.follow(scene);
        }
    }

    /// Says what holds them in a sub-step.
    pub(super) fn hold(
        &mut self,
        bodies: &Bodies,
        world: &World,
        start: Start<'_>,
        coupled: &mut Coupled,
    ) {
        for (placed, part) in self.all.iter().zip(&mut self.parts) {
            let holds = part.holds();
            holds.clear();
            for held in &placed.held {
                holds.extend(held.hold(start.fraction, bodies, world, coupled));
            }
        }
    }

    /// Finds the points at which they may touch what collides.
    pub(super) fn search(
        &mut self,
        bodies: &Bodies,
        world: &World,
        start: Start<'_>,
        coupled: &mut Coupled,
    ) -> Vec<P::Contact> {
        let mut contacts = Vec::new();
        for (number, placed) in self.all.iter_mut().enumerate() {
            let sides = std::mem::take(&mut placed.sides);
            let search = Search {
                number,
                sides: &sides,
                placed,
                bodies,
                world,
                start,
            };
            let mut found = Found {
                contacts,
                sides: Sides::new(),
            };
            search.run(&self.parts[number], &mut found, coupled);
            (contacts, placed.sides) = (found.contacts, found.sides);
        }
        contacts
    }

    /// Remembers how the parts move, to go back there.
    pub(super) fn remember(&mut self) {
        let states = self.parts.iter().map(Part::state).collect();
        self.start = Some((states, self.contacts.clone()));
    }

    /// The parts move as they were remembered.
    pub(super) fn go_back(&mut self) {
        if let Some((states, contacts)) = self.start.take() {
            for (part, state) in self.parts.iter_mut().zip(states) {
                part.set_state(state);
            }
            self.contacts = contacts;
        }
    }

    pub(super) fn report(&self, scene: &mut Scene) {
        for (placed, part) in self.all.iter().zip(&self.parts) {
            let tensions = part.tensions();
            let form = SoftForm {
                points: (0..part.len())
                    .map(|node| part.point(node).into())
                    .collect(),
                broken: (0..tensions.len()).map(|i| part.is_broken(i)).collect(),
                tensions,
                pressure: part.pressure(),
                pin_forces: placed.held.iter().map(|held| held.force(part)).collect(),
            };
            // The shape may have been removed in the meantime.
            let _ = scene.report_soft_form(placed.shape, &placed.plan.soft, Some(form));
        }
    }
}

/// Something soft where its shape is.
fn new_part<P: Part>(shape: Handle, plan: &SoftPlan, scene: &Scene) -> Option<P> {
    let form = scene.soft_form(shape).ok()?;
    let points = form.points.iter().map(|point| Point3::from(*point).coords);
    let points: Vec<V3> = points.collect();
    let mut part = P::new(&plan.soft, &points)?;
    part.put(&form);
    Some(part)
}
