//! Arms and random chains for tests and benches.
#![allow(dead_code, reason = "each program uses a part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use kinematics::*;
use nalgebra::{Translation3, UnitQuaternion, Vector3};

/// An arm with its group, whose element is constrained in the full pose unless said otherwise.
pub struct Arm {
    pub env: Environment,
    pub joints: Vec<ObjectId>,
    pub tip: ObjectId,
    pub target: ObjectId,
    pub group: GroupId,
    pub element: ElementId,
}

/// A pose from a position and a rotation about x, then z.
fn step(x: f64, y: f64, z: f64, about_x: f64) -> Pose {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), about_x);
    Pose::from_parts(Translation3::new(x, y, z), turn)
}

impl Arm {
    /// Joints with fixed transforms before them and to the tip.
    pub fn new(links: &[(JointType, Pose)], to_tip: Pose) -> Self {
        let mut env = Environment::new(7);
        let mut joints: Vec<ObjectId> = Vec::new();
        for (i, (joint_type, before)) in links.iter().enumerate() {
            let joint = env.create_joint(&format!("joint{i}"), *joint_type);
            env.set_parent(joint, joints.last().copied(), false)
                .unwrap();
            env.set_pose(joint, *before, Frame::Parent).unwrap();
            joints.push(joint);
        }
        let (tip, target) = (env.create_dummy("tip"), env.create_dummy("target"));
        env.set_parent(tip, joints.last().copied(), false).unwrap();
        env.set_pose(tip, to_tip, Frame::Parent).unwrap();
        env.set_partner(tip, Some(target)).unwrap();
        let group = env.create_group("arm");
        let element = env.add_element(group, tip).unwrap();
        env.element_mut(group, element).unwrap().constraints = Constraints::POSE;
        let mut arm = Self {
            env,
            joints,
            tip,
            target,
            group,
            element,
        };
        arm.reach();
        arm
    }

    /// Two revolute joints about z with links of half a metre.
    pub fn planar() -> Self {
        let mut arm = Self::new(
            &[
                (JointType::Revolute, Pose::identity()),
                (JointType::Revolute, Pose::translation(0.5, 0.0, 0.0)),
            ],
            Pose::translation(0.5, 0.0, 0.0),
        );
        arm.set_config(&[0.3, 0.6]);
        arm.reach();
        arm
    }

    /// With the lengths of Universal Robots' UR5, all joints within half a turn.
    pub fn ur5() -> Self {
        use std::f64::consts::FRAC_PI_2 as Q;
        // Denavit-Hartenberg: d, a, alpha.
        let rows = [
            (0.089159, 0.0, Q),
            (0.0, -0.425, 0.0),
            (0.0, -0.39225, 0.0),
            (0.10915, 0.0, Q),
            (0.09465, 0.0, -Q),
            (0.0823, 0.0, 0.0),
        ];
        let mut before = Pose::identity();
        let mut links = Vec::new();
        for (d, a, alpha) in rows {
            links.push((JointType::Revolute, before));
            before = step(a, 0.0, d, alpha);
        }
        let mut arm = Self::new(&links, before);
        arm.limit(&[(-std::f64::consts::PI, std::f64::consts::PI); 6]);
        arm
    }

    /// With the lengths and limits of Franka Emika's Panda.
    pub fn panda() -> Self {
        use std::f64::consts::FRAC_PI_2 as Q;
        // Modified Denavit-Hartenberg: a, d, alpha before each joint.
        let rows = [
            (0.0, 0.333, 0.0),
            (0.0, 0.0, -Q),
            (0.0, 0.316, Q),
            (0.0825, 0.0, Q),
            (-0.0825, 0.384, -Q),
            (0.0, 0.0, Q),
            (0.088, 0.0, Q),
        ];
        let links: Vec<(JointType, Pose)> = rows
            .map(|(a, d, alpha)| {
                (
                    JointType::Revolute,
                    step(a, 0.0, 0.0, alpha) * Pose::translation(0.0, 0.0, d),
                )
            })
            .to_vec();
        let mut arm = Self::new(&links, Pose::translation(0.0, 0.0, 0.107));
        arm.limit(&[
            (-2.8973, 2.8973),
            (-1.7628, 1.7628),
            (-2.8973, 2.8973),
            (-3.0718, -0.0698),
            (-2.8973, 2.8973),
            (-0.0175, 3.7525),
            (-2.8973, 2.8973),
        ]);
        arm
    }

    pub fn limit(&mut self, limits: &[(f64, f64)]) {
        for (joint, (low, high)) in self.joints.iter().zip(limits) {
            let joint = self.env.joint_mut(*joint).unwrap();
            (joint.cyclic, joint.min, joint.range) = (false, *low, high - low);
            let middle = 0.5 * (low + high);
            joint.position = if joint.position < *low || joint.position > *high {
                middle
            } else {
                joint.position
            };
        }
    }

    pub fn set_config(&mut self, config: &[f64]) {
        for (joint, position) in self.joints.iter().zip(config) {
            self.env.set_joint_position(*joint, *position).unwrap();
        }
    }

    pub fn config(&self) -> Vec<f64> {
        self.joints
            .iter()
            .map(|joint| self.env.joint(*joint).unwrap().position)
            .collect()
    }

    pub fn tip_pose(&self) -> Pose {
        self.env.pose(self.tip, Frame::World).unwrap()
    }

    /// Puts the target where the tip is.
    pub fn reach(&mut self) {
        self.aim(self.tip_pose());
    }

    pub fn aim(&mut self, pose: Pose) {
        self.env.set_pose(self.target, pose, Frame::World).unwrap();
    }

    /// Distance and angle between tip and target, computed from the poses.
    pub fn gap(&self) -> [f64; 2] {
        let (tip, target) = (
            self.tip_pose(),
            self.env.pose(self.target, Frame::World).unwrap(),
        );
        [
            (tip.translation.vector - target.translation.vector).norm(),
            tip.rotation.angle_to(&target.rotation),
        ]
    }

    pub fn set_element(&mut self, change: impl FnOnce(&mut Element)) {
        change(self.env.element_mut(self.group, self.element).unwrap());
    }

    pub fn set_group(&mut self, change: impl FnOnce(&mut Group)) {
        change(self.env.group_mut(self.group).unwrap());
    }

    pub fn handle(&mut self) -> Outcome {
        self.env.handle(&[self.group]).unwrap()
    }

    /// A config within the limits.
    pub fn random_config(&self, random: &mut Random) -> Vec<f64> {
        let draw = |joint: &ObjectId| {
            let [low, high] = self
                .env
                .joint(*joint)
                .unwrap()
                .limits()
                .unwrap_or([-3.0, 3.0]);
            low + random.uniform() * (high - low)
        };
        self.joints.iter().map(draw).collect()
    }
}

/// A chain of revolute, prismatic and screw joints with random transforms between them.
pub fn random_chain(random: &mut Random, joints: usize) -> Arm {
    let pose = |random: &mut Random| {
        let vector = Vector3::from_fn(|_, _| random.uniform() - 0.5);
        let turn = Vector3::from_fn(|_, _| 4.0 * (random.uniform() - 0.5));
        Pose::from_parts(vector.into(), UnitQuaternion::from_scaled_axis(turn))
    };
    let kinds: Vec<bool> = (0..joints).map(|_| random.uniform() < 0.2).collect();
    let links: Vec<(JointType, Pose)> = kinds
        .iter()
        .map(|prismatic| {
            (
                if *prismatic {
                    JointType::Prismatic
                } else {
                    JointType::Revolute
                },
                pose(random),
            )
        })
        .collect();
    let mut arm = Arm::new(&links, pose(random));
    for (joint, prismatic) in arm.joints.clone().into_iter().zip(kinds) {
        if !prismatic && random.uniform() < 0.2 {
            arm.env.joint_mut(joint).unwrap().screw_lead = 0.1;
        }
        if random.uniform() < 0.5 {
            let joint = arm.env.joint_mut(joint).unwrap();
            (joint.cyclic, joint.min, joint.range) = (false, -1.5, 3.0);
        }
    }
    arm
}
