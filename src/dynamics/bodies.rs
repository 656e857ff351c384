//! Rigid bodies: building them from plans, moving the static ones along with the scene, noticing what scripts moved.

use std::collections::BTreeMap;

use geometry::Finite;
use geometry::pose::interpolate;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, MassProperties, RigidBody, RigidBodyBuilder,
    RigidBodyHandle, RigidBodyType,
};

use super::colliders;
use super::convert::{from_pose, to_matrix, to_pose, to_vector};
use super::plan::{BodyBuild, BodyPlan, FrictionRule, Surface, is_far};
use super::world::{ALL_HOOKS, World};
use crate::scene::{Field, Handle, Pose, Scene};

/// A static body that moved less than this between two calls has not moved: metres and radians.
const STILL: (f64, f64) = (1e-5, 0.05 * std::f64::consts::PI / 180.0);
/// A body of which no point moves faster, metres per second, for so many seconds, falls asleep, with all that it touches.
const RESTING: (f64, f64) = (1e-5, 1.0);
/// The threshold of bodies that stay awake.
const NEVER: f64 = -1.0;

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
    /// Whether it slept at the last report to the scene.
    pub slept: bool,
}

/// Identifies a collider in callbacks: shape, root of its tree, mask.
#[derive(Clone, Copy)]
pub(super) struct Tag {
    pub shape: Handle,
    pub root: Handle,
    pub mask: u16,
}

impl Tag {
    pub(super) fn pack(self) -> u128 {
        u128::from(self.shape.0) | u128::from(self.root.0) << 32 | u128::from(self.mask) << 64
    }

    pub(super) fn unpack(data: u128) -> Self {
        Self { shape: Handle(data as u32), root: Handle((data >> 32) as u32), mask: (data >> 64) as u16 }
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
                object.dynamics_reset || (body.build.dynamic && object.pose() != body.local) || is_far(scene, shape)
            }
            Err(_) => true,
        })
    }

    /// Makes the engine's bodies those of the plan; those whose making is unchanged go on as they are.
    pub(super) fn apply_plan(&mut self, plan: Vec<(Handle, BodyPlan)>, world: &mut World, scene: &mut Scene) {
        let mut old: BTreeMap<Handle, Body> = std::mem::take(&mut self.all).into_iter().collect();
        self.places = plan.iter().enumerate().map(|(place, (shape, _))| (*shape, place)).collect();
        for (shape, plan) in plan {
            let is_unchanged = |body: &Body| body.build == plan.build && !wants_rebuild(scene, shape, body);
            // Bodies that no longer exist stay in `old`, to be removed from the engine.
            let existing = if old.get(&shape).is_some_and(is_unchanged) { old.remove(&shape) } else { None };
            let body = match existing {
                Some(body) => body.with_surface(shape, plan.surface, world),
                None => Body::insert(shape, plan, world, scene),
            };
            self.all.push((shape, body));
        }
        for body in old.into_values() {
            world.remove_body(body.rigid);
        }
    }
}

fn wants_rebuild(scene: &Scene, shape: Handle, body: &Body) -> bool {
    let moved = |object: &crate::scene::Object| body.build.dynamic && object.pose() != body.local;
    scene.object(shape).is_ok_and(|object| object.dynamics_reset || moved(object))
}

impl Body {
    /// Builds the body where its shape is, with the initial velocity the shape carries, which is used up by that.
    fn insert(shape: Handle, plan: BodyPlan, world: &mut World, scene: &mut Scene) -> Self {
        let pose = scene.world_pose(shape).unwrap_or_else(|_| Pose::identity());
        let local = scene.object(shape).map(|object| object.pose()).unwrap_or(pose);
        let mut rigid = rigid_body(&plan, &pose);
        if let Ok(velocity) = take_initial_velocity(scene, shape)
            && plan.build.dynamic
        {
            rigid.set_linvel(to_vector(velocity.linear), true);
            rigid.set_angvel(to_vector(velocity.angular), true);
            if plan.asleep && velocity == Default::default() {
                rigid.sleep();
            }
        }
        let rigid = world.bodies.insert(rigid);
        let (build, surface) = (plan.build, plan.surface);
        let mut body = Self { rigid, colliders: Vec::new(), build, surface, local, sweep: None, slept: false };
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
        let tag = Tag { shape, root: self.surface.root, mask: self.surface.mask };
        let forms = self.build.parts.iter().flat_map(|part| colliders::forms(part, self.build.dynamic));
        for (pose, form) in forms.collect::<Vec<_>>() {
            let collider = ColliderBuilder::new(form)
                .position(pose)
                .density(0.0)
                .friction(self.surface.friction)
                .restitution(self.surface.restitution)
                .friction_combine_rule(combine_rule(self.surface.friction_rule))
                .restitution_combine_rule(CoefficientCombineRule::Multiply)
                .active_hooks(ALL_HOOKS)
                .user_data(tag.pack());
            self.colliders.push(world.colliders.insert_with_parent(collider, self.rigid, &mut world.bodies));
        }
    }

    fn with_surface(mut self, shape: Handle, surface: Surface, world: &mut World) -> Self {
        if self.surface == surface {
            return self;
        }
        self.surface = surface;
        let tag = Tag { shape, root: surface.root, mask: surface.mask };
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

    /// Whether the engine still has the body.
    pub(super) fn pose(&self, world: &World) -> Option<Pose> {
        world.bodies.get(self.rigid).map(|rigid| from_pose(rigid.position()))
    }
}

fn combine_rule(rule: FrictionRule) -> CoefficientCombineRule {
    match rule {
        FrictionRule::Product => CoefficientCombineRule::Multiply,
        FrictionRule::Largest => CoefficientCombineRule::Max,
    }
}

fn rigid_body(plan: &BodyPlan, pose: &Pose) -> RigidBody {
    let kind = if plan.build.dynamic { RigidBodyType::Dynamic } else { RigidBodyType::Fixed };
    let mass = &plan.build.mass;
    let inertia = to_matrix(&(mass.inertia * mass.mass));
    RigidBodyBuilder::new(kind)
        .pose(to_pose(pose))
        .additional_mass_properties(MassProperties::with_inertia_matrix(to_vector(mass.com), mass.mass, inertia))
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
            let threshold = if stays_awake(shape) { NEVER } else { RESTING.0 };
            let is_set = |rigid: &RigidBody| rigid.activation().normalized_linear_threshold == threshold;
            if world.bodies.get(body.rigid).is_some_and(is_set) {
                continue;
            }
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                let activation = rigid.activation_mut();
                (activation.normalized_linear_threshold, activation.angular_threshold) = (threshold, threshold);
                activation.time_until_sleep = RESTING.1;
                if threshold == NEVER {
                    rigid.wake_up(true);
                }
            }
        }
    }
}

fn take_initial_velocity(scene: &mut Scene, shape: Handle) -> crate::scene::SceneResult<crate::scene::shape::Velocity> {
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
    /// Plans the way of the static bodies over the call: from where the engine has them to where the scene has them.
    pub(super) fn plan_sweeps(&mut self, world: &mut World, scene: &Scene) {
        self.sweeping.clear();
        for (place, (shape, body)) in self.all.iter_mut().enumerate().filter(|(_, (_, body))| !body.build.dynamic) {
            let (Some(from), Ok(to)) = (body.pose(world), scene.world_pose(*shape)) else { continue };
            body.sweep = (has_moved(&from, &to) && to.is_finite()).then_some((from, to));
            if body.sweep.is_some() {
                self.sweeping.push(place);
                body.let_move(world);
            }
        }
    }

    /// Moves the static bodies to `fraction` of their way.
    pub(super) fn sweep(&self, fraction: f64, world: &mut World) {
        for body in self.sweeping.iter().filter_map(|&place| Some(&self.all.get(place)?.1)) {
            let Some((from, to)) = &body.sweep else { continue };
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                rigid.set_next_kinematic_position(to_pose(&interpolate(from, to, fraction)));
            }
        }
    }

    /// Applies the forces of scripts, in place of those of the last sub-step. rapier processes every body that was changed, so bodies
    /// without forces are left alone.
    pub(super) fn apply_forces(&self, world: &mut World, scene: &Scene) {
        for (shape, body) in self.iter().filter(|(_, body)| body.build.dynamic) {
            let Ok(shape) = scene.object(shape).and_then(|object| object.shape()) else { continue };
            let is_forced = shape.force != [0.0; 3] || shape.torque != [0.0; 3];
            if !is_forced && world.bodies.get(body.rigid).is_none_or(is_free) {
                continue;
            }
            let Some(rigid) = world.bodies.get_mut(body.rigid) else { continue };
            rigid.reset_forces(false);
            rigid.reset_torques(false);
            if shape.force.iter().chain(&shape.torque).all(|x| x.is_finite()) {
                rigid.add_force(to_vector(shape.force), true);
                rigid.add_torque(to_vector(shape.torque), true);
            }
        }
    }
}

impl Body {
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

fn is_free(rigid: &RigidBody) -> bool {
    rigid.user_force() == Vector::ZERO && rigid.user_torque() == Vector::ZERO
}

fn has_moved(from: &Pose, to: &Pose) -> bool {
    let shift = (to.translation.vector - from.translation.vector).norm();
    shift > STILL.0 || from.rotation.angle_to(&to.rotation) > STILL.1
}
