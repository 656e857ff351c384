//! Distances, bounds and what lies between states.

use std::f64::consts::{FRAC_PI_4, PI};

use planning::space::{Bounds, Component, CompoundSpace};
use planning::{Random, StateSpace};
use test_support::random;

struct Numbers(random::Random);

impl Numbers {
    fn new(seed: u64) -> Self {
        Self(random::Random::new(seed))
    }
}

impl Random for Numbers {
    fn next(&mut self) -> f64 {
        self.0.unit()
    }
}

fn of(component: Component) -> CompoundSpace {
    CompoundSpace::new(vec![(component, 1.0)])
}

fn bounds(count: usize, limit: f64) -> Bounds {
    Bounds::new(vec![-limit; count], vec![limit; count])
}

fn dubins(symmetric: bool) -> CompoundSpace {
    of(Component::Dubins {
        bounds: bounds(2, 5.0),
        radius: 0.05,
        symmetric,
    })
}

fn all() -> Vec<CompoundSpace> {
    vec![
        of(Component::Real(bounds(3, 2.0))),
        of(Component::Angle),
        of(Component::Rotation),
        of(Component::Plane(bounds(2, 2.0))),
        of(Component::Space(bounds(3, 2.0))),
        dubins(false),
        dubins(true),
        CompoundSpace::new(vec![
            (Component::Plane(bounds(2, 1.0)), 2.0),
            (Component::Angle, 0.5),
        ]),
    ]
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-8
}

#[test]
fn distances_are_those_of_the_original() {
    let weighted = CompoundSpace::new(vec![(Component::Real(bounds(2, 1.0)), 2.0)]);
    assert!(near(weighted.distance(&[0.0, 0.0], &[0.3, 0.4]), 1.0));
    let plane = of(Component::Plane(bounds(2, 5.0)));
    assert!(near(
        plane.distance(&[0.0, 0.0, 3.0], &[3.0, 4.0, -3.0]),
        5.141_592_654
    ));
    let space = of(Component::Space(bounds(3, 5.0)));
    let half = FRAC_PI_4.sin_cos();
    let turned = [0.0, 0.0, 0.0, 0.0, 0.0, half.0, half.1];
    assert!(near(
        space.distance(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &turned),
        FRAC_PI_4
    ));
}

#[test]
fn shortest_curves_are_those_of_the_original() {
    let start = [0.0; 3];
    assert!(near(dubins(false).distance(&start, &[1.0, 0.0, 0.0]), 1.0));
    assert!(near(
        dubins(false).distance(&start, &[0.0, 0.1, PI]),
        0.157_079_633
    ));
    assert!(near(
        dubins(false).distance(&start, &[-1.0, 0.0, 0.0]),
        1.314_159_265
    ));
    assert!(near(dubins(true).distance(&start, &[-1.0, 0.0, 0.0]), 1.0));
}

#[test]
fn ways_begin_and_end_where_they_should_and_are_even() {
    let mut random = Numbers::new(1);
    for space in all() {
        for _ in 0..200 {
            let (from, to) = (space.sample(&mut random), space.sample(&mut random));
            assert!(space.is_within_bounds(&from), "{from:?}");
            let length = space.distance(&from, &to);
            assert!(length >= 0.0 && length.is_finite());
            for (part, expected) in [(0.0, &from), (1.0, &to)] {
                let end = space.interpolate(&from, &to, part);
                assert!(
                    space.distance(&end, expected) < 1e-4,
                    "{space:?} {from:?} {to:?} {end:?}"
                );
            }
            let middle = space.interpolate(&from, &to, 0.5);
            if space.is_symmetric() {
                assert!(
                    (space.distance(&from, &middle) - 0.5 * length).abs() < 1e-6,
                    "{space:?}"
                );
            } else {
                assert!(
                    space.distance(&from, &middle) <= 0.5 * length + 1e-6,
                    "{space:?}"
                );
            }
        }
    }
}

#[test]
fn states_near_another_are_near_and_within_bounds() {
    let mut random = Numbers::new(2);
    for space in all().into_iter().filter(|space| space.is_symmetric()) {
        for _ in 0..200 {
            let centre = space.sample(&mut random);
            let state = space.sample_near(&mut random, &centre, 0.1);
            assert!(space.is_within_bounds(&state), "{space:?} {state:?}");
            assert!(space.distance(&centre, &state) < 1.0, "{space:?}");
        }
    }
}

#[test]
fn bounds_are_kept_and_enforced() {
    let angle = of(Component::Angle);
    assert!(!angle.is_within_bounds(&[PI]) && angle.is_within_bounds(&[-PI]));
    let mut state = [4.0];
    angle.enforce_bounds(&mut state);
    assert!(near(state[0], -2.283_185_307));
    let square = of(Component::Real(bounds(2, 1.0)));
    let mut state = [2.0, -3.0];
    square.enforce_bounds(&mut state);
    assert_eq!(state, [1.0, -1.0]);
    let mut rotation = [0.0; 4];
    of(Component::Rotation).enforce_bounds(&mut rotation);
    assert_eq!(rotation, [0.0, 0.0, 0.0, 1.0]);
    assert!(!square.is_within_bounds(&[f64::NAN, 0.0]));
}

#[test]
fn extents_are_the_largest_distances() {
    let mut random = Numbers::new(3);
    for space in all().into_iter().filter(|space| space.is_symmetric()) {
        let extent = space.extent();
        for _ in 0..500 {
            let (a, b) = (space.sample(&mut random), space.sample(&mut random));
            assert!(space.distance(&a, &b) <= extent + 1e-9);
        }
    }
}

#[test]
fn motions_are_checked_as_closely_as_the_original_does() {
    let square = of(Component::Real(bounds(2, 1.0)));
    assert_eq!(square.parts(&[-0.5, 0.0], &[0.5, 0.0], 0.01), 36);
}

#[test]
fn rotations_lie_on_the_short_way_whatever_the_sign_of_their_quaternions() {
    let rotation = of(Component::Rotation);
    let about_z = |angle: f64| [0.0, 0.0, (0.5 * angle).sin(), (0.5 * angle).cos()];
    let (from, to) = (about_z(0.0), about_z(FRAC_PI_4));
    let same_as_to = to.map(|part| -part);
    for end in [to, same_as_to] {
        let between = rotation.interpolate(&from, &end, 0.25);
        let expected = about_z(0.25 * FRAC_PI_4);
        assert!(
            between.iter().zip(expected).all(|(a, b)| near(*a, b)),
            "{between:?}"
        );
    }
}
