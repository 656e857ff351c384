//! Tendons over bodies and joints of a mechanism: their forces are those for which the mechanism gets the rates that they were found for.
//!
//! The mechanism is solved without them, and once more with a small force of each tendon, which gives the response of rates to forces. Contacts, limits and motors change that: forces and responses are
//! then improved by Broyden's method (C. G. Broyden, *A class of methods for solving nonlinear simultaneous equations*, 1965).

use articulation::JointState;
use nalgebra::{DMatrix, DVector, Vector6};

use super::{Linked, PROBED_SPEED};
use crate::links::Links;
use crate::plan::LinkKind;
use crate::tendons::{Layout, Pull, Tendon, Wrench};
use scene::Handle;

/// How often the forces are improved at most.
const MAX_ITERATIONS: usize = 8;
/// Forces that give rates nearer than this to those they were found for are right, m/s.
const RATE_TOLERANCE: f64 = 1e-9;
/// The same as a fraction of the rate.
const RELATIVE_TOLERANCE: f64 = 1e-7;
/// How often the tendons are visited to find forces that fit each other.
const MAX_SWEEPS: usize = 100;

/// A tendon of a mechanism in a sub-step.
pub(super) struct Strand {
    /// By the index of the joint, and what its position counts.
    joints: Vec<(usize, f64)>,
    /// By the index of the body: what a force of 1 N does to it.
    wrenches: Vec<(usize, Vector6<f64>)>,
    /// The rate that an impulse of 1 N s along the joints gives, if nothing but what they move resists, m/s.
    response_of_joints: f64,
    /// The rate by what moves without being of the mechanism, m/s.
    carried: f64,
    pull: Pull,
    /// N
    force: f64,
}

impl Linked {
    /// Adds a tendon for a sub-step. `index`: of bodies of the mechanism that move; `carried`: the rate by the other ones, m/s.
    pub(in crate::mechanisms) fn add_tendon(
        &mut self,
        tendon: &Tendon,
        layout: &Layout,
        index: impl Fn(Handle) -> Option<usize>,
        carried: f64,
        links: &Links,
    ) {
        let joints = tendon.plan.joints.iter().filter_map(|part| {
            let place = links.place(part.joint)?;
            let number = self.links.iter().position(|link| *link == place)?;
            Some((number, part.factor))
        });
        let joints: Vec<(usize, f64)> = joints.collect();
        let of_body = |wrench: &Wrench| Some((index(wrench.body)?, wrench.spatial()));
        let wrenches: Vec<(usize, Vector6<f64>)> =
            layout.wrenches.iter().filter_map(of_body).collect();
        let of_joints = joints.iter().map(|(joint, factor)| {
            let link = links.at(self.links[*joint]);
            factor * link.motion.velocity
        });
        let of_wrenches = wrenches
            .iter()
            .map(|(body, wrench)| wrench.dot(&self.input.bodies[*body].motion.velocity));
        let rate = carried + of_joints.sum::<f64>() + of_wrenches.sum::<f64>();
        let responses = tendon.plan.joints.iter().filter_map(|part| {
            let plan = &links.get(part.joint)?.plan;
            let [mass, .., moment] = self.bodies[index(plan.second)?].mass();
            let inertia = if plan.kind == LinkKind::Revolute {
                moment
            } else {
                mass
            };
            Some(part.factor * part.factor / inertia)
        });
        self.strands.push(Strand {
            response_of_joints: responses.sum(),
            joints,
            wrenches,
            carried,
            pull: tendon.pull(layout.length, rate, self.input.step),
            force: 0.0,
        });
    }

    /// Finds the forces of joints, contacts and tendons.
    pub(super) fn solve_with_tendons(&mut self, probe: Option<(usize, Vector6<f64>)>) {
        self.strands.iter_mut().for_each(Strand::relax);
        self.solve_once(probe);
        let mut free = self.rates();
        // Forces that do not depend on rates count for the rates of the others.
        let constant = self.strands.iter().zip(&free);
        let constant: Vec<Option<f64>> = constant
            .map(|(strand, rate)| strand.pull.constant_force(*rate))
            .collect();
        let acting: Vec<usize> = (0..constant.len())
            .filter(|number| constant[*number].is_none())
            .collect();
        for (strand, force) in self.strands.iter_mut().zip(constant) {
            strand.force = force.unwrap_or(0.0);
        }
        if self.strands.iter().any(|strand| strand.force != 0.0) {
            self.solve_once(probe);
            free = self.rates();
        }
        if self.is_solved && !acting.is_empty() {
            self.improve(probe, &acting, &free);
        }
    }

    /// Finds the forces of the tendons `acting`, of which the rates are `free` without them.
    fn improve(&mut self, probe: Option<(usize, Vector6<f64>)>, acting: &[usize], free: &[f64]) {
        let of_acting = |rates: &[f64]| {
            DVector::from_iterator(acting.len(), acting.iter().map(|number| rates[*number]))
        };
        let mut rates = of_acting(free);
        let mut response = DMatrix::zeros(acting.len(), acting.len());
        for (column, &number) in acting.iter().enumerate() {
            let force = self.probing_force(number);
            self.strands[number].force = force;
            self.solve_once(probe);
            let changed = (of_acting(&self.rates()) - &rates) / force;
            self.strands[number].force = 0.0;
            if changed.iter().all(|x| x.is_finite()) {
                response.set_column(column, &changed);
            }
        }
        let mut forces = DVector::zeros(acting.len());
        for _ in 0..MAX_ITERATIONS {
            let before = forces.clone();
            self.balance(acting, &rates, &response, &mut forces);
            self.set_forces(acting, &forces);
            self.solve_once(probe);
            let found = of_acting(&self.rates());
            let change = &forces - &before;
            let error = &found - (&rates + &response * &change);
            let is_small = |(error, rate): (&f64, &f64)| {
                error.abs() <= RATE_TOLERANCE + RELATIVE_TOLERANCE * rate.abs()
            };
            if !self.is_solved || error.iter().zip(&found).all(is_small) {
                break;
            }
            rates = found;
            let square = change.norm_squared();
            if square > 0.0 {
                response.ger(1.0 / square, &error, &change, 1.0);
            }
        }
    }

    /// Finds the forces that go with the rates that they give: `rates` are those of the forces so far.
    fn balance(
        &self,
        acting: &[usize],
        rates: &DVector<f64>,
        response: &DMatrix<f64>,
        forces: &mut DVector<f64>,
    ) {
        let mut expected = rates.clone();
        for _ in 0..MAX_SWEEPS {
            let mut largest: f64 = 0.0;
            for (place, &number) in acting.iter().enumerate() {
                let mobility = response[(place, place)].max(0.0);
                let free = expected[place] - mobility * forces[place];
                let force = self.strands[number].pull.force(free, mobility);
                let change = force - forces[place];
                forces[place] = force;
                expected += response.column(place) * change;
                largest = largest.max(change.abs() / (1.0 + force.abs()));
            }
            if largest < 1e-12 {
                break;
            }
        }
    }

    fn set_forces(&mut self, acting: &[usize], forces: &DVector<f64>) {
        for (number, force) in acting.iter().zip(forces) {
            self.strands[*number].force = if force.is_finite() { *force } else { 0.0 };
        }
    }

    /// The rates of the tendons at the end of the sub-step, as it was solved.
    fn rates(&self) -> Vec<f64> {
        let joints: Vec<f64> = self.mechanism.axis_velocities().collect();
        let bodies: Vec<&Vector6<f64>> = self.mechanism.velocities().collect();
        let rate = |strand: &Strand| {
            let of_joints = strand.joints.iter().map(|(joint, x)| joints[*joint] * x);
            let of_bodies = strand.wrenches.iter().map(|(body, x)| bodies[*body].dot(x));
            strand.carried + of_joints.sum::<f64>() + of_bodies.sum::<f64>()
        };
        self.strands.iter().map(rate).collect()
    }

    /// A force that gives a tendon a small rate, if nothing but its bodies resists.
    fn probing_force(&self, number: usize) -> f64 {
        let strand = &self.strands[number];
        let mass = |body: usize| self.bodies[body].mass();
        let of_bodies = strand.wrenches.iter().map(|(body, wrench)| {
            let mass = mass(*body);
            (0..6)
                .map(|axis| wrench[axis].powi(2) / mass[axis])
                .sum::<f64>()
        });
        let mobility = (of_bodies.sum::<f64>() + strand.response_of_joints) * self.input.step;
        if mobility > 0.0 && mobility.is_finite() {
            PROBED_SPEED / mobility
        } else {
            PROBED_SPEED
        }
    }

    /// What the tendons do to the bodies, about their centres of mass: N, N m.
    pub(super) fn tendon_loads(&self) -> impl Iterator<Item = (usize, Vector6<f64>)> {
        let loads = |strand: &Strand| {
            let force = strand.force;
            let wrenches = strand.wrenches.iter();
            wrenches
                .map(move |(body, wrench)| (*body, wrench * force))
                .collect::<Vec<_>>()
        };
        self.strands.iter().flat_map(loads)
    }

    /// The joints with what the tendons do along their axes; None without tendons.
    pub(super) fn joints_with_tendons(&self) -> Option<Vec<JointState>> {
        let mut joints = (!self.strands.is_empty()).then(|| self.input.joints.clone())?;
        for strand in &self.strands {
            for (joint, factor) in &strand.joints {
                joints[*joint].passive.effort += factor * strand.force;
            }
        }
        Some(joints)
    }
}

impl Strand {
    fn relax(&mut self) {
        self.force = 0.0;
    }
}
