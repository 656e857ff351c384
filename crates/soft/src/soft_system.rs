//! Rods, cloths and volumes in one step.

use nalgebra::Vector6;

use crate::body::Body;
use crate::contact::{Contact, Surface};
use crate::fem::{self, Deformable};
use crate::rod::Rod;
use crate::{Step, newton};

/// Everything that is soft.
pub struct SoftSystem<'a> {
    /// Rods.
    pub rods: &'a mut Vec<Rod>,
    /// Contacts of rods with each other, bodies and obstacles.
    pub rod_contacts: &'a mut Vec<Contact>,
    /// Cloths and volumes.
    pub parts: &'a mut [Deformable],
    /// Their contacts; rods are numbered after the cloths and volumes.
    pub contacts: &'a mut [fem::Contact],
}

/// Moves what is soft, and gives bodies the velocities that they get by that; the impulses on these.
///
/// Rods that touch no cloth or volume come first, then cloths and volumes, with the rods that touch them. Where there is no solution in finite numbers, things stay where
/// they are, at rest, and exert nothing.
pub fn solve_system(all: SoftSystem, bodies: &mut [Body], step: Step) -> Vec<Vector6<f64>> {
    let mut impulses = vec![Vector6::zeros(); bodies.len()];
    let SoftSystem {
        rods,
        rod_contacts,
        parts,
        contacts,
    } = all;
    let count = parts.len();
    let coupled = coupled(rods.len(), rod_contacts, count, contacts);
    let [mut free, mut touching] = split(rods, rod_contacts, &coupled);
    if !free.rods.is_empty() && newton::solve(&mut free.rods, bodies, &mut free.contacts, step) {
        take_impulses(bodies, &mut impulses);
    }
    renumber(contacts, count, &|rod| touching.place(rod));
    let touching_parts = fem::Parts {
        parts,
        contacts,
        rods: &mut touching.rods,
        rod_contacts: &mut touching.contacts,
    };
    if count > 0 && fem::solve(touching_parts, bodies, step) {
        take_impulses(bodies, &mut impulses);
    }
    renumber(contacts, count, &|place| touching.numbers[place]);
    put_back([free, touching], rods, rod_contacts);
    impulses
}

/// Bodies go on with what they have received.
fn take_impulses(bodies: &mut [Body], impulses: &mut [Vector6<f64>]) {
    for (body, sum) in bodies.iter_mut().zip(impulses) {
        *sum += body.impulse;
        body.velocity += body.response * body.impulse;
    }
}

/// Which rods touch a cloth or volume, or a rod that does.
fn coupled(
    rods: usize,
    rod_contacts: &[Contact],
    parts: usize,
    contacts: &[fem::Contact],
) -> Vec<bool> {
    let mut coupled = vec![false; rods];
    for number in contacts.iter().flat_map(fem::Contact::parts) {
        if let Some(rod) = number.checked_sub(parts) {
            coupled[rod] = true;
        }
    }
    let pair = |contact: &Contact| match contact.surface {
        Surface::Rod(other, ..) => Some([contact.rod, other]),
        _ => None,
    };
    let pairs: Vec<[usize; 2]> = rod_contacts.iter().filter_map(pair).collect();
    while let Some(pair) = pairs.iter().find(|[a, b]| coupled[*a] != coupled[*b]) {
        pair.iter().for_each(|rod| coupled[*rod] = true);
    }
    coupled
}

/// Some of the rods, with their contacts, in which they are numbered as here.
#[derive(Default)]
struct Group {
    /// Their numbers among all.
    numbers: Vec<usize>,
    rods: Vec<Rod>,
    contacts: Vec<Contact>,
}

impl Group {
    fn place(&self, number: usize) -> usize {
        self.numbers.partition_point(|known| *known < number)
    }
}

/// Those that are not coupled, and those that are.
fn split(rods: &mut Vec<Rod>, contacts: &mut Vec<Contact>, coupled: &[bool]) -> [Group; 2] {
    let mut groups = [Group::default(), Group::default()];
    for (number, rod) in rods.drain(..).enumerate() {
        let group = &mut groups[usize::from(coupled[number])];
        group.numbers.push(number);
        group.rods.push(rod);
    }
    for mut contact in contacts.drain(..) {
        let group = &mut groups[usize::from(coupled[contact.rod])];
        contact.number_rods(|number| group.place(number));
        group.contacts.push(contact);
    }
    groups
}

fn put_back(groups: [Group; 2], rods: &mut Vec<Rod>, contacts: &mut Vec<Contact>) {
    let mut all: Vec<(usize, Rod)> = Vec::new();
    for group in groups {
        let numbers = group.numbers;
        contacts.extend(group.contacts.into_iter().map(|mut contact| {
            contact.number_rods(|place| numbers[place]);
            contact
        }));
        all.extend(numbers.into_iter().zip(group.rods));
    }
    all.sort_by_key(|(number, _)| *number);
    rods.extend(all.into_iter().map(|(_, rod)| rod));
}

/// Gives the rods in contacts with cloths and volumes other numbers.
fn renumber(contacts: &mut [fem::Contact], parts: usize, rods: &dyn Fn(usize) -> usize) {
    for number in contacts.iter_mut().flat_map(fem::Contact::parts_mut) {
        if let Some(rod) = number.checked_sub(parts) {
            *number = parts + rods(rod);
        }
    }
}
