//! The physics of gymnasium's half cheetah alone: microseconds of a sub-step of 10 ms while it runs, and while it lies on the ground.
//!
//!     cargo bench -p swanilda-dynamics [--bench cheetah -- STEPS]

use std::time::Instant;

use dynamics::{Dynamics, ScriptAccess, Verdicts};
use geometry::{MassProperties, PrimitiveKind};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use scene::joint::{Control, Joint, JointMode, JointType, Passive};
use scene::parameters::engine::Engine;
use scene::shape::Shape;
use scene::{Field, Handle, Kind, Pose, Scene};

#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

/// Of a step, seconds.
const STEP: f64 = 0.05;
const RADIUS: f64 = 0.046;
const RUNS: usize = 15;
/// Largest torque of each motor, N m.
const TORQUES: [f64; 6] = [120.0, 90.0, 60.0, 120.0, 60.0, 30.0];

/// A link of a leg, in the frame of the link before: joint, middle of the capsule, its turn about y, half of its length, range and passive values of the joint.
struct Link {
    at: [f64; 2],
    middle: [f64; 2],
    turn: f64,
    half_length: f64,
    range: [f64; 2],
    stiffness: f64,
    damping: f64,
}

const fn link(
    at: [f64; 2],
    middle: [f64; 2],
    turn: f64,
    half_length: f64,
    range: [f64; 2],
    [stiffness, damping]: [f64; 2],
) -> Link {
    Link {
        at,
        middle,
        turn,
        half_length,
        range,
        stiffness,
        damping,
    }
}

const LEGS: [[Link; 3]; 2] = [
    [
        link(
            [-0.5, 0.0],
            [0.1, -0.13],
            -3.8,
            0.145,
            [-0.52, 1.05],
            [240.0, 6.0],
        ),
        link(
            [0.16, -0.25],
            [-0.14, -0.07],
            -2.03,
            0.15,
            [-0.785, 0.785],
            [180.0, 4.5],
        ),
        link(
            [-0.28, -0.14],
            [0.03, -0.097],
            -0.27,
            0.094,
            [-0.4, 0.785],
            [120.0, 3.0],
        ),
    ],
    [
        link(
            [0.5, 0.0],
            [-0.07, -0.12],
            0.52,
            0.133,
            [-1.0, 0.7],
            [180.0, 4.5],
        ),
        link(
            [-0.14, -0.24],
            [0.065, -0.09],
            -0.6,
            0.106,
            [-1.2, 0.87],
            [120.0, 3.0],
        ),
        link(
            [0.13, -0.18],
            [0.045, -0.07],
            -0.6,
            0.07,
            [-0.5, 0.5],
            [60.0, 1.5],
        ),
    ],
];

fn pose([x, z]: [f64; 2], turn: f64) -> Pose {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::y() * turn);
    Pose::from_parts(Translation3::new(x, 0.0, z), turn)
}

/// The robot with its floor.
struct Cheetah {
    scene: Scene,
    dynamics: Dynamics,
    motors: Vec<Handle>,
    torso: Handle,
}

impl Cheetah {
    fn new() -> Self {
        let mut cheetah = Self {
            scene: Scene::new(),
            dynamics: Dynamics::default(),
            motors: Vec::new(),
            torso: Handle(0),
        };
        cheetah.scene.modify_settings(|settings| {
            settings.dynamics.engine.engine = Engine::Mujoco;
            settings.dynamics.step = 0.01;
        });
        let floor = cheetah.shape(
            PrimitiveKind::Cuboid,
            [80.0, 80.0, 0.2],
            pose([0.0, -0.1], 0.0),
            None,
        );
        cheetah.change(floor, |shape| shape.dynamics.is_static = true);
        // Links of one tree touch by the lower bits of their masks only, which these have not.
        let base = cheetah.shape(
            PrimitiveKind::Cuboid,
            [0.01; 3],
            pose([0.0, 0.7], 0.0),
            None,
        );
        cheetah.change(base, |shape| {
            (shape.dynamics.is_static, shape.dynamics.respondable) = (true, false);
        });
        let first = cheetah.slide(
            base,
            UnitQuaternion::rotation_between(&Vector3::z(), &Vector3::x()),
        );
        let second = cheetah.slide(first, Some(UnitQuaternion::identity()));
        let hinge = cheetah.hinge(second, &pose([0.0, 0.7], 0.0));
        let torso = cheetah.capsule(&pose([0.0, 0.7], std::f64::consts::FRAC_PI_2), 0.5, hinge);
        cheetah.torso = torso;
        for leg in &LEGS {
            let (mut parent, mut frame) = (torso, pose([0.0, 0.7], 0.0));
            for link in leg {
                frame *= pose(link.at, 0.0);
                let joint = cheetah.hinge(parent, &frame);
                let passive = Passive {
                    armature: 0.1,
                    stiffness: link.stiffness,
                    damping: link.damping,
                    ..Passive::default()
                };
                cheetah.set_joint(joint, |joint| {
                    joint.set_passive(&passive);
                    (joint.cyclic, joint.min) = (false, link.range[0]);
                    joint.range = link.range[1] - link.range[0];
                    joint.control = Control::Force;
                });
                cheetah.motors.push(joint);
                parent = cheetah.capsule(
                    &(frame * pose(link.middle, link.turn)),
                    link.half_length,
                    joint,
                );
            }
        }
        cheetah
    }

    fn shape(
        &mut self,
        kind: PrimitiveKind,
        size: [f64; 3],
        at: Pose,
        parent: Option<Handle>,
    ) -> Handle {
        let shape = Shape::primitive(kind, size, Default::default()).expect("a primitive");
        let handle = self
            .scene
            .add("body", Kind::Shape(Box::new(shape)))
            .expect("room");
        self.scene.set_world_pose(handle, at).expect("exists");
        self.scene
            .set_parent(handle, parent, true)
            .expect("no circle");
        self.change(handle, |shape| {
            shape.dynamics.is_static = false;
            shape.dynamics.respondable = true;
            shape.dynamics.respondable_mask = scene::shape::RespondableMask(0xff00);
        });
        handle
    }

    fn change(&mut self, shape: Handle, change: impl FnOnce(&mut Shape)) {
        let changed = self.scene.try_modify(shape, Field::Dynamics, |object| {
            change(object.shape_mut()?);
            Ok(())
        });
        changed.expect("a shape");
    }

    fn set_joint(&mut self, joint: Handle, change: impl FnOnce(&mut Joint)) {
        let changed = self.scene.try_modify(joint, Field::Joint, |object| {
            change(object.joint_mut()?);
            Ok(())
        });
        changed.expect("a joint");
    }

    fn capsule(&mut self, at: &Pose, half_length: f64, parent: Handle) -> Handle {
        let size = [2.0 * RADIUS, 2.0 * RADIUS, 2.0 * (half_length + RADIUS)];
        let handle = self.shape(PrimitiveKind::Capsule, size, *at, Some(parent));
        let (mass, length) = (4.0 * half_length + 0.5, 2.0 * (half_length + RADIUS));
        let across = length * length / 12.0;
        self.change(handle, |shape| {
            shape.mass = MassProperties::diagonal(mass, [across, across, RADIUS * RADIUS / 2.0]);
        });
        handle
    }

    fn joint(&mut self, kind: JointType, at: Pose, parent: Handle) -> Handle {
        let joint = Kind::Joint(Box::new(Joint::new(kind, JointMode::Dynamic)));
        let handle = self.scene.add("joint", joint).expect("room");
        self.scene.set_world_pose(handle, at).expect("exists");
        self.scene
            .set_parent(handle, Some(parent), true)
            .expect("no circle");
        handle
    }

    fn hinge(&mut self, parent: Handle, at: &Pose) -> Handle {
        let along_y = UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
        self.joint(
            JointType::Revolute,
            Pose::from_parts(at.translation, along_y),
            parent,
        )
    }

    /// A prismatic joint, and a body on it that touches nothing.
    fn slide(&mut self, parent: Handle, turn: Option<UnitQuaternion<f64>>) -> Handle {
        let at = Pose::from_parts(Translation3::new(0.0, 0.0, 0.7), turn.unwrap_or_default());
        let joint = self.joint(JointType::Prismatic, at, parent);
        self.set_joint(joint, |joint| joint.cyclic = true);
        let carrier = self.shape(
            PrimitiveKind::Cuboid,
            [0.01; 3],
            pose([0.0, 0.7], 0.0),
            Some(joint),
        );
        self.change(carrier, |shape| {
            shape.dynamics.respondable = false;
            shape.mass = MassProperties::diagonal(1e-3, [1e-5; 3]);
        });
        carrier
    }

    fn step(&mut self) -> u32 {
        let begun = self
            .dynamics
            .begin(&mut self.scene, STEP)
            .expect("not busy");
        let call = begun.expect("bodies that move");
        for number in 1..=call.sub_steps {
            self.dynamics.prepare(&self.scene, number);
            let (access, verdicts) = (ScriptAccess::default(), Verdicts::default());
            let started = self
                .dynamics
                .start_sub_step(&self.scene, number, access, verdicts);
            let mut sub_step = started.expect("a world");
            sub_step.run(None);
            self.dynamics.finish_sub_step(sub_step, &mut self.scene);
        }
        self.dynamics.end(&mut self.scene);
        call.sub_steps
    }
}

/// Numbers between -1 and 1 (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn signed(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Microseconds of a sub-step; `effort`: the part of their torque that motors use.
#[allow(clippy::disallowed_methods, reason = "how long it takes is the result")]
fn measure(steps: usize, effort: f64) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let (mut cheetah, mut random) = (Cheetah::new(), Random(1));
        for _ in 0..20 {
            cheetah.step();
        }
        let (mut elapsed, mut sub_steps) = (0.0, 0);
        for _ in 0..steps {
            for (joint, largest) in cheetah.motors.clone().into_iter().zip(TORQUES) {
                let torque = effort * largest * random.signed();
                let set = cheetah
                    .scene
                    .try_modify(joint, Field::JointControl, |object| {
                        object.joint_mut()?.target_force = torque;
                        Ok(())
                    });
                set.expect("a joint");
            }
            let began = Instant::now();
            sub_steps += cheetah.step();
            elapsed += began.elapsed().as_secs_f64();
        }
        best = best.min(1e6 * elapsed / f64::from(sub_steps));
    }
    best
}

fn main() {
    let steps = std::env::args().find_map(|arg| arg.parse().ok());
    let steps = steps.unwrap_or(300);
    for (name, effort) in [("runs", 0.3), ("lies", 0.0)] {
        println!("{name}: {:.2} us a sub-step", measure(steps, effort));
    }
}
