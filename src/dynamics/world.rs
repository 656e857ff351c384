//! rapier's world: its sets, its settings, one sub-step.
//!
//! A sub-step is one semi-implicit Euler step: rapier's own sub-division is switched off, so that free bodies move exactly as in the
//! original and impulses divided by the step are forces.

use rapier3d_f64::math::{Rotation, Vector};
use rapier3d_f64::prelude::{
    BroadPhaseBvh, CCDSolver, ColliderHandle, ColliderSet, FrictionModel, ImpulseJointSet, IntegrationParameters,
    IslandManager, MultibodyJointSet, NarrowPhase, PhysicsHooks, PhysicsPipeline, RigidBody, RigidBodyHandle,
    RigidBodySet, SoftBodySet, SpringCoefficients,
};

/// Iterations of the constraint solver per sub-step.
const ITERATIONS: usize = 4;
/// How stiffly contacts push bodies apart: stiffer than rapier's default, so that a tower of eight boxes sinks by well under a
/// hundredth of its height.
const CONTACT_SOFTNESS: SpringCoefficients<f64> = SpringCoefficients { natural_frequency: 60.0, damping_ratio: 5.0 };
/// Penetration left alone, metres.
const SLOP: f64 = 2e-4;
/// Distance at which contacts are prepared, metres.
const PREDICTION: f64 = 0.01;

/// Turns in a sub-step that rapier makes exactly enough, radians: a thirty-thousandth is missing.
const EXACT_TURN: f64 = 0.02;

/// Everything rapier needs for one scene.
pub(super) struct World {
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub joints: ImpulseJointSet,
    pub narrow_phase: NarrowPhase,
    broad_phase: BroadPhaseBvh,
    islands: IslandManager,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
    /// Of the step before.
    gravity: Option<Vector>,
}

impl World {
    pub(super) fn new() -> Self {
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
        }
    }

    /// Advances everything by `step` seconds under `gravity` (m/s2).
    pub(super) fn step(&mut self, step: f64, gravity: Vector, hooks: &dyn PhysicsHooks) {
        self.parameters.dt = step;
        if self.gravity.replace(gravity).is_some_and(|before| before != gravity) {
            self.wake_all();
        }
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
        // Only those are changed: rapier processes every body that may have changed.
        let awake = self.islands.active_bodies();
        let fast = awake.filter(|&handle| self.bodies.get(handle).is_some_and(|rigid| turns_fast(rigid, step)));
        for handle in fast.collect::<Vec<_>>() {
            if let Some(rigid) = self.bodies.get_mut(handle) {
                complete_turn(rigid, step);
            }
        }
    }

    /// Bodies that do not sleep, static ones excepted.
    pub(super) fn awake(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.islands.active_bodies()
    }

    pub(super) fn wake_all(&mut self) {
        self.bodies.iter_mut().for_each(|(_, rigid)| rigid.wake_up(true));
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
    rigid.is_dynamic() && angle >= EXACT_TURN && angle.is_finite()
}

/// rapier turns a body by the tangent of half the angle: what is missing is made up for, so that wheels turn as fast as they say.
fn complete_turn(rigid: &mut RigidBody, step: f64) {
    let spin = rigid.angvel();
    let angle = spin.length() * step;
    let missing = Rotation::from_scaled_axis(spin * (step * (1.0 - 2.0 * (angle / 2.0).atan() / angle)));
    let com = rigid.center_of_mass();
    let mut pose = *rigid.position();
    pose.translation = com + missing * (pose.translation - com);
    pose.rotation = missing * pose.rotation;
    rigid.set_position(pose, false);
}

fn parameters() -> IntegrationParameters {
    IntegrationParameters {
        num_solver_iterations: 1,
        num_internal_pgs_iterations: ITERATIONS,
        normalized_allowed_linear_error: SLOP,
        normalized_prediction_distance: PREDICTION,
        normalized_max_linear_velocity: f64::MAX,
        contact_softness: CONTACT_SOFTNESS,
        static_contact_softness: CONTACT_SOFTNESS,
        friction_model: FrictionModel::Simplified,
        ..IntegrationParameters::default()
    }
}
