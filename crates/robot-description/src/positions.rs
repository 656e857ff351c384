//! Where the links are at positions of the joints.

use nalgebra::{Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

use crate::limits;
use crate::model::{Joint, JointKind, Mimic, Pose, Robot};

/// Positions that do not belong to the robot.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the joints of '{robot}' have {expected} positions, not {found}")]
pub struct PositionError {
    /// Name of the robot.
    pub robot: String,
    /// Numbers of the positions of all its joints.
    pub expected: usize,
    /// Numbers that were given.
    pub found: usize,
}

impl Robot {
    /// How many numbers the positions of all joints have ([`JointKind::numbers`]).
    pub fn position_count(&self) -> usize {
        self.joints.iter().map(|joint| joint.kind.numbers()).sum()
    }

    /// The positions where all joints are at their zero.
    pub fn zero_positions(&self) -> Vec<f64> {
        let zero = |joint: &Joint| match joint.kind {
            JointKind::Spherical => vec![0.0, 0.0, 0.0, 1.0],
            JointKind::Floating => vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            kind => vec![0.0; kind.numbers()],
        };
        self.joints.iter().flat_map(zero).collect()
    }

    /// The frames of all links in the robot's frame. Positions are in the order of the joints; that of a joint that mimics another one is not looked at.
    ///
    /// # Errors
    ///
    /// If there are not as many positions as the joints have.
    pub fn link_poses(&self, positions: &[f64]) -> Result<Vec<Pose>, PositionError> {
        self.check_count(positions)?;
        let starts = self.position_starts();
        let parents = self.parent_joints();
        let mut poses: Vec<Pose> = self.links.iter().map(|link| link.pose).collect();
        for link in self.links_from_the_roots() {
            if let Some(index) = parents[link] {
                let joint = &self.joints[index];
                let motion = self.motion(index, positions, &starts);
                poses[link] = poses[joint.parent] * joint.origin * motion * joint.child_pose;
            }
        }
        Ok(poses)
    }

    /// For each joint with one number its position, where those that mimic others follow them; 0 for all other joints. `positions` are those of
    /// [`link_poses`](Self::link_poses).
    ///
    /// # Errors
    ///
    /// If there are not as many positions as the joints have.
    pub fn joint_positions(&self, positions: &[f64]) -> Result<Vec<f64>, PositionError> {
        self.check_count(positions)?;
        let starts = self.position_starts();
        let position = |(index, joint): (usize, &Joint)| match (joint.kind.numbers(), joint.mimic) {
            (1, None) => positions[starts[index]],
            (1, Some(_)) => self.mimicked(index, positions, &starts),
            _ => 0.0,
        };
        Ok(self.joints.iter().enumerate().map(position).collect())
    }

    fn check_count(&self, positions: &[f64]) -> Result<(), PositionError> {
        let expected = self.position_count();
        if positions.len() == expected {
            return Ok(());
        }
        Err(PositionError {
            robot: self.name.clone(),
            expected,
            found: positions.len(),
        })
    }

    fn position_starts(&self) -> Vec<usize> {
        let add = |start: &mut usize, joint: &Joint| {
            let at = *start;
            *start += joint.kind.numbers();
            Some(at)
        };
        self.joints.iter().scan(0, add).collect()
    }

    fn motion(&self, index: usize, positions: &[f64], starts: &[usize]) -> Pose {
        let joint = &self.joints[index];
        if joint.mimic.is_some() && joint.kind.numbers() == 1 {
            return joint.motion(&[self.mimicked(index, positions, starts)]);
        }
        joint.motion(&positions[starts[index]..starts[index] + joint.kind.numbers()])
    }

    /// The position that a chain of joints that mimic each other leads to.
    fn mimicked(&self, index: usize, positions: &[f64], starts: &[usize]) -> f64 {
        let Ok(Mimic {
            joint,
            multiplier,
            offset,
        }) = self.whole_mimic(index)
        else {
            return 0.0;
        };
        let master = if self.joints[joint].kind.numbers() == 1 {
            positions[starts[joint]]
        } else {
            0.0
        };
        multiplier * master + offset
    }

    /// How a joint mimics the first of a chain of joints that mimic each other; one that mimics none, itself. An error says why there is no such relation.
    pub(crate) fn whole_mimic(&self, index: usize) -> Result<Mimic, &'static str> {
        let mut whole = Mimic {
            joint: index,
            multiplier: 1.0,
            offset: 0.0,
        };
        for _ in 0..=limits::MIMIC_CHAIN {
            let Some(mimic) = self.joints[whole.joint].mimic else {
                let is_finite = whole.multiplier.is_finite() && whole.offset.is_finite();
                return is_finite
                    .then_some(whole)
                    .ok_or("mimics joints by numbers that are too large");
            };
            whole.offset += whole.multiplier * mimic.offset;
            whole.multiplier *= mimic.multiplier;
            whole.joint = mimic.joint;
        }
        Err("mimics joints without end")
    }
}

impl Joint {
    /// The axis with length 1; x if there is none.
    pub fn unit_axis(&self) -> Unit<Vector3<f64>> {
        Unit::try_new(Vector3::from(self.axis), 1e-9).unwrap_or_else(Vector3::x_axis)
    }

    /// How far a position of the joint moves its frame.
    pub(crate) fn motion(&self, position: &[f64]) -> Pose {
        let axis = self.unit_axis();
        match (self.kind, position) {
            (JointKind::Revolute | JointKind::Continuous, [angle]) => {
                Pose::from_parts(Translation3::identity(), turn(&axis, *angle))
            }
            (JointKind::Prismatic, [distance]) => {
                Translation3::from(axis.into_inner() * *distance).into()
            }
            (JointKind::Planar, [u, v, angle]) => {
                let to_axis = UnitQuaternion::rotation_between(&Vector3::z(), &axis)
                    .unwrap_or_else(|| {
                        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
                    });
                Pose::from_parts(
                    Translation3::from(to_axis * Vector3::new(*u, *v, 0.0)),
                    turn(&axis, *angle),
                )
            }
            (JointKind::Spherical, [x, y, z, w]) => {
                Pose::from_parts(Translation3::identity(), rotation([*x, *y, *z, *w]))
            }
            (JointKind::Floating, [px, py, pz, x, y, z, w]) => {
                Pose::from_parts(Translation3::new(*px, *py, *pz), rotation([*x, *y, *z, *w]))
            }
            _ => Pose::identity(),
        }
    }
}

/// A rotation about an axis, with sine and cosine that are the same on every machine.
pub(crate) fn turn(axis: &Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    let (sine, cosine) = libm::sincos(angle / 2.0);
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cosine, axis.into_inner() * sine))
}

fn rotation([x, y, z, w]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9).unwrap_or_default()
}

/// The rotation of roll, pitch and yaw: about x, then y, then z of the fixed frame.
pub fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> UnitQuaternion<f64> {
    turn(&Vector3::z_axis(), yaw) * turn(&Vector3::y_axis(), pitch) * turn(&Vector3::x_axis(), roll)
}

/// Roll, pitch and yaw of a rotation; where pitch is a quarter turn, yaw is 0.
pub fn to_rpy(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let m = rotation.to_rotation_matrix();
    let across = libm::hypot(m[(0, 0)], m[(1, 0)]);
    let pitch = libm::atan2(-m[(2, 0)], across);
    if across > 1e-7 {
        return [
            libm::atan2(m[(2, 1)], m[(2, 2)]),
            pitch,
            libm::atan2(m[(1, 0)], m[(0, 0)]),
        ];
    }
    [libm::atan2(-m[(1, 2)], m[(1, 1)]), pitch, 0.0]
}
