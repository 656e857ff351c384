//! The bodies that ropes pull at or touch.

use nalgebra::{Matrix3, Matrix6, Vector6};
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};
use scene::Handle;
use soft::{Body, V3};

use crate::convert::{from_vector, to_vector};

/// The bodies of a sub-step, in the order in which ropes found them.
#[derive(Default)]
pub(super) struct Coupled {
    all: Vec<(Handle, RigidBodyHandle)>,
}

impl Coupled {
    pub(super) fn clear(&mut self) {
        self.all.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The number of a body.
    pub(super) fn add(&mut self, shape: Handle, rigid: RigidBodyHandle) -> usize {
        let known = self.all.iter().position(|(known, _)| *known == shape);
        known.unwrap_or_else(|| {
            self.all.push((shape, rigid));
            self.all.len() - 1
        })
    }

    pub(super) fn shapes(&self) -> impl Iterator<Item = Handle> + '_ {
        self.all.iter().map(|(shape, _)| *shape)
    }

    pub(super) fn rigids(&self) -> impl Iterator<Item = RigidBodyHandle> + '_ {
        self.all.iter().map(|(_, rigid)| *rigid)
    }
}

/// Where a body would go, and what an impulse changes.
pub(crate) struct Response {
    com: [f64; 3],
    velocity: Vector6<f64>,
    response: Matrix6<f64>,
}

impl Response {
    /// Of a body that is linked with others, or touches them: velocity at the end of the sub-step, and what an impulse adds.
    pub(crate) fn linked(
        rigid: &RigidBody,
        velocity: Vector6<f64>,
        response: &Matrix6<f64>,
    ) -> Self {
        Self {
            com: from_vector(rigid.center_of_mass()),
            velocity,
            response: *response,
        }
    }

    /// Of a body that nothing but gravity and forces move.
    pub(crate) fn free(rigid: &RigidBody, gravity: [f64; 3], step: f64) -> Self {
        let mass = rigid.mass_properties();
        let inverse = mass.effective_inv_mass.x;
        let turning = inverse_inertia(rigid);
        let forced = rigid.linvel()
            + (to_vector(gravity) * rigid.gravity_scale() + rigid.user_force() * inverse) * step;
        let torque = V3::from(from_vector(rigid.user_torque()));
        let spin = V3::from(from_vector(rigid.angvel_with_gyroscopic_forces(step)));
        let mut velocity = Vector6::zeros();
        velocity
            .fixed_rows_mut::<3>(0)
            .copy_from(&V3::from(from_vector(forced)));
        velocity
            .fixed_rows_mut::<3>(3)
            .copy_from(&(spin + turning * torque * step));
        let mut response = Matrix6::zeros();
        response.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(inverse);
        response.fixed_view_mut::<3, 3>(3, 3).copy_from(&turning);
        Self::linked(rigid, velocity, &response)
    }

    pub(super) fn body(self) -> Body {
        Body::new(V3::from(self.com), self.velocity, self.response)
    }
}

fn inverse_inertia(rigid: &RigidBody) -> Matrix3<f64> {
    let inverse = rigid.mass_properties().effective_world_inv_inertia;
    let columns =
        [Vector::X, Vector::Y, Vector::Z].map(|axis| V3::from(from_vector(inverse * axis)));
    Matrix3::from_columns(&columns)
}
