//! Bodies that rest fall asleep, and everything that could move them wakes them.

use super::*;
use scene::shape::{RespondableMask, Shape, Velocity};

/// A box asleep on a floor, both respondable.
struct Sleeper {
    bench: Bench,
    floor: Handle,
    body: Handle,
}

impl Sleeper {
    fn new() -> Self {
        let mut bench = Bench::new();
        let floor = bench.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true);
        let body = bench.shape([0.1; 3], [0.0, 0.0, 0.05], 1.0, true, true);
        let mut sleeper = Self { bench, floor, body };
        sleeper.fall_asleep();
        sleeper
    }

    fn fall_asleep(&mut self) {
        self.bench.run(60);
        assert!(self.sleeps(), "the box does not sleep");
    }

    fn sleeps(&self) -> bool {
        let rigid = self
            .bench
            .dynamics
            .bodies
            .get(self.body)
            .map(|body| body.rigid);
        let world = self.bench.dynamics.world.as_ref();
        rigid
            .and_then(|rigid| world?.bodies.get(rigid))
            .is_some_and(|rigid| rigid.is_sleeping())
    }

    fn change(&mut self, handle: Handle, change: impl FnOnce(&mut Shape)) {
        let changed = self
            .bench
            .scene
            .try_modify(handle, Field::Dynamics, |object| {
                change(object.shape_mut()?);
                Ok(())
            });
        changed.expect("a shape");
    }

    fn place(&mut self, handle: Handle, at: [f64; 3]) {
        self.bench
            .scene
            .set_world_pose(handle, Pose::translation(at[0], at[1], at[2]))
            .expect("exists");
    }

    fn at(&self) -> [f64; 3] {
        self.bench
            .scene
            .world_pose(self.body)
            .expect("exists")
            .translation
            .vector
            .into()
    }

    /// Force of the floor on the box in each sub-step of the last call, newtons.
    fn support(&self) -> Vec<f64> {
        let mut sub_steps = vec![0.0; 10];
        for contact in self.bench.dynamics.contacts() {
            sub_steps[contact.sub_step as usize] += contact.seen_from(self.body).force[2];
        }
        sub_steps
    }
}

#[test]
fn a_sleeper_does_not_move_and_its_support_is_read_in_every_sub_step() {
    let mut sleeper = Sleeper::new();
    let (place, support) = (
        sleeper.bench.scene.world_pose(sleeper.body),
        sleeper.support(),
    );
    assert!(
        support.iter().all(|force| (force - 9.81).abs() < 1e-3),
        "{support:?}"
    );
    sleeper.bench.run(100);
    assert_eq!(sleeper.bench.scene.world_pose(sleeper.body), place);
    assert_eq!(sleeper.support(), support);
    let velocity = sleeper
        .bench
        .scene
        .object(sleeper.body)
        .and_then(|o| Ok(o.shape()?.velocity));
    assert_eq!(velocity, Ok(Velocity::default()));
}

#[test]
fn a_sleeping_stack_stays_as_it_is_to_the_last_bit() {
    let mut sleeper = Sleeper::new();
    let stack: Vec<Handle> = (1..6)
        .map(|i| {
            sleeper.bench.shape(
                [0.1; 3],
                [0.0, 0.0, 0.05 + 0.1 * f64::from(i)],
                1.0,
                true,
                true,
            )
        })
        .collect();
    sleeper.bench.run(400);
    assert!(sleeper.sleeps(), "the stack does not sleep");
    let poses = |bench: &Bench| {
        stack
            .iter()
            .map(|&body| bench.scene.world_pose(body))
            .collect::<Vec<_>>()
    };
    let before = poses(&sleeper.bench);
    sleeper.bench.run(400);
    assert_eq!(poses(&sleeper.bench), before);
}

#[test]
fn a_force_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.change(sleeper.body, |shape| shape.force = [20.0, 0.0, 0.0]);
    sleeper.bench.run(1);
    assert!(sleeper.at()[0] > 0.001);
}

#[test]
fn a_torque_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.change(sleeper.body, |shape| shape.torque = [0.0, 0.0, 5.0]);
    sleeper.bench.run(1);
    let turned = sleeper
        .bench
        .scene
        .world_pose(sleeper.body)
        .expect("exists")
        .rotation
        .angle();
    assert!(turned > 0.01, "{turned}");
}

#[test]
fn a_place_given_by_a_script_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.place(sleeper.body, [0.0, 0.0, 1.0]);
    sleeper.bench.run(2);
    assert!(sleeper.at()[2] < 0.97);
}

#[test]
fn a_velocity_given_by_a_script_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.change(sleeper.body, |shape| {
        shape.dynamics.initial_velocity.linear = [0.0, 0.0, 2.0];
    });
    sleeper
        .bench
        .scene
        .modify(sleeper.body, Field::Dynamics, |object| {
            object.dynamics_reset = true;
        })
        .expect("exists");
    sleeper.bench.run(1);
    assert!(sleeper.at()[2] > 0.1);
}

#[test]
fn another_gravity_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.bench.gravity(9.81);
    sleeper.bench.run(2);
    assert!(sleeper.at()[2] > 0.07);
}

#[test]
fn another_mass_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.change(sleeper.body, |shape| shape.mass.mass = 3.0);
    sleeper.bench.run(20);
    let support = sleeper.support();
    assert!(
        support.iter().all(|force| (force - 3.0 * 9.81).abs() < 0.1),
        "{support:?}"
    );
}

#[test]
fn a_support_that_is_removed_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper
        .bench
        .scene
        .remove(&[sleeper.floor])
        .expect("exists");
    sleeper.bench.run(2);
    assert!(sleeper.at()[2] < 0.02);
}

#[test]
fn a_support_that_lets_pass_wakes() {
    let mut sleeper = Sleeper::new();
    sleeper.change(sleeper.floor, |shape| {
        shape.dynamics.respondable_mask = RespondableMask::NONE;
    });
    sleeper.bench.run(2);
    assert!(sleeper.at()[2] < 0.02);
}

#[test]
fn a_support_that_moves_wakes_first_and_again() {
    let mut sleeper = Sleeper::new();
    for height in [0.02, 0.04] {
        sleeper.place(sleeper.floor, [0.0, 0.0, height - 0.05]);
        sleeper.fall_asleep();
        near(sleeper.at()[2], height + 0.05, 1e-3);
    }
    sleeper.place(sleeper.floor, [0.0, 0.0, -1.0]);
    sleeper.bench.run(10);
    assert!(sleeper.at()[2] < 0.0, "the box stays in the air");
}

#[test]
fn another_material_wakes_and_counts() {
    let mut sleeper = Sleeper::new();
    // A slope the box does not slide on: gravity leans instead of the floor.
    let lean = |sleeper: &mut Sleeper| {
        sleeper
            .bench
            .scene
            .modify_settings(|settings| settings.dynamics.gravity = [2.0, 0.0, -9.81]);
    };
    lean(&mut sleeper);
    sleeper.fall_asleep();
    let before = sleeper.at()[0];
    for shape in [sleeper.floor, sleeper.body] {
        sleeper.change(shape, |shape| shape.material.friction = 0.0);
    }
    sleeper.bench.run(20);
    assert!(sleeper.at()[0] > before + 0.5, "the box does not slide");
}

#[test]
fn a_neighbour_that_hits_wakes() {
    let mut sleeper = Sleeper::new();
    let ram = sleeper
        .bench
        .shape([0.1; 3], [-0.5, 0.0, 0.06], 5.0, true, true);
    sleeper.change(ram, |shape| {
        shape.dynamics.initial_velocity.linear = [4.0, 0.0, 0.0];
    });
    sleeper.bench.run(10);
    assert!(sleeper.at()[0] > 0.05);
}

#[test]
fn a_neighbour_that_moves_away_wakes() {
    let mut sleeper = Sleeper::new();
    let upper = sleeper
        .bench
        .shape([0.1; 3], [0.0, 0.0, 0.15], 1.0, true, true);
    sleeper.bench.run(100);
    sleeper.fall_asleep();
    let lower = std::mem::replace(&mut sleeper.body, upper);
    sleeper.change(lower, |shape| shape.force = [300.0, 0.0, 0.0]);
    sleeper.bench.run(20);
    assert!(sleeper.at()[2] < 0.07, "the upper box stays in the air");
}

#[test]
fn a_link_wakes_and_keeps_awake() {
    let mut sleeper = Sleeper::new();
    let base = sleeper.bench.ghost([0.0, 0.0, 1.0], false);
    let joint = Joint::new(JointType::Prismatic, JointMode::Dynamic);
    let joint = sleeper.bench.object(
        Kind::Joint(Box::new(joint)),
        Pose::translation(0.0, 0.0, 0.5),
        base,
    );
    sleeper.bench.hang(sleeper.body, joint);
    sleeper.bench.run(60);
    assert!(!sleeper.sleeps());
}

#[test]
fn contact_callbacks_wake_bodies_whose_contacts_they_change() {
    let mut sleeper = Sleeper::new();
    let calls = std::cell::Cell::new(0);
    let callback = |_, _| {
        calls.set(calls.get() + 1);
        ContactResponse::NoCollision
    };
    sleeper.bench.run_asking(1, Some(&callback));
    assert!(
        calls.get() >= 10 && sleeper.at()[2] < 0.045,
        "{} {}",
        calls.get(),
        sleeper.at()[2]
    );
}

#[test]
fn bodies_sleep_while_contact_callbacks_look_on() {
    let mut sleeper = Sleeper::new();
    let calls = std::cell::Cell::new(0);
    let callback = |_, _| {
        calls.set(calls.get() + 1);
        ContactResponse::Default
    };
    sleeper.bench.run_asking(1, Some(&callback));
    assert!(sleeper.sleeps() && calls.get() >= 10, "{}", calls.get());
}

#[test]
fn a_sleeper_below_a_parent_stays_where_it_is_when_the_parent_moves() {
    let mut sleeper = Sleeper::new();
    let parent = sleeper.bench.ghost([1.0, 0.0, 1.0], false);
    sleeper.bench.hang(sleeper.body, parent);
    sleeper.bench.run(1);
    sleeper.fall_asleep();
    let before = sleeper.at();
    sleeper.place(parent, [2.0, 0.0, 1.0]);
    sleeper.bench.run(1);
    let after = sleeper.at();
    (0..3).for_each(|axis| near(after[axis], before[axis], 1e-3));
}
