//! Forward and inverse kinematics of joints in a tree.
//!
//! # Design
//!
//! | part | contains |
//! |---|---|
//! | [`Environment`] | a tree of dummies and joints ([`Object`]), by numbers that are never used twice; it knows no scene |
//! | [`Group`], [`Element`] | a task: the tip of each element reaches its target, in the axes of its constraints, relative to its base |
//! | chain (`chain.rs`) | an element compiled: the joints from the base to the tip with fixed transforms between them, kept until the tree changes |
//! | equations (`equations.rs`) | Jacobian and errors of a group |
//! | least squares (`least_squares.rs`) | damped and undamped pseudo-inverse: Cholesky where it is exact enough, else singular values |
//! | [`Environment::handle`] | iterations of one or several groups, the first with the highest priority (`solver.rs`) |
//! | [`Environment::find_posture`] | any posture that satisfies a group: Levenberg-Marquardt from random starts (`search.rs`) |
//! | [`Environment::to_bytes`] | an environment as bytes |
//!
//! # Units and frames
//!
//! Metres and radians. A joint moves along or about the z axis of its own frame; its children are attached to its moving side. Poses relative
//! to a joint refer to its moving side. Orientation errors are Euler angles (alpha, beta, gamma; R = Rx Ry Rz) of the target as the tip sees it. Rows of a full orientation
//! are along the axes of the constraint base, as those of positions; rows of a part of it (`alpha_beta` alone, `gamma` alone) along the
//! axes of the tip, whose z they are about.
//!
//! # Limits
//!
//! Kinematics only: no masses, no collisions. The Jacobian of an element has columns for the joints between its base and its tip (and
//! for masters of dependent ones); joints that move its target count through other elements of the group. Nothing panics or loops on
//! any input: numbers that are not finite end a calculation with [`Flags::CANNOT_INVERT`].
//!
//! # Determinism
//!
//! No clock, no hashing, no fused arithmetic; sines from `libm`. Random starts come from the environment's own generator.
//!
//! ```
//! use kinematics::*;
//!
//! let mut arm = Environment::new(1);
//! let shoulder = arm.create_joint("shoulder", JointType::Revolute);
//! let elbow = arm.create_joint("elbow", JointType::Revolute);
//! let (tip, target) = (arm.create_dummy("tip"), arm.create_dummy("target"));
//! let reach = Pose::translation(0.5, 0.0, 0.0);
//! arm.set_parent(elbow, Some(shoulder), true)?;
//! arm.set_pose(elbow, reach, Frame::Object(shoulder))?;
//! arm.set_parent(tip, Some(elbow), true)?;
//! arm.set_pose(tip, reach, Frame::Object(elbow))?;
//! arm.set_joint_position(elbow, 0.6)?;
//! arm.set_pose(target, Pose::translation(0.6, 0.5, 0.0), Frame::World)?;
//! arm.set_partner(tip, Some(target))?;
//!
//! let group = arm.create_group("arm");
//! arm.group_mut(group)?.iterations = 20;
//! arm.add_element(group, tip)?;
//! let outcome = arm.handle(&[group])?;
//! assert!(outcome.is_success());
//! assert!((arm.pose(tip, Frame::World)?.translation.vector - nalgebra::Vector3::new(0.6, 0.5, 0.0)).norm() < 5e-4);
//! # Ok::<(), KinematicsError>(())
//! ```

mod chain;
mod environment;
mod equations;
mod error;
mod group;
mod joint;
mod least_squares;
mod object;
mod queries;
mod random;
mod rigid;
mod search;
mod solver;
mod step;
mod stored;

pub use environment::{Environment, Frame};
pub use equations::{Equations, JacobianColumn, JacobianRow};
pub use error::{KinematicsError, Result};
pub use geometry::Pose;
pub use group::{
    Constraints, Element, ElementId, Flags, Group, GroupFlags, GroupId, LimitHit, Method,
};
pub use joint::{Dependency, Joint, JointMode, JointType, Law};
pub use object::{Object, ObjectId};
pub use queries::Posture;
pub use random::Random;
pub use search::Start;
pub use solver::{Outcome, Revise, Revision};
