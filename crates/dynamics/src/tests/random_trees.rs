//! Mechanisms nobody would build: masses over six decades, inertias at the edge of what a body can have, all joints and modes. None explodes.

use geometry::MassProperties;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use scene::joint::{Control, JointType};
use scene::sensor::force_sensor::ForceSensor;
use scene::{Field, Kind, Pose};
use test_support::random::Random;

use super::super::*;
use super::bench::Bench;

const MECHANISMS: u64 = 150;
const STEPS: usize = 30;
/// Relative gain of energy: light links that whirl about heavy ones gain and lose some, what explodes gains thousands.
const MAX_GAIN: f64 = 20.0;

/// Moments of a body (per unit of mass), one of which may be nearly the sum of the others.
fn inertia(random: &mut Random, size: f64) -> Matrix3<f64> {
    let [a, b] = [random.unit(), random.unit()].map(|x| size * size * (0.01 + x));
    let edge = [1e-6, 0.1, 0.9][random.below(3)];
    let c = (a - b).abs() + (2.0 * a.min(b)) * (1.0 - edge);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from(random.vector()) * 3.0);
    let axes = turn.to_rotation_matrix();
    axes.matrix() * Matrix3::from_diagonal(&Vector3::new(a, b, c)) * axes.matrix().transpose()
}

fn body(bench: &mut Bench, random: &mut Random, at: [f64; 3], is_fixed: bool) -> Handle {
    let mass = 10.0_f64.powf(random.unit() * 6.0 - 4.0);
    let handle = bench.shape([0.1; 3], at, mass, !is_fixed, false);
    let size = 0.02 + random.unit() * 0.1;
    let tensor = inertia(random, size);
    let (linear, angular) = (random.vector(), random.vector().map(|x| x * 5.0));
    bench
        .scene
        .try_modify(handle, Field::Dynamics, |object| {
            let shape = object.shape_mut()?;
            shape.mass = MassProperties {
                inertia: tensor,
                ..MassProperties::diagonal(mass, [1.0; 3])
            };
            shape.dynamics.initial_velocity.linear = linear;
            shape.dynamics.initial_velocity.angular = angular;
            Ok(())
        })
        .expect("a shape");
    handle
}

fn link(bench: &mut Bench, random: &mut Random, at: [f64; 3], parent: Handle) -> Handle {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from(random.vector()) * 3.0);
    let pose = Pose::from_parts(at.into(), turn);
    if random.below(4) == 0 {
        return bench.object(
            Kind::ForceSensor(Box::<ForceSensor>::default()),
            pose,
            parent,
        );
    }
    let kind = [
        JointType::Revolute,
        JointType::Prismatic,
        JointType::Spherical,
    ][random.below(3)];
    let mut joint = Joint::new(kind, JointMode::Dynamic);
    // A brake, not one that follows a profile, which may push.
    joint.velocity_profile = false;
    joint.motor_lock = random.below(2) == 0;
    if kind != JointType::Spherical {
        (joint.control, joint.target_force) = match random.below(3) {
            0 => (Control::Free, 0.0),
            // Holds still, with as much force as it takes, or with little.
            1 => (Control::Velocity, 1e6),
            _ => (Control::Velocity, 1e-3),
        };
    }
    bench.object(Kind::Joint(Box::new(joint)), pose, parent)
}

fn kinetic_energy(bench: &Bench, bodies: &[Handle]) -> f64 {
    let of = |&handle: &Handle| {
        let object = bench.scene.object(handle).expect("exists");
        let shape = object.shape().expect("a shape");
        let turn = bench.scene.world_pose(handle).expect("exists").rotation;
        let spin = turn.inverse() * Vector3::from(shape.velocity.angular);
        let speed = Vector3::from(shape.velocity.linear);
        shape.mass.mass * (speed.dot(&speed) + spin.dot(&(shape.mass.inertia * spin))) / 2.0
    };
    bodies.iter().map(of).sum()
}

fn gain(seed: u64) -> f64 {
    let (mut bench, mut random) = (Bench::new(), Random::new(seed));
    bench.gravity(0.0);
    let is_fixed = random.below(2) == 0;
    let mut bodies = vec![body(&mut bench, &mut random, [0.0, 0.0, 1.0], is_fixed)];
    for _ in 0..1 + random.below(6) {
        let parent = bodies[random.below(bodies.len())];
        let from = bench.scene.world_pose(parent).expect("exists").translation;
        let way = random.vector().map(|x| x * 0.2);
        let [middle, end] =
            [0.5, 1.0].map(|share| [0, 1, 2].map(|axis| from.vector[axis] + way[axis] * share));
        let joint = link(&mut bench, &mut random, middle, parent);
        let child = body(&mut bench, &mut random, end, false);
        bench.hang(child, joint);
        bodies.push(child);
    }
    bodies.drain(..usize::from(is_fixed));
    bench.run(1);
    let before = kinetic_energy(&bench, &bodies);
    let mut largest = before;
    for _ in 0..STEPS {
        bench.run(1);
        let now = kinetic_energy(&bench, &bodies);
        largest = if now.is_finite() {
            largest.max(now)
        } else {
            f64::INFINITY
        };
    }
    largest / before.max(1e-9) - 1.0
}

#[test]
fn no_mechanism_explodes() {
    let gains: Vec<(u64, f64)> = (0..MECHANISMS).map(|seed| (seed, gain(seed))).collect();
    let wild: Vec<_> = gains.iter().filter(|(_, gain)| *gain > MAX_GAIN).collect();
    assert!(wild.is_empty(), "{wild:?}");
}
