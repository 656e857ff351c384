//! Rigid bodies: building them from plans, moving the static ones along with the scene, noticing what scripts moved.

use std::collections::BTreeMap;

use geometry::Finite;
use geometry::pose::interpolate;
use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, MassProperties, RigidBody,
    RigidBodyBuilder, RigidBodyHandle, RigidBodyType,
};

use super::body_mass::{carrier, mass_properties, massless};
use super::colliders;
use super::convert::{from_pose, to_pose, to_vector};
use super::fluid::drag;
use super::plan::{BodyBuild, BodyPlan, FrictionRule, Surface, is_far};
use super::world::{ALL_HOOKS, World};
use scene::shape::Velocity;
use scene::{Field, Handle, Pose, Scene};

/// A static body counts as moved when it moved more than this between two calls, metres and radians.
const STATIC_TOLERANCE: (f64, f64) = (1e-5, 0.05 * std::f64::consts::PI / 180.0);
/// A body sleeps, with all that it touches, after no point of it has moved faster than this (m/s) for so many seconds.
pub(super) const SLEEP_THRESHOLD: (f64, f64) = (1e-5, 0.5);
/// The threshold of speed for bodies that never sleep.
const NEVER_SLEEPS: f64 = -1.0;

/// The bodies by shape.
#[derive(Default)]
pub(super) struct Bodies {
    /// Base-to-tip.
    all: Vec<(Handle, Body)>,
    /// Index of the body of a shape.
    places: BTreeMap<Handle, usize>,
    /// Those that move though they are static.
    sweeping: Vec<usize>,
}

/// A shape's body in the engine.
pub(super) struct Body {
    pub rigid: RigidBodyHandle,
    pub colliders: Vec<ColliderHandle>,
    pub build: BodyBuild,
    surface: Surface,
    /// Pose in the parent frame as last read from or written to the scene.
    pub local: Pose,
    /// Where a static body goes during this call: from, to.
    sweep: Option<(Pose, Pose)>,
    /// Velocity of the surface of a static body, which stays where it is: the initial velocity that scripts set.
    drift: Velocity,
    /// Where a body stands whose surface moves or moved: the engine has it a little further.
    standing: Option<Pose>,
    /// Whether it slept at the last report to the scene.
    pub slept: bool,
}

/// Identifies a collider in callbacks: shape, root of its tree, mask.
#[derive(Clone, Copy)]
pub(super) struct Tag {
    pub shape: Handle,
    pub root: Handle,
    pub mask: u16,
    /// Of the local mask, as many as [`scene::FURTHER_BITS`].
    pub further_bits: u64,
}

impl Tag {
    pub(super) fn pack(self) -> u128 {
        let masks = u128::from(self.mask) << 64 | u128::from(self.further_bits) << 80;
        u128::from(self.shape.0) | u128::from(self.root.0) << 32 | masks
    }

    pub(super) fn unpack(data: u128) -> Self {
        Self {
            shape: Handle(data as u32),
            root: Handle((data >> 32) as u32),
            mask: (data >> 64) as u16,
            further_bits: (data >> 80) as u64,
        }
    }
}

impl Bodies {
    pub(super) fn get(&self, shape: Handle) -> Option<&Body> {
        Some(&self.all[*self.places.get(&shape)?].1)
    }

    /// All bodies, base-to-tip.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Handle, &Body)> {
        self.all.iter().map(|(shape, body)| (*shape, body))
    }

    /// The same, to be changed.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = (Handle, &mut Body)> {
        self.all.iter_mut().map(|(shape, body)| (*shape, body))
    }

    /// Whether a script moved a shape or requested a reset.
    pub(super) fn were_touched(&self, scene: &Scene) -> bool {
        self.iter().any(|(shape, body)| match scene.object(shape) {
            Ok(object) => {
                object.dynamics_reset
                    || (body.build.dynamic && object.pose() != body.local)
                    || is_far(scene, shape)
            }
            Err(_) => true,
        })
    }

    /// Makes the engine's bodies those of the plan; those whose making is unchanged go on as they are.
    pub(super) fn apply_plan(
        &mut self,
        plan: Vec<(Handle, BodyPlan)>,
        world: &mut World,
        scene: &mut Scene,
    ) {
        let mut old: BTreeMap<Handle, Body> = std::mem::take(&mut self.all).into_iter().collect();
        self.places = plan
            .iter()
            .enumerate()
            .map(|(place, (shape, _))| (*shape, place))
            .collect();
        for (shape, plan) in plan {
            let is_unchanged =
                |body: &Body| body.build == plan.build && !wants_rebuild(scene, shape, body, world);
            // Bodies that no longer exist stay in `old`, to be removed from the engine.
            let existing = if old.get(&shape).is_some_and(is_unchanged) {
                old.remove(&shape)
            } else {
                None
            };
            let body = match existing {
                Some(body) => body
                    .with_surface(shape, plan.surface, world)
                    .with_drift(shape, scene),
                None => Body::insert(shape, plan, world, scene),
            };
            self.all.push((shape, body));
        }
        for body in old.into_values() {
            world.remove_body(body.rigid);
        }
    }
}

/// A static body that is reset stays, with its contacts, unless it was moved: then it is elsewhere at once, without a way there.
fn wants_rebuild(scene: &Scene, shape: Handle, body: &Body, world: &World) -> bool {
    let Ok(object) = scene.object(shape) else {
        return false;
    };
    if body.build.dynamic {
        return object.dynamics_reset || object.pose() != body.local;
    }
    let stands = body.standing.or_else(|| body.pose(world));
    object.dynamics_reset
        && stands
            .zip(scene.world_pose(shape).ok())
            .is_none_or(|(from, to)| has_moved(&from, &to))
}

impl Body {
    /// Builds the body where its shape is, with the initial velocity the shape carries, which is used up by that.
    fn insert(shape: Handle, plan: BodyPlan, world: &mut World, scene: &mut Scene) -> Self {
        let pose = scene.world_pose(shape).unwrap_or_else(|_| Pose::identity());
        let local = scene.object(shape).map_or(pose, |object| object.pose());
        let mut rigid = rigid_body(&plan, &pose);
        let velocity = take_initial_velocity(scene, shape).unwrap_or_default();
        let drift = if plan.build.dynamic {
            Velocity::default()
        } else {
            velocity
        };
        if plan.build.dynamic {
            rigid.set_linvel(to_vector(velocity.linear), true);
            rigid.set_angvel(to_vector(velocity.angular), true);
            if plan.asleep && velocity == Default::default() {
                rigid.sleep();
            }
        }
        let rigid = world.bodies.insert(rigid);
        let (build, surface) = (plan.build, plan.surface);
        let (sweep, standing, slept) = (None, None, false);
        let mut body = Self {
            rigid,
            colliders: Vec::new(),
            build,
            surface,
            local,
            sweep,
            drift,
            standing,
            slept,
        };
        body.insert_colliders(shape, world);
        // rapier would only know the mass during the first step, mechanisms need it before.
        if let Some(rigid) = world.bodies.get_mut(rigid) {
            rigid.recompute_mass_properties_from_colliders(&world.colliders);
        }
        body
    }

    fn insert_colliders(&mut self, shape: Handle, world: &mut World) {
        if !self.build.respondable {
            return;
        }
        let tag = Tag {
            shape,
            root: self.surface.root,
            mask: self.surface.mask,
            further_bits: self.surface.further_bits,
        };
        let forms = self
            .build
            .parts
            .iter()
            .flat_map(|part| colliders::forms(part, self.build.dynamic));
        let forms = forms.collect::<Vec<_>>();
        let carrier = carrier(forms.iter().map(|(pose, _)| pose));
        for (index, (pose, form)) in forms.into_iter().enumerate() {
            let builder = ColliderBuilder::new(form).position(pose);
            let collider = self
                .with_mass(builder, &pose, carrier == Some(index), world)
                .friction(self.surface.friction)
                .restitution(self.surface.restitution)
                .friction_combine_rule(combine_rule(self.surface.friction_rule))
                .restitution_combine_rule(CoefficientCombineRule::Multiply)
                .active_hooks(ALL_HOOKS)
                .user_data(tag.pack());
            world.has_new_colliders = true;
            self.colliders.push(world.colliders.insert_with_parent(
                collider,
                self.rigid,
                &mut world.bodies,
            ));
        }
    }

    /// Lets a collider carry the mass of the body, instead of the body.
    fn with_mass(
        &self,
        builder: ColliderBuilder,
        pose: &EnginePose,
        carries: bool,
        world: &mut World,
    ) -> ColliderBuilder {
        let Some(rigid) = world.bodies.get_mut(self.rigid).filter(|_| carries) else {
            return builder.mass_properties(massless(pose));
        };
        rigid.set_additional_mass_properties(MassProperties::default(), false);
        builder.mass_properties(mass_properties(&self.build.mass).transform_by(&pose.inverse()))
    }

    fn with_surface(mut self, shape: Handle, surface: Surface, world: &mut World) -> Self {
        if self.surface == surface {
            return self;
        }
        self.surface = surface;
        let tag = Tag {
            shape,
            root: surface.root,
            mask: surface.mask,
            further_bits: surface.further_bits,
        };
        for &handle in &self.colliders {
            if let Some(collider) = world.colliders.get_mut(handle) {
                collider.set_friction(surface.friction);
                collider.set_friction_combine_rule(combine_rule(surface.friction_rule));
                collider.set_restitution(surface.restitution);
                collider.user_data = tag.pack();
            }
            world.renew_contacts(handle);
        }
        if let Some(rigid) = world.bodies.get_mut(self.rigid) {
            rigid.set_linear_damping(surface.linear_damping);
            rigid.set_angular_damping(surface.angular_damping);
            rigid.wake_up(true);
        }
        self
    }

    /// A static body that was reset has the surface velocity that it carries now.
    fn with_drift(mut self, shape: Handle, scene: &mut Scene) -> Self {
        let is_reset = scene
            .object(shape)
            .is_ok_and(|object| object.dynamics_reset);
        if is_reset && !self.build.dynamic {
            self.drift = take_initial_velocity(scene, shape).unwrap_or_default();
        }
        self
    }

    /// Whether the engine slows the body down.
    pub(super) fn is_damped(&self) -> bool {
        self.surface.linear_damping != 0.0 || self.surface.angular_damping != 0.0
    }

    fn drifts(&self) -> bool {
        self.drift != Velocity::default()
            && self
                .drift
                .linear
                .iter()
                .chain(&self.drift.angular)
                .all(|x| x.is_finite())
    }

    /// Whether the engine still has the body.
    pub(super) fn pose(&self, world: &World) -> Option<Pose> {
        world
            .bodies
            .get(self.rigid)
            .map(|rigid| from_pose(rigid.position()))
    }
}

fn combine_rule(rule: FrictionRule) -> CoefficientCombineRule {
    match rule {
        FrictionRule::Product => CoefficientCombineRule::Multiply,
        FrictionRule::Largest => CoefficientCombineRule::Max,
    }
}

fn rigid_body(plan: &BodyPlan, pose: &Pose) -> RigidBody {
    let kind = if plan.build.dynamic {
        RigidBodyType::Dynamic
    } else {
        RigidBodyType::Fixed
    };
    RigidBodyBuilder::new(kind)
        .pose(to_pose(pose))
        .additional_mass_properties(mass_properties(&plan.build.mass))
        .linear_damping(plan.surface.linear_damping)
        .angular_damping(plan.surface.angular_damping)
        .can_sleep(false)
        .allow_fast_rotation(true)
        .build()
}

impl Bodies {
    /// Lets bodies sleep when they rest, but for those that `stays_awake` names.
    pub(super) fn let_sleep(&self, world: &mut World, stays_awake: impl Fn(Handle) -> bool) {
        for (shape, body) in self.iter().filter(|(_, body)| body.build.dynamic) {
            let threshold = if stays_awake(shape) {
                NEVER_SLEEPS
            } else {
                SLEEP_THRESHOLD.0
            };
            let is_set =
                |rigid: &RigidBody| rigid.activation().normalized_linear_threshold == threshold;
            if world.bodies.get(body.rigid).is_some_and(is_set) {
                continue;
            }
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                let activation = rigid.activation_mut();
                (
                    activation.normalized_linear_threshold,
                    activation.angular_threshold,
                ) = (threshold, threshold);
                activation.time_until_sleep = SLEEP_THRESHOLD.1;
                if threshold == NEVER_SLEEPS {
                    rigid.wake_up(true);
                }
            }
        }
    }
}

fn take_initial_velocity(scene: &mut Scene, shape: Handle) -> scene::SceneResult<Velocity> {
    let object = scene.object(shape)?;
    let velocity = object.shape()?.dynamics.initial_velocity;
    if object.dynamics_reset || velocity != Default::default() {
        scene.try_modify(shape, Field::Dynamics, |object| {
            object.dynamics_reset = false;
            object.shape_mut()?.dynamics.initial_velocity = Default::default();
            Ok(())
        })?;
    }
    Ok(velocity)
}

impl Bodies {
    /// Whether a static body moves during this call.
    pub(super) fn are_sweeping(&self) -> bool {
        !self.sweeping.is_empty()
    }

    /// Plans the way of the static bodies over the call: from where the engine has them to where the scene has them.
    pub(super) fn plan_sweeps(&mut self, world: &mut World, scene: &Scene) {
        self.sweeping.clear();
        for (place, (shape, body)) in self
            .all
            .iter_mut()
            .enumerate()
            .filter(|(_, (_, body))| !body.build.dynamic)
        {
            body.stop_drift(world);
            let (Some(held), Ok(to)) = (body.pose(world), scene.world_pose(*shape)) else {
                continue;
            };
            let from = body.standing.unwrap_or(held);
            let moves = has_moved(&from, &to) || body.drifts();
            body.sweep = (moves && to.is_finite()).then_some((from, to));
            body.standing = body.sweep.filter(|_| body.drifts()).map(|_| from);
            if body.sweep.is_some() {
                self.sweeping.push(place);
                body.let_move(world);
            }
        }
    }

    /// Moves the static bodies to `fraction` of their way, in a sub-step of so many seconds. Those whose surface moves begin where they
    /// stand and go as far as their surface does: contacts only know velocities of bodies.
    pub(super) fn sweep(&mut self, fraction: f64, step: f64, world: &mut World) {
        for &place in &self.sweeping {
            let Some((_, body)) = self.all.get_mut(place) else {
                continue;
            };
            let (Some((from, to)), Some(rigid)) = (&body.sweep, world.bodies.get_mut(body.rigid))
            else {
                continue;
            };
            let next = interpolate(from, to, fraction);
            let Some(standing) = &mut body.standing else {
                rigid.set_next_kinematic_position(to_pose(&next));
                continue;
            };
            rigid.set_position(to_pose(standing), false);
            rigid.set_next_kinematic_position(to_pose(&drifted(&next, &body.drift, step)));
            *standing = next;
        }
    }

    /// Whether forces change from sub-step to sub-step.
    pub(super) fn are_in_fluid(&self) -> bool {
        self.iter().any(|(_, body)| body.surface.fluid.is_some())
    }

    /// Applies the forces of scripts and of fluids, in place of those of the last sub-step of `step` seconds. rapier processes every body that was changed, so
    /// bodies without forces are left alone.
    pub(super) fn apply_forces(&self, world: &mut World, scene: &Scene, step: f64) {
        for (shape, body) in self.iter().filter(|(_, body)| body.build.dynamic) {
            let Ok(shape) = scene.object(shape).and_then(|object| object.shape()) else {
                continue;
            };
            let Some(rigid) = world.bodies.get(body.rigid) else {
                continue;
            };
            let drag = body.surface.fluid.map(|fluid| drag(fluid, rigid, step));
            let mut forces = drag.unwrap_or([Vector::ZERO; 2]);
            let told = [shape.force, shape.torque].map(to_vector);
            if told.iter().all(|force| force.is_finite()) {
                forces = [forces[0] + told[0], forces[1] + told[1]];
            }
            let is_forced = forces != [Vector::ZERO; 2];
            if !is_forced && is_free(rigid) {
                continue;
            }
            let Some(rigid) = world.bodies.get_mut(body.rigid) else {
                continue;
            };
            rigid.reset_forces(false);
            rigid.reset_torques(false);
            let wakes = told != [Vector::ZERO; 2];
            rigid.add_force(forces[0], wakes);
            rigid.add_torque(forces[1], wakes);
        }
    }
}

impl Body {
    /// Puts a body back to where it stands whose surface does not move any more.
    fn stop_drift(&mut self, world: &mut World) {
        if !self.drifts()
            && let Some(standing) = self.standing.take()
            && let Some(rigid) = world.bodies.get_mut(self.rigid)
        {
            rigid.set_position(to_pose(&standing), true);
        }
    }

    /// A static body that begins to move pushes others, and leaves others without support.
    fn let_move(&self, world: &mut World) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid)
            && rigid.is_fixed()
        {
            // rapier wakes what touches the body.
            rigid.set_body_type(RigidBodyType::KinematicPositionBased, true);
        }
    }
}

/// Where a body would go with a velocity, seconds later.
fn drifted(pose: &Pose, velocity: &Velocity, seconds: f64) -> Pose {
    let [linear, angular] = [velocity.linear, velocity.angular].map(nalgebra::Vector3::from);
    let shift = nalgebra::Translation3::from(linear * seconds);
    let turn = nalgebra::UnitQuaternion::from_scaled_axis(angular * seconds);
    Pose::from_parts(shift * pose.translation, turn * pose.rotation)
}

fn is_free(rigid: &RigidBody) -> bool {
    rigid.user_force() == Vector::ZERO && rigid.user_torque() == Vector::ZERO
}

fn has_moved(from: &Pose, to: &Pose) -> bool {
    let shift = (to.translation.vector - from.translation.vector).norm();
    shift > STATIC_TOLERANCE.0 || from.rotation.angle_to(&to.rotation) > STATIC_TOLERANCE.1
}
