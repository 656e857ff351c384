//! Bodies in a fluid: a body is slowed down as the box is that has its mass and its moments of inertia.
//!
//! The model is that of MuJoCo's manual (*Computation*, passive forces, inertia model). Along a principal axis, across which the box has the area `A`, the fluid
//! presses with `density A v²/2`, and it resists with `3 pi d viscosity v`, where `d` is the mean edge; likewise about the axes. The force is
//! that at the begin of the step; one that would turn a free body back stops it.

use std::f64::consts::PI;

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::RigidBody;
use scene::shape::Fluid;

/// Force at the centre of mass and torque on a body in a fluid of which all moves with `wind`, in the world's frame: N, N m.
pub(super) fn drag(fluid: Fluid, wind: Vector, rigid: &RigidBody, step: f64) -> [Vector; 2] {
    let properties = rigid.mass_properties();
    let moments = properties.local_mprops.principal_inertia();
    let frame = rigid.position().rotation * properties.local_mprops.principal_inertia_local_frame;
    let mass = rigid.mass();
    let com = rigid.center_of_mass();
    let linear = frame.inverse() * (rigid.velocity_at_point(com) - wind);
    let angular = frame.inverse() * rigid.angvel();
    let Some(edges) = edges(mass, moments) else {
        return [Vector::ZERO; 2];
    };
    let [along, about] = coefficients(fluid, edges, linear, angular);
    let force = damped(along, linear, Vector::splat(mass), step);
    let torque = damped(about, angular, moments, step);
    [frame * force, frame * torque]
}

/// The edges of the box with that mass and those principal moments of inertia, metres.
fn edges(mass: f64, moments: Vector) -> Option<Vector> {
    let sum = moments.x + moments.y + moments.z;
    let squares = (Vector::splat(sum) - moments * 2.0) * (6.0 / mass);
    let edges = squares.max(Vector::ZERO).map(f64::sqrt);
    (edges.is_finite() && mass > 0.0).then_some(edges)
}

/// Force per speed along the axes, and torque per angular speed about them.
fn coefficients(fluid: Fluid, edges: Vector, linear: Vector, angular: Vector) -> [Vector; 2] {
    let Fluid { density, viscosity } = fluid;
    let mean = (edges.x + edges.y + edges.z) / 3.0;
    let areas = Vector::new(edges.y * edges.z, edges.x * edges.z, edges.x * edges.y);
    let fourth = edges * edges * edges * edges;
    let swept = edges * (Vector::splat(fourth.x + fourth.y + fourth.z) - fourth);
    let along = areas * linear.abs() * (density / 2.0) + Vector::splat(3.0 * PI * mean * viscosity);
    let about = swept * angular.abs() * (density / 64.0)
        + Vector::splat(PI * mean * mean * mean * viscosity);
    [along, about]
}

/// The force against a velocity, at most the one that stops a free body in a step.
fn damped(coefficients: Vector, velocity: Vector, inertia: Vector, step: f64) -> Vector {
    let share = coefficients * step / inertia;
    let force = -coefficients * velocity / share.max(Vector::ONE);
    if force.is_finite() {
        force
    } else {
        Vector::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLUID: Fluid = Fluid {
        density: 100.0,
        viscosity: 2.0,
    };

    #[test]
    fn the_box_is_that_of_the_moments() {
        let [x, y, z] = [1.0, 2.0, 3.0_f64];
        let moments = Vector::new(y * y + z * z, x * x + z * z, x * x + y * y) * (12.0 / 12.0);
        let found = edges(12.0, moments).expect("a box");
        assert!((found - Vector::new(x, y, z)).length() < 1e-12, "{found:?}");
        assert_eq!(edges(0.0, moments), None);
    }

    #[test]
    fn a_box_is_slowed_down_by_its_areas_and_its_size() {
        let edges = Vector::new(1.0, 2.0, 3.0);
        let (linear, angular) = (Vector::new(0.0, -2.0, 0.0), Vector::new(0.0, 0.0, 0.5));
        let [along, about] = coefficients(FLUID, edges, linear, angular);
        let [slow, slow_turn] = [3.0 * PI * 2.0 * 2.0, PI * 8.0 * 2.0];
        // Across y: 1 m by 3 m, at 2 m/s.
        assert!((along - Vector::new(slow, 50.0 * 3.0 * 2.0 + slow, slow)).length() < 1e-9);
        // About z, 3 m long: edges of 1 m and 2 m.
        let turn = 100.0 / 64.0 * 3.0 * (1.0 + 16.0) * 0.5;
        assert!((about - Vector::new(slow_turn, slow_turn, slow_turn + turn)).length() < 1e-9);
    }

    #[test]
    fn no_drag_turns_a_body_back() {
        for (coefficient, force) in [(0.5, -0.5), (100.0, -100.0), (1e6, -100.0)] {
            let found = damped(Vector::splat(coefficient), Vector::X, Vector::ONE, 0.01);
            assert!((found - Vector::X * force).length() < 1e-9, "{found:?}");
        }
    }
}
