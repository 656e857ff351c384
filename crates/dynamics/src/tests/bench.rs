//! Scenes built by hand: bodies, links between them, and steps of the physics without scripts.

use geometry::MassProperties;
use geometry::PrimitiveKind;

use super::super::*;
use scene::joint::JointType;
use scene::shape::Shape;
use scene::{Field, Kind, Pose};

pub(super) const STEP: f64 = 0.05;

/// A scene, and the physics that moves it.
pub(super) struct Bench {
    pub(super) scene: Scene,
    pub(super) dynamics: Dynamics,
    /// Of the last call.
    pub(super) triggers: Vec<Trigger>,
}

impl Bench {
    pub(super) fn new() -> Self {
        Self {
            scene: Scene::new(),
            dynamics: Dynamics::default(),
            triggers: Vec::new(),
        }
    }

    pub(super) fn shape(
        &mut self,
        size: [f64; 3],
        at: [f64; 3],
        mass: f64,
        dynamic: bool,
        respondable: bool,
    ) -> Handle {
        let mut shape =
            Shape::primitive(PrimitiveKind::Cuboid, size, Default::default()).expect("a cuboid");
        shape.mass = MassProperties {
            mass,
            com: [0.0; 3],
            ..MassProperties::diagonal(mass, [0.01; 3])
        };
        shape.dynamics.is_static = !dynamic;
        shape.dynamics.respondable = respondable;
        let handle = self
            .scene
            .add("body", Kind::Shape(Box::new(shape)))
            .expect("room");
        self.scene
            .set_world_pose(handle, Pose::translation(at[0], at[1], at[2]))
            .expect("exists");
        handle
    }

    pub(super) fn ghost(&mut self, at: [f64; 3], dynamic: bool) -> Handle {
        self.shape([0.1; 3], at, 1.0, dynamic, false)
    }

    pub(super) fn object(&mut self, kind: Kind, pose: Pose, parent: Handle) -> Handle {
        let handle = self.scene.add("link", kind).expect("room");
        self.scene.set_world_pose(handle, pose).expect("exists");
        self.scene
            .set_parent(handle, Some(parent), true)
            .expect("no cycle");
        handle
    }

    pub(super) fn hang(&mut self, child: Handle, parent: Handle) {
        self.scene
            .set_parent(child, Some(parent), true)
            .expect("no cycle");
    }

    pub(super) fn gravity(&mut self, z: f32) {
        self.scene
            .modify_settings(|settings| settings.dynamics.gravity = [0.0, 0.0, z]);
    }

    pub(super) fn run(&mut self, steps: usize) {
        self.run_asking(steps, None);
    }

    /// Steps with a script that decides about contacts.
    pub(super) fn run_asking(&mut self, steps: usize, callback: Option<ContactCallback<'_>>) {
        self.run_with(steps, callback, |_| (None, None));
    }

    /// Steps with a script that answers with velocity and force of joints in callback control, and one that decides about contacts.
    pub(super) fn run_with(
        &mut self,
        steps: usize,
        callback: Option<ContactCallback<'_>>,
        mut answer: impl FnMut(&JointRequest) -> (Option<f64>, Option<f64>),
    ) {
        for _ in 0..steps {
            let Some(call) = self
                .dynamics
                .begin(&mut self.scene, STEP)
                .expect("not busy")
            else {
                continue;
            };
            for number in 1..=call.sub_steps {
                for request in self.dynamics.prepare(&self.scene, number) {
                    let (velocity, force) = answer(&request);
                    self.dynamics.drive(request.joint, velocity, force);
                }
                self.sub_step(number, callback);
            }
            self.triggers = self.dynamics.end(&mut self.scene);
        }
    }

    /// The sub-steps of a call that was begun, without scripts.
    pub(super) fn sub_steps(&mut self, count: u32) {
        for number in 1..=count {
            self.dynamics.prepare(&self.scene, number);
            self.sub_step(number, None);
        }
        self.triggers = self.dynamics.end(&mut self.scene);
    }

    fn sub_step(&mut self, number: u32, callback: Option<ContactCallback<'_>>) {
        let verdicts = callback.map_or_else(Verdicts::default, |asked| {
            ask(self.dynamics.pairs_near(), asked)
        });
        let script_access = ScriptAccess {
            possible: callback.is_some(),
        };
        let started = self
            .dynamics
            .start_sub_step(&self.scene, number, script_access, verdicts);
        let mut sub_step = started.expect("there is a world");
        sub_step.run(callback);
        self.dynamics.finish_sub_step(sub_step, &mut self.scene);
    }

    /// Changes a shape.
    pub(super) fn change(&mut self, shape: Handle, change: impl FnOnce(&mut Shape)) {
        let changed = self.scene.try_modify(shape, Field::Dynamics, |object| {
            change(object.shape_mut()?);
            Ok(())
        });
        changed.expect("a shape");
    }

    /// A shape as it is now.
    pub(super) fn shape_of(&self, shape: Handle) -> &Shape {
        let object = self.scene.object(shape).expect("exists");
        object.shape().expect("a shape")
    }

    pub(super) fn pose(&self, handle: Handle) -> Pose {
        self.scene.world_pose(handle).expect("exists")
    }

    /// Place in the world, metres.
    pub(super) fn at(&self, handle: Handle) -> [f64; 3] {
        self.pose(handle).translation.vector.into()
    }

    /// A floor whose top is at height 0.
    pub(super) fn floor(&mut self) -> Handle {
        self.shape([10.0, 10.0, 0.1], [0.0, 0.0, -0.05], 1.0, false, true)
    }

    pub(super) fn height(&self, handle: Handle) -> f64 {
        self.scene.world_pose(handle).expect("exists").translation.z
    }

    /// Kinetic and potential, the engine's velocity being that of half a sub-step before.
    pub(super) fn energy(&self, handle: Handle) -> f64 {
        let object = self.scene.object(handle).expect("exists");
        let shape = object.shape().expect("a shape");
        let pose = self.scene.world_pose(handle).expect("exists");
        let spin = pose.rotation.inverse() * nalgebra::Vector3::from(shape.velocity.angular);
        let speed = nalgebra::Vector3::from(shape.velocity.linear);
        let mass = &shape.mass;
        let kinetic = (speed.dot(&speed) + spin.dot(&(mass.inertia * spin))) * mass.mass / 2.0;
        kinetic + mass.mass * 9.81 * pose.translation.z
    }

    pub(super) fn joint(&self, handle: Handle) -> &Joint {
        self.scene
            .object(handle)
            .and_then(|object| object.joint())
            .expect("a joint")
    }

    /// Static base, joint along world +y at (0, 0, 1), arm of 1 kg whose centre is `reach` along x.
    pub(super) fn arm(
        &mut self,
        own_inertia: f64,
        reach: f64,
        change: impl FnOnce(&mut Joint),
    ) -> (Handle, Handle) {
        let base = self.ghost([0.0, 0.0, 1.0], false);
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        change(&mut joint);
        let joint = self.object(Kind::Joint(Box::new(joint)), along_y([0.0, 0.0, 1.0]), base);
        let arm = self.ghost([reach, 0.0, 1.0], true);
        let mass = MassProperties::diagonal(1.0, [own_inertia; 3]);
        self.scene
            .try_modify(arm, Field::Dynamics, |object| {
                object.shape_mut()?.mass = mass;
                Ok(())
            })
            .expect("a shape");
        self.hang(arm, joint);
        (joint, arm)
    }
}

/// Turned so that a joint's axis points along world +y.
pub(super) fn along_y(at: [f64; 3]) -> Pose {
    let turn = nalgebra::UnitQuaternion::from_euler_angles(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
    Pose::from_parts(nalgebra::Translation3::from(at), turn)
}

pub(super) fn near(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} is not {expected}"
    );
}

/// Asks about pairs of shapes, in their order.
pub(super) fn ask(pairs: Vec<(Handle, Handle)>, callback: ContactCallback<'_>) -> Verdicts {
    let responses = pairs
        .iter()
        .map(|&(first, second)| callback(first, second))
        .collect();
    Verdicts::new(pairs, responses)
}
