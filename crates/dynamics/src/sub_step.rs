//! A sub-step: forces, soft bodies and mechanisms, then what is left to the engine.

use std::sync::Arc;

use rapier3d_f64::math::Vector;
use scene::{Handle, Scene};

use super::{Dynamics, DynamicsCall, gravity_of};
use crate::contacts::{self, ColliderPair, ContactCallback, Verdicts};
use crate::soft_bodies::{self, Response};
use crate::world::World;
use crate::{adhesion, convert};

/// How often soft bodies and the bodies that they push are solved in a sub-step, at most, until both agree.
const MAX_ATTEMPTS: usize = 4;

/// Whether scripts can reach the scene around a sub-step.
#[derive(Debug, Clone, Copy, Default)]
pub struct ScriptAccess {
    /// Scripts run before, during or after the sub-step and may read and change the scene.
    pub possible: bool,
}

/// A sub-step ready to run. Holds the engine, so that a script called meanwhile finds no physics to disturb.
pub struct SubStep {
    pub(super) world: Box<World>,
    pub(super) gravity: Vector,
    pub(super) step: f64,
    /// Whether scripts can read the scene before the next sub-step.
    pub(super) seen: bool,
    pub(super) verdicts: Verdicts,
    /// The pairs of colliders that mechanisms solve.
    pub(super) apart: Vec<ColliderPair>,
    /// Whether the mechanisms have moved all that moves, so that the engine only detects collisions.
    pub(super) is_integrated: bool,
    /// Whether that is known as well, so that the engine has nothing to do.
    pub(super) is_known: bool,
}

impl SubStep {
    /// Advances the engine; `callback` decides about pairs of shapes that may touch.
    pub fn run(&mut self, callback: Option<ContactCallback<'_>>) {
        if self.is_known {
            return;
        }
        let verdicts = std::mem::take(&mut self.verdicts);
        let surfaces = Arc::clone(&self.world.surfaces);
        let rules = contacts::Rules::new(callback, verdicts, &self.apart, surfaces);
        if self.is_integrated {
            self.world.detect_collisions(self.gravity, &rules);
        } else {
            self.world.step(self.step, self.gravity, &rules);
        }
    }
}

impl Dynamics {
    /// Prepares sub-step number `sub_step` (from 1): forces of scripts, gravity. `verdicts`: what scripts decided about contacts.
    pub fn start_sub_step(
        &mut self,
        scene: &Scene,
        sub_step: u32,
        script_access: ScriptAccess,
        mut verdicts: Verdicts,
    ) -> Option<SubStep> {
        let mut world = self.world.take()?;
        verdicts.add_rules(&self.pairs);
        let call = self.call?;
        let gravity = gravity_of(scene);
        // Nobody else can have changed the forces since the first sub-step.
        let was_pushed = self.soft_bodies.have_pushed
            || self.particles.have_pushed
            || self.have_adhered
            || self.tendons.have_pulled;
        let is_pushed = self.bodies.are_in_fluid || was_pushed;
        if sub_step == 1 || script_access.possible || is_pushed {
            self.bodies
                .apply_forces(&mut world, scene, gravity, call.step);
        }
        self.particles.push(&mut world, call.step);
        self.tendons
            .pull(&self.bodies, &self.links, &mut world, gravity, call.step);
        self.have_adhered = adhesion::pull(&self.bodies, &mut world, &verdicts);
        for link in self.links.values_mut() {
            link.before_step(&world);
        }
        self.move_soft_bodies(&mut world, gravity, call, sub_step, &verdicts);
        let is_integrated = self.solve_mechanisms(&mut world, gravity, call.step, &verdicts);
        let apart = self.mechanisms.contacts().pairs(&mut world, &verdicts);
        let is_known = is_integrated
            && !script_access.possible
            && self.soft_bodies.is_empty()
            && scene.drawings().particles().is_empty()
            && !self.bodies.are_adhering
            && self.mechanisms.know_surroundings(&mut world);
        if !is_known {
            contacts::set_hooks(&mut world, &verdicts, &apart);
        }
        if !is_integrated {
            world.divide_touching(|collider| self.mechanisms.solves(collider));
            self.mechanisms.note_parts(&mut self.links, &mut world);
        }
        let seen = script_access.possible || sub_step == call.sub_steps;
        let gravity = convert::to_vector(gravity);
        Some(SubStep {
            world,
            gravity,
            step: call.step,
            seen,
            verdicts,
            apart,
            is_integrated,
            is_known,
        })
    }

    /// Moves the soft bodies, and applies to the bodies what they do to them.
    fn move_soft_bodies(
        &mut self,
        world: &mut World,
        gravity: [f64; 3],
        call: DynamicsCall,
        sub_step: u32,
        verdicts: &Verdicts,
    ) {
        self.soft_bodies.have_pushed = false;
        if self.soft_bodies.is_empty() {
            return;
        }
        let start = soft_bodies::Start {
            verdicts,
            gravity,
            step: call.step,
            fraction: f64::from(sub_step) / f64::from(call.sub_steps),
        };
        if !self.soft_bodies.look_around(&self.bodies, world, start) {
            self.soft_bodies.solve(Vec::new(), world, start);
            return;
        }
        for attempt in 1..=MAX_ATTEMPTS {
            self.solve_coupled(world, gravity, call.step, verdicts);
            let shapes = self.soft_bodies.coupled_shapes().into_iter();
            let responses = shapes
                .filter_map(|shape| self.response_of(shape, world, gravity, call.step))
                .collect();
            self.soft_bodies.solve(responses, world, start);
            if attempt == MAX_ATTEMPTS || self.go_as_expected(world, gravity, call.step, verdicts) {
                break;
            }
            self.soft_bodies.go_back();
        }
    }

    /// Solves the mechanisms with the forces that bodies have.
    fn solve_coupled(
        &mut self,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
        verdicts: &Verdicts,
    ) {
        let (links, bodies, workers) = (&mut self.links, &self.bodies, &mut self.workers);
        let tendons = &self.tendons;
        self.mechanisms.solve(
            links, bodies, world, gravity, step, verdicts, tendons, workers,
        );
    }

    /// Whether bodies of mechanisms get the velocities with which the soft bodies were solved. They do not where a motor has come to its limit, or a contact opens.
    fn go_as_expected(
        &mut self,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
        verdicts: &Verdicts,
    ) -> bool {
        let shapes = self.soft_bodies.coupled_shapes();
        if shapes
            .iter()
            .all(|shape| self.mechanisms.velocity(*shape).is_none())
        {
            return true;
        }
        self.solve_coupled(world, gravity, step, verdicts);
        let velocities = shapes
            .into_iter()
            .map(|shape| self.mechanisms.velocity(shape));
        self.soft_bodies.are_expected(velocities)
    }

    /// Where a body would go without soft bodies, and what an impulse changes.
    fn response_of(
        &mut self,
        shape: Handle,
        world: &World,
        gravity: [f64; 3],
        step: f64,
    ) -> Option<Response> {
        let rigid = world.bodies.get(self.bodies.get(shape)?.rigid)?;
        let linked = self.mechanisms.response(shape);
        let of_linked = |(velocity, response)| Response::linked(rigid, velocity, &response);
        Some(linked.map_or_else(|| Response::free(rigid, gravity, step), of_linked))
    }

    /// Solves the mechanisms, and moves their bodies if nothing else moves; whether it did.
    fn solve_mechanisms(
        &mut self,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
        verdicts: &Verdicts,
    ) -> bool {
        self.solve_coupled(world, gravity, step, verdicts);
        let is_usual = self.is_stepped
            && world.has_gravity(convert::to_vector(gravity))
            && !self.bodies.are_sweeping();
        let is_integrated = is_usual && self.mechanisms.can_integrate(world);
        if is_integrated {
            self.mechanisms
                .integrate(&mut self.links, world, &mut self.workers);
        } else {
            self.mechanisms.apply_forces(world);
        }
        self.is_stepped = true;
        is_integrated
    }
}
