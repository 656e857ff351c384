//! Pairs of shapes of which a shape says whether they touch.

use std::collections::BTreeMap;

use crate::contacts::ContactResponse;
use scene::shape::ContactPair;
use scene::{Handle, Scene};

/// What a shape says of itself and another one.
pub(crate) struct PairRule {
    pub shapes: [Handle; 2],
    pub response: ContactResponse,
}

/// The rules of all bodies.
pub(super) fn rules(scene: &Scene, bodies: &BTreeMap<Handle, bool>) -> Vec<PairRule> {
    let has_contacts = scene.settings().dynamics.surrounding().has_contacts;
    let mut rules = Vec::new();
    for shape in bodies.keys().copied().filter(|_| has_contacts) {
        let Ok(object) = scene.object(shape) else {
            continue;
        };
        rules.extend(object.contact_pairs().into_iter().map(|pair| PairRule {
            shapes: [shape, pair.other],
            response: response(&pair),
        }));
    }
    rules
}

fn response(pair: &ContactPair) -> ContactResponse {
    match pair.friction {
        _ if !pair.touches => ContactResponse::NoCollision,
        Some(friction) => ContactResponse::Collide {
            friction,
            restitution: 0.0,
        },
        None => ContactResponse::Default,
    }
}
