//! How far shapes may move until others could come to touch them, and which are near.

use rapier3d_f64::math::{Rotation, Vector};
use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder};
use scene::Handle;
use test_support::random::Random;

use super::*;

fn tag(shape: u32, mask: u16) -> u128 {
    Tag {
        shape: Handle(shape),
        root: Handle(shape),
        mask,
        further_bits: 0,
    }
    .pack()
}

/// Adds a collider with a body of its own, or of no body.
fn add(world: &mut World, form: ColliderBuilder, at: Vector, moves: bool) -> ColliderHandle {
    let number = world.colliders.len() as u32 + 1;
    let form = form.user_data(tag(number, u16::MAX));
    let handle = if moves {
        let body = RigidBodyBuilder::dynamic().translation(at).build();
        let body = world.bodies.insert(body);
        let colliders = &mut world.colliders;
        colliders.insert_with_parent(form.build(), body, &mut world.bodies)
    } else {
        world.colliders.insert(form.translation(at).build())
    };
    world
        .known
        .add(handle, &world.colliders[handle], &world.bodies);
    handle
}

fn ball() -> ColliderBuilder {
    ColliderBuilder::ball(0.1)
}

fn pairs_of(world: &World, handle: ColliderHandle) -> Vec<NearPair> {
    let bounds = |(handle, collider): (_, &Collider)| (handle, collider.compute_aabb());
    let all: Vec<_> = world.colliders.iter().map(bounds).collect();
    let mut pairs = Vec::new();
    add_pairs(world, handle, &all, &mut pairs);
    pairs
}

#[test]
fn no_point_goes_farther_than_the_way_and_some_nearly_as_far() {
    let mut random = Random::new(5);
    let mut vector = |size: f64| {
        Vector::new(random.signed(), random.signed(), random.signed()).normalize() * size
    };
    for case in 0..200 {
        let (mut before, mut after) = (EnginePose::IDENTITY, EnginePose::IDENTITY);
        before.translation = vector(3.0);
        before.rotation = Rotation::from_scaled_axis(vector(2.0));
        let axis = vector(1.0);
        let angle = if case % 2 == 0 { 0.1 } else { 0.0 };
        let shift = vector(if case % 3 == 0 { 0.0 } else { 0.05 });
        after.translation = before.translation + shift;
        after.rotation = Rotation::from_scaled_axis(axis * angle) * before.rotation;
        let placed = Placed {
            collider: ColliderHandle::invalid(),
            pose: before,
            radius: 0.5,
        };
        let way = placed.way_to(&after);
        // The sine of a small angle is nearly the angle.
        let expected = shift.length() + 0.5 * angle;
        assert!((way - expected).abs() < 1e-4, "{way} is not {expected}");
        let point = vector(0.5);
        let went = (after * point - before * point).length();
        assert!(went <= way + 1e-12, "{went} beyond {way}");
        // The same rotation, by the other of its two quaternions.
        after.rotation = -after.rotation;
        assert!((placed.way_to(&after) - way).abs() < 1e-9);
    }
}

#[test]
fn shapes_are_apart_when_their_gap_is_wider_than_the_reach() {
    // Of a ball and a floor whose top is at 0, then of two balls that move, by their boxes.
    let mut world = World::default();
    let floor = ColliderBuilder::cuboid(5.0, 5.0, 0.1);
    add(&mut world, floor, Vector::Z * -0.1, false);
    let upper = add(&mut world, ball(), Vector::Z * 0.4, true);
    let pairs = pairs_of(&world, upper);
    assert_eq!(pairs.len(), 1);
    assert!(pairs[0].is_apart(&world, 0.29) && !pairs[0].is_apart(&world, 0.31));
    let mut world = World::default();
    let [first, _] = [0.0, 0.5].map(|x| add(&mut world, ball(), Vector::X * x, true));
    let pairs = pairs_of(&world, first);
    assert_eq!(pairs.len(), 1);
    assert!(pairs[0].is_apart(&world, 0.29) && !pairs[0].is_apart(&world, 0.31));
}

#[test]
fn what_both_may_reach_before_they_are_searched_again_is_near() {
    let mut world = World::default();
    let floor = ColliderBuilder::cuboid(5.0, 5.0, 0.1);
    let floor = add(&mut world, floor, Vector::Z * -0.1, false);
    // Gaps of 0.4 m and of 0.42 m: each of two may move by 0.2 m, and contacts are prepared from 0.01 m on.
    let near = add(&mut world, ball(), Vector::new(0.0, 0.0, 0.5), true);
    let far = add(&mut world, ball(), Vector::new(3.0, 0.0, 0.52), true);
    let colliders = |pairs: Vec<NearPair>| -> Vec<[ColliderHandle; 2]> {
        pairs.into_iter().map(|pair| pair.colliders).collect()
    };
    assert_eq!(colliders(pairs_of(&world, near)), [ordered([floor, near])]);
    assert!(colliders(pairs_of(&world, far)).is_empty());
}

#[test]
fn pairs_that_may_not_touch_are_left_out_and_others_found_once() {
    let mut world = World::default();
    let [first, second] = [0.0, 0.3].map(|x| add(&mut world, ball(), Vector::X * x, true));
    // A part of the first body, and something that nothing touches.
    let body = world.colliders[first].parent().expect("it has a body");
    let part = ball().user_data(tag(1, u16::MAX)).build();
    let part = world
        .colliders
        .insert_with_parent(part, body, &mut world.bodies);
    world.known.add(part, &world.colliders[part], &world.bodies);
    let ghost = world.colliders.insert(ball().user_data(tag(9, 0)).build());
    world
        .known
        .add(ghost, &world.colliders[ghost], &world.bodies);
    let mut surroundings = Surroundings::default();
    let mechanism = [first, part, second];
    surroundings.find(&world, [&mechanism[..]].into_iter());
    let pairs = surroundings.of(0).expect("they are known");
    let found: Vec<_> = pairs.iter().map(|pair| pair.colliders).collect();
    assert_eq!(found, [[first, second], [part, second]].map(ordered));
    surroundings.forget();
    assert!(surroundings.of(0).is_none());
}

#[test]
fn neighbours_are_known_until_a_shape_has_moved_far() {
    let mut world = World::default();
    let handle = add(&mut world, ball(), Vector::ZERO, true);
    let mut surroundings = Surroundings::default();
    surroundings.find(&world, [&[handle][..]].into_iter());
    for (x, expected) in [(0.0, true), (0.19, true), (0.21, false), (-0.19, true)] {
        world.colliders[handle].set_position(EnginePose::from_translation(Vector::X * x));
        assert_eq!(surroundings.cover(&world), expected, "{x}");
    }
}

#[test]
fn among_many_colliders_neighbours_are_not_searched() {
    for (count, expected) in [(MAX_COLLIDERS, true), (MAX_COLLIDERS + 1, false)] {
        let mut world = World::default();
        let handle = add(&mut world, ball(), Vector::ZERO, true);
        for number in 1..count {
            let at = Vector::X * (2.0 * number as f64);
            add(&mut world, ball(), at, false);
        }
        let mut surroundings = Surroundings::default();
        surroundings.find(&world, [&[handle][..]].into_iter());
        assert_eq!(surroundings.are_known(), expected, "{count}");
    }
    // Nine about one shape.
    for (count, expected) in [(MAX_PAIRS, true), (MAX_PAIRS + 1, false)] {
        let mut world = World::default();
        let handle = add(&mut world, ball(), Vector::ZERO, true);
        for _ in 0..count {
            add(&mut world, ball(), Vector::X * 0.2, false);
        }
        let mut surroundings = Surroundings::default();
        surroundings.find(&world, [&[handle][..]].into_iter());
        assert_eq!(surroundings.are_known(), expected, "{count}");
    }
}
