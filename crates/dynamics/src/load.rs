//! The load a rigid link transmits, from the impulses rapier reports for it.
//!
//! rapier solves the six rows of a locked joint after making them independent of each other (modified Gram-Schmidt in the metric of
//! the inverse masses), so an impulse belongs to a combination of rows. The same is done here, in the same order, to get the force
//! and the torque back.

use nalgebra::{Matrix3, Vector3};
use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};

use super::convert::{from_pose, from_vector};
use super::plan::LinkPlan;
use super::world::World;
use scene::Pose;

/// Force and torque on the parent, in the frame of the sensor.
pub(super) type Load = ([f64; 3], [f64; 3]);

/// The rows of a locked joint as the solver sees them in one sub-step.
pub(super) struct Rows {
    base: Pose,
    /// Centre of mass of the second body, world.
    com: Vector3<f64>,
    rows: [Row; 6],
}

#[derive(Clone, Copy)]
struct Row {
    linear: Vector3<f64>,
    angular: [Vector3<f64>; 2],
}

/// How a body answers impulses: inverse mass and inverse inertia, world axes.
struct Response {
    mass: f64,
    inertia: Matrix3<f64>,
}

impl Rows {
    pub(super) fn new(
        world: &World,
        bodies: [RigidBodyHandle; 2],
        plan: &LinkPlan,
    ) -> Option<Self> {
        let [first, second] = [world.bodies.get(bodies[0])?, world.bodies.get(bodies[1])?];
        let base = from_pose(first.position()) * plan.base;
        let tip = from_pose(second.position()) * plan.tip;
        let axes = base.rotation.to_rotation_matrix();
        // All axes are locked: both levers reach to the base.
        let levers = [first, second].map(|body| base.translation.vector - com(body));
        let tip_lever = tip.translation.vector - com(second);
        let row = |i: usize| {
            let axis: Vector3<f64> = axes.matrix().column(i % 3).into();
            match i {
                0..3 => Row {
                    linear: Vector3::zeros(),
                    angular: [axis * 0.5; 2],
                },
                _ => Row {
                    linear: axis,
                    angular: [levers[0].cross(&axis), tip_lever.cross(&axis)],
                },
            }
        };
        let mut rows = [0, 1, 2, 3, 4, 5].map(row);
        make_independent(&mut rows, &[response(first), response(second)]);
        Some(Self {
            base,
            com: com(second),
            rows,
        })
    }

    /// Load of the second body on the first through the link, from the solver's impulses over `step` seconds.
    pub(super) fn load(&self, impulses: &[f64; 6], step: f64) -> Load {
        // rapier numbers the axes linear first.
        let of_row = |i: usize| impulses[(i + 3) % 6] / step;
        let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
        for (i, row) in self.rows.iter().enumerate() {
            force += row.linear * of_row(i);
            torque += row.angular[1] * of_row(i);
        }
        // From the centre of mass to the sensor.
        torque += (self.com - self.base.translation.vector).cross(&force);
        let local = |v: Vector3<f64>| self.base.rotation.inverse_transform_vector(&v).into();
        (local(force), local(torque))
    }
}

fn com(body: &RigidBody) -> Vector3<f64> {
    from_vector(body.center_of_mass()).into()
}

fn response(body: &RigidBody) -> Response {
    if !body.is_dynamic() {
        return Response {
            mass: 0.0,
            inertia: Matrix3::zeros(),
        };
    }
    let inverse = body.mass_properties().effective_world_inv_inertia;
    Response {
        mass: 1.0 / body.mass(),
        inertia: Matrix3::new(
            inverse.m11,
            inverse.m12,
            inverse.m13,
            inverse.m12,
            inverse.m22,
            inverse.m23,
            inverse.m13,
            inverse.m23,
            inverse.m33,
        ),
    }
}

fn make_independent(rows: &mut [Row; 6], bodies: &[Response; 2]) {
    let dot = |a: &Row, b: &Row| {
        let linear = a.linear.dot(&b.linear) * (bodies[0].mass + bodies[1].mass);
        linear
            + (0..2)
                .map(|i| (bodies[i].inertia * a.angular[i]).dot(&b.angular[i]))
                .sum::<f64>()
    };
    for j in 0..rows.len() {
        let done = rows[j];
        let norm = dot(&done, &done);
        for row in rows.iter_mut().skip(j + 1).filter(|_| norm > 0.0) {
            let share = dot(row, &done) / norm;
            row.linear -= done.linear * share;
            for i in 0..2 {
                row.angular[i] -= done.angular[i] * share;
            }
        }
    }
}
