//! Where ropes, cloths and volumes touch each other and themselves.

use soft::fem::{self, Deformable};
use soft::{Contact, Rod};

use super::group::Group;
use super::part::Part;
use super::{Placed, Start};

/// What comes nearer than this to each other may touch, metres, beside what it moves in a sub-step.
const MARGIN: f64 = 1e-3;

/// Contacts of ropes with each other and themselves.
pub(super) fn ropes(ropes: &Group<Rod>, start: Start<'_>) -> Vec<Contact> {
    let all: Vec<&Placed> = ropes.all.iter().collect();
    if is_alone(&all) {
        return Vec::new();
    }
    let fastest = ropes.parts.iter().map(Part::fastest).fold(0.0, f64::max);
    let margin = MARGIN + 2.0 * fastest * start.step;
    soft::between(&ropes.parts, margin, |first, second| {
        friction(&all, [first, second], start)
    })
}

/// Contacts of cloths and volumes with each other, themselves and ropes, which are numbered after them.
pub(super) fn touching(
    bodies: &Group<Deformable>,
    ropes: &Group<Rod>,
    start: Start<'_>,
) -> Vec<fem::Contact> {
    let all: Vec<&Placed> = bodies.all.iter().chain(&ropes.all).collect();
    if bodies.is_empty() || is_alone(&all) {
        return Vec::new();
    }
    fem::nearby(
        &bodies.parts,
        &ropes.parts,
        MARGIN,
        start.step,
        |first, second| friction(&all, [first, second], start),
    )
}

/// Whether there is nothing that could touch something else, or itself.
fn is_alone(all: &[&Placed]) -> bool {
    all.len() < 2 && !all.iter().any(|placed| placed.plan.soft.touches_itself())
}

/// Friction of two of them; None if they do not touch.
fn friction(all: &[&Placed], [first, second]: [usize; 2], start: Start<'_>) -> Option<f64> {
    let [a, b] = [first, second].map(|number| all[number]);
    if first == second {
        let own = a.friction(b.plan.surface.friction);
        return a.plan.soft.touches_itself().then_some(own);
    }
    let response = start.verdicts.response(a.tag(), b.tag());
    a.friction_in(response, b.plan.surface.friction)
}
