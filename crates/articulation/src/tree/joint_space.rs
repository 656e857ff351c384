//! A tree seen along its free axes: with few of them, masses and momenta along the axes are a small dense system, to which contacts add.
//!
//! The matrix of masses is found by the composite-rigid-body algorithm (R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, section 6.2): what hangs on an
//! axis moves with it as one body, whose momentum the axes on the way to the root feel. Axes along which a motor or a limit imposes the velocity have no unknown.

use nalgebra::{Vector3, Vector6};

use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::spatial_inertia::{shifted_impulse, shifted_velocity};
use crate::tree::{Link, Tree};

/// The free axes of a tree: the unknown velocities along them, in the order of its links, those at the tips first.
#[derive(Default)]
pub(crate) struct JointSpace {
    /// The first unknown of each link.
    firsts: Vec<usize>,
    /// The link of each body that moves.
    places: Vec<Option<usize>>,
    pub count: usize,
    /// The masses: the upper triangle, row by row, each row as long as there are unknowns.
    pub masses: Vec<f64>,
    /// The momenta that all but contacts would lead to.
    pub momenta: Vec<f64>,
}

impl Tree {
    /// The number of free axes along which nothing imposes a velocity, at most.
    pub(crate) fn axis_count(&self) -> usize {
        self.links.iter().map(|link| link.axes.len()).sum()
    }

    /// Finds masses and momenta along the free axes, for where the bodies are. The velocities of the links become those without any along the axes.
    pub(crate) fn project(
        &mut self,
        joints: &[Joint],
        bodies: &[LinkedBody],
        space: &mut JointSpace,
    ) {
        for link in &mut self.links {
            link.place(joints, bodies);
            link.inertia = bodies[link.body].spatial_inertia();
            link.impose_velocity(joints, bodies);
        }
        self.is_factor = false;
        space.number(self, bodies.len());
        self.carry_velocities(|link, _| link.offset);
        for link in &mut self.links {
            let body = &bodies[link.body];
            link.impulse = body.free_momentum() - body.momentum(&link.velocity);
        }
        self.toward_root(
            |_| {},
            |link, parent, arm| {
                parent.inertia.add_shifted(&link.inertia, arm);
                link.carry_impulse(parent, arm);
            },
        );
        for place in 0..self.links.len() {
            self.project_link(place, space);
        }
    }

    /// From the root to the tips: the velocity of each link is that of its parent and what `own` says, which also gets the place of the link.
    fn carry_velocities(&mut self, own: impl Fn(&Link, usize) -> Vector6<f64>) {
        for place in (0..self.links.len()).rev() {
            let (links, others) = self.links.split_at_mut(place + 1);
            let link = &mut links[place];
            link.velocity = own(link, place);
            let Some(parent) = &link.parent else { continue };
            if let Some(of_parent) = parent.place {
                let velocity = &others[of_parent - place - 1].velocity;
                link.velocity += shifted_velocity(velocity, &parent.arm);
            }
        }
    }

    /// Masses and momenta along the axes of a link.
    fn project_link(&self, place: usize, space: &mut JointSpace) {
        let link = &self.links[place];
        for (number, axis) in (space.firsts[place]..).zip(link.free_axes()) {
            space.momenta[number] = axis.motion.dot(&link.impulse) + link.effort;
            let mut momentum = link.inertia.times(&axis.motion);
            let own = link.free_axes().take(number + 1 - space.firsts[place]);
            for (other, of_other) in (space.firsts[place]..).zip(own) {
                space.masses[other * space.count + number] = of_other.motion.dot(&momentum);
            }
            space.masses[number * space.count + number] += link.passive_inertia;
            let mut here = link;
            while let Some(parent) = &here.parent
                && let Some(next) = parent.place
            {
                momentum = shifted_impulse(&momentum, &parent.arm);
                here = &self.links[next];
                for (other, axis) in (space.firsts[next]..).zip(here.free_axes()) {
                    space.masses[number * space.count + other] = axis.motion.dot(&momentum);
                }
            }
        }
    }

    /// Calls `visit` with each axis that moves a body, and its velocity at a point of the body that is `lever` away from the centre of mass; for a body that moves.
    pub(crate) fn velocities_at(
        &self,
        space: &JointSpace,
        body: usize,
        lever: &Vector3<f64>,
        mut visit: impl FnMut(usize, Vector3<f64>),
    ) {
        let mut lever = *lever;
        let mut next = space.places[body];
        while let Some(place) = next {
            let link = &self.links[place];
            for (number, axis) in (space.firsts[place]..).zip(link.free_axes()) {
                visit(number, velocity_at(&axis.motion, &lever));
            }
            let Some(parent) = &link.parent else { return };
            lever += parent.arm;
            next = parent.place;
        }
    }

    /// The velocity of a point of a body without any along the axes, as [`project`](Self::project) has left it.
    pub(crate) fn imposed_velocity_at(
        &self,
        space: &JointSpace,
        body: usize,
        lever: &Vector3<f64>,
    ) -> Vector3<f64> {
        space.places[body].map_or_else(Vector3::zeros, |place| {
            velocity_at(&self.links[place].velocity, lever)
        })
    }

    /// The velocities of the bodies for those along the axes.
    pub(crate) fn set_velocities(
        &mut self,
        space: &JointSpace,
        along_axes: &[f64],
        bodies: &mut [LinkedBody],
    ) {
        self.carry_velocities(|link, place| {
            let axes = along_axes[space.firsts[place]..].iter();
            let moved = axes
                .zip(link.free_axes())
                .map(|(velocity, axis)| axis.motion * *velocity);
            moved.fold(link.offset, |sum, velocity| sum + velocity)
        });
        for link in &self.links {
            bodies[link.body].velocity = link.velocity;
        }
    }
}

impl JointSpace {
    /// Numbers the unknowns of a tree.
    fn number(&mut self, tree: &Tree, body_count: usize) {
        self.firsts.clear();
        self.places.clear();
        self.places.resize(body_count, None);
        self.count = 0;
        for (place, link) in tree.links.iter().enumerate() {
            self.firsts.push(self.count);
            self.places[link.body] = Some(place);
            self.count += link.free_axes().count();
        }
        self.masses.clear();
        self.masses.resize(self.count * self.count, 0.0);
        self.momenta.clear();
        self.momenta.resize(self.count, 0.0);
    }
}

/// Linear velocity at a point that is `lever` away from where a velocity is given.
fn velocity_at(velocity: &Vector6<f64>, lever: &Vector3<f64>) -> Vector3<f64> {
    let [linear, angular] = [0, 3].map(|first| Vector3::from_fn(|axis, _| velocity[first + axis]));
    linear + angular.cross(lever)
}
