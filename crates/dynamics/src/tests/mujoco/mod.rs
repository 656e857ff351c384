//! MuJoCo's parameters of the scene, of shapes and of dummies, where it is the selected engine: closed forms.

mod tendons;

use scene::parameters::engine::Engine;
use scene::shape::{ContactPair, Material, MovingSurface, RespondableMask, SURFACE};
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

/// Motors hold an arm, joints follow others and loops are closed as long as the scene lets them.
#[test]
fn motors_and_equalities_of_the_scene_are_switched_off() {
    let turned = |name: &'static str| {
        let mut bench = mujoco();
        let (joint, _) = bench.arm(0.01, 0.3, |joint| {
            joint.set_interval(true, -3.0, 6.0);
            joint.set_control(Control::Velocity);
            joint.target_velocity = 0.0;
            joint.set_target_force(100.0, false);
        });
        set_scene(&mut bench, name, Data::Bool(false));
        bench.run(4);
        bench.joint(joint).position
    };
    near(turned("mujoco.sensorEnable"), 0.0, 1e-6);
    assert!(turned("mujoco.actuationEnable") > 0.2);
    let fall = |name: &'static str| {
        let mut bench = mujoco();
        let base = bench.ghost([0.0, 0.0, 1.0], false);
        let body = bench.ghost([0.0, 0.0, 0.5], true);
        let ends = [(base, 0.75), (body, 0.75)].map(|(parent, z)| {
            let mut dummy = Dummy::new(0.01);
            dummy.link_type = LinkType::LoopClosure;
            bench.object(Kind::Dummy(dummy), Pose::translation(0.0, 0.0, z), parent)
        });
        bench
            .scene
            .link_dummies(ends[0], Some(ends[1]))
            .expect("dummies");
        set_scene(&mut bench, name, Data::Bool(false));
        bench.run(4);
        0.5 - bench.height(body)
    };
    near(fall("mujoco.sensorEnable"), 0.0, 1e-6);
    near(fall("mujoco.equalityEnable"), 0.2011, 1e-3);
}

/// The floor bears the weight of 3 kg in place of one.
#[test]
fn bodies_have_at_least_the_mass_of_the_scene() {
    let mut bench = mujoco();
    bench.floor();
    let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
    set_scene(&mut bench, "mujoco.boundMass", Data::Float(3.0));
    bench.run(20);
    let contacts = bench.dynamics.contacts();
    let force: f64 = contacts
        .map(|contact| contact.seen_from(body).force[2])
        .sum();
    near(force / 10.0, 3.0 * 9.81, 0.05);
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

fn say_motion(bench: &mut Bench, shape: Handle, linear: [f64; 3]) {
    let angular = [0.0; 3];
    let motion = MovingSurface { linear, angular };
    let text = (ValueType::String, Data::text(&motion.to_string()));
    let edit = Edit::Name(SURFACE, Some(text));
    let scene = &mut bench.scene;
    let said = scene.edit_named_values(Some(shape), Namespace::CustomData, edit);
    said.expect("exists");
}

/// A belt of 1 m/s on a cart of 3 kg that rolls without friction, and a box of 1 kg on it: friction accelerates the box and pushes the cart back, until the box is faster than the cart by the speed of the belt.
/// Momentum stays: 1/4 and 3/4 of that speed. The cart is free, or on a slider; there may be many of them, which are solved in another way.
#[test]
fn a_belt_that_is_carried_carries_and_is_pushed_back() {
    for (is_linked, count) in [(false, 1), (true, 1), (false, 80)] {
        let mut bench = Bench::new();
        let floor = bench.shape([10.0, 600.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
        bench.change(floor, |shape| shape.material = Material::of_friction(0.0));
        let mut carts = Vec::new();
        for number in 0..count {
            let y = 3.0 * f64::from(number);
            let cart = bench.shape([2.0, 0.5, 0.1], [0.0, y, 0.05], 3.0, true, true);
            let body = bench.shape([0.2, 0.2, 0.1], [-0.4, y, 0.15], 1.0, true, true);
            for shape in [cart, body] {
                bench.change(shape, |shape| {
                    shape.material = Material::of_friction(0.5);
                });
            }
            say_motion(&mut bench, cart, [1.0, 0.0, 5.0]);
            if is_linked {
                let base = bench.ghost([0.0, y, 0.05], false);
                let mut joint = Joint::new(JointType::Prismatic, JointMode::Dynamic);
                joint.set_interval(false, -100.0, 200.0);
                joint.set_control(Control::Free);
                let turn = nalgebra::UnitQuaternion::from_euler_angles(
                    0.0,
                    std::f64::consts::FRAC_PI_2,
                    0.0,
                );
                let pose = Pose::from_parts(nalgebra::Translation3::new(0.0, y, 0.05), turn);
                let joint = bench.object(Kind::Joint(Box::new(joint)), pose, base);
                bench.hang(cart, joint);
            }
            carts.push((cart, body));
        }
        bench.run(10);
        for (cart, body) in carts {
            near(speed(&bench, body)[0], 0.75, 5e-3);
            near(speed(&bench, cart)[0], -0.25, 5e-3);
            near(bench.height(body), 0.15, 1e-3);
        }
    }
}

/// What a shape says of another one counts before masks: a box falls through the floor or does not, and slides by the friction of the pair.
#[test]
fn shapes_say_how_they_touch_others() {
    let fall = |mask: u16, touches: bool| {
        let mut bench = Bench::new();
        let floor = bench.floor();
        let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
        bench.change(body, |shape| {
            shape.dynamics.respondable_mask = RespondableMask(i64::from(mask));
        });
        let pair = ContactPair {
            other: floor,
            touches,
            friction: None,
        };
        bench
            .scene
            .set_contact_pairs(body, &[pair])
            .expect("exists");
        bench.run(4);
        bench.height(body) - 0.05
    };
    near(fall(0, true), 0.0, 2e-3);
    near(fall(0xffff, false), -0.2011, 1e-3);
    let slide = |friction: Option<f64>| {
        let mut bench = Bench::new();
        bench
            .scene
            .modify_settings(|settings| settings.dynamics.gravity = [4.0, 0.0, -9.81]);
        let floor = bench.floor();
        let body = bench.shape([0.2, 0.2, 0.05], [0.0, 0.0, 0.025], 1.0, true, true);
        for shape in [floor, body] {
            bench.change(shape, |shape| shape.material = Material::of_friction(0.1));
        }
        let pair = ContactPair {
            other: body,
            touches: true,
            friction,
        };
        bench
            .scene
            .set_contact_pairs(floor, &[pair])
            .expect("exists");
        bench.run(20);
        bench.at(body)[0]
    };
    near(slide(None), (4.0 - 0.981) / 2.0, 0.02);
    near(slide(Some(0.3)), (4.0 - 0.3 * 9.81) / 2.0, 0.02);
    near(slide(Some(0.5)), 0.0, 1e-3);
}
