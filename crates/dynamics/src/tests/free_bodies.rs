//! Bodies that touch nothing: forces, drag, and rotations have closed forms.

use nalgebra::{UnitQuaternion, Vector3};
use scene::shape::Velocity;
use scene::{Data, Edit, Object};

use super::*;
use geometry::MassProperties;

/// A body in a scene without gravity. Mass in kg, moments per kg.
fn adrift(mass: f64, moments: [f64; 3], velocity: Velocity) -> (Bench, Handle) {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let body = bench.ghost([1.0, 2.0, 3.0], true);
    bench.change(body, |shape| {
        shape.mass = MassProperties::diagonal(mass, moments);
        shape.dynamics.initial_velocity = velocity;
    });
    (bench, body)
}

fn moving(linear: [f64; 3], angular: [f64; 3]) -> Velocity {
    Velocity { linear, angular }
}

#[test]
fn a_force_acts_for_one_call() {
    let (mut bench, body) = adrift(2.0, [0.02, 0.04, 0.05], Velocity::default());
    bench.change(body, |shape| {
        (shape.force, shape.torque) = ([10.0, 0.0, 0.0], [0.0, 0.8, 0.0]);
    });
    bench.run(1);
    // The specification's case: 0.25 m/s after a step, and 6.875 mm.
    near(bench.at(body)[0], 1.006_875, 1e-9);
    for _ in 0..2 {
        let velocity = bench.shape_of(body).velocity;
        near(velocity.linear[0], 0.25, 1e-12);
        near(velocity.angular[1], 0.8 / (2.0 * 0.04) * STEP, 1e-9);
        bench.run(1);
    }
}

#[test]
fn forces_that_are_no_numbers_do_nothing() {
    let (mut bench, body) = adrift(1.0, [0.01; 3], Velocity::default());
    bench.change(body, |shape| {
        (shape.force, shape.torque) = ([1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]);
    });
    bench.run(1);
    assert_eq!(bench.at(body), [1.0, 2.0, 3.0]);
}

/// Damping takes so large a part of the velocity in a second.
#[test]
fn damping_slows_down() {
    let (mut bench, body) = adrift(1.0, [0.01; 3], moving([2.0, 0.0, 0.0], [0.0, 0.0, 3.0]));
    bench.change(body, |shape| {
        (
            shape.material.linear_damping,
            shape.material.angular_damping,
        ) = (0.3, 0.6);
    });
    bench.run(20);
    let velocity = bench.shape_of(body).velocity;
    near(velocity.linear[0], 2.0 * (-0.3f64).exp(), 2e-3);
    near(velocity.angular[2], 3.0 * (-0.6f64).exp(), 5e-3);
}

fn in_fluid(bench: &mut Bench, body: Handle, fluid: &str) {
    let poured = bench
        .scene
        .modify(body, Field::Dynamics, |object: &mut Object| {
            let fluid = Data::from(fluid.to_owned());
            object
                .custom_data
                .edit(Edit::Tag(scene::shape::FLUID, Some(fluid)));
        });
    poured.expect("exists");
}

/// A cube of 0.2 m, 1 kg: `3 pi d viscosity` per speed, `pi d³ viscosity` per angular speed.
#[test]
fn a_viscous_fluid_slows_a_cube_down_exponentially() {
    let moment = 0.04 / 6.0;
    let (mut bench, body) = adrift(1.0, [moment; 3], moving([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]));
    in_fluid(&mut bench, body, "viscosity=0.2");
    bench.run(20);
    let velocity = bench.shape_of(body).velocity;
    let rates = [3.0 * 0.2 * 0.2, 0.008 * 0.2 / moment].map(|rate| rate * std::f64::consts::PI);
    near(velocity.linear[0], (-rates[0]).exp(), 2e-3);
    near(velocity.angular[1], 2.0 * (-rates[1]).exp(), 5e-3);
}

/// With drag `density A v²/2` the speed after a time is `v / (1 + density A v time / 2 m)`. The box, 0.1 m by 0.2 m by 0.3 m, lies on its side.
#[test]
fn a_dense_fluid_slows_a_box_down_by_the_area_across() {
    let [x, y, z] = [0.1, 0.2, 0.3f64].map(|edge| edge * edge / 12.0);
    let (mut bench, body) = adrift(
        2.0,
        [y + z, x + z, x + y],
        moving([0.0, 4.0, 0.0], [0.0; 3]),
    );
    let side = UnitQuaternion::from_euler_angles(0.0, 0.0, std::f64::consts::FRAC_PI_2);
    let pose = Pose::from_parts(bench.pose(body).translation, side);
    bench.scene.set_world_pose(body, pose).expect("exists");
    in_fluid(&mut bench, body, "density=20");
    bench.run(20);
    // The way of the world's y is that of the box's x, across which it is 0.2 m by 0.3 m.
    let rate = 20.0 * 0.06 * 4.0 / (2.0 * 2.0);
    near(
        bench.shape_of(body).velocity.linear[1],
        4.0 / (1.0 + rate),
        0.01,
    );
}

#[test]
fn a_cube_turns_as_fast_as_it_says_about_its_centre_of_mass() {
    let spin = [0.0, 0.0, 20.0];
    let (mut bench, body) = adrift(1.0, [0.01; 3], moving([0.5, 0.0, 0.0], spin));
    bench.change(body, |shape| shape.mass.com = [0.1, 0.0, 0.2]);
    let com = |bench: &Bench| bench.pose(body) * nalgebra::Point3::new(0.1, 0.0, 0.2);
    let start = com(&bench);
    bench.run(20);
    let turned = bench.pose(body).rotation;
    let expected = UnitQuaternion::from_scaled_axis(Vector3::from(spin));
    near(turned.angle_to(&expected), 0.0, 1e-6);
    let way = com(&bench) - start;
    near((way - Vector3::new(0.5, 0.0, 0.0)).norm(), 0.0, 1e-6);
}

#[test]
fn bodies_far_away_and_what_hangs_on_them_are_out_of_service() {
    let (mut bench, near_by) = adrift(1.0, [0.01; 3], Velocity::default());
    bench.gravity(-9.81);
    let far = bench.ghost([0.0, 0.0, 2000.0], true);
    let below = bench.ghost([0.0, 0.0, 3.0], true);
    bench.hang(below, far);
    bench.run(1);
    let drop = 0.013_488_75;
    near(bench.height(near_by), 3.0 - drop, 1e-6);
    assert_eq!([far, below].map(|shape| bench.height(shape)), [2000.0, 3.0]);
    assert!(!bench.dynamics.simulates(far) && bench.dynamics.simulates(near_by));
    let near_pose = Pose::translation(0.0, 0.0, 5.0);
    bench.scene.set_world_pose(far, near_pose).expect("exists");
    bench.run(1);
    near(bench.height(far), 5.0 - drop, 1e-6);
}

#[test]
fn a_body_whose_motion_runs_out_of_numbers_is_stopped_until_it_is_moved() {
    let (mut bench, body) = adrift(1.0, [0.01; 3], Velocity::default());
    let other = bench.ghost([5.0, 0.0, 0.0], true);
    bench.change(other, |shape| {
        shape.dynamics.initial_velocity.linear[0] = 1.0;
    });
    bench.change(body, |shape| shape.force = [1e308, 0.0, 0.0]);
    bench.run(2);
    assert_eq!(bench.dynamics.take_frozen(), [body]);
    assert!(bench.dynamics.take_frozen().is_empty());
    let place = bench.at(body);
    assert!(place.iter().all(|x| x.is_finite()), "{place:?}");
    near(bench.at(other)[0], 5.1, 1e-9);
    bench.gravity(-9.81);
    bench.run(1);
    assert_eq!(bench.at(body), place);
    let moved = bench
        .scene
        .set_world_pose(body, Pose::translation(0.0, 0.0, 1.0));
    moved.expect("exists");
    bench.run(1);
    assert!(bench.height(body) < 0.99, "{}", bench.height(body));
}

#[test]
fn nothing_moves_in_no_time_or_without_physics() {
    let (mut bench, body) = adrift(1.0, [0.01; 3], moving([1.0, 0.0, 0.0], [0.0; 3]));
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let call = bench.dynamics.begin(&mut bench.scene, time);
        assert_eq!(call, Ok(None), "{time}");
    }
    bench
        .scene
        .modify_settings(|settings| settings.dynamics.enabled = false);
    bench.run(1);
    assert_eq!(bench.at(body), [1.0, 2.0, 3.0]);
    bench
        .scene
        .modify_settings(|settings| settings.dynamics.enabled = true);
    let call = bench.dynamics.begin(&mut bench.scene, 0.02);
    let expected = DynamicsCall {
        sub_steps: 4,
        step: 0.005,
    };
    assert_eq!(call, Ok(Some(expected)));
}
