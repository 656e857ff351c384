//! What holds rods and what they touch, as forces in the equations.

use nalgebra::{Matrix3, Vector6};

use crate::assembly::{CommonEquations, Equations, lever_map};
use crate::body::{Body, Unknown};
use crate::contact::{Contact, Surface};
use crate::elastic::Shape;
use crate::frames::angle_about;
use crate::rod::{Hold, Node, Rod, Target};
use crate::touch::{Placed, Push};
use crate::{V3, material::Material};

/// How many times stiffer than its surroundings a place is at which a rod is held: it gives way by that part of what they do.
const HOLD_STIFFNESS: f64 = 1e4;
/// The same for contacts, against the inertia of a node.
const CONTACT_STIFFNESS: f64 = 1e3;

/// The bodies during a step, with their unknowns.
pub(crate) struct Bodies<'a> {
    pub all: &'a [Body],
    pub unknowns: &'a [Unknown],
}

/// A force between a rod and a body or something that no force moves.
struct Coupling<'a> {
    nodes: &'a [(usize, f64)],
    body: Option<(usize, V3)>,
    force: V3,
    stiffness: Matrix3<f64>,
}

impl Coupling<'_> {
    fn add(&self, equations: &mut Equations, common: &mut CommonEquations) {
        equations.add_push(self.nodes, &self.force, &self.stiffness);
        let Some((body, lever)) = self.body else {
            return;
        };
        let map = lever_map(&lever);
        let (matrix, gradient) = &mut common.bodies[body];
        *gradient += map.transpose() * self.force;
        *matrix += map.transpose() * self.stiffness * map;
        let side = self.stiffness * map;
        for &(node, weight) in self.nodes {
            for axis in 0..3 {
                let row: Vector6<f64> = side.row(axis).transpose() * -weight;
                let columns = CommonEquations::columns_of(body);
                equations.add_to_border(columns, 4 * node + axis, row.as_slice());
            }
        }
    }
}

/// An edge that is held against turning about its axis.
pub(crate) struct TwistHold {
    pub edge: usize,
    /// The body that it turns with.
    pub body: Option<usize>,
    pub axis: V3,
    /// The angle by which it is turned too far.
    pub excess: f64,
    /// N m
    pub stiffness: f64,
}

impl TwistHold {
    /// None where a hold lets the edge turn.
    pub(crate) fn new(hold: &Hold, rod: &Rod, shape: &Shape, bodies: &Bodies) -> Option<Self> {
        let edge = edge_of(hold, rod);
        Some(Self {
            edge,
            body: hold.body().map(|(body, _)| body),
            axis: shape.tangents[edge],
            excess: excess_twist(hold, edge, shape, bodies)?,
            stiffness: twist_stiffness(rod, edge),
        })
    }

    /// On the edge, N m.
    pub(crate) fn torque(&self) -> V3 {
        self.axis * (-self.stiffness * self.excess)
    }

    pub(crate) fn potential(&self) -> f64 {
        0.5 * self.stiffness * self.excess * self.excess
    }

    /// How the angle of the edge goes with the displacement of a body.
    pub(crate) fn about(&self) -> Vector6<f64> {
        let mut about = Vector6::zeros();
        about.fixed_rows_mut::<3>(3).copy_from(&self.axis);
        about
    }

    fn add(&self, equations: &mut Equations, common: &mut CommonEquations) {
        let row = 4 * self.edge + 3;
        let torque = self.stiffness * self.excess;
        equations.add_spring(row, &[1.0], torque, self.stiffness);
        if let Some(body) = self.body {
            let about = self.about();
            let (matrix, gradient) = &mut common.bodies[body];
            *gradient -= about * torque;
            *matrix += about * about.transpose() * self.stiffness;
            let columns = CommonEquations::columns_of(body);
            equations.add_to_border(columns, row, (about * -self.stiffness).as_slice());
        }
    }
}

/// Finds the forces and torques at the places where a rod is held.
pub(crate) fn find_hold_forces(
    rod: &mut Rod,
    shape: &Shape,
    trial: &[Node],
    step: f64,
    bodies: &Bodies,
) {
    let stiffness = hold_stiffness(rod, step);
    let mut holds = std::mem::take(&mut rod.holds);
    for hold in &mut holds {
        hold.force = (place_of(hold, bodies) - trial[hold.node].xyz()) * stiffness;
        let twist = TwistHold::new(hold, rod, shape, bodies);
        hold.torque = twist.map_or(V3::zeros(), |twist| twist.torque());
    }
    rod.holds = holds;
}

/// Adds the forces at the places where a rod is held.
pub(crate) fn add_holds(
    rod: &mut Rod,
    shape: &Shape,
    trial: &[Node],
    step: f64,
    bodies: &Bodies,
    equations: &mut Equations,
    common: &mut CommonEquations,
) {
    find_hold_forces(rod, shape, trial, step, bodies);
    let stiffness = hold_stiffness(rod, step);
    for hold in &rod.holds {
        let coupling = Coupling {
            nodes: &[(hold.node, 1.0)],
            body: hold.body(),
            force: hold.force,
            stiffness: Matrix3::identity() * stiffness,
        };
        coupling.add(equations, common);
        if let Some(twist) = TwistHold::new(hold, rod, shape, bodies) {
            twist.add(equations, common);
        }
    }
}

impl Hold {
    /// The body that holds, and where.
    fn body(&self) -> Option<(usize, V3)> {
        match self.target {
            Target::Place(_) => None,
            Target::Body(body, lever) => Some((body, lever)),
        }
    }
}

fn edge_of(hold: &Hold, rod: &Rod) -> usize {
    hold.node.min(rod.rest_lengths.len() - 1)
}

fn twist_stiffness(rod: &Rod, edge: usize) -> f64 {
    HOLD_STIFFNESS * rod.material.twist / rod.rest_lengths[edge]
}

fn hold_stiffness(rod: &Rod, step: f64) -> f64 {
    let shortest = rod.rest_lengths.iter().copied().fold(f64::MAX, f64::min);
    let bend = rod.material.bend / shortest.powi(3);
    let inertia = rod.material.line_density * shortest / (step * step);
    HOLD_STIFFNESS * (rod.material.stretch / shortest + bend + inertia)
}

/// The angle by which an edge is turned about its axis beyond the direction in which it is held.
fn excess_twist(hold: &Hold, edge: usize, shape: &Shape, bodies: &Bodies) -> Option<f64> {
    let tangent = shape.tangents[edge];
    let mut direction = hold.direction?;
    if let Some((body, _)) = hold.body() {
        let turned: V3 = bodies.unknowns[body].moved.fixed_rows::<3>(3).into();
        direction += turned.cross(&direction);
    }
    let across = direction - tangent * tangent.dot(&direction);
    let is_across = across.norm() > 1e-6 * direction.norm();
    is_across.then(|| angle_about(&tangent, &across, &shape.materials[edge][0]))
}

/// Displacement of what a contact touches.
fn surface_displacement(
    contact: &Contact,
    bodies: &Bodies,
    rods: &[Rod],
    trials: &[Vec<Node>],
    step: f64,
) -> V3 {
    match contact.surface {
        Surface::Obstacle(velocity) => velocity * step,
        Surface::Body(body) => {
            let lever = contact.touch.point - bodies.all[body].com;
            bodies.unknowns[body].displacement(&lever)
        }
        Surface::Rod(other, edge, weight) => {
            let on = |places: &[Node]| point_on(places, edge, weight);
            on(&trials[other]) - on(&rods[other].now.places)
        }
    }
}

pub(crate) fn point_on(places: &[Node], edge: usize, weight: f64) -> V3 {
    places[edge].xyz() * (1.0 - weight) + places[edge + 1].xyz() * weight
}

/// Stiffness of the contacts of a rod, N/m.
fn contact_stiffness(material: &Material, edge_length: f64, step: f64) -> f64 {
    CONTACT_STIFFNESS * material.line_density * edge_length / (step * step)
}

/// Where a contact is with the nodes at `trials`.
pub(crate) fn placed(
    contact: &Contact,
    bodies: &Bodies,
    rods: &[Rod],
    trials: &[Vec<Node>],
    step: f64,
) -> Placed {
    let rod = &rods[contact.rod];
    let on = |places: &[Node]| point_on(places, contact.edge, contact.weight);
    let (before, now) = (on(&rod.now.places), on(&trials[contact.rod]));
    let moved = surface_displacement(contact, bodies, rods, trials, step);
    Placed {
        distance: contact
            .touch
            .normal
            .dot(&(now - contact.touch.point - moved))
            - rod.material.radius,
        slip: now - before - moved,
        stiffness: contact_stiffness(&rod.material, rod.rest_lengths[contact.edge], step),
    }
}

/// What a contact exerts with the nodes at `trials`, for a largest elongation of its friction spring; None where the surfaces are apart.
pub(crate) fn force_of(
    contact: &Contact,
    limit: f64,
    bodies: &Bodies,
    rods: &[Rod],
    trials: &[Vec<Node>],
    step: f64,
) -> Option<Push> {
    placed(contact, bodies, rods, trials, step).push(&contact.touch, limit)
}

/// The potential of what holds a rod.
pub(crate) fn hold_potential(
    rod: &Rod,
    shape: &Shape,
    trial: &[Node],
    step: f64,
    bodies: &Bodies,
) -> f64 {
    let stiffness = hold_stiffness(rod, step);
    let of_hold = |hold: &Hold| {
        let twist = TwistHold::new(hold, rod, shape, bodies);
        let apart = place_of(hold, bodies) - trial[hold.node].xyz();
        0.5 * stiffness * apart.norm_squared() + twist.map_or(0.0, |twist| twist.potential())
    };
    rod.holds.iter().map(of_hold).sum()
}

/// Where a node is held at the end of the step.
fn place_of(hold: &Hold, bodies: &Bodies) -> V3 {
    match hold.target {
        Target::Place(place) => place,
        Target::Body(body, lever) => {
            bodies.all[body].com + lever + bodies.unknowns[body].displacement(&lever)
        }
    }
}

/// Adds the forces of contacts.
pub(crate) fn add_contacts(
    (contacts, limits): (&[Contact], &[f64]),
    rods: &[Rod],
    trials: &[Vec<Node>],
    step: f64,
    bodies: &Bodies,
    equations: &mut [Equations],
    common: &mut CommonEquations,
) {
    for (contact, limit) in contacts.iter().zip(limits) {
        let Some(push) = force_of(contact, *limit, bodies, rods, trials, step) else {
            continue;
        };
        let nodes = nodes_of(contact.edge, contact.weight);
        if let Surface::Rod(other, edge, weight) = contact.surface {
            let columns = common.add_contact();
            let root = root_of(&push.stiffness);
            add_side(
                &mut equations[contact.rod],
                &nodes,
                &push.force,
                &root,
                &columns,
            );
            let nodes = nodes_of(edge, weight);
            add_side(
                &mut equations[other],
                &nodes,
                &-push.force,
                &-root,
                &columns,
            );
            continue;
        }
        let body = match contact.surface {
            Surface::Body(body) => Some((body, contact.touch.point - bodies.all[body].com)),
            _ => None,
        };
        let coupling = Coupling {
            nodes: &nodes,
            body,
            force: push.force,
            stiffness: push.stiffness,
        };
        coupling.add(&mut equations[contact.rod], common);
    }
}

/// Adds one of the two rods at a contact between them. Its stiffness couples unknowns that are far from each other: it stands beside the matrices.
fn add_side(
    equations: &mut Equations,
    nodes: &[(usize, f64)],
    force: &V3,
    root: &Matrix3<f64>,
    columns: &std::ops::Range<usize>,
) {
    equations.add_push(nodes, force, &Matrix3::zeros());
    for &(node, weight) in nodes {
        for axis in 0..3 {
            let row: V3 = root.row(axis).transpose() * weight;
            equations.add_to_border(columns.clone(), 4 * node + axis, row.as_slice());
        }
    }
}

/// A matrix that, times its transpose, is the given one.
fn root_of(stiffness: &Matrix3<f64>) -> Matrix3<f64> {
    let parts = stiffness.symmetric_eigen();
    let roots = parts.eigenvalues.map(|value| value.max(0.0).sqrt());
    parts.eigenvectors * Matrix3::from_diagonal(&roots)
}

fn nodes_of(edge: usize, weight: f64) -> [(usize, f64); 2] {
    [(edge, 1.0 - weight), (edge + 1, weight)]
}
