//! Springs, dampers, rotors and dry friction of a joint, alone and beside a motor, by the formulas of mechanics.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use nalgebra::Vector3;
use rig::*;

/// A body on a slide along x that is moved step by step; gravity does not act along it.
struct Slide {
    rig: Rig,
    position: f64,
}

impl Slide {
    fn new(position: f64, passive: Passive) -> Self {
        let mut rig = rig(JointKind::Prismatic, Vector3::x(), 0.0, Vector3::zeros());
        rig.joint.passive = passive;
        rig.joint.position = position;
        rig.body.motion.pose = geometry::Pose::translation(position, 0.0, 0.0);
        Self { rig, position }
    }

    fn with_motor(mut self, velocity: f64, max_force: f64) -> Self {
        self.rig.joint.motor = Some(Motor {
            velocity,
            max_force,
        });
        self
    }

    /// Moves on, and returns the velocity.
    fn step(&mut self) -> f64 {
        self.rig.begin(Vector3::zeros());
        let velocity = self.rig.velocity().0;
        self.position += velocity.x * STEP;
        let moving = moving(velocity, Vector3::zeros());
        self.rig.body = moving;
        self.rig.body.motion.pose = geometry::Pose::translation(self.position, 0.0, 0.0);
        (self.rig.joint.position, self.rig.joint.velocity) = (self.position, velocity.x);
        velocity.x
    }

    fn after(&mut self, seconds: f64) -> f64 {
        (0..(seconds / STEP).round() as usize)
            .map(|_| self.step())
            .last()
            .unwrap()
    }

    /// Of the motor in the last step.
    fn motor_force(&self) -> f64 {
        self.rig.mechanism.joint_loads().next().unwrap().motor
    }
}

#[test]
fn a_damped_spring_swings_as_its_formula_says() {
    let (stiffness, damping, armature) = (80.0, 4.0, 3.0);
    let mut slide = Slide::new(
        0.3,
        Passive {
            armature,
            stiffness,
            rest: 0.1,
            damping,
            ..Passive::default()
        },
    );
    let mass = MASS + armature;
    let decay = damping / (2.0 * mass);
    let frequency = (stiffness / mass - decay * decay).sqrt();
    for _ in 0..4 {
        slide.after(0.25);
    }
    // Positions are those of half a step later.
    let time = 1.0 + STEP / 2.0;
    let swing = (frequency * time).cos() + decay / frequency * (frequency * time).sin();
    let expected = 0.1 + 0.2 * (-decay * time).exp() * swing;
    assert!(
        (slide.position - expected).abs() < 2e-3,
        "{}",
        slide.position
    );
}

#[test]
fn a_spring_conserves_energy_and_one_too_stiff_for_the_step_gains_none() {
    for stiffness in [10.0, 1e4, 1e8] {
        let passive = Passive {
            stiffness,
            ..Passive::default()
        };
        let mut slide = Slide::new(0.1, passive);
        let mut amplitude = |steps: usize| {
            let swing = (0..steps).map(|_| {
                slide.step();
                slide.position.abs()
            });
            swing.fold(0.0, f64::max)
        };
        let early = amplitude(1000);
        amplitude(20_000);
        let late = amplitude(1000);
        assert!(
            (late / early - 1.0).abs() < 1e-2,
            "{stiffness}: {early} {late}"
        );
    }
}

#[test]
fn a_rotor_slows_a_pendulum() {
    let armature = 0.7;
    let mut rig = rig(JointKind::Revolute, Vector3::y(), 0.0, Vector3::x());
    rig.joint.passive.armature = armature;
    rig.begin(Vector3::new(0.0, 0.0, -9.81));
    let turn = MASS * 9.81 / (INERTIA + MASS + armature) * STEP;
    close(rig.velocity().1, Vector3::y() * turn);
}

#[test]
fn friction_holds_what_is_weaker_and_slows_what_slides() {
    let friction = Passive {
        friction: 3.0,
        ..Passive::default()
    };
    let mut held = Slide::new(0.0, friction);
    held.rig.body.force[0] = 2.9;
    held.step();
    assert_eq!(held.position, 0.0);
    let mut sliding = Slide::new(0.0, friction);
    sliding.rig.body.motion.velocity[0] = 1.0;
    nearly(sliding.after(0.2), 1.0 - 3.0 / MASS * 0.2);
    assert_eq!(sliding.after(1.0), 0.0);
}

#[test]
fn a_motor_bears_spring_damper_rotor_and_friction_beside_it() {
    let passive = Passive {
        armature: 5.0,
        stiffness: 20.0,
        damping: 4.0,
        friction: 3.0,
        ..Passive::default()
    };
    let mut driven = Slide::new(0.0, passive).with_motor(0.5, 1e6);
    // From rest: the mass and the rotor within a step.
    nearly(driven.step(), 0.5);
    let jerk = (MASS + 5.0 + 20.0 * STEP * STEP / 4.0) * 0.5 / STEP;
    nearly(driven.motor_force(), jerk + 4.0 * 0.5 + 3.0);
    driven.after(1.0);
    let stretched = 20.0 * (driven.position - 0.5 * STEP);
    nearly(driven.motor_force(), stretched + 4.0 * 0.5 + 3.0);
}

#[test]
fn a_weak_motor_moves_what_friction_and_damper_leave_it() {
    let passive = Passive {
        damping: 4.0,
        friction: 3.0,
        ..Passive::default()
    };
    let mut weak = Slide::new(0.0, passive).with_motor(100.0, 5.0);
    nearly(weak.after(8.0), (5.0 - 3.0) / 4.0);
    let mut weaker = Slide::new(0.0, passive).with_motor(100.0, 2.0);
    assert_eq!(weaker.after(1.0), 0.0);
    // A motor that keeps still holds together with friction.
    let mut brake = Slide::new(0.0, passive).with_motor(0.0, 2.0);
    brake.rig.body.force[0] = 4.9;
    assert_eq!(brake.step(), 0.0);
}

#[test]
fn a_limit_stops_an_axis_with_everything() {
    let passive = Passive {
        armature: 1.0,
        stiffness: 50.0,
        rest: 1.0,
        damping: 1.0,
        friction: 1.0,
        effort: 1.0,
    };
    let mut slide = Slide::new(0.0, passive);
    slide.rig.joint.limits = Some([-0.2, 0.2]);
    slide.after(2.0);
    nearly(slide.position, 0.2);
}

/// A motor or a limit that moves an axis at rest has friction against it, from the first step on.
#[test]
fn friction_opposes_what_sets_an_axis_in_motion() {
    let friction = Passive {
        friction: 3.0,
        ..Passive::default()
    };
    let mut driven = Slide::new(0.0, friction);
    // Friction holds at first, and then the motor moves.
    assert_eq!(driven.after(0.05), 0.0);
    driven.rig.joint.motor = Some(Motor {
        velocity: 0.5,
        max_force: 1e6,
    });
    nearly(driven.step(), 0.5);
    nearly(driven.motor_force(), MASS * 0.5 / STEP + 3.0);
    driven.rig.joint.motor = Some(Motor {
        velocity: -0.5,
        max_force: 1e6,
    });
    nearly(driven.step(), -0.5);
    nearly(driven.motor_force(), -MASS / STEP - 3.0);
    let mut pushed = Slide::new(0.3, friction);
    pushed.rig.joint.limits = Some([-0.2, 0.2]);
    // A fifth of what is missing, whatever friction holds.
    nearly(pushed.step(), -0.02 / STEP);
    let load = pushed.rig.mechanism.joint_loads().next().unwrap();
    nearly(load.rows.norm(), MASS * 0.02 / STEP / STEP);
}
