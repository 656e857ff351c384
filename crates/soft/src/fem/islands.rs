//! Cloths and volumes that have nothing to do with each other are solved on their own.

use super::Deformable;
use super::contact::{Contact, Surface};
use super::newton::solve_island;
use crate::body::Body;
use crate::rod::Target;
use crate::{Step, V3};

/// Cloths and volumes that touch each other, or that the same bodies hold or touch, with these bodies and contacts; their indices are those within the island.
pub(super) struct Island<'a> {
    pub parts: Vec<&'a mut Deformable>,
    pub bodies: Vec<Body>,
    pub contacts: Vec<Contact>,
    /// Their places among all.
    numbers: Numbers,
}

#[derive(Default)]
struct Numbers {
    parts: Vec<usize>,
    bodies: Vec<usize>,
    contacts: Vec<usize>,
}

/// Moves cloths and volumes, and finds the impulses on bodies and at contacts; false where there is no solution in finite numbers for some of them: these stay where
/// they are, at rest.
pub fn solve(
    parts: &mut [Deformable],
    bodies: &mut [Body],
    contacts: &mut [Contact],
    step: Step,
) -> bool {
    for body in bodies.iter_mut() {
        body.impulse.fill(0.0);
    }
    contacts
        .iter_mut()
        .for_each(|contact| contact.touch.impulse = V3::zeros());
    let roots = roots(parts, bodies.len(), contacts);
    let mut left: Vec<Option<&mut Deformable>> = parts.iter_mut().map(Some).collect();
    let mut are_found = true;
    for numbers in islands(&roots, left.len(), contacts) {
        let mut island = Island::taken(numbers, &mut left, bodies, contacts);
        are_found &= solve_island(&mut island, step);
        island.give_back(bodies, contacts);
    }
    are_found
}

/// For each part, and after them for each body, the first one of its island.
fn roots(parts: &[Deformable], bodies: usize, contacts: &[Contact]) -> Vec<usize> {
    let count = parts.len();
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
    for (number, part) in parts.iter().enumerate() {
        for hold in &part.holds {
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

/// The islands, in the order of their first parts. A body alone is in none.
fn islands(roots: &[usize], parts: usize, contacts: &[Contact]) -> Vec<Numbers> {
    let mut all: Vec<Numbers> = (0..parts).map(|_| Numbers::default()).collect();
    for (number, root) in roots.iter().enumerate() {
        if number < parts {
            all[*root].parts.push(number);
        } else if *root < parts {
            all[*root].bodies.push(number - parts);
        }
    }
    for (number, contact) in contacts.iter().enumerate() {
        all[roots[contact.part]].contacts.push(number);
    }
    all.retain(|numbers| !numbers.parts.is_empty());
    all
}

impl<'a> Island<'a> {
    fn taken(
        numbers: Numbers,
        left: &mut [Option<&'a mut Deformable>],
        bodies: &[Body],
        contacts: &[Contact],
    ) -> Self {
        let parts = numbers
            .parts
            .iter()
            .filter_map(|number| left[*number].take());
        let mut island = Self {
            parts: parts.collect(),
            bodies: numbers
                .bodies
                .iter()
                .map(|number| bodies[*number].clone())
                .collect(),
            contacts: numbers
                .contacts
                .iter()
                .map(|number| contacts[*number].clone())
                .collect(),
            numbers,
        };
        island.renumber();
        island
    }

    fn renumber(&mut self) {
        let Numbers { parts, bodies, .. } = &self.numbers;
        let place =
            |numbers: &[usize], number: usize| numbers.partition_point(|known| *known < number);
        for hold in self.parts.iter_mut().flat_map(|part| &mut part.holds) {
            if let Target::Body(body, _) = &mut hold.target {
                *body = place(bodies, *body);
            }
        }
        for contact in &mut self.contacts {
            contact.part = place(parts, contact.part);
            match &mut contact.surface {
                Surface::Body(body) => *body = place(bodies, *body),
                Surface::Soft(other, _) => *other = place(parts, *other),
                Surface::Obstacle(_) => {}
            }
        }
    }

    fn give_back(self, bodies: &mut [Body], contacts: &mut [Contact]) {
        let numbers = &self.numbers;
        for (number, body) in numbers.bodies.iter().zip(self.bodies) {
            bodies[*number] = body;
        }
        for hold in self.parts.into_iter().flat_map(|part| &mut part.holds) {
            if let Target::Body(body, _) = &mut hold.target {
                *body = numbers.bodies[*body];
            }
        }
        for (number, contact) in numbers.contacts.iter().zip(self.contacts) {
            contacts[*number].touch = contact.touch;
        }
    }
}
