//! What Newton's method on contacts solves for: the velocities of all bodies, or, in trees with few free axes, those along the axes.

use nalgebra::Vector3;

use crate::mechanism::Mechanism;

/// The unknowns of Newton's method, with their values before the present step of it.
pub(super) trait Unknowns {
    /// Solves for contacts that act as they do near the last velocities; false where there is no solution. `is_first`: for these joints and places of the bodies.
    fn solve(&mut self, mechanism: &mut Mechanism, is_first: bool) -> bool;

    /// The relative velocities at the contacts, along their axes.
    fn at_contacts(&self, mechanism: &Mechanism, velocities: &mut Vec<Vector3<f64>>);

    /// Notes the present values as those before the next step.
    fn keep(&mut self, mechanism: &Mechanism);

    /// Twice the kinetic energy of the change since then, with what is passive along the axes.
    fn square_of_step(&self, mechanism: &Mechanism) -> f64;

    /// Goes back to a part of the way from there.
    fn shorten(&mut self, mechanism: &mut Mechanism, share: f64);

    /// Gives the bodies their velocities.
    fn finish(&mut self, mechanism: &mut Mechanism);
}
