//! Poses in their two orders.

use nalgebra::{Quaternion, UnitQuaternion};

use super::Value;
use crate::ttt::error::FileResult;
use crate::ttt::node::{Node, NodeResult};
use crate::ttt::read::{Reader, Real};
use crate::ttt::write::Writer;
use scene::Pose;

/// A pose that begins with its quaternion: w x y z, then the position.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RotationFirst(pub [f64; 7]);

/// A pose that begins with its position, then the quaternion, w x y z.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PositionFirst(pub [f64; 7]);

impl RotationFirst {
    /// With a quaternion of length one; nothing if a number is not finite.
    pub fn pose(&self) -> Option<Pose> {
        let [w, x, y, z, position @ ..] = self.0;
        pose(position, [w, x, y, z])
    }
}

impl From<Pose> for RotationFirst {
    fn from(pose: Pose) -> Self {
        let (q, p) = (pose.rotation, pose.translation);
        Self([q.w, q.i, q.j, q.k, p.x, p.y, p.z])
    }
}

impl PositionFirst {
    /// With a quaternion of length one; nothing if a number is not finite.
    pub fn pose(&self) -> Option<Pose> {
        let [x, y, z, rotation @ ..] = self.0;
        pose([x, y, z], rotation)
    }
}

impl From<Pose> for PositionFirst {
    fn from(pose: Pose) -> Self {
        let (q, p) = (pose.rotation, pose.translation);
        Self([p.x, p.y, p.z, q.w, q.i, q.j, q.k])
    }
}

fn pose(position: [f64; 3], rotation: [f64; 4]) -> Option<Pose> {
    position
        .iter()
        .chain(&rotation)
        .all(|n| n.is_finite())
        .then(|| Pose::from_parts(position.into(), unit_quaternion(rotation)))
}

/// The rotation w x y z, made one in length; none at all where the length is zero.
pub fn unit_quaternion([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12).unwrap_or_default()
}

macro_rules! wrapped {
    ($($name:ident),*) => {$(
        impl Value for $name {
            fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
                Value::read(input, real).map(Self)
            }
            fn write(&self, out: &mut Writer) {
                self.0.write(out);
            }
            fn to_node(&self) -> Node {
                self.0.to_node()
            }
            fn from_node(node: &Node) -> NodeResult<Self> {
                Value::from_node(node).map(Self)
            }
        }
    )*};
}

wrapped!(RotationFirst, PositionFirst);
