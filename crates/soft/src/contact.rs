//! Contacts of rods.

use crate::V3;
use crate::touch::Touch;

/// What a rod touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// Something that no force moves, with the velocity of its surface.
    Obstacle(V3),
    /// A rigid body, by its index.
    Body(usize),
    /// A rod, by its index: an edge, and where on it (0 to 1).
    Rod(usize, usize, f64),
}

/// A point at which a rod touches something, or may in this step.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The rod.
    pub rod: usize,
    /// Its edge, and where on that the point is (0 to 1).
    pub edge: usize,
    /// Where on the edge, 0 to 1.
    pub weight: f64,
    /// What is touched.
    pub surface: Surface,
    /// Where on what is touched, and what is exerted there.
    pub touch: Touch,
    /// Names the contact from step to step, together with rod and edge.
    pub key: u64,
}

impl Contact {
    /// Gives the rods other numbers.
    pub(crate) fn number_rods(&mut self, number: impl Fn(usize) -> usize) {
        self.rod = number(self.rod);
        if let Surface::Rod(other, ..) = &mut self.surface {
            *other = number(*other);
        }
    }

    fn name(&self) -> (usize, usize, u64) {
        (self.rod, self.edge, self.key)
    }

    /// Goes on with the friction of the same contact in the step before. Both lists are put in order.
    pub fn carry_on(contacts: &mut [Self], before: &mut [Self]) {
        contacts.sort_by_key(Self::name);
        before.sort_by_key(Self::name);
        for contact in contacts {
            let same = before.binary_search_by_key(&contact.name(), Self::name);
            if let Some(known) = same.ok().map(|place| &before[place]) {
                contact.touch.carry_on(&known.touch);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_goes_on_along_the_surface() {
        let contact = |key| Contact {
            rod: 0,
            edge: 0,
            weight: 0.0,
            surface: Surface::Obstacle(V3::zeros()),
            touch: Touch::new(V3::zeros(), V3::z(), 0.5),
            key,
        };
        let mut before = vec![contact(0)];
        before[0].touch.stick = V3::new(1.0, 0.0, 0.0);
        let mut now = vec![contact(0), contact(7)];
        now[0].touch.normal = V3::new(0.6, 0.0, 0.8);
        Contact::carry_on(&mut now, &mut before);
        assert!((now[0].touch.stick - V3::new(0.64, 0.0, -0.48)).norm() < 1e-12);
        assert_eq!(now[1].touch.stick, V3::zeros());
    }
}
