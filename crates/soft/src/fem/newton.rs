//! One step of cloths and volumes, and of the bodies that they are coupled with.

use nalgebra::Vector6;

use super::Deformable;
use super::contact::{Contact, Surface, Trial};
use super::gas::{volume_gradient, volume_of};
use super::islands::Island;
use super::system::{Coupling, Held, Joined, System, Vector};
use crate::assembly::lever_map;
use crate::body::{Body, Unknown};
use crate::rod::Target;
use crate::{Step, V3};

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

/// Moves cloths and volumes that have to do with each other; false where there is no solution in finite numbers: then they stay where they are, at rest.
pub(super) fn solve_island(island: &mut Island, step: Step) -> bool {
    let Island {
        parts,
        bodies,
        contacts,
        ..
    } = island;
    parts.iter_mut().for_each(|part| part.begin_step());
    let mut solver = Solver::new(parts, bodies, step);
    let is_found = solver.iterate(parts, bodies, contacts);
    if is_found {
        solver.finish(parts, bodies, contacts);
    } else {
        for part in parts {
            part.velocities.fill(V3::zeros());
        }
    }
    is_found
}

struct Solver {
    step: Step,
    starts: Vec<usize>,
    masses: Vec<f64>,
    radii: Vec<f64>,
    held: Vec<Held>,
    /// Places at the beginning of the step and in the trial.
    before: Vec<V3>,
    now: Vec<V3>,
    unknowns: Vec<Unknown>,
    /// Change by which the solution counts as found, metres.
    enough: f64,
    /// Of the potential in the trial.
    gradient: Vector,
    /// Largest elongation of the friction springs.
    limits: Vec<f64>,
}

impl Solver {
    fn new(parts: &[&mut Deformable], bodies: &[Body], step: Step) -> Self {
        let mut starts = Vec::new();
        let (mut masses, mut before, mut now) = (Vec::new(), Vec::new(), Vec::new());
        for part in parts {
            starts.push(before.len());
            masses.extend(&part.masses);
            before.extend(&part.places);
            let pairs = part.places.iter().zip(&part.velocities);
            now.extend(pairs.map(|(place, velocity)| place + velocity * step.length));
        }
        let scale = scale(parts);
        let unknowns = bodies
            .iter()
            .map(|body| Unknown::new(body, scale, step.length));
        let shortest = parts
            .iter()
            .map(|part| part.shortest)
            .fold(f64::MAX, f64::min);
        let mut solver = Self {
            step,
            radii: parts.iter().map(|part| part.material.radius).collect(),
            held: held(parts, &starts),
            gradient: Vector::zeros(before.len(), bodies.len()),
            unknowns: unknowns.collect(),
            enough: TOLERANCE * shortest,
            limits: Vec::new(),
            starts,
            masses,
            before,
            now,
        };
        solver.place_held(parts, bodies);
        solver
    }

    /// Puts nodes where what holds them is.
    fn place_held(&mut self, parts: &[&mut Deformable], bodies: &[Body]) {
        for (start, part) in self.starts.iter().zip(parts) {
            for hold in &part.holds {
                self.now[start + hold.node] = match hold.target {
                    Target::Place(place) => place,
                    Target::Body(body, lever) => {
                        bodies[body].com + lever + self.unknowns[body].displacement(&lever)
                    }
                };
            }
        }
    }

    fn iterate(
        &mut self,
        parts: &mut [&mut Deformable],
        bodies: &[Body],
        contacts: &[Contact],
    ) -> bool {
        for iteration in 0..MAX_ITERATIONS {
            if iteration < FRICTION_ITERATIONS {
                self.find_limits(contacts, bodies);
            }
            let (couplings, joined) = self.assemble(parts, bodies, contacts);
            let Some(change) = self.change(parts, couplings, joined) else {
                return false;
            };
            let way = change.nodes.iter().map(V3::norm).fold(0.0, f64::max);
            if !way.is_finite() {
                return false;
            }
            self.advance(&change, parts, bodies, contacts);
            if way < self.enough {
                break;
            }
        }
        true
    }

    fn change(
        &self,
        parts: &[&mut Deformable],
        couplings: Vec<Coupling>,
        joined: Vec<Joined>,
    ) -> Option<Vector> {
        let parts = self.starts.iter().zip(parts);
        let parts = parts.map(|(start, part)| (*start, &part.blocks, &part.bending.matrix));
        let system = System {
            parts: parts.collect(),
            couplings,
            joined,
            bodies: self.unknowns.iter().map(|body| body.resistance).collect(),
            held: &self.held,
        };
        let mut right = self.gradient.clone();
        right.nodes.iter_mut().for_each(|force| *force = -*force);
        right.bodies.iter_mut().for_each(|force| *force = -*force);
        system.solve(right)
    }

    /// Goes along a change as far as the potential falls.
    fn advance(
        &mut self,
        change: &Vector,
        parts: &[&mut Deformable],
        bodies: &[Body],
        contacts: &[Contact],
    ) {
        let start = self.potential(parts, bodies, contacts);
        let mut part = 1.0;
        self.apply(change, part);
        for _ in 0..MAX_HALVINGS {
            if self.potential(parts, bodies, contacts) <= start + ROUNDING * start.abs() {
                break;
            }
            part *= 0.5;
            self.apply(change, -part);
        }
    }

    fn apply(&mut self, change: &Vector, part: f64) {
        for (place, change) in self.now.iter_mut().zip(&change.nodes) {
            *place += change * part;
        }
        for (body, change) in self.unknowns.iter_mut().zip(&change.bodies) {
            body.moved += change * part;
        }
    }

    fn trial<'a>(&'a self, bodies: &'a [Body]) -> Trial<'a> {
        Trial {
            starts: &self.starts,
            masses: &self.masses,
            radii: &self.radii,
            before: &self.before,
            now: &self.now,
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
        let start = self.starts[number];
        &self.now[start..start + part.len()]
    }

    /// What the step minimises.
    fn potential(&self, parts: &[&mut Deformable], bodies: &[Body], contacts: &[Contact]) -> f64 {
        let mut sum: f64 = self.unknowns.iter().map(Unknown::potential).sum();
        for (number, part) in parts.iter().enumerate() {
            let places = self.places(number, part);
            sum += self.inertia_potential(part, places)
                + part.elastic_potential(places, part.material.damping / self.step.length);
            if let Some(gas) = part.gas {
                // Nothing goes on through where the volume would be none.
                let potential = gas.potential(volume_of(&part.surface, places));
                sum += potential.unwrap_or(f64::INFINITY);
            }
        }
        let trial = self.trial(bodies);
        for (contact, limit) in contacts.iter().zip(&self.limits) {
            sum += trial.placed(contact).potential(&contact.touch, *limit);
        }
        sum
    }

    /// The potential of inertia, weight and drag.
    fn inertia_potential(&self, part: &Deformable, places: &[V3]) -> f64 {
        let inverse = 1.0 / self.step.length;
        let of_node = |node: usize| {
            let moved = places[node] - part.places[node];
            let square = moved * (0.5 * inverse * (inverse + part.material.drag));
            let linear = square - part.velocities[node] * inverse - self.step.gravity;
            part.masses[node] * moved.dot(&linear)
        };
        (0..part.len()).map(of_node).sum()
    }

    /// Finds the gradient and the matrices.
    fn assemble(
        &mut self,
        parts: &mut [&mut Deformable],
        bodies: &[Body],
        contacts: &[Contact],
    ) -> (Vec<Coupling>, Vec<Joined>) {
        let mut gradient = Vector::zeros(self.now.len(), self.unknowns.len());
        for (sum, body) in gradient.bodies.iter_mut().zip(&self.unknowns) {
            *sum = body.resistance * (body.moved - body.free);
        }
        let mut joined = Vec::new();
        for (number, part) in parts.iter_mut().enumerate() {
            let start = self.starts[number];
            let nodes = start..start + part.len();
            let (places, gradient) = (&self.now[nodes.clone()], &mut gradient.nodes[nodes]);
            part.assemble(places, part.material.damping / self.step.length, gradient);
            add_inertia(part, places, self.step, gradient);
            joined.extend(add_gas(part, start, places, gradient));
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

    fn finish(
        mut self,
        parts: &mut [&mut Deformable],
        bodies: &mut [Body],
        contacts: &mut [Contact],
    ) {
        self.assemble(parts, bodies, contacts);
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
        for (number, part) in parts.iter_mut().enumerate() {
            for hold in &mut part.holds {
                hold.force = self.gradient.nodes[self.starts[number] + hold.node];
                if let Target::Body(body, lever) = hold.target {
                    let impulse = hold.force * self.step.length;
                    impulses[body] -= lever_map(&lever).transpose() * impulse;
                }
            }
            part.move_to(self.starts[number], &self.now, self.step.length);
        }
        for (body, impulse) in bodies.iter_mut().zip(impulses) {
            body.impulse = impulse;
        }
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

impl Deformable {
    /// The end of a step.
    fn move_to(&mut self, start: usize, now: &[V3], step: f64) {
        let ends = &now[start..start + self.len()];
        for ((place, velocity), end) in self.places.iter_mut().zip(&mut self.velocities).zip(ends) {
            *velocity = (end - *place) / step;
            *place = *end;
        }
        self.tear_weakest();
    }
}

/// The nodes that are held; a node that is held twice goes with the first holder.
fn held(parts: &[&mut Deformable], starts: &[usize]) -> Vec<Held> {
    let mut all: Vec<Held> = Vec::new();
    for (start, part) in starts.iter().zip(parts) {
        for hold in &part.holds {
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

/// Mass of all parts, and their moment of inertia about an end.
fn scale(parts: &[&mut Deformable]) -> [f64; 2] {
    let of = |part: &&mut Deformable| {
        let mass: f64 = part.masses.iter().sum();
        let from = part.places[0];
        let sizes = part
            .places
            .iter()
            .map(|place| (place - from).norm_squared());
        [
            mass,
            mass * sizes.fold(part.shortest * part.shortest, f64::max),
        ]
    };
    parts.iter().map(of).fold([0.0; 2], |sum, [mass, moment]| {
        [sum[0] + mass, sum[1] + moment]
    })
}

fn add_inertia(part: &mut Deformable, places: &[V3], step: Step, gradient: &mut [V3]) {
    let inverse = 1.0 / step.length;
    for (node, mass) in part.masses.iter().enumerate() {
        let velocity = (places[node] - part.places[node]) * inverse;
        let rate = (velocity - part.velocities[node]) * inverse + velocity * part.material.drag
            - step.gravity;
        gradient[node] += rate * *mass;
        let stiffness = mass * inverse * (inverse + part.material.drag);
        part.blocks.add_to_diagonal(node, stiffness);
    }
}

/// Adds the pressure of the gas within.
fn add_gas(part: &Deformable, start: usize, places: &[V3], gradient: &mut [V3]) -> Option<Joined> {
    let gas = part.gas?;
    let volume = volume_of(&part.surface, places);
    let along = volume_gradient(&part.surface, places);
    let pressure = gas.pressure(volume);
    for (sum, part) in gradient.iter_mut().zip(&along) {
        *sum -= part * pressure;
    }
    Some(Joined {
        start,
        gradient: along,
        stiffness: gas.stiffness(volume),
    })
}
