//! Mechanisms without loops: the articulated-body algorithm, for impulses and velocities (R. Featherstone, *Rigid Body Dynamics Algorithms*,
//! 2008, chapter 7).
//!
//! From the tips to the root every body gets its articulated inertia, that by which it resists an impulse together with all that hangs on
//! it: what is beyond a joint resists only across the free axes of the joint. Those are eliminated one after the other, as if there were bodies
//! without mass between them; a body that hangs on nothing has six free axes. The second pass, from the root to the tips, finds the velocities.
//! A motor that tracks its velocity, and a limit, leave no free axis but impose a velocity.

mod joint_space;

use std::ops::Range;

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::block_cholesky::Segment;
use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::spatial_inertia::{SpatialInertia, shifted_impulse, shifted_velocity};
use crate::system::System;
use crate::tree_growth::grown;
pub(crate) use joint_space::JointSpace;

/// The bodies of a tree, and what was found for them.
pub(crate) struct Tree {
    /// For every body that moves, those at the tips first; guests come last.
    links: Vec<Link>,
    /// Number of links without those of guests.
    linked: usize,
    is_factor: bool,
}

/// A body with the joint that leads to the root.
pub(crate) struct Link {
    body: usize,
    /// None for a body that hangs on nothing.
    parent: Option<Parent>,
    axes: Vec<Axis>,
    /// Whether a motor or a limit imposes the velocity along the axis.
    is_imposed: bool,
    /// The articulated inertia, the free axes eliminated.
    inertia: SpatialInertia,
    /// Velocity of the body relative to its parent that the joint imposes, and its momentum.
    offset: Vector6<f64>,
    offset_momentum: Vector6<f64>,
    /// Known impulse along the axis: of a saturated motor, and what is passive.
    effort: f64,
    /// Inertia of what is passive along the axis.
    passive_inertia: f64,
    /// Impulse on the body and on what is beyond.
    impulse: Vector6<f64>,
    /// Velocity or displacement.
    velocity: Vector6<f64>,
}

/// The body before, on the way from the root, and the joint to it.
pub(crate) struct Parent {
    pub body: usize,
    pub joint: usize,
    /// The place of the link of that body; None if it does not move.
    place: Option<usize>,
    /// 1 if the joint's second body is the one farther from the root, else -1.
    pub sign: f64,
    /// From the centre of mass of the parent to that of the body.
    arm: Vector3<f64>,
    /// From the point of the joint to the centre of mass of the body.
    lever: Vector3<f64>,
}

/// An axis that the joint leaves free.
#[derive(Clone)]
struct Axis {
    /// The motion of the body at unit velocity, about its centre of mass.
    motion: Vector6<f64>,
    /// Its momentum.
    momentum: Vector6<f64>,
    /// One over the momentum along the axis; 0 where a motor or a limit imposes the velocity.
    response: f64,
    /// Impulse along the axis, times the response.
    rate: f64,
}

/// What a unit impulse on a body becomes along a free axis on the way to the root: a row for each part of the impulse.
struct Share {
    /// Link and axis.
    axis: (usize, usize),
    impulses: Vector6<f64>,
    response: f64,
}

impl Tree {
    /// The tree of all bodies; None where joints form a loop, or a body has an inertia that the algorithm cannot use.
    pub(crate) fn new(bodies: &[LinkedBody], joints: &[Joint]) -> Option<Self> {
        let usable = |body: &LinkedBody| !body.is_dynamic() || body.properties.can_turn();
        let mut links = bodies.iter().all(usable).then(|| grown(bodies, joints))??;
        let place = |body| links.iter().position(|link| link.body == body);
        let places: Vec<Option<usize>> = (0..bodies.len()).map(place).collect();
        for parent in links.iter_mut().filter_map(|link| link.parent.as_mut()) {
            parent.place = places[parent.body];
        }
        Some(Self {
            linked: links.len(),
            links,
            is_factor: false,
        })
    }

    /// Calls `visit` for every link from the tips to the root, and `carry` with it, its parent and the arm between them.
    fn toward_root(
        &mut self,
        mut visit: impl FnMut(&mut Link),
        carry: impl Fn(&Link, &mut Link, &Vector3<f64>),
    ) {
        for place in 0..self.links.len() {
            let (visited, others) = self.links.split_at_mut(place + 1);
            let link = &mut visited[place];
            visit(link);
            if let Some(Parent {
                place: Some(parent),
                arm,
                ..
            }) = &link.parent
            {
                carry(link, &mut others[parent - place - 1], arm);
            }
        }
    }

    /// Prepares for solutions with other inertias of the bodies, the joints as they were.
    pub(crate) fn refactorize(&mut self, bodies: &[LinkedBody]) -> bool {
        for link in &mut self.links {
            link.inertia = bodies[link.body].spatial_inertia();
        }
        let carry = |link: &Link, parent: &mut Link, arm: &Vector3<f64>| {
            parent.inertia.add_shifted(&link.inertia, arm);
        };
        self.toward_root(Link::eliminate_axes, carry);
        let can_respond = |axis: &Axis| axis.response >= 0.0 && axis.response.is_finite();
        self.is_factor = self
            .links
            .iter()
            .all(|link| link.axes.iter().all(can_respond));
        self.is_factor
    }

    /// Both passes: impulses on the bodies become velocities.
    fn find_velocities(&mut self) {
        self.toward_root(Link::eliminate_impulse, Link::carry_impulse);
        for place in (0..self.links.len()).rev() {
            let (links, others) = self.links.split_at_mut(place + 1);
            let link = &mut links[place];
            let carried = |parent: &Parent| {
                let velocity = &others[parent.place? - place - 1].velocity;
                Some(shifted_velocity(velocity, &parent.arm))
            };
            let carried = link.parent.as_ref().and_then(carried);
            link.find_velocity(carried.unwrap_or_else(Vector6::zeros));
        }
    }

    /// The velocities to which impulses lead, those of the joints included.
    pub(crate) fn find_body_velocities(&mut self, joints: &[Joint], bodies: &mut [LinkedBody]) {
        for link in &mut self.links {
            link.impulse = bodies[link.body].free_momentum();
            link.impose_velocity(joints, bodies);
        }
        self.find_velocities();
        for link in &self.links {
            bodies[link.body].velocity = link.velocity;
        }
    }

    /// The impulses of the joints that lead to the velocities of the bodies.
    pub(crate) fn find_joint_impulses(&mut self, joints: &mut [Joint], bodies: &mut [LinkedBody]) {
        self.links
            .iter_mut()
            .for_each(|link| link.impulse = Vector6::zeros());
        let visit = |link: &mut Link| {
            let body = &mut bodies[link.body];
            let Some(parent) = &link.parent else {
                body.joint_impulse = -link.impulse;
                return;
            };
            body.joint_impulse = body.missing_impulse();
            link.impulse += body.joint_impulse;
            joints[parent.joint]
                .set_impulse(&(shifted_impulse(&link.impulse, &parent.lever) * parent.sign));
        };
        self.toward_root(visit, Link::carry_impulse);
    }

    /// What unit impulses on a body become along the free axes from there to the root.
    fn shares(&self, body: usize) -> Vec<Share> {
        let mut impulses = Matrix6::identity();
        let mut shares = Vec::new();
        let mut next = self.links.iter().position(|link| link.body == body);
        while let Some(place) = next {
            let link = &self.links[place];
            for (
                number,
                Axis {
                    motion,
                    momentum,
                    response,
                    ..
                },
            ) in link.axes.iter().enumerate()
            {
                let along = impulses.tr_mul(motion);
                impulses -= momentum * (along * *response).transpose();
                shares.push(Share {
                    axis: (place, number),
                    impulses: along,
                    response: *response,
                });
            }
            next = link.parent.as_ref().and_then(|parent| parent.place);
            for column in (0..6).filter(|_| next.is_some()) {
                let arm = link
                    .parent
                    .as_ref()
                    .map_or_else(Vector3::zeros, |parent| parent.arm);
                impulses.set_column(
                    column,
                    &shifted_impulse(&impulses.column(column).into_owned(), &arm),
                );
            }
        }
        shares
    }
}

impl System for Tree {
    fn set_guests(&mut self, guests: Range<usize>) {
        self.links.truncate(self.linked);
        self.links
            .extend(guests.map(|guest| Link::new(guest, None, 6)));
    }

    fn factorize(&mut self, joints: &[Joint], bodies: &[LinkedBody]) -> bool {
        for link in &mut self.links {
            link.place(joints, bodies);
        }
        self.refactorize(bodies)
    }

    fn as_tree(&mut self) -> Option<&mut Tree> {
        Some(self)
    }

    fn is_factor(&self) -> bool {
        self.is_factor
    }

    fn find_impulses(&mut self, joints: &mut [Joint], bodies: &mut [LinkedBody]) {
        self.find_body_velocities(joints, bodies);
        self.find_joint_impulses(joints, bodies);
    }

    fn displace(&mut self, joints: &[Joint], bodies: &mut [LinkedBody], errors: &mut [Segment]) {
        for link in &mut self.links {
            link.impose_displacement(joints, errors);
        }
        self.find_velocities();
        for link in &self.links[..self.linked] {
            bodies[link.body].displace(&link.velocity);
        }
    }

    fn find_corrections(&mut self, joints: &mut [Joint], bodies: &[LinkedBody]) {
        self.links
            .iter_mut()
            .for_each(|link| link.impulse = Vector6::zeros());
        let visit = |link: &mut Link| {
            let Some(parent) = &link.parent else { return };
            let body = &bodies[link.body];
            link.impulse += body.momentum(&body.correction);
            joints[parent.joint]
                .set_correction(&(shifted_impulse(&link.impulse, &parent.lever) * parent.sign));
        };
        self.toward_root(visit, Link::carry_impulse);
    }

    fn responses(&mut self, _: &[Joint], touching: &[usize]) -> Vec<Matrix6<f64>> {
        let shares: Vec<Vec<Share>> = touching.iter().map(|&body| self.shares(body)).collect();
        let of = |first: &[Share], second: &[Share]| {
            let common = first
                .iter()
                .rev()
                .zip(second.iter().rev())
                .take_while(|(a, b)| a.axis == b.axis);
            common
                .map(|(a, b)| a.impulses * (b.impulses * b.response).transpose())
                .sum()
        };
        shares
            .iter()
            .flat_map(|first| shares.iter().map(move |second| of(first, second)))
            .collect()
    }
}

impl Link {
    pub(crate) fn new(body: usize, parent: Option<Parent>, axes: usize) -> Self {
        let none = Vector6::zeros();
        let axis = Axis {
            motion: none,
            momentum: none,
            response: 0.0,
            rate: 0.0,
        };
        Self {
            body,
            parent,
            axes: vec![axis; axes],
            is_imposed: false,
            inertia: SpatialInertia::zero(),
            offset: none,
            offset_momentum: none,
            effort: 0.0,
            passive_inertia: 0.0,
            impulse: none,
            velocity: none,
        }
    }

    /// Finds the axes for where the bodies are.
    fn place(&mut self, joints: &[Joint], bodies: &[LinkedBody]) {
        let Some(parent) = &mut self.parent else {
            (0..6).for_each(|row| self.axes[row].motion = Vector6::ith(row, 1.0));
            return;
        };
        let (joint, com) = (&joints[parent.joint], bodies[self.body].com);
        (parent.arm, parent.lever) = (com - bodies[parent.body].com, com - joint.point);
        for (axis, motion) in self.axes.iter_mut().zip(joint.free_motions()) {
            axis.motion = shifted_velocity(&motion, &parent.lever) * parent.sign;
        }
        self.is_imposed = joint.imposes_velocity();
        self.passive_inertia = joint.soft_row().map_or(0.0, |(_, inertia)| inertia);
    }

    /// The axes along which nothing imposes a velocity.
    fn free_axes(&self) -> impl Iterator<Item = &Axis> {
        let count = if self.is_imposed { 0 } else { self.axes.len() };
        self.axes[..count].iter()
    }

    /// Eliminates the free axes from the inertia.
    fn eliminate_axes(&mut self) {
        for axis in &mut self.axes {
            axis.momentum = self.inertia.times(&axis.motion);
            axis.response = 0.0;
            if !self.is_imposed {
                axis.response = 1.0 / (axis.motion.dot(&axis.momentum) + self.passive_inertia);
                self.inertia.subtract_square(&axis.momentum, axis.response);
            }
        }
    }

    /// Sets what motors and limits do, and bodies that are moved.
    fn impose_velocity(&mut self, joints: &[Joint], bodies: &[LinkedBody]) {
        (self.offset, self.offset_momentum, self.effort) =
            (Vector6::zeros(), Vector6::zeros(), 0.0);
        let Some(parent) = &self.parent else { return };
        let joint = &joints[parent.joint];
        if self.is_imposed {
            let velocity = joint.imposed_velocity();
            (self.offset, self.offset_momentum) = (
                self.axes[0].motion * velocity,
                self.axes[0].momentum * velocity,
            );
        } else {
            self.effort = joint.known_impulse();
        }
        if parent.place.is_none() {
            self.offset += shifted_velocity(&bodies[parent.body].free_velocity(), &parent.arm);
        }
    }

    /// Lets the body move against the error of its joint.
    fn impose_displacement(&mut self, joints: &[Joint], errors: &[Segment]) {
        (self.impulse, self.effort) = (Vector6::zeros(), 0.0);
        let Some(parent) = &self.parent else { return };
        self.offset = shifted_velocity(
            &joints[parent.joint].along_axes(&errors[parent.joint]),
            &parent.lever,
        ) * -parent.sign;
        self.offset_momentum = self.inertia.times(&self.offset);
    }

    /// What the impulse becomes beyond the free axes.
    fn eliminate_impulse(&mut self) {
        for axis in &mut self.axes {
            axis.rate = (axis.motion.dot(&self.impulse) + self.effort) * axis.response;
            self.impulse -= axis.momentum * axis.rate;
        }
        self.impulse -= self.offset_momentum;
    }

    fn carry_impulse(&self, parent: &mut Self, arm: &Vector3<f64>) {
        parent.impulse += shifted_impulse(&self.impulse, arm);
    }

    /// Finds the velocity on a parent that carries the body along at `carried`.
    fn find_velocity(&mut self, carried: Vector6<f64>) {
        self.velocity = carried + self.offset;
        for axis in self.axes.iter().rev() {
            self.velocity +=
                axis.motion * (axis.rate - axis.momentum.dot(&self.velocity) * axis.response);
        }
    }
}

impl Parent {
    pub(crate) fn new(joint: usize, body: usize, sign: f64) -> Self {
        Self {
            joint,
            body,
            place: None,
            sign,
            arm: Vector3::zeros(),
            lever: Vector3::zeros(),
        }
    }
}
