//! Tendons over joints, over points of linked bodies, with pulleys, and between two dummies where MuJoCo is selected: closed forms.

use scene::object::tendon::{TENDON_TARGETS, Tendon, TendonLaw, TendonPart};
use scene::{Data, Edit, Namespace, ValueType};

use super::super::*;
use super::mujoco;

const G: f64 = 9.81;

/// A body of that mass on a slider along z, from a base that does not move.
fn slider(bench: &mut Bench, x: f64, mass: f64) -> (Handle, Handle) {
    let base = bench.ghost([x, 0.0, 0.0], false);
    let mut joint = Joint::new(JointType::Prismatic, JointMode::Dynamic);
    joint.set_interval(false, -100.0, 200.0);
    joint.set_control(Control::Free);
    let kind = Kind::Joint(Box::new(joint));
    let joint = bench.object(kind, Pose::translation(x, 0.0, 0.0), base);
    let body = bench.shape([0.1; 3], [x, 0.0, 0.0], mass, true, false);
    bench.hang(body, joint);
    (joint, body)
}

/// A dummy at a place, below an object or in the world.
fn site(bench: &mut Bench, parent: Option<Handle>, [x, y, z]: [f64; 3]) -> Handle {
    let handle = bench.scene.add("site", Kind::Dummy(Dummy::new(0.01)));
    let handle = handle.expect("room");
    let pose = Pose::translation(x, y, z);
    bench.scene.set_world_pose(handle, pose).expect("exists");
    if let Some(parent) = parent {
        bench.hang(handle, parent);
    }
    handle
}

fn tendon(bench: &mut Bench, path: Vec<TendonPart>, law: TendonLaw) -> Handle {
    let dummy = site(bench, None, [0.0; 3]);
    let set = bench.scene.set_tendon(dummy, &Tendon { law, path });
    set.expect("a dummy");
    dummy
}

fn of_range(low: f64, high: f64) -> TendonLaw {
    TendonLaw {
        range: Some([low, high]),
        ..TendonLaw::default()
    }
}

fn position(bench: &Bench, joint: Handle) -> f64 {
    bench.joint(joint).position
}

/// Two masses between which there is a spring swing against each other with `w^2 = 2 k / m`, also where the spring is too stiff for the sub-step.
#[test]
fn a_spring_over_two_joints_swings() {
    for stiffness in [50.0, 800.0] {
        let mut bench = Bench::new();
        bench.gravity(0.0);
        let [one, two] = [0.0, 1.0].map(|x| slider(&mut bench, x, 1.0).0);
        let law = TendonLaw {
            stiffness,
            rest: Some([0.1; 2]),
            ..TendonLaw::default()
        };
        let path = vec![TendonPart::Joint(one, 1.0), TendonPart::Joint(two, -1.0)];
        tendon(&mut bench, path, law);
        let w = (2.0 * stiffness).sqrt();
        // A sub-step of 5 ms: half of it late, and slower by (w h)^2 / 12.
        let late = |time: f64| w * 0.0025 + w * time * (w * 0.005).powi(2) / 12.0;
        for number in 1..=40 {
            bench.run(1);
            let length = position(&bench, one) - position(&bench, two);
            let time = STEP * f64::from(number);
            near(length, 0.1 - 0.1 * (w * time).cos(), 0.12 * late(time));
            near(position(&bench, one) + position(&bench, two), 0.0, 1e-9);
        }
    }
}

/// Atwood's machine: `a = g (m1 - m2) / (m1 + m2)`. Both masses are mechanisms of their own but for the tendon.
#[test]
fn a_length_that_stays_lets_the_heavier_mass_lift_the_lighter_one() {
    let mut bench = Bench::new();
    let (one, _) = slider(&mut bench, 0.0, 2.0);
    let (two, _) = slider(&mut bench, 1.0, 1.0);
    let path = vec![TendonPart::Joint(one, 1.0), TendonPart::Joint(two, 1.0)];
    tendon(&mut bench, path, of_range(0.0, 0.0));
    bench.run(20);
    near(position(&bench, two), G / 6.0, 0.01);
    near(position(&bench, one) + position(&bench, two), 0.0, 1e-9);
}

/// A line from a mass over a pulley that halves the other end: with `m1 a1 = m1 g - T`, `m2 a2 = T / 2 - m2 g` and `a2 = 2 a1` follows `a1 = g (m1 - 2 m2) / (m1 + 4 m2)`. Free bodies, and linked
/// ones.
#[test]
fn a_pulley_halves_what_follows() {
    for is_linked in [false, true] {
        let mut bench = Bench::new();
        let bodies = [(0.0, 3.0), (1.0, 1.0)].map(|(x, mass)| {
            if is_linked {
                slider(&mut bench, x, mass).1
            } else {
                bench.shape([0.1; 3], [x, 0.0, 0.0], mass, true, false)
            }
        });
        let tops = [0.0, 1.0].map(|x| site(&mut bench, None, [x, 0.0, 3.0]));
        let ends =
            [0, 1].map(|i| site(&mut bench, Some(bodies[i]), [f64::from(i as u8), 0.0, 0.0]));
        let path = vec![
            TendonPart::Site(tops[0]),
            TendonPart::Site(ends[0]),
            TendonPart::Pulley(2.0),
            TendonPart::Site(tops[1]),
            TendonPart::Site(ends[1]),
        ];
        tendon(&mut bench, path, of_range(0.0, 4.5));
        bench.run(10);
        let way = G * (3.0 - 2.0) / (3.0 + 4.0) * 0.5 * 0.25;
        near(bench.height(bodies[0]), -way, 5e-3);
        near(bench.height(bodies[1]), 2.0 * way, 1e-2);
        let length = 3.0 - bench.height(bodies[0]) + (3.0 - bench.height(bodies[1])) / 2.0;
        near(length, 4.5, 1e-9);
    }
}

/// An arm of a metre with 1 kg at its end, held by a spring straight above: it carries `m g` where it hangs `m g / k` lower, however stiff the spring is, and although the joint bears a part.
#[test]
fn a_spring_holds_an_arm_at_rest() {
    for stiffness in [500.0, 1e5, 1e8] {
        let mut bench = Bench::new();
        let (joint, arm) = bench.arm(1e-4, 1.0, |joint| {
            joint.set_interval(true, -3.0, 6.0);
            joint.set_control(Control::Free);
        });
        // Far above, so that the line stays vertical.
        let top = site(&mut bench, None, [1.0, 0.0, 101.0]);
        let end = site(&mut bench, Some(arm), [1.0, 0.0, 1.0]);
        let law = TendonLaw {
            stiffness,
            damping: 2.0 * stiffness.sqrt(),
            rest: Some([100.0; 2]),
            ..TendonLaw::default()
        };
        let path = vec![TendonPart::Site(top), TendonPart::Site(end)];
        tendon(&mut bench, path, law);
        bench.run(100);
        near(
            position(&bench, joint).sin(),
            G / stiffness,
            1e-4 * G / 500.0,
        );
    }
}

/// A spring without force between two lengths: a mass falls through them and stops where the spring bears it.
#[test]
fn a_spring_may_have_slack() {
    let mut bench = Bench::new();
    let (joint, _) = slider(&mut bench, 0.0, 1.0);
    let law = TendonLaw {
        stiffness: 200.0,
        damping: 30.0,
        rest: Some([-0.2, 0.1]),
        ..TendonLaw::default()
    };
    tendon(&mut bench, vec![TendonPart::Joint(joint, 1.0)], law);
    bench.run(100);
    near(position(&bench, joint), -0.2 - G / 200.0, 1e-4);
}

/// Friction holds 1 kg up to its weight, and slows it down beyond; a rotor makes it heavier.
#[test]
fn tendons_have_friction_and_inertia() {
    let fall = |law: TendonLaw| {
        let mut bench = Bench::new();
        let (joint, _) = slider(&mut bench, 0.0, 1.0);
        tendon(&mut bench, vec![TendonPart::Joint(joint, 2.0)], law);
        bench.run(10);
        -position(&bench, joint)
    };
    let friction = |friction: f64| TendonLaw {
        friction,
        ..TendonLaw::default()
    };
    // It acts twice along the joint.
    near(fall(friction(5.0)), 0.0, 1e-9);
    near(fall(friction(2.0)), (G - 4.0) * 0.125, 0.02);
    let armature = TendonLaw {
        armature: 0.5,
        ..TendonLaw::default()
    };
    near(fall(armature), G / 3.0 * 0.125, 0.02);
}

/// A motor of 6 N on a length that counts a joint half pushes it with 3 N; a script sets it.
#[test]
fn actuators_pull_at_tendons() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (joint, _) = slider(&mut bench, 0.0, 2.0);
    let law = TendonLaw::default();
    let tendon = tendon(&mut bench, vec![TendonPart::Joint(joint, 0.5)], law);
    let mut say = |name: &str, value: (ValueType, Data)| {
        let edit = Edit::Name(name, Some(value));
        let scene = &mut bench.scene;
        let said = scene.edit_named_values(Some(tendon), Namespace::CustomData, edit);
        said.expect("exists");
    };
    let text = Data::text("force highest=6");
    say(scene::joint::ACTUATOR, (ValueType::String, text));
    let much = (ValueType::Float, Data::Float(100.0));
    say(TENDON_TARGETS[0], much);
    bench.run(20);
    near(position(&bench, joint), 0.5 * 1.5, 0.01);
}

/// A servo of a tendon over two joints brings the length where it is told; the joints share the way as their masses say.
#[test]
fn a_servo_keeps_the_length_of_a_tendon() {
    let mut bench = Bench::new();
    bench.gravity(0.0);
    let (one, _) = slider(&mut bench, 0.0, 1.0);
    let (two, _) = slider(&mut bench, 1.0, 3.0);
    let law = TendonLaw::default();
    let path = vec![TendonPart::Joint(one, 1.0), TendonPart::Joint(two, 1.0)];
    let tendon = tendon(&mut bench, path, law);
    let texts = [
        (
            scene::joint::ACTUATOR,
            ValueType::String,
            Data::text("position stiffness=1000 damping=60"),
        ),
        (TENDON_TARGETS[1], ValueType::Float, Data::Float(0.4)),
    ];
    for (name, kind, value) in texts {
        let edit = Edit::Name(name, Some((kind, value)));
        let scene = &mut bench.scene;
        let said = scene.edit_named_values(Some(tendon), Namespace::CustomData, edit);
        said.expect("exists");
    }
    bench.run(60);
    near(position(&bench, one), 0.3, 1e-3);
    near(position(&bench, two), 0.1, 1e-3);
}

/// Two dummies at those places, the ends of a tendon: one of the world, one below a body.
fn pair(bench: &mut Bench, body: Handle, ends: [[f64; 3]; 2], values: &[(&'static str, Data)]) {
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
        pair(&mut bench, body, [[0.0; 3], [1.1, 0.0, 0.0]], &values);
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
    pair(&mut bench, body, [[0.0; 3], [0.0, 0.0, -1.0]], &values);
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
    pair(&mut bench, body, [[0.0; 3], [0.0, 0.0, -0.5]], &values);
    bench.run(40);
    near(bench.height(body), -1.0, 1e-6);
    // T = 2 pi sqrt(l / g), for a point of small inertia.
    let mut bench = mujoco();
    let body = bench.ghost([0.05, 0.0, -(1.0f64 - 0.0025).sqrt()], true);
    let end = bench.at(body);
    pair(&mut bench, body, [[0.0; 3], end], &values);
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
    pair(&mut bench, body, [[0.0; 3], [0.0, 0.0, -1.0]], &values);
    bench.run(1);
    near(bench.height(body), -1.013_488_751, 1e-7);
}
