//! Rods against closed forms, and what they exchange with bodies and each other.

mod bodies;
mod contacts;
mod fem;
mod motion;
mod statics;

use soft::{Body, Contact, Hold, Material, Rod, Step, Target, Touch, V3, solve};

pub(crate) const GRAVITY: f64 = 9.81;

/// A thin rope of 50 g/m that hardly bends or stretches.
pub(crate) fn rope() -> Material {
    Material {
        radius: 0.002,
        line_density: 0.05,
        stretch: 1e5,
        bend: 1e-8,
        twist: 1e-8,
        damping: 0.0,
        drag: 0.0,
        strength: f64::INFINITY,
    }
}

/// Points on a straight line.
pub(crate) fn line(from: V3, to: V3, edges: usize) -> Vec<V3> {
    (0..=edges)
        .map(|i| from + (to - from) * (i as f64 / edges as f64))
        .collect()
}

/// Holds a node where it is.
pub(crate) fn hold(rod: &mut Rod, node: usize) {
    let place = rod.point(node);
    rod.holds.push(Hold::new(node, Target::Place(place), None));
}

/// Holds two nodes and the direction of the edge between them.
pub(crate) fn clamp(rod: &mut Rod, node: usize) {
    let direction = rod.direction(node);
    hold(rod, node);
    hold(rod, node + 1);
    let last = rod.holds.len() - 2;
    rod.holds[last].direction = Some(direction);
}

pub(crate) fn step(length: f64) -> Step {
    Step {
        gravity: V3::new(0.0, 0.0, -GRAVITY),
        length,
    }
}

pub(crate) fn weightless(length: f64) -> Step {
    Step {
        gravity: V3::zeros(),
        length,
    }
}

/// Steps of rods alone.
pub(crate) fn run(rods: &mut [Rod], step: Step, count: usize) {
    for _ in 0..count {
        assert!(solve(rods, &mut [], &mut [], step));
    }
}

/// A step with contacts that go on from step to step.
pub(crate) fn run_in_contact(
    rods: &mut [Rod],
    bodies: &mut [Body],
    kept: &mut Vec<Contact>,
    mut contacts: Vec<Contact>,
    step: Step,
) {
    Contact::carry_on(&mut contacts, kept);
    assert!(solve(rods, bodies, &mut contacts, step));
    *kept = contacts;
}

pub(crate) fn near(value: f64, expected: f64, part: f64) {
    assert!(
        (value - expected).abs() <= part * expected.abs(),
        "{value} is not within {part} of {expected}"
    );
}
