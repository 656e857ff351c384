//! Ropes among bodies and mechanisms.

use super::super::*;
use scene::appearance::colour::Colour;
use scene::shape::soft::rope::Rope;
use scene::shape::soft::{Pin, Soft};
use scene::shape::{Appearance, Material, Shape};

/// A rope of 100 g/m through points of the world.
fn rope(points: Vec<[f64; 3]>) -> Rope {
    Rope {
        radius: 0.004,
        line_density: 0.1,
        stretch: 1e5,
        bend: 1e-5,
        twist: 1e-5,
        damping: 1e-3,
        drag: 1.0,
        strength: f64::INFINITY,
        length: 0.0,
        straight: true,
        touches_itself: false,
        points,
    }
}

fn line(from: [f64; 3], to: [f64; 3], edges: usize) -> Vec<[f64; 3]> {
    let at = |i: usize, axis: usize| from[axis] + (to[axis] - from[axis]) * i as f64 / edges as f64;
    (0..=edges)
        .map(|i| [0, 1, 2].map(|axis| at(i, axis)))
        .collect()
}

pub(super) fn pin(point: usize, holder: Option<Handle>, place: [f64; 3]) -> Pin {
    Pin {
        point,
        holder,
        place,
        clamped: false,
    }
}

impl Bench {
    fn rope(&mut self, rope: &Rope, pins: &[Pin]) -> Handle {
        let appearance = Appearance::new([0.5; 3]);
        assert_eq!(appearance.colour, Colour::new([0.5; 3]));
        let mut shape = Shape::of_soft(&Soft::Rope(rope.clone()), appearance).expect("a rope");
        shape.material = Material::of_friction(1.0);
        let handle = self
            .scene
            .add("rope", Kind::Shape(Box::new(shape)))
            .expect("room");
        self.scene
            .set_soft(handle, &Soft::Rope(rope.clone()))
            .expect("exists");
        self.scene.set_pins(handle, pins).expect("exists");
        handle
    }

    fn point(&self, rope: Handle, point: usize) -> [f64; 3] {
        self.scene.soft_form(rope).expect("a rope").points[point]
    }

    fn tension(&self, rope: Handle, edge: usize) -> f64 {
        self.scene.soft_form(rope).expect("a rope").tensions[edge]
    }
}

#[test]
fn a_rope_hangs_from_the_world_and_bears_a_box() {
    let mut bench = Bench::new();
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.45], 2.0, true, true);
    let points = line([0.0, 0.0, 1.0], [0.0, 0.0, 0.5], 20);
    let pins = [
        pin(0, None, [0.0, 0.0, 1.0]),
        pin(20, Some(body), [0.0, 0.0, 0.05]),
    ];
    let rope = bench.rope(&rope(points), &pins);
    bench.run(100);
    near(bench.tension(rope, 19), 2.0 * 9.81, 0.05);
    near(bench.tension(rope, 0), 2.05 * 9.81, 0.05);
    near(bench.height(body), 0.45, 1e-3);
    let form = bench.scene.soft_form(rope).expect("a rope");
    near(form.pin_forces[0][2], 2.05 * 9.81, 0.05);
    near(form.pin_forces[1][2], -2.0 * 9.81, 0.05);
}

#[test]
fn an_arm_that_is_held_by_its_motor_bears_a_rope() {
    let mut bench = Bench::new();
    let (joint, link) = bench.arm(0.02, 0.25, |joint| {
        joint.set_control(Control::Velocity);
        (joint.target_velocity, joint.target_force) = (0.0, 100.0);
    });
    let points = line([0.5, 0.0, 1.0], [0.5, 0.0, 0.4], 20);
    let rope = bench.rope(&rope(points), &[pin(0, Some(link), [0.25, 0.0, 0.0])]);
    bench.run(100);
    // An arm of 1 kg with its centre at 0.25 m, and 60 g of rope at 0.5 m.
    let torque = bench.joint(joint).force.expect("it was measured");
    near(torque.abs(), 9.81 * (0.25 + 0.06 * 0.5), 0.01);
    near(bench.point(rope, 0)[2], 1.0, 1e-4);
    near(bench.tension(rope, 0), 0.06 * 9.81, 0.02);
}

#[test]
fn a_rope_that_falls_on_a_box_rests_there_and_presses() {
    let mut bench = Bench::new();
    bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    let rope = bench.rope(&rope(line([-0.2, 0.0, 0.2], [0.2, 0.0, 0.2], 24)), &[]);
    bench.run(60);
    near(bench.height(body), 0.05, 1e-4);
    near(bench.point(rope, 12)[2], 0.104, 1e-3);
    assert!(bench.point(rope, 0)[2] < 0.1);
    let resting = bench.point(rope, 12);
    bench.run(60);
    let now = bench.point(rope, 12);
    for axis in 0..3 {
        near(now[axis], resting[axis], 1e-4);
    }
}

#[test]
fn a_rope_goes_along_with_what_a_script_moves() {
    let mut bench = Bench::new();
    let holder = bench.shape([0.1; 3], [0.0, 0.0, 1.0], 1.0, false, false);
    let rope = bench.rope(
        &rope(line([0.0, 0.0, 1.0], [0.0, 0.0, 0.5], 10)),
        &[pin(0, Some(holder), [0.0; 3])],
    );
    for i in 1..=20 {
        let pose = Pose::translation(0.02 * f64::from(i), 0.0, 1.0);
        bench.scene.set_world_pose(holder, pose).expect("exists");
        bench.run(1);
        near(bench.point(rope, 0)[0], 0.02 * f64::from(i), 1e-6);
    }
    assert!(bench.point(rope, 10)[0] > 0.2);
}

#[test]
fn a_rope_that_is_let_go_falls_and_is_back_after_the_run() {
    let mut bench = Bench::new();
    let rope = bench.rope(
        &rope(line([0.0, 0.0, 1.0], [0.5, 0.0, 1.0], 10)),
        &[pin(0, None, [0.0, 0.0, 1.0])],
    );
    bench.scene.store_initial_state();
    bench.run(4);
    near(bench.point(rope, 0)[2], 1.0, 1e-6);
    bench.scene.set_pins(rope, &[]).expect("exists");
    bench.run(10);
    assert!(bench.point(rope, 0)[2] < 0.5);
    let mesh = |bench: &Bench| {
        bench.scene.object(rope).unwrap().shape().unwrap().parts[0]
            .mesh
            .clone()
    };
    let lowest = |bench: &Bench| {
        mesh(bench)
            .vertices
            .iter()
            .map(|v| v[2])
            .fold(9.0, f64::min)
    };
    assert!(lowest(&bench) < 0.5);
    bench.scene.restore_initial_state();
    near(bench.point(rope, 0)[2], 1.0, 1e-12);
    near(lowest(&bench), 0.996, 1e-6);
}

#[test]
fn ropes_make_no_new_plan() {
    let mut bench = Bench::new();
    bench.rope(
        &rope(line([0.0, 0.0, 1.0], [0.5, 0.0, 1.0], 10)),
        &[pin(0, None, [0.0, 0.0, 1.0])],
    );
    bench.run(2);
    assert!(!bench.dynamics.has_new_changes(&bench.scene));
}

#[test]
fn a_cable_that_is_clamped_in_a_body_bends_like_a_beam() {
    let mut bench = Bench::new();
    let holder = bench.shape([0.1; 3], [0.0, 0.0, 1.0], 1.0, false, true);
    let cable = Rope {
        bend: 0.5,
        twist: 0.5,
        drag: 5.0,
        ..rope(line([-0.02, 0.0, 1.0], [0.4, 0.0, 1.0], 21))
    };
    let clamped = Pin {
        clamped: true,
        ..pin(0, Some(holder), [-0.02, 0.0, 0.0])
    };
    let cable = bench.rope(&cable, &[clamped]);
    bench.run(60);
    // Under its own weight: q L^4 / 8 EI.
    let sag = 0.1 * 9.81 * 0.4_f64.powi(4) / (8.0 * 0.5);
    near(bench.point(cable, 21)[2], 1.0 - sag, 0.02 * sag);
}

#[test]
fn the_number_of_threads_does_not_count() {
    let once = |threads: usize| {
        let mut bench = Bench::new();
        bench.dynamics = Dynamics::new(threads.try_into().expect("not none"), FormMaker::default());
        bench.floor();
        let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
        let rope = bench.rope(
            &rope(line([-0.2, 0.0, 0.2], [0.2, 0.0, 0.2], 24)),
            &[pin(0, Some(body), [0.0, 0.0, 0.1])],
        );
        bench.run(20);
        bench.scene.soft_form(rope).expect("a rope").points
    };
    assert_eq!(once(1), once(4));
}
