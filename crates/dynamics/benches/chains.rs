//! The physics of a pendulum and of a chain of seven links alone, as in `benches/compare/restarts.lua`: microseconds of a sub-step of 5 ms
//! while they swing, and of a start with its first step of ten sub-steps. The last number shows whether two builds compute the same.
//!
//!     cargo bench -p swanilda-dynamics --bench chains

use std::time::Instant;

use dynamics::{Dynamics, ScriptAccess, Verdicts};
use geometry::PrimitiveKind;
use nalgebra::{UnitQuaternion, Vector3};
use scene::joint::{Joint, JointMode, JointType};
use scene::shape::Shape;
use scene::{Field, Handle, Kind, Pose, Scene};

#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

/// Of a step, seconds.
const STEP: f64 = 0.05;
/// Of a link, metres.
const LENGTH: f64 = 0.3;
const RUNS: usize = 15;
const STARTS: usize = 400;

fn shape(scene: &mut Scene, size: [f64; 3], z: f64, is_static: bool) -> Handle {
    let mut shape =
        Shape::primitive(PrimitiveKind::Cuboid, size, Default::default()).expect("a cuboid");
    shape.dynamics.is_static = is_static;
    shape.dynamics.respondable = false;
    let handle = scene.add("body", Kind::Shape(Box::new(shape)));
    let handle = handle.expect("room");
    scene
        .set_world_pose(handle, Pose::translation(0.0, 0.0, z))
        .expect("exists");
    handle
}

/// Links one above the other, which fall to the side of their own accord.
fn chain(links: usize) -> (Scene, Handle) {
    let mut scene = Scene::new();
    let mut parent = shape(&mut scene, [0.1; 3], 0.0, true);
    for i in 1..=links {
        let joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        let joint = scene.add("joint", Kind::Joint(Box::new(joint)));
        let joint = joint.expect("room");
        let along_y = UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
        let at = Pose::from_parts(
            Vector3::new(0.0, 0.0, LENGTH * (i as f64 - 0.5)).into(),
            along_y,
        );
        scene.set_world_pose(joint, at).expect("exists");
        let link = shape(&mut scene, [0.05, 0.05, LENGTH], LENGTH * i as f64, false);
        for (child, parent) in [(joint, parent), (link, joint)] {
            scene
                .set_parent(child, Some(parent), true)
                .expect("no circle");
        }
        parent = link;
    }
    let tilt = scene.try_modify(parent, Field::Dynamics, |object| {
        object.shape_mut()?.dynamics.initial_velocity.linear = [0.3, 0.0, 0.0];
        Ok(())
    });
    tilt.expect("a shape");
    (scene, parent)
}

fn step(dynamics: &mut Dynamics, scene: &mut Scene) -> u32 {
    let begun = dynamics.begin(scene, STEP).expect("not busy");
    let call = begun.expect("bodies that move");
    for number in 1..=call.sub_steps {
        dynamics.prepare(scene, number);
        let (access, verdicts) = (ScriptAccess::default(), Verdicts::default());
        let started = dynamics.start_sub_step(scene, number, access, verdicts);
        let mut sub_step = started.expect("a world");
        sub_step.run(None);
        dynamics.finish_sub_step(sub_step, scene);
    }
    dynamics.end(scene);
    call.sub_steps
}

/// Microseconds of a sub-step and of a start, and the bits of where the tip is at last.
#[allow(clippy::disallowed_methods, reason = "how long it takes is the result")]
fn measure(links: usize) -> (f64, f64, u64) {
    let (mut of_step, mut of_start, mut bits) = (f64::INFINITY, f64::INFINITY, 0);
    for _ in 0..RUNS {
        let (mut scene, tip) = chain(links);
        let mut dynamics = Dynamics::default();
        step(&mut dynamics, &mut scene);
        let (began, mut sub_steps) = (Instant::now(), 0);
        for _ in 0..200 {
            sub_steps += step(&mut dynamics, &mut scene);
        }
        of_step = of_step.min(1e6 * began.elapsed().as_secs_f64() / f64::from(sub_steps));
        let began = Instant::now();
        for _ in 0..STARTS {
            dynamics.reset();
            step(&mut dynamics, &mut scene);
        }
        of_start = of_start.min(1e6 * began.elapsed().as_secs_f64() / STARTS as f64);
        let place = scene.world_pose(tip).expect("exists").translation.vector;
        bits = place
            .iter()
            .fold(0, |bits: u64, x| bits.rotate_left(21) ^ x.to_bits());
    }
    (of_step, of_start, bits)
}

fn main() {
    for links in [1, 7] {
        let (of_step, of_start, bits) = measure(links);
        println!(
            "{links} links: {of_step:.3} us a sub-step, {of_start:.2} us a start with a step; {bits:016x}"
        );
    }
}
