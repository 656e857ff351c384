//! What has nothing to do with each other is solved on its own.

use super::Deformable;
use super::contact::{Contact, Spot, Surface};
use super::newton::solve_island;
use crate::body::Body;
use crate::contact as rod_contact;
use crate::rod::{Hold, Rod, Target};
use crate::{Step, V3};

/// Cloths, volumes and rods that touch each other, or that the same bodies hold or touch, with these bodies and contacts; their indices are those within the island.
pub(super) struct Island<'a> {
    pub members: Members<'a>,
    pub bodies: Vec<Body>,
    pub contacts: Vec<Contact>,
    /// Their places among all.
    numbers: Numbers,
}

/// Cloths and volumes, and rods, which are numbered after them.
pub(super) struct Members<'a> {
    pub parts: Vec<&'a mut Deformable>,
    pub rods: Vec<&'a mut Rod>,
}

impl Members<'_> {
    /// What holds each of them.
    pub(super) fn holds(&self) -> impl Iterator<Item = &Vec<Hold>> {
        let parts = self.parts.iter().map(|part| &part.holds);
        parts.chain(self.rods.iter().map(|rod| &rod.holds))
    }

    fn holds_mut(&mut self) -> impl Iterator<Item = &mut Hold> {
        let parts = self.parts.iter_mut().flat_map(|part| &mut part.holds);
        parts.chain(self.rods.iter_mut().flat_map(|rod| &mut rod.holds))
    }

    /// Shortest edge at rest, metres.
    pub(super) fn shortest_edge(&self) -> f64 {
        let parts = self.parts.iter().map(|part| part.shortest);
        let rods = self.rods.iter().flat_map(|rod| &rod.rest_lengths);
        parts.chain(rods.copied()).fold(f64::MAX, f64::min)
    }

    /// Mass of all, and their moment of inertia about an end.
    pub(super) fn scale(&self) -> [f64; 2] {
        let rods = self.rods.iter().map(|rod| rod.scale());
        let all = self.parts.iter().map(|part| part.scale()).chain(rods);
        all.fold([0.0; 2], |sum, [mass, moment]| {
            [sum[0] + mass, sum[1] + moment]
        })
    }
}

/// Cloths and volumes, and the rods that they touch, with their contacts and those of these rods.
pub struct Parts<'a> {
    /// Cloths and volumes.
    pub parts: &'a mut [Deformable],
    /// Contacts of cloths and volumes; rods are numbered after these.
    pub contacts: &'a mut [Contact],
    /// Rods that are in these contacts, or in contacts with such rods.
    pub rods: &'a mut [Rod],
    /// Contacts of rods with each other, bodies and obstacles.
    pub rod_contacts: &'a mut [rod_contact::Contact],
}

impl<'a> Parts<'a> {
    /// Cloths and volumes alone.
    pub fn without_rods(parts: &'a mut [Deformable], contacts: &'a mut [Contact]) -> Self {
        Self {
            parts,
            contacts,
            rods: &mut [],
            rod_contacts: &mut [],
        }
    }
}
#[derive(Default)]
struct Numbers {
    /// Parts, and after them rods.
    members: Vec<usize>,
    bodies: Vec<usize>,
    contacts: Vec<usize>,
}

/// Moves cloths, volumes and rods, and finds the impulses on bodies and at contacts; false where there is no solution in finite numbers for some of them: these stay
/// where they are, at rest.
pub fn solve(parts: Parts, bodies: &mut [Body], step: Step) -> bool {
    for body in bodies.iter_mut() {
        body.impulse.fill(0.0);
    }
    let Parts {
        parts,
        contacts,
        rods,
        rod_contacts,
    } = parts;
    let count = parts.len();
    let of_rods = rod_contacts.iter().map(|contact| of_rod(contact, count));
    let mut all: Vec<Contact> = contacts.iter().cloned().chain(of_rods).collect();
    all.iter_mut()
        .for_each(|contact| contact.touch.impulse = V3::zeros());
    let mut remaining = Remaining {
        parts: parts.iter_mut().map(Some).collect(),
        rods: rods.iter_mut().map(Some).collect(),
    };
    let mut are_found = true;
    for numbers in islands(&remaining, bodies.len(), &all) {
        let mut island = Island::taken(numbers, &mut remaining, bodies, &all);
        are_found &= solve_island(&mut island, step);
        island.give_back(bodies, &mut all);
    }
    let touches = all.into_iter().map(|contact| contact.touch);
    let own = contacts.iter_mut().map(|contact| &mut contact.touch);
    let of_rods = rod_contacts.iter_mut().map(|contact| &mut contact.touch);
    own.chain(of_rods)
        .zip(touches)
        .for_each(|(own, touch)| *own = touch);
    are_found
}

/// A contact of a rod, where rods are numbered after so many parts.
fn of_rod(contact: &rod_contact::Contact, parts: usize) -> Contact {
    let spot = |edge: usize, weight: f64| -> Spot {
        [(edge, 1.0 - weight), (edge + 1, weight), (edge + 1, 0.0)]
    };
    Contact {
        part: parts + contact.rod,
        spot: spot(contact.edge, contact.weight),
        surface: match contact.surface {
            rod_contact::Surface::Obstacle(velocity) => Surface::Obstacle(velocity),
            rod_contact::Surface::Body(body) => Surface::Body(body),
            rod_contact::Surface::Rod(other, edge, weight) => {
                Surface::Soft(parts + other, spot(edge, weight))
            }
        },
        touch: contact.touch.clone(),
        key: contact.key,
    }
}

/// What is in no island yet.
struct Remaining<'a> {
    parts: Vec<Option<&'a mut Deformable>>,
    rods: Vec<Option<&'a mut Rod>>,
}

impl<'a> Remaining<'a> {
    fn len(&self) -> usize {
        self.parts.len() + self.rods.len()
    }

    fn holds(&self) -> impl Iterator<Item = &Vec<Hold>> {
        let parts = self.parts.iter().flatten().map(|part| &part.holds);
        parts.chain(self.rods.iter().flatten().map(|rod| &rod.holds))
    }

    fn take(&mut self, numbers: &[usize]) -> Members<'a> {
        let (parts, rods) = numbers.split_at(numbers.partition_point(|n| *n < self.parts.len()));
        let count = self.parts.len();
        Members {
            parts: parts.iter().filter_map(|n| self.parts[*n].take()).collect(),
            rods: rods
                .iter()
                .filter_map(|n| self.rods[*n - count].take())
                .collect(),
        }
    }
}

/// For each part and rod, and after them for each body, the first one of its island.
fn roots(remaining: &Remaining, bodies: usize, contacts: &[Contact]) -> Vec<usize> {
    let count = remaining.len();
    let mut roots: Vec<usize> = (0..count + bodies).collect();
    let mut join = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|mut at| {
            while roots[at] != at {
                at = roots[at];
            }
            at
        });
        roots[a.max(b)] = a.min(b);
    };
    for (number, holds) in remaining.holds().enumerate() {
        for hold in holds {
            if let Target::Body(body, _) = hold.target {
                join(number, count + body);
            }
        }
    }
    for contact in contacts {
        match contact.surface {
            Surface::Body(body) => join(contact.part, count + body),
            Surface::Soft(other, _) => join(contact.part, other),
            Surface::Obstacle(_) => {}
        }
    }
    // The first one of each island comes before all others of it.
    for number in 0..roots.len() {
        roots[number] = roots[roots[number]];
    }
    roots
}

/// The islands, in the order of their first members. A body alone is in none.
fn islands(remaining: &Remaining, bodies: usize, contacts: &[Contact]) -> Vec<Numbers> {
    let (members, roots) = (remaining.len(), roots(remaining, bodies, contacts));
    let mut all: Vec<Numbers> = (0..members).map(|_| Numbers::default()).collect();
    for (number, root) in roots.iter().enumerate() {
        if number < members {
            all[*root].members.push(number);
        } else if *root < members {
            all[*root].bodies.push(number - members);
        }
    }
    for (number, contact) in contacts.iter().enumerate() {
        all[roots[contact.part]].contacts.push(number);
    }
    all.retain(|numbers| !numbers.members.is_empty());
    all
}

impl<'a> Island<'a> {
    fn taken(
        numbers: Numbers,
        remaining: &mut Remaining<'a>,
        bodies: &[Body],
        contacts: &[Contact],
    ) -> Self {
        let bodies = numbers.bodies.iter().map(|number| bodies[*number].clone());
        let touching = numbers
            .contacts
            .iter()
            .map(|number| contacts[*number].clone());
        let mut island = Self {
            members: remaining.take(&numbers.members),
            bodies: bodies.collect(),
            contacts: touching.collect(),
            numbers,
        };
        island.renumber();
        island
    }

    fn renumber(&mut self) {
        let Numbers {
            members, bodies, ..
        } = &self.numbers;
        let place =
            |numbers: &[usize], number: usize| numbers.partition_point(|known| *known < number);
        for hold in self.members.holds_mut() {
            if let Target::Body(body, _) = &mut hold.target {
                *body = place(bodies, *body);
            }
        }
        for contact in &mut self.contacts {
            contact.part = place(members, contact.part);
            match &mut contact.surface {
                Surface::Body(body) => *body = place(bodies, *body),
                Surface::Soft(other, _) => *other = place(members, *other),
                Surface::Obstacle(_) => {}
            }
        }
    }

    fn give_back(mut self, bodies: &mut [Body], contacts: &mut [Contact]) {
        let numbers = &self.numbers;
        for (number, body) in numbers.bodies.iter().zip(self.bodies) {
            bodies[*number] = body;
        }
        for hold in self.members.holds_mut() {
            if let Target::Body(body, _) = &mut hold.target {
                *body = numbers.bodies[*body];
            }
        }
        for (number, contact) in numbers.contacts.iter().zip(self.contacts) {
            contacts[*number].touch = contact.touch;
        }
    }
}
