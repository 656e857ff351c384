//! Pairs of shapes of which a shape says whether they touch.

use std::collections::BTreeMap;

use scene::{Handle, Scene};

/// What a shape says of itself and another one.
pub(crate) struct PairRule {
    pub shapes: [Handle; 2],
    pub touches: bool,
    /// Coefficient of friction of both together; None for that of their materials.
    pub friction: Option<f64>,
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
            touches: pair.touches,
            friction: pair.friction,
        }));
    }
    rules
}
