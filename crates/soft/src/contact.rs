//! Contacts of rods.

use crate::V3;

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
    /// The point of what is touched that is nearest, at the beginning of the step.
    pub point: V3,
    /// Points to the rod.
    pub normal: V3,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Names the contact from step to step, together with rod and edge.
    pub key: u64,
    /// Elongation of the spring along the surface, metres, of the rod against what it touches.
    pub stick: V3,
    /// Out: impulse on the rod, N s.
    pub impulse: V3,
}

impl Contact {
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
                let normal = contact.normal;
                contact.stick = known.stick - normal * normal.dot(&known.stick);
            }
        }
    }
}

/// Force on a rod at a contact, and how it changes with a displacement.
pub(crate) struct Push {
    pub force: V3,
    pub stiffness: nalgebra::Matrix3<f64>,
    pub stick: V3,
}

/// Where a contact is in a trial.
pub(crate) struct Placed {
    /// Negative: penetration, metres.
    pub gap: f64,
    /// How far the rod has moved against what it touches since the beginning of the step.
    pub slip: V3,
    /// N/m
    pub stiffness: f64,
}

impl Placed {
    /// The spring along the surface, if nothing gives way.
    fn stick(&self, contact: &Contact) -> V3 {
        let stick = contact.stick + self.slip;
        stick - contact.normal * contact.normal.dot(&stick)
    }

    /// The force; None where the surfaces are apart.
    pub(crate) fn push(&self, contact: &Contact) -> Option<Push> {
        if self.gap >= 0.0 {
            return None;
        }
        let (normal, stiffness) = (contact.normal, self.stiffness);
        let outer = normal * normal.transpose();
        let along = nalgebra::Matrix3::identity() - outer;
        let stick = self.stick(contact);
        let (length, limit) = (stick.norm(), contact.friction * -self.gap);
        let (stick, resistance) = if length <= limit {
            (stick, along * stiffness)
        } else {
            let direction = stick / length;
            let across = along - direction * direction.transpose();
            (direction * limit, across * (stiffness * limit / length))
        };
        Some(Push {
            force: (normal * -self.gap - stick) * stiffness,
            stiffness: outer * stiffness + resistance,
            stick,
        })
    }

    /// The potential, for a known largest elongation of the spring along the surface.
    pub(crate) fn potential(&self, contact: &Contact, limit: f64) -> f64 {
        let depth = (-self.gap).max(0.0);
        let length = self.stick(contact).norm();
        let along = if length <= limit {
            0.5 * length * length
        } else {
            limit * (length - 0.5 * limit)
        };
        self.stiffness * (0.5 * depth * depth + along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(friction: f64) -> Contact {
        Contact {
            rod: 0,
            edge: 0,
            weight: 0.0,
            surface: Surface::Obstacle(V3::zeros()),
            point: V3::zeros(),
            normal: V3::z(),
            friction,
            key: 0,
            stick: V3::zeros(),
            impulse: V3::zeros(),
        }
    }

    fn placed(gap: f64, slip: f64) -> Placed {
        Placed {
            gap,
            slip: V3::x() * slip,
            stiffness: 1000.0,
        }
    }

    #[test]
    fn friction_sticks_up_to_its_limit() {
        let sticks = placed(-1e-3, 4e-4).push(&contact(0.5)).unwrap();
        assert!((sticks.force - V3::new(-0.4, 0.0, 1.0)).norm() < 1e-12);
        let slips = placed(-1e-3, 4e-2).push(&contact(0.5)).unwrap();
        assert!((slips.force - V3::new(-0.5, 0.0, 1.0)).norm() < 1e-12);
        assert!(placed(1e-9, 1.0).push(&contact(0.5)).is_none());
    }

    #[test]
    fn a_contact_goes_on_along_the_surface() {
        let mut before = vec![contact(0.5)];
        before[0].stick = V3::new(1.0, 0.0, 0.0);
        let mut now = vec![contact(0.5), contact(0.5)];
        now[1].key = 7;
        now[0].normal = V3::new(0.6, 0.0, 0.8);
        Contact::carry_on(&mut now, &mut before);
        assert!((now[0].stick - V3::new(0.64, 0.0, -0.48)).norm() < 1e-12);
        assert_eq!(now[1].stick, V3::zeros());
    }
}
