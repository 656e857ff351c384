//! The edge between the scene's maths (nalgebra) and rapier's (glam).

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier3d_f64::math::{Pose as EnginePose, Rotation, Vector};

use scene::Pose;

pub(super) fn to_vector(v: [f64; 3]) -> Vector {
    Vector::new(v[0], v[1], v[2])
}

pub(super) fn from_vector(v: Vector) -> [f64; 3] {
    [v.x, v.y, v.z]
}

pub(super) fn to_rotation(rotation: &UnitQuaternion<f64>) -> Rotation {
    Rotation::from_xyzw(rotation.i, rotation.j, rotation.k, rotation.w)
}

pub(super) fn to_pose(pose: &Pose) -> EnginePose {
    EnginePose::from_parts(
        to_vector(pose.translation.vector.into()),
        to_rotation(&pose.rotation),
    )
}

pub(super) fn from_pose(pose: &EnginePose) -> Pose {
    let (t, r) = (pose.translation, pose.rotation);
    Pose::from_parts(
        Translation3::from(Vector3::new(t.x, t.y, t.z)),
        UnitQuaternion::new_normalize(Quaternion::new(r.w, r.x, r.y, r.z)),
    )
}
