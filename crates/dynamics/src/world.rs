//! rapier's world: its sets, its settings, one sub-step.
//!
//! For free bodies a sub-step is one semi-implicit Euler step, so that they move exactly as in the original. Bodies in contact, with all that
//! is connected to them, are solved in parts of it: only then are contacts stiff, and independent of the masses above each other; and meshes on
//! the ground do not creep, as they would in one part.

use std::sync::Arc;

use rapier3d_f64::math::{Rotation, Vector};
use rapier3d_f64::prelude::{
    ActiveHooks, BroadPhaseBvh, CCDSolver, CoefficientCombineRule, Collider, ColliderHandle,
    ColliderSet, ContactManifold, ContactPair, FrictionModel, ImpulseJointSet,
    IntegrationParameters, IslandManager, MultibodyJointSet, NarrowPhase, PhysicsHooks,
    PhysicsPipeline, QueryFilter, RigidBody, RigidBodyHandle, RigidBodySet, SoftBodySet,
    SpringCoefficients,
};

use super::free_rotation;
use super::moving_surfaces::MovingSurfaces;

/// Number of solver steps into which a sub-step is divided for bodies in contact.
pub(super) const CONTACT_SUBSTEPS: usize = 4;
/// Iterations of the constraint solver in each solver step.
const ITERATIONS: usize = 2;
/// Stiffness and damping of contacts: as stiff as solver steps of 1.25 ms resolve.
const CONTACT_SOFTNESS: SpringCoefficients<f64> = SpringCoefficients {
    natural_frequency: 240.0,
    damping_ratio: 5.0,
};
/// Penetration that is not corrected, metres.
const PENETRATION_SLOP: f64 = 2e-4;
/// Distance at which contacts are prepared, metres.
pub(super) const PREDICTION_DISTANCE: f64 = 0.01;
/// Contact points are kept while bodies move less than this against each other, metres. With a larger distance wheels roll as polygons do.
const CONTACT_RECYCLE_DISTANCE: f64 = 0.005;

/// The decisions that rapier leaves to [`Rules`](super::contacts::Rules).
pub(super) const ALL_HOOKS: ActiveHooks =
    ActiveHooks::FILTER_CONTACT_PAIRS.union(ActiveHooks::MODIFY_SOLVER_CONTACTS);

/// Rotation in a sub-step up to which rapier integrates accurately enough, radians: its relative error there is 1/30000.
const MAX_ACCURATE_ROTATION: f64 = 0.02;

/// Everything rapier needs for one scene.
pub(super) struct World {
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub joints: ImpulseJointSet,
    pub narrow_phase: NarrowPhase,
    pub broad_phase: BroadPhaseBvh,
    islands: IslandManager,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
    /// Of the step before.
    gravity: Option<Vector>,
    /// Whether colliders came that no step has seen.
    pub has_new_colliders: bool,
    /// The colliders of the present plan.
    pub known: Known,
    /// The surfaces that move along bodies of the present plan.
    pub surfaces: Arc<MovingSurfaces>,
}

/// What only changes with the plan, so that it need not be looked up for each pair of colliders in each sub-step.
#[derive(Default)]
pub(super) struct Known {
    /// By index.
    colliders: Vec<Option<KnownCollider>>,
    /// Whether shapes have masks of their own, or no friction.
    pub is_special: bool,
    /// Whether there are shapes of several colliders.
    pub is_composite: bool,
}

#[derive(Clone, Copy)]
pub(super) struct KnownCollider {
    handle: ColliderHandle,
    pub body: Option<RigidBodyHandle>,
    /// Whether the body is dynamic.
    pub moves: bool,
    /// Its user data.
    pub tag: u128,
    friction: (f64, CoefficientCombineRule),
}

impl Known {
    pub(super) fn add(
        &mut self,
        handle: ColliderHandle,
        collider: &Collider,
        bodies: &RigidBodySet,
    ) {
        let index = handle.into_raw_parts().0 as usize;
        self.colliders
            .resize(self.colliders.len().max(index + 1), None);
        let body = collider.parent();
        let moves = body
            .and_then(|body| bodies.get(body))
            .is_some_and(RigidBody::is_dynamic);
        let friction = (collider.friction(), collider.friction_combine_rule());
        self.colliders[index] = Some(KnownCollider {
            handle,
            body,
            moves,
            tag: collider.user_data,
            friction,
        });
    }

    /// Colliders that are still there.
    pub(super) fn pair(&self, pair: &ContactPair) -> Option<[&KnownCollider; 2]> {
        self.both([pair.collider1, pair.collider2])
    }

    pub(super) fn both(&self, colliders: [ColliderHandle; 2]) -> Option<[&KnownCollider; 2]> {
        let of = |handle: ColliderHandle| {
            let known = self
                .colliders
                .get(handle.into_raw_parts().0 as usize)?
                .as_ref();
            known.filter(|known| known.handle == handle)
        };
        Some([of(colliders[0])?, of(colliders[1])?])
    }
}

impl KnownCollider {
    /// Friction between this collider and another one.
    pub(super) fn friction(&self, other: &Self) -> f64 {
        let (own, others) = (self.friction, other.friction);
        CoefficientCombineRule::combine(own.0, others.0, own.1, others.1)
    }
}

impl Default for World {
    fn default() -> Self {
        Self {
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            narrow_phase: NarrowPhase::new(),
            broad_phase: BroadPhaseBvh::new(),
            islands: IslandManager::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
            pipeline: PhysicsPipeline::new(),
            parameters: parameters(),
            gravity: None,
            has_new_colliders: false,
            known: Known::default(),
            surfaces: Arc::default(),
        }
    }
}

impl World {
    /// Advances everything by `step` seconds under `gravity` (m/s2).
    pub(super) fn step(&mut self, step: f64, gravity: Vector, hooks: &dyn PhysicsHooks) {
        if self
            .gravity
            .replace(gravity)
            .is_some_and(|before| before != gravity)
        {
            self.wake_all();
        }
        let tumbling = self.select_tumbling();
        self.run_pipeline(step, gravity, hooks);
        for &handle in &tumbling {
            if let Some(rigid) = self.bodies.get_mut(handle) {
                free_rotation::complete(rigid, step);
            }
        }
        // Only those are changed: rapier processes every body that may have changed.
        let awake = self.islands.active_bodies();
        let fast = awake.filter(|handle| {
            let rigid = self.bodies.get(*handle);
            rigid.is_some_and(|rigid| turns_fast(rigid, step)) && !tumbling.contains(handle)
        });
        for handle in fast.collect::<Vec<_>>() {
            if let Some(rigid) = self.bodies.get_mut(handle) {
                complete_turn(rigid, step);
            }
        }
    }

    /// Finds what touches what, and moves nothing: a step of no length.
    pub(super) fn detect_collisions(&mut self, gravity: Vector, hooks: &dyn PhysicsHooks) {
        self.run_pipeline(0.0, gravity, hooks);
        if self.has_lost_boxes() {
            self.run_pipeline(0.0, gravity, hooks);
        }
    }

    /// Whether no query finds anything: when rapier 0.36.1 improves its tree of boxes in a step of no length, it does not put it back before the next step begins.
    fn has_lost_boxes(&self) -> bool {
        let dispatcher = self.narrow_phase.query_dispatcher();
        let query = self.broad_phase.as_query_pipeline(
            dispatcher,
            &self.bodies,
            &self.colliders,
            QueryFilter::default(),
        );
        query.bvh.is_empty() && !self.colliders.is_empty()
    }

    /// Moves the colliders to where their bodies are, as a step does before it detects collisions.
    pub(super) fn move_colliders(&mut self) {
        self.bodies
            .propagate_modified_body_positions_to_colliders(&mut self.colliders);
    }

    /// Whether the last step was made under the same gravity.
    pub(super) fn has_gravity(&self, gravity: Vector) -> bool {
        self.gravity == Some(gravity)
    }

    fn run_pipeline(&mut self, step: f64, gravity: Vector, hooks: &dyn PhysicsHooks) {
        self.parameters.dt = step;
        self.pipeline.step(
            gravity,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft_bodies,
            &mut self.ccd,
            hooks,
            &(),
        );
    }

    /// Selects the bodies that are solved in parts: those in contact. Mechanisms solve their own contacts, in whole sub-steps: `exact` says which
    /// colliders are theirs.
    pub(super) fn divide_touching(&mut self, exact: impl Fn(&Collider) -> bool) {
        let touching = self.touching(exact);
        let extra = |handle: RigidBodyHandle| {
            let touches = touching.get(index_of(handle)).copied().unwrap_or(false);
            if touches { CONTACT_SUBSTEPS - 1 } else { 0 }
        };
        let differs = |&handle: &RigidBodyHandle| {
            let rigid = self.bodies.get(handle).filter(|rigid| rigid.is_dynamic());
            rigid.is_some_and(|rigid| rigid.additional_solver_iterations() != extra(handle))
        };
        // Only those are changed: rapier processes every body that may have changed.
        for handle in self.awake().filter(differs).collect::<Vec<_>>() {
            if let Some(rigid) = self.bodies.get_mut(handle) {
                rigid.set_additional_solver_iterations(extra(handle));
            }
        }
    }

    /// Whether bodies are in contact, by index.
    fn touching(&self, exact: impl Fn(&Collider) -> bool) -> Vec<bool> {
        let mut touching = vec![false; self.bodies.len()];
        for pair in self
            .narrow_phase
            .contact_pairs()
            .filter(|pair| pair.has_any_active_contact())
        {
            let Some(colliders) = self.known.pair(pair) else {
                continue;
            };
            for (known, body) in colliders
                .iter()
                .filter_map(|known| Some((known, known.body?)))
            {
                let index = index_of(body);
                touching.resize(touching.len().max(index + 1), false);
                touching[index] =
                    touching[index] || !self.colliders.get(known.handle).is_some_and(&exact);
            }
        }
        touching
    }

    /// Parts in which a body is solved in the next step.
    pub(super) fn parts_of(&self, body: RigidBodyHandle) -> usize {
        self.bodies.get(body).map_or(1, parts)
    }

    /// Bodies that do not sleep, static ones excepted.
    pub(super) fn awake(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.islands.active_bodies()
    }

    pub(super) fn wake_all(&mut self) {
        self.bodies
            .iter_mut()
            .for_each(|(_, rigid)| rigid.wake_up(true));
    }

    /// Recomputes the contacts of a collider that changed; what touches it wakes up.
    pub(super) fn renew_contacts(&mut self, collider: ColliderHandle) {
        if let Some(collider) = self.colliders.get_mut(collider)
            && let Some(&pose) = collider.position_wrt_parent()
        {
            // Even to the same place: rapier uses contacts again, with their friction, while nothing is moved.
            collider.set_position_wrt_parent(pose);
        }
    }

    /// Gravity of the last step, m/s2.
    pub(super) fn gravity(&self) -> Vector {
        self.gravity.unwrap_or(Vector::ZERO)
    }

    /// Whether rapier holds joints of a body.
    pub(super) fn has_joints(&self, body: RigidBodyHandle) -> bool {
        self.joints.attached_joints(body).next().is_some()
    }

    /// Whether the last step found bodies without a finite next state. rapier leaves them where they were.
    pub(super) fn has_invalid_bodies(&self) -> bool {
        !self.pipeline.quarantine().is_empty()
    }

    /// Removes a body with its colliders and joints.
    pub(super) fn remove_body(&mut self, body: RigidBodyHandle) {
        self.bodies.remove(
            body,
            &mut self.islands,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft_bodies,
            true,
        );
    }
}

fn turns_fast(rigid: &RigidBody, step: f64) -> bool {
    let angle = rigid.angvel().length() * step;
    rigid.is_dynamic() && angle >= MAX_ACCURATE_ROTATION && angle.is_finite()
}

/// rapier turns a body by the tangent of half the angle: what is missing is made up for, so that wheels turn as fast as they say.
fn complete_turn(rigid: &mut RigidBody, step: f64) {
    let (spin, count) = (rigid.angvel(), parts(rigid) as f64);
    let angle = spin.length() * step;
    let turned = 2.0 * count * libm::atan(angle / (2.0 * count));
    let missing = Rotation::from_scaled_axis(spin * (step * (1.0 - turned / angle)));
    let com = rigid.center_of_mass();
    let mut pose = *rigid.position();
    pose.translation = com + missing * (pose.translation - com);
    pose.rotation = missing * pose.rotation;
    rigid.set_position(pose, false);
}

/// How many times the impulse of the last part of a sub-step the contacts exerted in all of it. rapier knows both of the normal impulses,
/// but only the last one of friction.
pub(super) fn parts_of_impulse(manifold: &ContactManifold) -> f64 {
    let (mut all, mut last) = (0.0, 0.0);
    for contact in &manifold.data.solver_contacts {
        let Some(point) = manifold.points.get(contact.contact_indices()[0] as usize) else {
            continue;
        };
        all += point.data.impulse;
        last += point.data.warmstart_impulse;
    }
    if last > 0.0 { all / last } else { 1.0 }
}

fn parts(rigid: &RigidBody) -> usize {
    1 + rigid.additional_solver_iterations()
}

pub(super) fn index_of(body: RigidBodyHandle) -> usize {
    body.into_raw_parts().0 as usize
}

fn parameters() -> IntegrationParameters {
    IntegrationParameters {
        num_solver_iterations: 1,
        num_internal_pgs_iterations: ITERATIONS,
        normalized_allowed_linear_error: PENETRATION_SLOP,
        normalized_prediction_distance: PREDICTION_DISTANCE,
        normalized_max_linear_velocity: f64::MAX,
        normalized_contact_recycle_distance: CONTACT_RECYCLE_DISTANCE,
        contact_softness: CONTACT_SOFTNESS,
        static_contact_softness: CONTACT_SOFTNESS,
        friction_model: FrictionModel::Simplified,
        ..IntegrationParameters::default()
    }
}
