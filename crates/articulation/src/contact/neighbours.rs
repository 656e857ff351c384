//! Neighbours at a joint that overlap: whether the joint lets them escape.

use nalgebra::Vector3;

use crate::contact::Contact;
use crate::joint::Joint;
use crate::mechanism::Mechanism;

/// Neighbours at a joint are in contact only if its motion separates them at this fraction of its speed or more.
const MIN_SEPARATION_RATE: f64 = 1e-3;
/// Distance below which points of neighbours count as touching, metres.
const TOUCHING_DISTANCE: f64 = 2e-4;
/// Passes of the perceptron that searches for a motion that separates neighbours at all of their points.
const MAX_PERCEPTRON_PASSES: usize = 8;

impl Mechanism {
    /// Whether the bodies of a contact can be separated: those of a joint only where its motion does so at all points where they touch.
    pub(super) fn can_separate(&self, contact: &Contact, all: &[Contact]) -> bool {
        let joins = |joint: &&Joint| {
            joint
                .properties
                .bodies
                .into_iter()
                .all(|body| contact.is_of(body))
        };
        self.joints.iter().filter(joins).all(|joint| {
            let touching = all
                .iter()
                .filter(|other| other.distance < TOUCHING_DISTANCE && other.has_bodies_of(contact));
            let directions: Vec<Vector3<f64>> =
                touching.map(|contact| joint.separation(contact)).collect();
            joint.separation(contact).norm() > MIN_SEPARATION_RATE && is_separable(&directions)
        })
    }
}

/// Whether some motion has a positive part along all these directions: the perceptron finds it unless it hardly does (F. Rosenblatt, 1958).
fn is_separable(directions: &[Vector3<f64>]) -> bool {
    let mut motion: Vector3<f64> = directions.iter().sum();
    for _ in 0..MAX_PERCEPTRON_PASSES {
        let mut is_found = true;
        for direction in directions
            .iter()
            .filter(|direction| direction.norm() > MIN_SEPARATION_RATE)
        {
            if direction.dot(&motion) <= 0.0 {
                motion += direction;
                is_found = false;
            }
        }
        if is_found {
            return true;
        }
    }
    false
}

impl Contact {
    /// Whether a body of the mechanism is one of the two.
    fn is_of(&self, body: usize) -> bool {
        match self.bodies {
            [Some(first), Some(second)] => body == first || body == second,
            [Some(only), None] | [None, Some(only)] => body == only || self.base == Some(body),
            [None, None] => false,
        }
    }

    fn has_bodies_of(&self, other: &Self) -> bool {
        let ends = |contact: &Self| {
            let [first, second] = contact.bodies.map(|body| body.or(contact.base));
            (first.min(second), first.max(second))
        };
        ends(self) == ends(other)
    }
}
