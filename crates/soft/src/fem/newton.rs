//! One step of cloths and volumes, of rods that they touch, and of the bodies that they are coupled with.

use nalgebra::Vector6;

use super::Deformable;
use super::contact::{Contact, Surface, Trial};
use super::coupled_rod::CoupledRod;
use super::islands::{Island, Members};
use super::nodes::Nodes;
use super::system::{Coupling, Held, Joined, System, Vector};
use crate::assembly::lever_map;
use crate::body::{Body, Unknown};
use crate::bound::Bodies;
use crate::rod::{Hold, Target};
use crate::{Step, V3, newton};

/// Most iterations of Newton's method in a step.
const MAX_ITERATIONS: usize = 20;
/// Iterations after which the largest friction forces stay as they are.
const FRICTION_ITERATIONS: usize = 3;
/// Change of places by which the solution counts as found, in lengths of the shortest edge.
const TOLERANCE: f64 = 3e-5;
/// Part of the potential that counts as nothing.
const ROUNDING: f64 = 1e-12;
/// How often a change is halved that goes too far.
const MAX_HALVINGS: usize = 12;

/// Farthest that a node goes in an iteration where there are rods, in lengths of the shortest edge.
const LONGEST_WAY: f64 = 1.0;

/// Moves what has to do with each other; false where there is no solution in finite numbers: then it stays where it is, at rest.
pub(super) fn solve_island(island: &mut Island, step: Step) -> bool {
    let Island {
        members,
        bodies,
        contacts,
        ..
    } = island;
    members.parts.iter_mut().for_each(|part| part.begin_step());
    let mut solver = Solver::new(members, bodies, step);
    let outcome = solver.iterate(members, bodies, contacts);
    if outcome != Outcome::Lost {
        solver.finish(members, bodies, contacts);
    }
    if outcome != Outcome::Found {
        for part in &mut members.parts {
            part.velocities.fill(V3::zeros());
        }
        members.rods.iter_mut().for_each(|rod| newton::stop(rod));
    }
    outcome != Outcome::Lost
}

struct Solver {
    step: Step,
    nodes: Nodes,
    held: Vec<Held>,
    unknowns: Vec<Unknown>,
    /// Farthest that a node goes in an iteration, metres.
    longest_way: f64,
    /// Change by which the solution counts as found, metres.
    enough: f64,
    /// Of the potential in the trial.
    gradient: Vector,
    /// Largest elongation of the friction springs.
    limits: Vec<f64>,
}

impl Solver {
    fn new(members: &mut Members, bodies: &[Body], step: Step) -> Self {
        let nodes = Nodes::new(members, step.length);
        let scale = members.scale();
        let unknowns = bodies
            .iter()
            .map(|body| Unknown::new(body, scale, step.length));
        let shortest = members.shortest_edge();
        let longest_way = match &nodes.rods[..] {
            [] => f64::INFINITY,
            _ => LONGEST_WAY * shortest,
        };
        let mut solver = Self {
            step,
            held: held(members, &nodes.starts),
            gradient: nodes.zeros(bodies.len()),
            unknowns: unknowns.collect(),
            longest_way,
            enough: TOLERANCE * shortest,
            limits: Vec::new(),
            nodes,
        };
        solver.place_held(members, bodies);
        solver
    }

    /// Puts nodes where what holds them is.
    fn place_held(&mut self, members: &Members, bodies: &[Body]) {
        for (start, holds) in self.nodes.starts.iter().zip(members.holds()) {
            for hold in holds {
                self.nodes.now[start + hold.node] = match hold.target {
                    Target::Place(place) => place,
                    Target::Body(body, lever) => {
                        bodies[body].com + lever + self.unknowns[body].displacement(&lever)
                    }
                };
            }
        }
    }

    fn iterate(&mut self, members: &mut Members, bodies: &[Body], contacts: &[Contact]) -> Outcome {
        let mut is_whole = true;
        for iteration in 0..MAX_ITERATIONS {
            if iteration < FRICTION_ITERATIONS {
                self.find_limits(contacts, bodies);
            }
            let (couplings, joined) = self.assemble(members, bodies, contacts);
            let Some(change) = self.change(members, couplings, joined) else {
                return Outcome::Lost;
            };
            let way = change.nodes.iter().map(V3::norm).fold(0.0, f64::max);
            if !way.is_finite() {
                return Outcome::Lost;
            }
            is_whole = way <= self.longest_way;
            self.advance(&change, way, members, bodies, contacts);
            if way < self.enough {
                break;
            }
        }
        if is_whole {
            Outcome::Found
        } else {
            Outcome::OnTheWay
        }
    }

    fn change(
        &self,
        members: &Members,
        couplings: Vec<Coupling>,
        joined: Vec<Joined>,
    ) -> Option<Vector> {
        let parts = self.nodes.starts.iter().zip(&members.parts);
        let parts = parts.map(|(start, part)| (*start, &part.blocks, &part.bending.matrix));
        let system = System {
            parts: parts.collect(),
            rods: self.nodes.rods.iter().map(CoupledRod::matrix).collect(),
            couplings,
            joined,
            bodies: self.unknowns.iter().map(|body| body.resistance).collect(),
            held: &self.held,
        };
        system.solve(self.gradient.negated())
    }

    /// Goes along a change as far as the potential falls.
    fn advance(
        &mut self,
        change: &Vector,
        way: f64,
        members: &Members,
        bodies: &[Body],
        contacts: &[Contact],
    ) {
        let start = self.potential(members, bodies, contacts);
        let mut part = (self.longest_way / way).min(1.0);
        self.apply(change, part);
        for _ in 0..MAX_HALVINGS {
            if self.potential(members, bodies, contacts) <= start + ROUNDING * start.abs() {
                break;
            }
            part *= 0.5;
            self.apply(change, -part);
        }
    }

    fn apply(&mut self, change: &Vector, part: f64) {
        for (place, change) in self.nodes.now.iter_mut().zip(&change.nodes) {
            *place += change * part;
        }
        for (angle, change) in self.nodes.angles.iter_mut().zip(&change.angles) {
            *angle += change * part;
        }
        for (body, change) in self.unknowns.iter_mut().zip(&change.bodies) {
            body.moved += change * part;
        }
    }

    fn trial<'a>(&'a self, bodies: &'a [Body]) -> Trial<'a> {
        Trial {
            starts: &self.nodes.starts,
            masses: &self.nodes.masses,
            radii: &self.nodes.radii,
            before: &self.nodes.before,
            now: &self.nodes.now,
            bodies,
            unknowns: &self.unknowns,
            step: self.step.length,
        }
    }

    fn find_limits(&mut self, contacts: &[Contact], bodies: &[Body]) {
        let trial = self.trial(bodies);
        let limit = |contact: &Contact| trial.placed(contact).limit(&contact.touch);
        self.limits = contacts.iter().map(limit).collect();
    }

    /// The places of a part in the trial.
    fn places(&self, number: usize, part: &Deformable) -> &[V3] {
        let start = self.nodes.starts[number];
        &self.nodes.now[start..start + part.len()]
    }

    /// What the step minimises.
    fn potential(&self, members: &Members, bodies: &[Body], contacts: &[Contact]) -> f64 {
        let mut sum: f64 = self.unknowns.iter().map(Unknown::potential).sum();
        for (number, part) in members.parts.iter().enumerate() {
            sum += part.potential(self.places(number, part), self.step);
        }
        let known = self.known(bodies);
        for (joined, rod) in self.nodes.rods.iter().zip(&members.rods) {
            let trial = joined.trial(rod, &self.nodes.now, &self.nodes.angles);
            sum += joined.potential(rod, &trial, self.step, &known);
        }
        let trial = self.trial(bodies);
        for (contact, limit) in contacts.iter().zip(&self.limits) {
            sum += trial.placed(contact).potential(&contact.touch, *limit);
        }
        sum
    }

    fn known<'a>(&'a self, bodies: &'a [Body]) -> Bodies<'a> {
        Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        }
    }

    /// Finds the gradient and the matrices.
    fn assemble(
        &mut self,
        members: &mut Members,
        bodies: &[Body],
        contacts: &[Contact],
    ) -> (Vec<Coupling>, Vec<Joined>) {
        let mut gradient = self.nodes.zeros(self.unknowns.len());
        for (sum, body) in gradient.bodies.iter_mut().zip(&self.unknowns) {
            *sum = body.resistance * (body.moved - body.free);
        }
        let mut joined = Vec::new();
        for (start, part) in self.nodes.starts.iter().zip(&mut members.parts) {
            let nodes = *start..start + part.len();
            let places = &self.nodes.now[nodes.clone()];
            joined.extend(part.linearize(places, self.step, *start, &mut gradient.nodes[nodes]));
        }
        let known = Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        };
        for (joined, rod) in self.nodes.rods.iter_mut().zip(&members.rods) {
            let trial = joined.trial(rod, &self.nodes.now, &self.nodes.angles);
            joined.linearize(rod, &trial, self.step, &known, &mut gradient);
        }
        let mut couplings = Vec::new();
        let trial = self.trial(bodies);
        for (contact, limit) in contacts.iter().zip(&self.limits) {
            if let Some((coupling, force)) = trial.coupling(contact, *limit) {
                coupling.push(&force, &mut gradient);
                couplings.push(coupling);
            }
        }
        self.gradient = gradient;
        (couplings, joined)
    }

    fn finish(mut self, members: &mut Members, bodies: &mut [Body], contacts: &mut [Contact]) {
        self.assemble(members, bodies, contacts);
        let mut impulses = self.contact_impulses(bodies, contacts);
        let step = self.step.length;
        for (number, part) in members.parts.iter_mut().enumerate() {
            for hold in &mut part.holds {
                hold.force = self.gradient.nodes[self.nodes.starts[number] + hold.node];
            }
            let start = self.nodes.starts[number];
            part.move_to(&self.nodes.now[start..start + part.len()], step);
        }
        let known = Bodies {
            all: bodies,
            unknowns: &self.unknowns,
        };
        for (joined, rod) in self.nodes.rods.into_iter().zip(&mut members.rods) {
            let trial = joined.trial(rod, &self.nodes.now, &self.nodes.angles);
            joined.finish(rod, trial, step, &known, &self.gradient);
        }
        for hold in members.holds().flatten() {
            add_hold_impulse(hold, step, &mut impulses);
        }
        for (body, impulse) in bodies.iter_mut().zip(impulses) {
            body.impulse = impulse;
        }
    }

    /// Writes the impulses of contacts; those on bodies.
    fn contact_impulses(&self, bodies: &[Body], contacts: &mut [Contact]) -> Vec<Vector6<f64>> {
        let trial = self.trial(bodies);
        let mut impulses = vec![Vector6::zeros(); bodies.len()];
        for (contact, limit) in contacts.iter_mut().zip(&self.limits) {
            let Some(push) = trial.placed(contact).push(&contact.touch, *limit) else {
                contact.touch.stick = V3::zeros();
                continue;
            };
            contact.touch.impulse = push.force * self.step.length;
            contact.touch.stick = push.stick;
            if let Surface::Body(body) = contact.surface {
                let lever = contact.touch.point - bodies[body].com;
                impulses[body] -= lever_map(&lever).transpose() * contact.touch.impulse;
            }
        }
        impulses
    }
}

fn add_hold_impulse(hold: &Hold, step: f64, impulses: &mut [Vector6<f64>]) {
    if let Target::Body(body, lever) = hold.target {
        impulses[body] -= lever_map(&lever).transpose() * hold.force * step;
        let mut torque = impulses[body].fixed_rows_mut::<3>(3);
        torque -= hold.torque * step;
    }
}

impl Coupling {
    /// Adds a force on what is soft to a gradient.
    fn push(&self, force: &V3, gradient: &mut Vector) {
        for (node, weight) in self.nodes {
            gradient.nodes[node] -= force * weight;
        }
        if let Some((body, map)) = &self.body {
            gradient.bodies[*body] += map.transpose() * force;
        }
    }
}

/// How a step ends.
#[derive(Clone, Copy, PartialEq)]
enum Outcome {
    /// The equations are solved.
    Found,
    /// They are not, since nodes of rods would have to go too far: they come nearer, and rest there.
    OnTheWay,
    /// There is no solution in finite numbers.
    Lost,
}

/// The nodes that are held; a node that is held twice goes with the first holder.
fn held(members: &Members, starts: &[usize]) -> Vec<Held> {
    let mut all: Vec<Held> = Vec::new();
    for (start, holds) in starts.iter().zip(members.holds()) {
        for hold in holds {
            let body = match hold.target {
                Target::Place(_) => None,
                Target::Body(body, lever) => Some((body, lever)),
            };
            let node = start + hold.node;
            all.push(Held { node, body });
        }
    }
    all
}
