//! Bodies linked by joints: the impulses that satisfy all joints, motors, limits and force sensors of a mechanism at once.
//!
//! Iterative solvers of physics engines visit one joint after the other, and a chain under load needs hundreds of visits. The joints of
//! a mechanism form a sparse system, mostly a tree, that is solved here exactly in a time proportional to its length. This crate knows no
//! engine, no scene and no contacts: an engine passes the state of its bodies before a step, applies the resulting forces with its own
//! integration and contact solver, and passes the state after the step for the correction of positions.
//!
//! | in | out |
//! |---|---|
//! | once: mass, centre of mass, inertia of bodies ([`BodyProperties`]); kind, bodies and frames of joints ([`JointProperties`]) | a [`Mechanism`] |
//! | before a step: poses, velocities, external forces ([`BodyState`]); motors, limits, positions, springs, dampers, rotors, dry friction ([`JointState`], [`Passive`]); gravity; contacts ([`Contact`]), or their expected impulses | forces on bodies ([`Mechanism::body_loads`]), forces in joints ([`Mechanism::joint_loads`]) |
//! | without an engine: the motion over the step | poses and velocities ([`Mechanism::integrate`]) |
//! | after the step: poses and velocities ([`BodyMotion`]) | corrected poses and velocities ([`Mechanism::correct_positions`]) |
//!
//! # Units and frames
//!
//! Metres, radians, kilograms, seconds, newtons. All six-vectors are linear first, then angular, along the axes of the world, and forces
//! and velocities of bodies refer to their centres of mass. A joint's axis is the z of its base; its forces are along the axes of the base.
//!
//! # Method
//!
//! 1. Velocities at the end of the step are predicted from gravity, external forces, expected contact impulses and the gyroscopic torque.
//! 2. The impulses of joints and the velocities follow from a system of equations. Without loops it is solved by the articulated-body
//!    algorithm (R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008), which only knows the free axes. With loops every joint has six rows;
//!    active are the locked ones and those of motors and limits. With the Jacobian `J` of the active rows and the
//!    masses `M`, the system `(J M^-1 J^T + C) lambda = b - J v` gives the impulses `lambda` (D. Baraff, *Linear-time dynamics using
//!    Lagrange multipliers*, SIGGRAPH 1996). Two joints are coupled where they share a body that moves, so that the matrix has a 6 x 6 block for
//!    each such pair. It is factorised by a sparse block Cholesky decomposition; loops
//!    cause fill-in. The compliance `C`, a relative 1e-9, makes redundant rows solvable.
//! 3. A motor beyond its largest force becomes a known force (saturated), a limit that would pull becomes inactive, one that is reached
//!    active; the system is then solved again, at most eight times: an active-set method without guarantee of the optimum, which in
//!    practice ends after one or two solutions since it begins with the set of the step before.
//! 4. Contacts push, with friction forces within the friction cone. Contacts are barely compliant, so that velocities minimise a convex function for given limits
//!    of friction: Newton's method with exact line search finds them, with the resistance of contacts as inertia of the bodies of the tree (A. Castro, F. Permenter
//!    and X. Han, 2022), and the limits follow the normal impulses. Where that does not converge, nonsmooth conjugate gradients (M. Silcowitz, S. Niebe and K.
//!    Erleben, 2010) of projected Gauss-Seidel sweeps find the impulses. Free bodies that touch the mechanism take part as guests.
//! 5. Light bodies under heavy tension get additional inertia, so that explicit integration stays stable (S. Andrews, M. Teichmann and
//!    P. Kry, *Geometric stiffness for real-time constrained multibody dynamics*, 2017).
//! 6. After the step, gaps of the joints are closed by moving the bodies along the rows with the same factor, and velocities are changed
//!    by the displacement over the step: a SHAKE step (J.-P. Ryckaert, G. Ciccotti and H. Berendsen, 1977), which keeps the
//!    energy over long times. Bodies that turn far about a joint in a step (rotors) have their rotation composed of the turn about the axis and
//!    the turn of the axis.
//!
//! # Limits
//!
//! Joints are revolute (with a pitch: screws), prismatic, spherical or fixed. Where a mechanism touches
//! another one, contacts enter as expected impulses only, and the engine should have its own joints active as well. The response of contacts to
//! each other is dense: about a hundred points are the limit. [`Mechanism::solve`] returns false where numbers leave the range of
//! floating point; nothing panics on any state. Fill-in makes loops cost more: a grid of `n` loops is superlinear.
//!
//! # Determinism
//!
//! Single-threaded, no hashing, no clocks: the same calls have the same bits.
//!
//! ```
//! use articulation::*;
//! use geometry::Pose;
//! use nalgebra::{Matrix3, Vector3, Vector6};
//!
//! // A rod of 1 kg whose centre is 0.25 m in front of a hinge about y, held by a motor.
//! let about_y = nalgebra::UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
//! let frame = |x: f64| Pose::from_parts(Vector3::new(x, 0.0, 0.0).into(), about_y);
//! let hinge = JointProperties { kind: JointKind::Revolute, bodies: [0, 1], base: frame(0.0), tip: frame(-0.25), pitch: 0.0 };
//! let rod = BodyProperties::dynamic(1.0, Matrix3::from_diagonal_element(0.02), Vector3::zeros());
//! let mut mechanism = Mechanism::new(vec![BodyProperties::immovable(Vector3::zeros()), rod], vec![hinge]);
//!
//! let at_rest = |x: f64| BodyState {
//!     motion: BodyMotion { pose: Pose::translation(x, 0.0, 0.0), velocity: Vector6::zeros() },
//!     force: Vector6::zeros(),
//!     gyroscopic_velocity: Vector3::zeros(),
//!     target: None,
//! };
//! let motor = Some(Motor { velocity: 0.0, max_force: 100.0 });
//! let held = JointState { position: 0.0, velocity: 0.0, motor, limits: None, passive: Passive::default() };
//! mechanism.begin(&[at_rest(0.0), at_rest(0.25)], &[held], [0.0, 0.0, -9.81], 0.005);
//! assert!(mechanism.solve());
//! let load = mechanism.joint_loads().next().expect("one joint");
//! assert!((load.motor.abs() - 9.81 * 0.25).abs() < 1e-6);
//! ```

mod block_cholesky;
mod contact;
mod fast_rotor;
mod free_axis;
mod geometric_stiffness;
mod integration;
mod jacobian;
mod joint;
mod linked_body;
mod mechanism;
mod passive;
mod position_correction;
mod rows;
mod spatial_inertia;
mod system;
mod tree;
mod tree_growth;

use nalgebra::{Vector3, Vector6};

pub use contact::Contact;
pub use joint::{JointKind, JointLoad, JointProperties, JointState, Motor};
pub use linked_body::{BodyMotion, BodyProperties, BodyState};
pub use mechanism::Mechanism;
pub use passive::Passive;

/// Linear and angular part as one.
pub fn spatial(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
    )
}
