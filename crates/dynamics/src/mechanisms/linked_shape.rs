//! A body of a mechanism or a guest, and the states of bodies and joints as the articulation solver takes them.

use articulation::{BodyMotion, BodyProperties, BodyState, JointState, spatial};
use geometry::MassProperties;
use nalgebra::Vector6;
use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};

use super::reach::Reach;
use crate::bodies::Body;
use crate::convert::{from_pose, from_vector, to_vector};
use crate::links::Link;
use crate::world::World;
use scene::Handle;

/// A body of a mechanism.
pub(super) struct LinkedShape {
    pub shape: Handle,
    pub rigid: RigidBodyHandle,
    pub is_dynamic: bool,
    mass: MassProperties,
    /// Forces and torques of scripts: they outlast a sub-step, those of links do not.
    pub external: Vector6<f64>,
    /// Whether the engine slows the body down.
    pub is_damped: bool,
    pub reach: Reach,
}

/// The properties of a body for its mechanism.
pub(super) fn properties(body: &Body) -> BodyProperties {
    let mass = &body.build.mass;
    if body.build.dynamic {
        BodyProperties::dynamic(mass.mass, mass.inertia * mass.mass, mass.com.into())
    } else {
        BodyProperties::immovable(mass.com.into())
    }
}

impl LinkedShape {
    pub(super) fn new(shape: Handle, body: &Body) -> Self {
        Self {
            shape,
            rigid: body.rigid,
            is_dynamic: body.build.dynamic,
            mass: body.build.mass,
            external: Vector6::zeros(),
            is_damped: body.is_damped(),
            reach: Reach::default(),
        }
    }

    /// Whether this is a body as it is now.
    pub(super) fn is(&self, shape: Handle, body: &Body) -> bool {
        self.shape == shape
            && self.rigid == body.rigid
            && self.is_dynamic == body.build.dynamic
            && self.is_damped == body.is_damped()
            && self.mass == body.build.mass
    }

    /// Mass (three times) and largest moment of inertia (three times).
    pub(super) fn mass(&self) -> [f64; 6] {
        let mass = self.mass.mass;
        let moment = (self.mass.inertia * mass).diagonal().max();
        [mass, mass, mass, moment, moment, moment]
    }

    pub(super) fn remove_forces_of_links(&self, world: &mut World) {
        if let Some(rigid) = world
            .bodies
            .get_mut(self.rigid)
            .filter(|rigid| rigid.is_dynamic())
        {
            rigid.reset_forces(false);
            rigid.reset_torques(false);
            rigid.add_force(to_vector(linear(&self.external)), false);
            rigid.add_torque(to_vector(angular(&self.external)), false);
        }
    }
}

pub(super) fn body_state(rigid: &RigidBody, is_dynamic: bool, step: f64) -> BodyState {
    let motion = motion(rigid);
    if !is_dynamic {
        let target = rigid
            .is_kinematic()
            .then(|| from_pose(rigid.next_position()));
        return BodyState {
            motion,
            force: Vector6::zeros(),
            gyroscopic_velocity: angular(&motion.velocity).into(),
            target,
        };
    }
    let force = spatial(
        from_vector(rigid.user_force()).into(),
        from_vector(rigid.user_torque()).into(),
    );
    let gyroscopic_velocity = from_vector(rigid.angvel_with_gyroscopic_forces(step)).into();
    BodyState {
        motion,
        force,
        gyroscopic_velocity,
        target: None,
    }
}

pub(super) fn motion(rigid: &RigidBody) -> BodyMotion {
    let velocity = spatial(
        from_vector(rigid.linvel()).into(),
        from_vector(rigid.angvel()).into(),
    );
    BodyMotion {
        pose: from_pose(rigid.position()),
        velocity,
    }
}

pub(super) fn joint_state(link: &Link) -> JointState {
    let motor = link.drive.map(|drive| articulation::Motor {
        velocity: drive.velocity,
        max_force: drive.force,
    });
    JointState {
        position: link.motion.position,
        velocity: link.motion.velocity,
        motor,
        limits: link.stops,
        passive: link.passive,
    }
}

pub(super) fn linear(v: &Vector6<f64>) -> [f64; 3] {
    [v[0], v[1], v[2]]
}

pub(super) fn angular(v: &Vector6<f64>) -> [f64; 3] {
    [v[3], v[4], v[5]]
}
