//! Surfaces: friction, restitution, belts, seams, fast bodies, and where contacts are.

use super::*;
use scene::shape::{Material, RespondableMask};

/// A box on a floor, under a gravity that pulls along x as well, m/s2.
fn slope(pull: f32, frictions: [f64; 2]) -> (Bench, Handle) {
    let mut bench = Bench::new();
    bench
        .scene
        .modify_settings(|settings| settings.dynamics.gravity = [pull, 0.0, -9.81]);
    let floor = bench.floor();
    let body = bench.shape([0.2, 0.2, 0.05], [0.0, 0.0, 0.025], 1.0, true, true);
    for (shape, friction) in [(floor, frictions[0]), (body, frictions[1])] {
        bench.change(shape, |shape| {
            shape.material = Material::of_friction(friction);
        });
    }
    (bench, body)
}

#[test]
fn friction_holds_up_to_its_cone_and_slows_beyond() {
    let (mut bench, body) = slope(2.5, [0.3, 0.3]);
    bench.run(20);
    near(bench.at(body)[0], 0.0, 1e-3);
    let (mut bench, body) = slope(5.0, [0.3, 0.3]);
    bench.run(20);
    near(bench.at(body)[0], (5.0 - 0.3 * 9.81) / 2.0, 0.02);
}

/// Frictions are multiplied, with MuJoCo the larger one counts. A material of its own friction 0.4 has the root of it.
#[test]
fn frictions_of_two_materials_are_combined_as_the_engine_does() {
    let (mut bench, body) = slope(5.0, [0.4, 0.1]);
    bench.run(20);
    near(bench.at(body)[0], (5.0 - 0.2 * 9.81) / 2.0, 0.02);
    let (mut bench, body) = slope(5.0, [0.4, 0.1]);
    bench.scene.modify_settings(|settings| {
        settings.dynamics.engine.engine = scene::parameters::engine::Engine::Mujoco;
    });
    bench.run(20);
    near(bench.at(body)[0], (5.0 - 0.4 * 9.81) / 2.0, 0.02);
}

/// How high a ball rises again that falls from 0.5 m; metres.
fn height_of_bounce(restitutions: [f64; 2], callback: Option<ContactCallback<'_>>) -> f64 {
    let mut bench = Bench::new();
    let floor = bench.floor();
    let ball = bench.shape([0.1; 3], [0.0, 0.0, 0.55], 1.0, true, true);
    for (shape, restitution) in [(floor, restitutions[0]), (ball, restitutions[1])] {
        bench.change(shape, |shape| shape.material.restitution = restitution);
    }
    // It falls for 0.32 s and rises for as long at most.
    bench.run_asking(7, callback);
    let mut highest: f64 = 0.0;
    for _ in 0..8 {
        bench.run_asking(1, callback);
        highest = highest.max(bench.height(ball) - 0.05);
    }
    highest
}

#[test]
fn bodies_bounce_by_the_product_of_their_restitutions() {
    near(height_of_bounce([1.0, 0.8], None), 0.32, 0.02);
    near(height_of_bounce([0.7, 0.7], None), 0.12, 0.02);
    near(height_of_bounce([0.0, 1.0], None), 0.0, 1e-3);
}

#[test]
fn a_script_decides_how_two_bodies_bounce_and_slide() {
    let bouncy = ContactResponse::Collide {
        friction: 0.5,
        restitution: 0.8,
    };
    near(
        height_of_bounce([0.0, 0.0], Some(&|_, _| bouncy)),
        0.32,
        0.02,
    );
    let slippery = ContactResponse::Collide {
        friction: 0.1,
        restitution: 0.0,
    };
    let (mut bench, body) = slope(2.0, [0.5, 0.5]);
    bench.run_asking(20, Some(&|_, _| slippery));
    near(bench.at(body)[0], (2.0 - 0.981) / 2.0, 0.02);
}

#[test]
fn a_belt_carries_at_the_speed_of_its_surface() {
    let (mut bench, body) = slope(0.0, [0.5, 0.5]);
    let belt = bench.scene.objects().next().expect("the floor").handle();
    bench.change(belt, |shape| {
        shape.dynamics.initial_velocity.linear[1] = 0.4;
    });
    bench.run(20);
    let before = bench.at(body)[1];
    bench.run(20);
    near(bench.at(body)[1] - before, 0.4, 1e-3);
    // The belt itself stays where it is.
    near(bench.at(belt)[1], 0.0, 1e-12);
    let stopped = bench.scene.modify(belt, Field::Dynamics, |object| {
        object.dynamics_reset = true;
    });
    stopped.expect("exists");
    bench.run(10);
    let before = bench.at(body)[1];
    bench.run(10);
    near(bench.at(body)[1], before, 1e-4);
}

#[test]
fn a_turntable_carries_around() {
    let mut bench = Bench::new();
    let table = bench.shape([2.0, 2.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
    let body = bench.shape([0.1, 0.1, 0.02], [0.5, 0.0, 0.01], 1.0, true, true);
    bench.change(table, |shape| {
        shape.dynamics.initial_velocity.angular[2] = 0.8;
    });
    bench.run(40);
    let [x, y, _] = bench.at(body);
    near(x.hypot(y), 0.5, 0.01);
    near(y.atan2(x), 1.6, 0.08);
}

#[test]
fn masks_decide_what_falls_through() {
    // Masks of the floor and of the box, whether they are of one tree, whether they touch.
    let cases = [
        (0xff01, 0xff02, true, false),
        (0xff01, 0xff03, true, true),
        (0xff01, 0xff02, false, true),
        (0x00ff, 0xffff, false, false),
    ];
    for (floor_mask, body_mask, one_tree, touch) in cases {
        let mut bench = Bench::new();
        let floor = bench.floor();
        let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
        for (shape, mask) in [(floor, floor_mask), (body, body_mask)] {
            bench.change(shape, |shape| {
                shape.dynamics.respondable_mask = RespondableMask(mask);
            });
        }
        if one_tree {
            bench.hang(body, floor);
        }
        bench.run(4);
        let expected = if touch { 0.05 } else { 0.05 - 0.2011 };
        near(bench.height(body), expected, 2e-3);
    }
}

#[test]
fn a_fast_body_does_not_pass_through_a_thin_wall() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    bench.shape([0.01, 2.0, 2.0], [1.0, 0.0, 0.0], 1.0, false, true);
    let bullet = bench.shape([0.02; 3], [0.0, 0.0, 0.0], 0.1, true, true);
    bench.change(bullet, |shape| {
        shape.dynamics.initial_velocity.linear = [300.0, 0.0, 0.0];
    });
    bench.run(2);
    assert!(bench.at(bullet)[0] < 1.0, "{:?}", bench.at(bullet));
}

#[test]
fn a_seam_between_tiles_stops_nothing() {
    let mut bench = Bench::new();
    let tiles =
        [-0.5, 0.5, 1.5].map(|x| bench.shape([1.0, 1.0, 0.1], [x, 0.0, -0.05], 1.0, false, true));
    let body = bench.shape([0.1; 3], [-0.5, 0.0, 0.05], 1.0, true, true);
    for shape in tiles.into_iter().chain([body]) {
        bench.change(shape, |shape| shape.material.friction = 0.0);
    }
    bench.change(body, |shape| {
        shape.dynamics.initial_velocity.linear[0] = 1.5;
    });
    bench.run(20);
    near(bench.at(body)[0], 1.0, 1e-3);
    near(bench.height(body), 0.05, 1e-3);
    near(bench.shape_of(body).velocity.angular[1], 0.0, 1e-3);
}

#[test]
fn a_box_falls_through_a_shaft_that_is_hardly_wider() {
    let mut bench = Bench::new();
    for (x, y, size) in [
        (0.55, 0.0, [1.0, 3.0, 0.5]),
        (-0.55, 0.0, [1.0, 3.0, 0.5]),
        (0.0, 0.55, [0.098, 1.0, 0.5]),
        (0.0, -0.55, [0.098, 1.0, 0.5]),
    ] {
        bench.shape(size, [x, y, -0.25], 1.0, false, true);
    }
    let body = bench.shape([0.098; 3], [0.0, 0.0, 0.15], 1.0, true, true);
    bench.run(6);
    near(0.15 - bench.height(body), 9.81 * 0.3 * 0.305 / 2.0, 2e-3);
}

/// The middle of the forces on a body, weighted by the height components, and their sum.
fn support(bench: &Bench, body: Handle) -> ([f64; 2], f64) {
    let contacts: Vec<_> = bench
        .dynamics
        .contacts()
        .map(|contact| contact.seen_from(body))
        .filter(|contact| contact.shapes[0] == body && contact.normal[2] > 0.9)
        .collect();
    let sum: f64 = contacts.iter().map(|contact| contact.force[2]).sum();
    let middle = [0, 1].map(|axis| {
        let moments = contacts.iter().map(|c| c.force[2] * c.point[axis]);
        moments.sum::<f64>() / sum
    });
    (middle, sum / 10.0)
}

#[test]
fn forces_of_contacts_balance_the_weight_about_its_centre() {
    // One box, which is solved exactly, and a hundred, which rapier solves.
    for count in [1, 100] {
        let mut bench = Bench::new();
        bench.floor();
        let boxes: Vec<Handle> = (0..count)
            .map(|i| {
                let at = [0.5 * f64::from(i % 10), 0.5 * f64::from(i / 10), 0.05];
                bench.shape([0.2, 0.2, 0.1], at, 2.0, true, true)
            })
            .collect();
        let body = boxes[count as usize / 2];
        bench.change(body, |shape| shape.mass.com = [0.03, -0.02, 0.0]);
        bench.run(8);
        let [x, y, z] = bench.at(body);
        let (middle, force) = support(&bench, body);
        near(force, 2.0 * 9.81, 0.05);
        near(middle[0] - x, 0.03, 2e-3);
        near(middle[1] - y, -0.02, 2e-3);
        near(z, 0.05, 5e-4);
        let on_floor = |contact: Contact| contact.point[2].abs() < 1e-3;
        assert!(bench.dynamics.contacts().all(on_floor));
        assert_eq!(bench.dynamics.touching().len(), count as usize);
    }
}

#[test]
fn a_fast_arm_hits_a_thin_post() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (joint, arm) = bench.arm(0.01, 1.0, |_| {});
    bench.change(arm, |shape| {
        shape.dynamics.respondable = true;
        // Downwards, about y; the centre moves by the same rotation.
        shape.dynamics.initial_velocity.angular = [0.0, 40.0, 0.0];
        shape.dynamics.initial_velocity.linear = [0.0, 0.0, -40.0];
    });
    bench.shape([0.6, 0.5, 0.02], [1.0, 0.0, 0.7], 1.0, false, true);
    bench.run(1);
    let turned = bench.joint(joint).position;
    assert!((-6.0..0.5).contains(&turned), "{turned}");
    assert!(bench.height(arm) > 0.6, "{}", bench.height(arm));
}
