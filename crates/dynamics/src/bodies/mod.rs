//! Rigid bodies: building them from plans, moving the static ones along with the scene, noticing what scripts moved.

mod colliders;
mod forces;
mod form_maker;
mod hull_shape;
mod kept_hulls;
mod made_forms;
mod mass;
mod pieces;
mod sweeps;
mod tag;

use std::collections::BTreeMap;

use rapier3d_f64::math::Pose as EnginePose;
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, MassProperties, RigidBody,
    RigidBodyBuilder, RigidBodyHandle, RigidBodyType,
};

use super::convert::{from_pose, to_pose, to_vector};
use super::plan::{BodyBuild, BodyPlan, FrictionRule, Surface, is_far};
use super::world::{ALL_HOOKS, World};
pub use form_maker::FormMaker;
pub(crate) use made_forms::Forms;
use mass::{carrier, mass_properties, massless};
use scene::shape::Velocity;
use scene::{Field, Handle, Pose, Scene};
use sweeps::has_moved;
pub(super) use tag::Tag;

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
    /// Whether one is in a fluid: forces change from sub-step to sub-step.
    pub are_in_fluid: bool,
    /// Velocity of the fluid, m/s.
    pub wind: [f64; 3],
    /// Whether one adheres to what it touches.
    pub are_adhering: bool,
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
        forms: &mut Forms,
    ) {
        let mut old: BTreeMap<Handle, Body> = std::mem::take(&mut self.all).into_iter().collect();
        self.places = plan
            .iter()
            .enumerate()
            .map(|(place, (shape, _))| (*shape, place))
            .collect();
        self.are_in_fluid = plan.iter().any(|(_, plan)| plan.surface.fluid.is_some());
        self.are_adhering = plan.iter().any(|(_, plan)| plan.surface.adhesion > 0.0);
        let stay = staying(&plan, &old, world, scene);
        let made = plan.iter().zip(&stay).filter(|(_, stays)| !**stays);
        make_forms(made.map(|((_, plan), _)| &plan.build), forms);
        for ((shape, plan), stays) in plan.into_iter().zip(stay) {
            // Bodies that no longer exist stay in `old`, to be removed from the engine.
            let existing = if stays { old.remove(&shape) } else { None };
            let body = match existing {
                Some(body) => body
                    .with_surface(shape, plan.surface, world)
                    .with_drift(shape, scene),
                None => Body::insert(shape, plan, world, scene, forms),
            };
            self.all.push((shape, body));
        }
        for body in old.into_values() {
            world.remove_body(body.rigid);
        }
    }
}

/// Which bodies of the plan are there already, and go on as they are.
fn staying(
    plan: &[(Handle, BodyPlan)],
    old: &BTreeMap<Handle, Body>,
    world: &World,
    scene: &Scene,
) -> Vec<bool> {
    let stays = |(shape, plan): &(Handle, BodyPlan)| {
        let is_unchanged =
            |body: &Body| body.build == plan.build && !wants_rebuild(scene, *shape, body, world);
        old.get(shape).is_some_and(is_unchanged)
    };
    plan.iter().map(stays).collect()
}

/// Makes the forms of the meshes of bodies that collide.
fn make_forms<'a>(builds: impl Iterator<Item = &'a BodyBuild>, forms: &mut Forms) {
    let parts = builds
        .filter(|build| build.respondable)
        .flat_map(|build| build.parts.iter().map(|part| (part, build.dynamic)));
    let meshes =
        parts.filter_map(|(part, dynamic)| Some((&part.mesh, colliders::making(part, dynamic)?)));
    forms.make_all(meshes);
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
    fn insert(
        shape: Handle,
        plan: BodyPlan,
        world: &mut World,
        scene: &mut Scene,
        forms: &Forms,
    ) -> Self {
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
        body.insert_colliders(shape, world, forms);
        // rapier would only know the mass during the first step, mechanisms need it before.
        if let Some(rigid) = world.bodies.get_mut(rigid) {
            rigid.recompute_mass_properties_from_colliders(&world.colliders);
        }
        body
    }

    fn insert_colliders(&mut self, shape: Handle, world: &mut World, made: &Forms) {
        if !self.build.respondable {
            return;
        }
        let tag = Tag::new(shape, &self.surface);
        let forms = self
            .build
            .parts
            .iter()
            .flat_map(|part| colliders::forms(part, self.build.dynamic, made));
        let forms = colliders::with_few_colliders(forms.collect());
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
        if self.surface.motion.is_some() && surface.motion.is_none() {
            self.drift = Velocity::default();
        }
        self.surface = surface;
        let surface = &self.surface;
        let tag = Tag::new(shape, &self.surface);
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

    /// Whether it moves when particles hit it that collide with those bits of the global mask.
    pub(super) fn is_pushed_by(&self, mask: u8) -> bool {
        let collides = u16::from(mask) << 8 & self.surface.mask != 0;
        self.build.dynamic && self.build.respondable && collides
    }

    /// Force with which it adheres to what it touches, N.
    pub(super) fn adhesion(&self) -> f64 {
        self.surface.adhesion
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
