//! One step of rods and the bodies that they are coupled with.

use nalgebra::{DVector, Vector6};

use crate::V3;
use crate::assembly::{CommonEquations, Equations, lever_map};
use crate::body::{Body, Unknown};
use crate::bound::{
    Bodies, add_contacts, add_holds, find_hold_forces, force_of, hold_potential, placed, point_on,
};
use crate::condensation::{change_of, condense};
use crate::contact::{Contact, Surface};
use crate::elastic::{Elastic, elastic_potential, strains};
use crate::rod::{Motion, Node, Rod, Target};
use crate::scheme::Scheme;

/// Distance of surfaces at which a contact counts as near, in radii.
const NEAR: f64 = 0.5;
/// Most iterations of Newton's method in a step.
const MAX_ITERATIONS: usize = 20;
/// Iterations after which the largest friction forces stay as they are, so that the rest of the step has a potential.
const FRICTION_ITERATIONS: usize = 3;
/// Change of places by which the solution counts as found, metres.
const TOLERANCE: f64 = 1e-7;
/// Farthest that a node goes in an iteration, in lengths of the shortest edge.
const LONGEST_WAY: f64 = 1.0;
/// The part of that up to which a change need not be looked at: there the equations are as good as linear.
const SURE_WAY: f64 = 1e-3;
/// Part of the potential that counts as nothing.
const ROUNDING: f64 = 1e-12;
/// How often a change is halved that goes too far.
const MAX_HALVINGS: usize = 10;

/// What acts in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// m/s2
    pub gravity: V3,
    /// Seconds.
    pub length: f64,
}

/// Moves rods, and finds the impulses on bodies and at contacts; false where there is no solution in finite numbers: then the rods stay where they are, at rest.
pub fn solve(rods: &mut [Rod], bodies: &mut [Body], contacts: &mut [Contact], step: Step) -> bool {
    let mut solver = Solver::new(rods, bodies, contacts, step);
    let outcome = solver.iterate(rods, bodies, contacts, step);
    match outcome {
        Outcome::Found => solver.finish(rods, bodies, contacts, step.length),
        // What holds a rod is far from it: it comes nearer, and pulls at nothing meanwhile.
        Outcome::OnTheWay => {
            let parts = rods.iter_mut().zip(&solver.schemes).zip(solver.trials);
            for ((rod, scheme), trial) in parts {
                move_on(rod, scheme, trial, step.length);
                stop(rod);
            }
        }
        Outcome::Lost => rods.iter_mut().for_each(stop),
    }
    outcome != Outcome::Lost
}

/// How a step ends.
#[derive(Clone, Copy, PartialEq)]
enum Outcome {
    /// The equations are solved.
    Found,
    /// They are not, since nodes would have to go too far.
    OnTheWay,
    /// There is no solution in finite numbers.
    Lost,
}

/// Lets a rod rest where it is.
pub(crate) fn stop(rod: &mut Rod) {
    let velocities = rod.now.velocities.iter_mut();
    velocities.for_each(|velocity| *velocity = Node::zeros());
    for hold in &mut rod.holds {
        (hold.force, hold.torque) = (V3::zeros(), V3::zeros());
    }
    rod.forget_history();
}

/// A change of the unknowns.
struct Change {
    rods: Vec<Vec<f64>>,
    /// Of the bodies, and of contacts of rods.
    common: DVector<f64>,
}

impl Change {
    /// How far a node goes at most; no number if one of the unknowns becomes none.
    fn farthest(&self) -> f64 {
        let all = || self.rods.iter().flatten().chain(self.common.iter());
        if !all().all(|x| x.is_finite()) {
            return f64::NAN;
        }
        let way = |part: &[f64]| V3::new(part[0], part[1], part[2]).norm();
        let ways = self.rods.iter().flat_map(|rod| rod.chunks(4).map(way));
        ways.fold(0.0, f64::max)
    }
}

struct Solver {
    /// Farthest that a node goes in an iteration, metres.
    longest_way: f64,
    schemes: Vec<Scheme>,
    trials: Vec<Vec<Node>>,
    equations: Vec<Equations>,
    unknowns: Vec<Unknown>,
    /// Largest elongations of the friction springs.
    limits: Vec<f64>,
}

impl Solver {
    fn new(rods: &mut [Rod], bodies: &mut [Body], contacts: &mut [Contact], step: Step) -> Self {
        for body in bodies.iter_mut() {
            body.impulse = Vector6::zeros();
        }
        contacts
            .iter_mut()
            .for_each(|contact| contact.touch.impulse = V3::zeros());
        let guess = |rod: &Rod| {
            let pairs = rod.now.places.iter().zip(&rod.now.velocities);
            pairs
                .map(|(place, velocity)| place + velocity * step.length)
                .collect()
        };
        let trials: Vec<Vec<Node>> = rods.iter().map(guess).collect();
        let scale = rods
            .iter()
            .map(Rod::scale)
            .fold([0.0; 2], |sum, [mass, moment]| {
                [sum[0] + mass, sum[1] + moment]
            });
        let unknowns: Vec<Unknown> = bodies
            .iter()
            .map(|body| Unknown::new(body, scale, step.length))
            .collect();
        let known = Bodies {
            all: bodies,
            unknowns: &unknowns,
        };
        count_calm_steps(rods, contacts, &trials, &known, step.length);
        let lengths = rods.iter().flat_map(|rod| rod.rest_lengths.iter().copied());
        Self {
            longest_way: LONGEST_WAY * lengths.fold(f64::MAX, f64::min),
            schemes: rods
                .iter()
                .map(|rod| Scheme::new(rod, step.length))
                .collect(),
            trials,
            equations: rods.iter().map(|_| Equations::default()).collect(),
            unknowns,
            limits: Vec::new(),
        }
    }

    fn iterate(
        &mut self,
        rods: &mut [Rod],
        bodies: &[Body],
        contacts: &[Contact],
        step: Step,
    ) -> Outcome {
        let mut part = 1.0;
        for iteration in 0..MAX_ITERATIONS {
            if iteration < FRICTION_ITERATIONS {
                self.limits = self.friction_limits(rods, bodies, contacts, step);
            }
            let common = self.assemble(rods, bodies, contacts, step, iteration == 0);
            let Some(change) = self.solve(common) else {
                return Outcome::Lost;
            };
            let way = change.farthest();
            if !way.is_finite() {
                return Outcome::Lost;
            }
            part = self.advance(&change, way, |solver| {
                solver.potential(rods, bodies, contacts, step)
            });
            if way < TOLERANCE {
                break;
            }
        }
        // Where the last change was made in full, what is held is where it is held.
        if part == 1.0 {
            Outcome::Found
        } else {
            Outcome::OnTheWay
        }
    }

    /// Goes along a change as far as the potential falls; which part of it.
    fn advance(&mut self, change: &Change, way: f64, potential: impl Fn(&Self) -> f64) -> f64 {
        let longest = self.longest_way;
        let mut part = (longest / way).min(1.0);
        if way < SURE_WAY * longest {
            self.apply(change, part);
            return part;
        }
        let start = potential(self);
        self.apply(change, part);
        for _ in 0..MAX_HALVINGS {
            if potential(self) <= start + ROUNDING * start.abs() {
                break;
            }
            part *= 0.5;
            self.apply(change, -part);
        }
        part
    }

    fn apply(&mut self, change: &Change, part: f64) {
        for (trial, change) in self.trials.iter_mut().zip(&change.rods) {
            for (node, change) in trial.iter_mut().zip(change.chunks(4)) {
                *node += Node::from_column_slice(change) * part;
            }
        }
        for (body, unknown) in self.unknowns.iter_mut().enumerate() {
            unknown.moved += change.common.fixed_rows::<6>(6 * body) * part;
        }
    }

    fn friction_limits(
        &self,
        rods: &[Rod],
        bodies: &[Body],
        contacts: &[Contact],
        step: Step,
    ) -> Vec<f64> {
        let known = Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        };
        let limit = |contact: &Contact| {
            let place = placed(contact, &known, rods, &self.trials, step.length);
            place.limit(&contact.touch)
        };
        contacts.iter().map(limit).collect()
    }

    /// What the step minimises.
    fn potential(&self, rods: &[Rod], bodies: &[Body], contacts: &[Contact], step: Step) -> f64 {
        let known = Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        };
        let mut sum: f64 = self.unknowns.iter().map(Unknown::potential).sum();
        for (place, rod) in rods.iter().enumerate() {
            let trial = &self.trials[place];
            let shape = strains(trial, &rod.shape, &rod.directions);
            sum += self.schemes[place].potential(rod, trial, &step.gravity)
                + elastic_potential(rod, &shape, rod.material.damping / step.length)
                + hold_potential(rod, &shape, trial, step.length, &known);
        }
        for (contact, limit) in contacts.iter().zip(&self.limits) {
            let place = placed(contact, &known, rods, &self.trials, step.length);
            sum += place.potential(&contact.touch, *limit);
        }
        sum
    }

    fn assemble(
        &mut self,
        rods: &mut [Rod],
        bodies: &[Body],
        contacts: &[Contact],
        step: Step,
        is_first: bool,
    ) -> CommonEquations {
        let of_body =
            |body: &Unknown| (body.resistance, body.resistance * (body.moved - body.free));
        let mut common = CommonEquations {
            bodies: self.unknowns.iter().map(of_body).collect(),
            contacts: 0,
        };
        let bodies = Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        };
        for (place, rod) in rods.iter_mut().enumerate() {
            let (trial, equations) = (&self.trials[place], &mut self.equations[place]);
            equations.clear(rod.len());
            self.schemes[place].add_inertia(rod, trial, &step.gravity, equations);
            let shape = strains(trial, &rod.shape, &rod.directions);
            let elastic = Elastic {
                shape: &shape,
                viscous: rod.material.damping / step.length,
                is_guess: is_first,
                inverse_square: 1.0 / (self.schemes[place].factor * self.schemes[place].factor),
            };
            elastic.add_forces(rod, equations);
            add_holds(
                rod,
                &shape,
                trial,
                step.length,
                &bodies,
                equations,
                &mut common,
            );
        }
        let (trials, equations) = (&self.trials, &mut self.equations);
        add_contacts(
            (contacts, &self.limits),
            rods,
            trials,
            step.length,
            &bodies,
            equations,
            &mut common,
        );
        common
    }

    /// Solves the linearised equations.
    fn solve(&mut self, common: CommonEquations) -> Option<Change> {
        let (mut matrix, mut right) = common.system();
        let mut condensed = Vec::new();
        for equations in &mut self.equations {
            if !equations.matrix.factorize() {
                return None;
            }
            condensed.push(condense(equations, &mut matrix, &mut right));
        }
        let unknowns = if right.is_empty() {
            right
        } else {
            matrix.lu().solve(&right)?
        };
        let parts = self.equations.iter().zip(condensed);
        let rods = parts.map(|(equations, columns)| change_of(equations, &columns, &unknowns));
        Some(Change {
            rods: rods.collect(),
            common: unknowns,
        })
    }

    fn finish(self, rods: &mut [Rod], bodies: &mut [Body], contacts: &mut [Contact], step: f64) {
        let Self {
            schemes,
            trials,
            unknowns,
            limits,
            ..
        } = self;
        let mut impulses = vec![Vector6::zeros(); bodies.len()];
        let known = Bodies {
            all: bodies,
            unknowns: &unknowns,
        };
        for (contact, limit) in contacts.iter_mut().zip(limits) {
            let Some(push) = force_of(contact, limit, &known, rods, &trials, step) else {
                contact.touch.stick = V3::zeros();
                continue;
            };
            (contact.touch.impulse, contact.touch.stick) = (push.force * step, push.stick);
            if let Surface::Body(body) = contact.surface {
                let lever = contact.touch.point - known.all[body].com;
                impulses[body] -= lever_map(&lever).transpose() * contact.touch.impulse;
            }
        }
        for (rod, trial) in rods.iter_mut().zip(&trials) {
            let shape = strains(trial, &rod.shape, &rod.directions);
            find_hold_forces(rod, &shape, trial, step, &known);
            for hold in &rod.holds {
                if let Target::Body(body, lever) = hold.target {
                    impulses[body] -= lever_map(&lever).transpose() * hold.force * step;
                    let mut torque = impulses[body].fixed_rows_mut::<3>(3);
                    torque -= hold.torque * step;
                }
            }
        }
        for (body, impulse) in bodies.iter_mut().zip(impulses) {
            body.impulse = impulse;
        }
        for ((rod, scheme), trial) in rods.iter_mut().zip(schemes).zip(trials) {
            move_on(rod, &scheme, trial, step);
        }
    }
}

/// Counts the steps in which nothing is near the rods, now or where they would go.
fn count_calm_steps(
    rods: &mut [Rod],
    contacts: &[Contact],
    trials: &[Vec<Node>],
    bodies: &Bodies,
    step: f64,
) {
    rods.iter_mut().for_each(|rod| rod.calm_steps += 1);
    for contact in contacts {
        let rod = &rods[contact.rod];
        let now = point_on(&rod.now.places, contact.edge, contact.weight);
        let distance = contact.touch.normal.dot(&(now - contact.touch.point)) - rod.material.radius;
        let later = placed(contact, bodies, rods, trials, step).distance;
        if distance.min(later) < NEAR * rod.material.radius {
            rods[contact.rod].calm_steps = 0;
            if let Surface::Rod(other, ..) = contact.surface {
                rods[other].calm_steps = 0;
            }
        }
    }
}

/// The rod at the end of the step.
pub(crate) fn move_on(rod: &mut Rod, scheme: &Scheme, trial: Vec<Node>, step: f64) {
    let pairs = trial.iter().zip(&scheme.places);
    let velocities = pairs
        .map(|(end, start)| (end - start) / scheme.factor)
        .collect();
    let now = Motion {
        places: trial,
        velocities,
    };
    rod.before = std::mem::replace(&mut rod.now, now);
    (rod.last_step, rod.looked_back) = (step, scheme.looks_back(step));
    rod.find_shape();
    for edge in 0..rod.tensions.len() {
        let rest = rod.rest_lengths[edge];
        let strain = (rod.shape.lengths[edge] - rest) / rest;
        rod.tensions[edge] = if rod.broken[edge] {
            0.0
        } else {
            rod.material.stretch * strain
        };
    }
    rod.break_weakest();
}
