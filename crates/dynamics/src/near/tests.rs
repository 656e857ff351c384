//! How far bodies go, and what is in their way.

use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder};

use super::*;

const STEP: f64 = 0.01;
const GRAVITY: Vector = Vector::new(0.0, 0.0, -9.81);

/// A world under gravity with a ball of 0.1 m at height 1, and its colliders.
fn with_ball(rigid: RigidBodyBuilder) -> (World, ColliderHandle) {
    let mut world = World::default();
    let rigid = rigid.translation(Vector::Z).build();
    let body = world.bodies.insert(rigid);
    let ball = ColliderBuilder::ball(0.1).build();
    let ball = world
        .colliders
        .insert_with_parent(ball, body, &mut world.bodies);
    (world, ball)
}

/// Makes a step of no matter, after which gravity and the extents of bodies are known, and gives the ball a velocity.
fn moving(world: &mut World, ball: ColliderHandle, linear: Vector, angular: Vector) {
    world.step(1e-9, GRAVITY, &());
    let body = world.colliders[ball].parent().expect("it has a body");
    let rigid = &mut world.bodies[body];
    rigid.set_linvel(linear, true);
    rigid.set_angvel(angular, true);
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn a_body_goes_as_far_as_it_moves_turns_and_falls() {
    let (mut world, ball) = with_ball(RigidBodyBuilder::dynamic());
    let spin = Vector::new(0.0, 0.0, 4.0);
    moving(&mut world, ball, Vector::new(1.0, 2.0, 2.0), spin);
    let collider = &world.colliders[ball];
    let way = world.way(collider, STEP);
    near(way, (3.0 + 4.0 * 0.1 + 9.81 * STEP) * STEP);
    // Of a point beside the axis.
    let point = Vector::new(0.1, 0.0, 1.0);
    let of_point = world.way_of_point(collider, point, STEP);
    let expected = Vector::new(1.0, 2.0 + 0.4, 2.0 - 9.81 * STEP) * STEP;
    near((of_point - expected).length(), 0.0);
}

#[test]
fn what_no_force_moves_does_not_fall() {
    let spin = Vector::new(0.0, 0.0, 4.0);
    let kinematic = RigidBodyBuilder::kinematic_velocity_based();
    let (mut world, ball) = with_ball(kinematic);
    moving(&mut world, ball, Vector::X, spin);
    let collider = &world.colliders[ball];
    let way = world.way_of_point(collider, Vector::Z, STEP);
    near((way - Vector::X * STEP).length(), 0.0);
    let (mut world, ball) = with_ball(RigidBodyBuilder::fixed());
    moving(&mut world, ball, Vector::ZERO, Vector::ZERO);
    near(world.way(&world.colliders[ball], STEP), 0.0);
}

#[test]
fn what_is_in_the_way_of_a_fast_body_is_found() {
    let (mut world, ball) = with_ball(RigidBodyBuilder::dynamic());
    let post = |x: f64| {
        let post = ColliderBuilder::cuboid(0.1, 0.1, 0.1);
        post.translation(Vector::new(x, 0.0, 1.0)).build()
    };
    let [ahead, beyond, behind] = [1.0, 3.0, -1.0].map(|x| world.colliders.insert(post(x)));
    // Two metres in a sub-step.
    moving(&mut world, ball, Vector::X * 200.0, Vector::ZERO);
    assert_eq!(world.ahead(ball, STEP), [ordered([ball, ahead])]);
    moving(&mut world, ball, Vector::X * -200.0, Vector::ZERO);
    assert_eq!(world.ahead(ball, STEP), [ordered([ball, behind])]);
    moving(&mut world, ball, Vector::X * 400.0, Vector::ZERO);
    let pairs = [ahead, beyond].map(|post| ordered([ball, post]));
    assert_eq!(world.ahead(ball, STEP), pairs);
    // Slow bodies meet what the engine knows beforehand.
    moving(&mut world, ball, Vector::X * 0.1, Vector::ZERO);
    assert!(world.ahead(ball, STEP).is_empty());
}

#[test]
fn queries_find_what_is_there_after_each_detection_of_collisions() {
    let (mut world, ball) = with_ball(RigidBodyBuilder::dynamic());
    let post = ColliderBuilder::cuboid(0.1, 0.1, 0.1).translation(Vector::new(1.0, 0.0, 1.0));
    world.colliders.insert(post.build());
    moving(&mut world, ball, Vector::X * 200.0, Vector::ZERO);
    let body = world.colliders[ball].parent().expect("it has a body");
    for number in 0..40 {
        // Moved by something else than rapier, as mechanisms are.
        let place = Vector::new(0.01 * f64::from(number), 0.0, 1.0);
        world.bodies[body].set_translation(place, true);
        world.detect_collisions(GRAVITY, &());
        assert_eq!(world.ahead(ball, STEP).len(), 1, "after {number} moves");
    }
}

#[test]
fn a_pair_is_woken_as_far_as_it_sleeps() {
    let (mut world, ball) = with_ball(RigidBodyBuilder::dynamic());
    world.step(1e-9, GRAVITY, &());
    let body = world.colliders[ball].parent().expect("it has a body");
    let post = world.colliders.insert(ColliderBuilder::ball(0.1).build());
    world.bodies[body].sleep();
    let pair = (ball.into_raw_parts().0, post.into_raw_parts().0);
    assert!(world.bodies[body].is_sleeping());
    world.wake_pair(pair);
    assert!(!world.bodies[body].is_sleeping());
}
