//! Light links under tension, which swing to and fro like a string: faster than sub-steps can follow when the load is heavy.
//!
//! A body that turns by a small angle `a` out of the line of the forces at its ends is turned back by the torque `k a`, the forces times
//! their levers. A sub-step `t` follows such a swing as long as `k t^2 < 4 i`, `i` being the body's inertia; beyond, energy comes from nowhere.
//! In a chain `k` is exactly that of each body by itself, and its neighbours only add inertia, so that it suffices to look at one after the
//! other. A body for which the sub-step is too long gets as much inertia as it needs about its free axes, as in Newmark's
//! method: such swings are slower than they should be, while those that can be followed hardly feel it.
//! (S. Andrews and others, Geometric Stiffness for Real-time Constrained Multibody Dynamics, 2017.)

use nalgebra::{Matrix3, Vector3};

use super::chain::Chain;
use super::mover::Mover;
use super::node::Node;

/// Inertia is added until `k t^2` is this many times the inertia.
const WANTED: f64 = 2.0;
/// Inertia is added at once where the forces turn out to make it more than this.
const MOST: f64 = 3.0;

/// What tension makes of a body.
#[derive(Default)]
pub(super) struct Taut {
    /// The torques that turn the body back, times the square of the sub-step.
    stiffness: Matrix3<f64>,
    /// What the body's mass adds to its inertia, where it hangs on a point that does not move.
    carried: Matrix3<f64>,
    /// Inertia it is given, world axes.
    added: Option<Matrix3<f64>>,
}

impl Taut {
    pub(super) fn added(&self) -> Option<&Matrix3<f64>> {
        self.added.as_ref()
    }
}

impl Chain {
    /// Begins a sub-step with the inertia that the forces of the one before ask for.
    pub(super) fn steady(&mut self, step: f64) {
        for mover in self.movers.iter_mut().filter(|mover| mover.taut.added.is_some()) {
            mover.taut.added = None;
            mover.respond();
        }
        self.add_inertia(WANTED, step);
    }

    /// Adds what the forces ask for that were just found; true when the system must be solved again.
    pub(super) fn steady_more(&mut self, step: f64) -> bool {
        self.add_inertia(MOST, step)
    }

    fn add_inertia(&mut self, most: f64, step: f64) -> bool {
        for mover in &mut self.movers {
            (mover.taut.stiffness, mover.taut.carried) = (Matrix3::zeros(), Matrix3::zeros());
        }
        for node in self.nodes.iter().filter(|node| node.holds_point()) {
            let [first, second] = node.ends.map(|end| self.movers[end].moves());
            for (side, other_moves) in [second, first].into_iter().enumerate() {
                self.movers[node.ends[side]].feel_tension(node, side, other_moves, step);
            }
        }
        let mut added = false;
        for node in &self.nodes {
            for axis in node.free_axes() {
                for end in node.ends {
                    added |= self.movers[end].add_inertia(&axis, most);
                }
            }
        }
        added
    }
}

impl Node {
    /// Whether the link holds a point of one body to a point of the other.
    fn holds_point(&self) -> bool {
        self.locked[..3].iter().all(|&locked| locked)
    }

    /// The axes its bodies may turn about against each other.
    fn free_axes(&self) -> impl Iterator<Item = Vector3<f64>> {
        let axis = |row: usize| self.jacobians[1].row(row).fixed_columns::<3>(3).transpose();
        (3..6).filter(|&row| !self.acts(row)).map(axis)
    }
}

impl Mover {
    fn feel_tension(&mut self, node: &Node, side: usize, other_moves: bool, step: f64) {
        let lever = node.point - self.com;
        let force = (node.jacobians[side].transpose() * node.impulse).fixed_rows::<3>(0).into_owned();
        let across = lever * force.transpose();
        let turned_back = Matrix3::identity() * lever.dot(&force) - (across + across.transpose()) * 0.5;
        self.taut.stiffness += turned_back * step;
        if !other_moves && self.moves() {
            let square = Matrix3::identity() * lever.norm_squared() - lever * lever.transpose();
            self.taut.carried += square / self.inverse_mass;
        }
    }

    /// Adds inertia about an axis if that is needed there.
    fn add_inertia(&mut self, axis: &Vector3<f64>, most: f64) -> bool {
        let stiffness = axis.dot(&(self.taut.stiffness * axis));
        let answer = axis.dot(&(self.response.fixed_view::<3, 3>(3, 3) * axis));
        let may_need = self.moves() && stiffness.is_finite() && stiffness * answer > most;
        if !may_need {
            return false;
        }
        let added = self.taut.added.unwrap_or_else(Matrix3::zeros);
        let inertia = axis.dot(&((self.world_inertia() + self.taut.carried + added) * axis));
        if stiffness <= most * inertia {
            return false;
        }
        self.taut.added = Some(added + axis * axis.transpose() * (stiffness / WANTED - inertia));
        self.respond();
        true
    }
}
