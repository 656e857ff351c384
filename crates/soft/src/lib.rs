//! Ropes and cables as elastic rods that stretch, bend and twist, in contact with friction, coupled with rigid bodies.
//!
//! This crate knows no engine and no scene: an engine passes, before each step, gravity, the places where rods are held, the rigid bodies they pull at with what
//! an impulse does to these, and the contacts that it found. [`solve`] moves the rods and says which impulses the bodies receive.
//!
//! # Method
//!
//! - A rod is a chain of nodes with an angle of twist on each edge: discrete elastic rods (M. Bergou, M. Wardetzky, S. Robinson, B. Audoly and E. Grinspun, 2008;
//!   M. Bergou, B. Audoly, E. Vouga, M. Wardetzky and E. Grinspun, *Discrete viscous threads*, 2010). Curvature and twist are those of finite rotations, so that
//!   statics converge to Kirchhoff's rods (the elastica) with the square of the length of an edge. Mass is at the nodes.
//! - Time is integrated implicitly, by BDF2: second order, and what the step cannot resolve, such as vibrations along a stiff cable, is damped out, so that
//!   no stiffness is too high for a step. That looks back at two steps, and would return a third of an impact in the next step: while something is near a rod, or
//!   something has just changed, its steps are those of backward Euler. They damp what moves with the angular frequency w by w h / 2 of the critical damping.
//! - The equations of a step are solved by Newton's method. The unknowns of a rod are coupled to their neighbours only, so the matrix is banded and factorised
//!   directly: what a step costs grows linearly with the number of nodes, and the result is independent of their order. The tangent has the geometric stiffness of
//!   tension, and Gauss and Newton's approximation of the rest, so that it is positive definite.
//! - Rigid bodies at which rods are held, or that they touch, are unknowns too: six for each, by the Schur complement of all rods. What a body resists with is
//!   the response the engine says, which for a robot's hand is that of the whole robot with its motors. The impulses on bodies are those on rods with the opposite sign.
//! - Contacts push by stiff springs, and stick by springs along the surface that give way at Coulomb's limit (return mapping), so that what lies still does not creep.
//!   Contacts of rods with themselves and each other are found by [`between`]. They couple nodes far apart, so that each adds three common unknowns. Those with cloths
//!   and volumes are found by [`fem::nearby`], and solved with these ([`solve_system`]).
//!
//! # Limits
//!
//! Cross sections are circular. Friction turns no rod about its own axis. Normals of contacts are those at the beginning of the step.
//!
//! # Determinism
//!
//! No clock, no hashing, no threads; functions of `libm`: the same calls have the same bits.

mod assembly;
mod banded;
mod between;
mod body;
mod bound;
mod condensation;
mod contact;
mod elastic;
pub mod fem;
mod frames;
mod material;
mod newton;
mod rod;
mod scheme;
mod soft_system;
mod touch;

pub use between::between;
pub use body::Body;
pub use contact::{Contact, Surface};
pub use material::Material;
pub use newton::{Step, solve};
pub use rod::{Hold, Rod, Target};
pub use soft_system::{SoftSystem, solve_system};
pub use touch::Touch;

use nalgebra::Vector3;

/// A vector in the world: metres, newtons.
pub type V3 = Vector3<f64>;
