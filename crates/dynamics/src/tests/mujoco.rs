//! MuJoCo's parameters of the scene, of shapes and of dummies, where it is the selected engine: closed forms.

use scene::parameters::engine::Engine;
use scene::shape::{Material, MovingSurface, SURFACE};
use scene::{Data, Edit, Namespace, ValueType};

use super::*;

/// A scene for which MuJoCo is selected.
fn mujoco() -> Bench {
    let mut bench = Bench::new();
    bench
        .scene
        .modify_settings(|settings| settings.dynamics.engine.engine = Engine::Mujoco);
    bench
}

fn set_scene(bench: &mut Bench, name: &'static str, value: Data) {
    bench
        .scene
        .modify_settings(|settings| settings.dynamics.engine_values.set(name, value));
}

fn set(bench: &mut Bench, shape: Handle, values: &[(&'static str, Data)]) {
    bench.change(shape, |shape| {
        for (name, value) in values {
            shape.material.engine_values.set(name, value.clone());
        }
    });
}

fn adheres(force: f64) -> [(&'static str, Data); 3] {
    [
        ("mujoco.adhesion", Data::Bool(true)),
        ("mujoco.adhesiongain", Data::Float(force / 2.0)),
        ("mujoco.adhesionctrl", Data::Float(2.0)),
    ]
}

fn speed(bench: &Bench, shape: Handle) -> [f64; 3] {
    bench.shape_of(shape).velocity.linear
}

/// a = g (1 - part), and none of it with another engine.
#[test]
fn gravity_is_compensated_in_part() {
    for (engine, part, fall) in [
        (Engine::Mujoco, 1.0, 0.0),
        (Engine::Mujoco, 0.25, 0.75),
        (Engine::Mujoco, 2.0, -1.0),
        (Engine::Bullet, 1.0, 1.0),
    ] {
        let mut bench = mujoco();
        bench
            .scene
            .modify_settings(|settings| settings.dynamics.engine.engine = engine);
        let body = bench.ghost([0.0, 0.0, 10.0], true);
        set(&mut bench, body, &[("mujoco.gravcomp", Data::Float(part))]);
        bench.run(20);
        near(speed(&bench, body)[2], -9.81 * fall, 1e-6);
    }
}

#[test]
fn switches_of_the_scene_switch_off() {
    let mut bench = mujoco();
    let floor = bench.floor();
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    bench.run(5);
    near(bench.height(body), 0.05, 1e-4);
    set_scene(&mut bench, "mujoco.contactEnable", Data::Bool(false));
    bench.run(20);
    assert!(bench.height(body) < -4.0);
    set_scene(&mut bench, "mujoco.gravityEnable", Data::Bool(false));
    let before = speed(&bench, body);
    bench.run(20);
    assert_eq!(speed(&bench, body), before);
    near(bench.height(floor), -0.05, 1e-12);
}

/// The terminal speed of a ball in a fluid of which all rises with `wind`: that of the box with its inertia, `3 pi d viscosity v = m g`.
#[test]
fn bodies_fall_in_the_fluid_of_the_scene() {
    for wind in [0.0, 2.0] {
        let mut bench = mujoco();
        let body = bench.ghost([0.0, 0.0, 100.0], true);
        // The box of 1 kg with 0.01 kg m² about each axis.
        let edge = 0.06f64.sqrt();
        let viscosity = 9.81 / (3.0 * std::f64::consts::PI * edge * 5.0);
        set_scene(&mut bench, "mujoco.viscosity", Data::Float(viscosity));
        let moves = Data::from(vec![0.0, 0.0, wind]);
        set_scene(&mut bench, "mujoco.wind", moves);
        bench.run(100);
        near(speed(&bench, body)[2], wind - 5.0, 1e-3);
        set_scene(&mut bench, "mujoco.passiveEnable", Data::Bool(false));
        let before = speed(&bench, body)[2];
        bench.run(20);
        near(speed(&bench, body)[2], before - 9.81, 1e-6);
    }
}

/// A box of 1 kg under a ceiling: it hangs where the adhesion is stronger than its weight, and falls where it is not.
#[test]
fn what_adheres_hangs_under_a_ceiling() {
    for (force, hangs) in [(20.0, true), (5.0, false), (9.0, false), (10.5, true)] {
        let mut bench = mujoco();
        bench.shape([1.0, 1.0, 0.1], [0.0, 0.0, 1.05], 1.0, false, true);
        let body = bench.shape([0.1; 3], [0.0, 0.0, 0.95], 1.0, true, true);
        set(&mut bench, body, &adheres(force));
        bench.run(20);
        assert_eq!(bench.height(body) > 0.949, hangs, "{force}");
        set(
            &mut bench,
            body,
            &[("mujoco.adhesionctrl", Data::Float(0.0))],
        );
        bench.run(10);
        assert!(bench.height(body) < 0.9);
    }
}

/// On a wall friction mu bears up to mu times the adhesion.
#[test]
fn friction_holds_what_adheres_to_a_wall() {
    for (force, holds) in [(25.0, true), (15.0, false)] {
        let mut bench = mujoco();
        let wall = bench.shape([0.1, 1.0, 4.0], [-0.05, 0.0, 0.0], 1.0, false, true);
        let body = bench.shape([0.1; 3], [0.05, 0.0, 0.0], 1.0, true, true);
        for shape in [wall, body] {
            bench.change(shape, |shape| shape.material = Material::of_friction(0.5));
        }
        set(&mut bench, body, &adheres(force));
        bench.run(20);
        // Else it slides with g - mu F / m.
        let slides = if holds {
            0.0
        } else {
            (9.81 - 0.5 * force) / 2.0
        };
        near(bench.height(body), -slides, 0.02 * slides + 1e-3);
        near(bench.at(body)[0], 0.05, 1e-3);
    }
}

/// On the floor the contact bears weight and adhesion.
#[test]
fn the_contact_bears_the_adhesion() {
    let mut bench = mujoco();
    bench.floor();
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    set(&mut bench, body, &adheres(30.0));
    bench.run(20);
    let contacts = bench.dynamics.contacts();
    let force: f64 = contacts
        .map(|contact| contact.seen_from(body).force[2])
        .sum();
    near(force / 10.0, 9.81 + 30.0, 0.1);
}

/// A box on a belt: it slips for v / (mu g), and goes at the speed of the belt from then on. The belt turns about its own axis as well.
#[test]
fn a_moving_surface_carries() {
    let mut bench = mujoco();
    let belt = bench.floor();
    let body = bench.shape([0.2, 0.2, 0.05], [0.0, 0.0, 0.025], 1.0, true, true);
    for shape in [belt, body] {
        bench.change(shape, |shape| shape.material = Material::of_friction(0.5));
    }
    let motion = MovingSurface {
        linear: [0.0, 1.0, 0.0],
        angular: [0.0; 3],
    };
    let text = (ValueType::String, Data::text(&motion.to_string()));
    let edit = Edit::Name(SURFACE, Some(text));
    bench
        .scene
        .edit_named_values(Some(belt), Namespace::CustomData, edit)
        .expect("exists");
    bench.run(2);
    near(speed(&bench, body)[1], 0.5 * 9.81 * 0.1, 0.03);
    bench.run(18);
    near(speed(&bench, body)[1], 1.0, 1e-3);
    near(bench.at(body)[1], 1.0 - 1.0 / (2.0 * 0.5 * 9.81), 0.01);
    near(bench.at(belt)[1], 0.0, 1e-12);
    bench
        .scene
        .edit_named_values(Some(belt), Namespace::CustomData, Edit::Name(SURFACE, None))
        .expect("exists");
    // It is read when the shape changes.
    bench.change(belt, |_| ());
    bench.run(20);
    near(speed(&bench, body)[1], 0.0, 1e-6);
}

/// Two dummies at those places, the ends of a tendon: one of the world, one below a body.
fn tendon(bench: &mut Bench, body: Handle, ends: [[f64; 3]; 2], values: &[(&'static str, Data)]) {
    let dummies = ends.map(|[x, y, z]| {
        let mut dummy = Dummy::new(0.01);
        dummy.link_type = LinkType::Tendon;
        for (name, value) in values {
            dummy.engine_values.set(name, value.clone());
        }
        let handle = bench.scene.add("end", Kind::Dummy(dummy));
        let handle = handle.expect("room");
        let pose = Pose::translation(x, y, z);
        bench.scene.set_world_pose(handle, pose).expect("exists");
        handle
    });
    bench.hang(dummies[1], body);
    bench
        .scene
        .link_dummies(dummies[0], Some(dummies[1]))
        .expect("dummies");
}

/// T = 2 pi sqrt(m / k), whatever the stiffness; the amplitude stays. A mass of 1 kg, half a period and whole ones.
#[test]
fn a_tendon_swings_as_a_spring() {
    for stiffness in [4.0 * std::f64::consts::PI.powi(2), 400.0] {
        let mut bench = mujoco();
        bench.gravity(0.0);
        let body = bench.ghost([1.1, 0.0, 0.0], true);
        let values = [
            ("mujoco.springStiffness", Data::Float(stiffness)),
            ("mujoco.springLength", Data::Float(1.0)),
        ];
        tendon(&mut bench, body, [[0.0; 3], [1.1, 0.0, 0.0]], &values);
        let mut places = Vec::new();
        for _ in 0..40 {
            bench.run(1);
            places.push(bench.at(body)[0]);
        }
        let turns = stiffness.sqrt() * STEP;
        for (number, place) in places.iter().enumerate() {
            let phase = turns * (number + 1) as f64;
            near(*place, 1.0 + 0.1 * phase.cos(), 6e-3);
        }
    }
}

/// The mass hangs m g / k below the length of rest once the damper has brought it there. It is critically damped: c = 2 sqrt(k m).
#[test]
fn a_damped_tendon_comes_to_rest_where_it_bears_the_weight() {
    let mut bench = mujoco();
    let body = bench.ghost([0.0, 0.0, -1.0], true);
    let values = [
        ("mujoco.springStiffness", Data::Float(100.0)),
        ("mujoco.springDamping", Data::Float(20.0)),
    ];
    // The length at the start is that of rest.
    tendon(&mut bench, body, [[0.0; 3], [0.0, 0.0, -1.0]], &values);
    bench.run(60);
    near(bench.height(body), -1.0 - 0.0981, 1e-4);
}

/// A length without slack: a pendulum that swings at its length, and a mass that falls to it.
#[test]
fn a_tendon_is_no_longer_than_its_range() {
    let values = [
        ("mujoco.limitsEnabled", Data::Bool(true)),
        ("mujoco.limitsRange", Data::from(vec![0.0, 1.0])),
    ];
    let mut bench = mujoco();
    let body = bench.ghost([0.0, 0.0, -0.5], true);
    tendon(&mut bench, body, [[0.0; 3], [0.0, 0.0, -0.5]], &values);
    bench.run(40);
    near(bench.height(body), -1.0, 1e-6);
    // T = 2 pi sqrt(l / g), for a point of small inertia.
    let mut bench = mujoco();
    let body = bench.ghost([0.05, 0.0, -(1.0f64 - 0.0025).sqrt()], true);
    let end = bench.at(body);
    tendon(&mut bench, body, [[0.0; 3], end], &values);
    let period = std::f64::consts::TAU / 9.81f64.sqrt();
    bench.run((period / STEP).round() as usize);
    near(bench.at(body)[0], 0.05, 2e-3);
    near(bench.at(body).iter().map(|x| x * x).sum::<f64>(), 1.0, 1e-3);
}

#[test]
fn tendons_belong_to_mujoco() {
    let mut bench = Bench::new();
    let body = bench.ghost([0.0, 0.0, -1.0], true);
    let values = [("mujoco.springStiffness", Data::Float(1e4))];
    tendon(&mut bench, body, [[0.0; 3], [0.0, 0.0, -1.0]], &values);
    bench.run(1);
    near(bench.height(body), -1.013_488_751, 1e-7);
}
