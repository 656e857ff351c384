//! Bodies that turn freely, or fast where they touch something.

use geometry::MassProperties;
use nalgebra::{UnitQuaternion, Vector3};
use scene::sensor::force_sensor::ForceSensor;

use super::*;

/// A body of 2 kg with these moments per kg, and a spin, without gravity.
fn spinning(moments: [f64; 3], spin: [f64; 3]) -> (Bench, Handle) {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let body = bench.ghost([0.0; 3], true);
    bench.change(body, |shape| {
        shape.mass = MassProperties::diagonal(2.0, moments);
        shape.dynamics.initial_velocity.angular = spin;
    });
    (bench, body)
}

/// Angular momentum about its centre of mass, N m s, and rotational energy, J.
fn momentum(bench: &Bench, body: Handle) -> (Vector3<f64>, f64) {
    let shape = bench.shape_of(body);
    let turn = bench.pose(body).rotation;
    let spin = turn.inverse() * Vector3::from(shape.velocity.angular);
    let local = shape.mass.inertia * spin * shape.mass.mass;
    (turn * local, 0.5 * spin.dot(&local))
}

#[test]
fn what_tumbles_keeps_its_angular_momentum_and_its_energy() {
    let moments = [0.02, 0.04, 0.05];
    let (mut bench, body) = spinning(moments, [0.2, 8.0, 0.1]);
    let before = Vector3::new(0.2 * 0.02, 8.0 * 0.04, 0.1 * 0.05) * 2.0;
    let energy = 0.04 * 0.02 + 64.0 * 0.04 + 0.01 * 0.05;
    let mut has_turned_over = false;
    for _ in 0..60 {
        bench.run(1);
        let (now, its_energy) = momentum(&bench, body);
        near((now - before).norm(), 0.0, 1e-4);
        near(its_energy, energy, 1e-4);
        has_turned_over |= (bench.pose(body).rotation * Vector3::y()).y < -0.5;
    }
    // The axis of the moment in the middle is not stable.
    assert!(has_turned_over);
}

/// The axis of a top goes around its angular momentum L at |L| over the moment across the axis.
#[test]
fn a_free_top_precesses_about_its_angular_momentum() {
    let (across, along) = (0.03, 0.05);
    // The second one turns by a fifth of a radian in a sub-step, which is made in parts.
    for (faster, calls, tolerance) in [(1.0, 10, 1e-4), (12.0, 2, 0.02)] {
        let (mut bench, body) =
            spinning([across, across, along], [2.0 * faster, 0.0, 3.0 * faster]);
        let momentum = Vector3::new(2.0 * across, 0.0, 3.0 * along) * faster;
        bench.run(calls);
        let time = STEP * calls as f64;
        let turn = UnitQuaternion::from_scaled_axis(momentum / across * time);
        let expected = turn * Vector3::z();
        let axis = bench.pose(body).rotation * Vector3::z();
        near((axis - expected).norm(), 0.0, tolerance);
    }
}

/// Two bodies tied to each other keep the angular momentum of both, of their spins and about their common centre.
#[test]
fn bodies_that_are_tied_tumble_as_one() {
    let (mut bench, body) = spinning([0.02, 0.04, 0.05], [0.5, 6.0, 0.5]);
    let sensor = Kind::ForceSensor(Box::<ForceSensor>::default());
    let sensor = bench.object(sensor, Pose::translation(0.1, 0.0, 0.0), body);
    let other = bench.ghost([0.2, 0.0, 0.0], true);
    bench.change(other, |shape| {
        shape.mass = MassProperties::diagonal(1.0, [0.01, 0.02, 0.025]);
        shape.dynamics.initial_velocity.angular = [0.5, 6.0, 0.5];
        // Of the point where it is: the spin times the way there.
        shape.dynamics.initial_velocity.linear = [0.0, 0.1, -1.2];
    });
    bench.hang(other, sensor);
    let whole = |bench: &Bench| {
        let of = |handle| {
            let shape = bench.shape_of(handle);
            let place = bench.pose(handle).translation.vector;
            let linear = Vector3::from(shape.velocity.linear) * shape.mass.mass;
            (momentum(bench, handle).0 + place.cross(&linear), linear)
        };
        let [first, second] = [body, other].map(of);
        (first.0 + second.0, first.1 + second.1)
    };
    bench.run(1);
    let (before, push) = whole(&bench);
    near((push - Vector3::new(0.0, 0.1, -1.2)).norm(), 0.0, 1e-6);
    bench.run(20);
    let (after, push) = whole(&bench);
    near((push - Vector3::new(0.0, 0.1, -1.2)).norm(), 0.0, 1e-6);
    let lost = (after - before).norm() / before.norm();
    near(lost, 0.0, 0.02);
}

/// Boxes that spin on a floor without friction: alone, and with so many others that the engine solves their contacts.
#[test]
fn what_spins_on_ice_turns_as_fast_as_it_says() {
    for count in [1, 100] {
        let mut bench = Bench::new();
        let floor = bench.floor();
        let at = |i: u32| [0.5 * f64::from(i % 10), 0.5 * f64::from(i / 10), 0.05];
        let boxes: Vec<Handle> = (0..count)
            .map(|i| bench.shape([0.1; 3], at(i), 1.0, true, true))
            .collect();
        for &shape in boxes.iter().chain([&floor]) {
            bench.change(shape, |shape| shape.material.friction = 0.0);
        }
        for &shape in &boxes {
            bench.change(shape, |shape| {
                shape.dynamics.initial_velocity.angular = [0.0, 0.0, 15.0];
            });
        }
        bench.run(10);
        let body = boxes[count as usize / 2];
        near(bench.shape_of(body).velocity.angular[2], 15.0, 1e-3);
        let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * 15.0 * 0.5);
        near(bench.pose(body).rotation.angle_to(&turn), 0.0, 2e-3);
    }
}
