//! Contacts of cloths and volumes.

use nalgebra::Matrix3x6;

use super::system::Coupling;
use crate::V3;
use crate::assembly::lever_map;
use crate::body::{Body, Unknown};
use crate::touch::{Placed, Touch};

/// How many times stiffer a contact is than the inertia of what it pushes.
const STIFFNESS: f64 = 1e3;

/// A point on a triangle, an edge or a node: nodes with their weights, whose sum is one.
pub type Spot = [(usize, f64); 3];

/// What something soft touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// Something that no force moves, with the velocity of its surface.
    Obstacle(V3),
    /// A rigid body, by its index.
    Body(usize),
    /// A cloth or volume by its index, or a rod by its index after all of these, and where on it.
    Soft(usize, Spot),
}

/// A point at which a cloth or volume touches something, or a rod touches one of these, or may in this step.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The cloth or volume by its index, or the rod by its index after all of these.
    pub part: usize,
    /// Where on it.
    pub spot: Spot,
    /// What is touched.
    pub surface: Surface,
    /// Where on what is touched, and what is exerted there.
    pub touch: Touch,
    /// Names the contact from step to step, together with the part.
    pub key: u64,
}

impl Contact {
    /// The cloths, volumes and rods that touch each other.
    pub(crate) fn parts(&self) -> impl Iterator<Item = usize> + use<> {
        let other = match self.surface {
            Surface::Soft(other, _) => Some(other),
            _ => None,
        };
        std::iter::once(self.part).chain(other)
    }

    /// Their numbers, to change them.
    pub(crate) fn parts_mut(&mut self) -> impl Iterator<Item = &mut usize> {
        let other = match &mut self.surface {
            Surface::Soft(other, _) => Some(other),
            _ => None,
        };
        std::iter::once(&mut self.part).chain(other)
    }

    fn name(&self) -> (usize, u64) {
        (self.part, self.key)
    }

    /// Goes on with the friction of the same contact in the step before. Both lists are put in order.
    pub fn carry_on(contacts: &mut [Self], before: &mut [Self]) {
        contacts.sort_by_key(Self::name);
        before.sort_by_key(Self::name);
        for contact in contacts {
            let same = before.binary_search_by_key(&contact.name(), Self::name);
            if let Ok(known) = same {
                contact.touch.carry_on(&before[known].touch);
            }
        }
    }
}

/// Contacts in a trial.
pub(super) struct Trial<'a> {
    /// Where the nodes of each part begin among all.
    pub starts: &'a [usize],
    pub masses: &'a [f64],
    pub radii: &'a [f64],
    /// Places of all nodes at the beginning of the step and in the trial.
    pub before: &'a [V3],
    pub now: &'a [V3],
    pub bodies: &'a [Body],
    pub unknowns: &'a [Unknown],
    /// Seconds.
    pub step: f64,
}

impl Trial<'_> {
    /// A spot among all nodes.
    fn global(&self, part: usize, spot: &Spot) -> Spot {
        spot.map(|(node, weight)| (self.starts[part] + node, weight))
    }

    fn displacement(&self, spot: &Spot) -> V3 {
        let parts = spot.iter();
        parts.fold(V3::zeros(), |sum, (node, weight)| {
            sum + (self.now[*node] - self.before[*node]) * *weight
        })
    }

    fn lever(&self, contact: &Contact) -> Option<(usize, V3)> {
        match contact.surface {
            Surface::Body(body) => Some((body, contact.touch.point - self.bodies[body].com)),
            _ => None,
        }
    }

    /// Displacement of what a contact touches.
    fn moved(&self, contact: &Contact) -> V3 {
        match (contact.surface, self.lever(contact)) {
            (_, Some((body, lever))) => self.unknowns[body].displacement(&lever),
            (Surface::Soft(part, spot), _) => self.displacement(&self.global(part, &spot)),
            (Surface::Obstacle(velocity), _) => velocity * self.step,
            (Surface::Body(_), None) => V3::zeros(),
        }
    }

    /// Where a contact is.
    pub(super) fn placed(&self, contact: &Contact) -> Placed {
        let spot = self.global(contact.part, &contact.spot);
        let at = |places: &[V3]| {
            let parts = spot.iter();
            parts.fold(V3::zeros(), |sum, (node, weight)| {
                sum + places[*node] * *weight
            })
        };
        let moved = self.moved(contact);
        let mass: f64 = spot
            .iter()
            .map(|(node, weight)| self.masses[*node] * weight)
            .sum();
        let apart = at(self.now) - contact.touch.point - moved;
        Placed {
            distance: contact.touch.normal.dot(&apart) - self.radii[contact.part],
            slip: self.displacement(&spot) - moved,
            stiffness: STIFFNESS * mass / (self.step * self.step),
        }
    }

    /// What a contact adds to the equations, and its force on what is soft; None where the surfaces are apart.
    pub(super) fn coupling(&self, contact: &Contact, limit: f64) -> Option<(Coupling, V3)> {
        let push = self.placed(contact).push(&contact.touch, limit)?;
        let mut nodes = [(0, 0.0); 6];
        nodes[..3].copy_from_slice(&self.global(contact.part, &contact.spot));
        if let Surface::Soft(part, spot) = contact.surface {
            let other = self.global(part, &spot);
            nodes[3..].copy_from_slice(&other.map(|(node, weight)| (node, -weight)));
        }
        let body = self.lever(contact);
        let map =
            |(body, lever): (usize, V3)| -> (usize, Matrix3x6<f64>) { (body, lever_map(&lever)) };
        let coupling = Coupling {
            nodes,
            body: body.map(map),
            stiffness: push.stiffness,
        };
        Some((coupling, push.force))
    }
}
