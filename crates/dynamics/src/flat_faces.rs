//! Contacts without friction push along the face they lie on.
//!
//! The normal of a contact of meshes is found iteratively, and is that of either body's facet: it is off by some milliradians. Friction hides that;
//! without it a body at rest would slide away and turn. So such a contact gets the normal of the face of what no force moves, which is level
//! where the author of the scene meant it to be.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::parry::shape::{PolygonalFeature, Shape};
use rapier3d_f64::prelude::{Collider, ContactModificationContext, RigidBody};

/// Cosine of the largest angle, 2 degrees, between normals that count as equal.
const MIN_NORMAL_COSINE: f64 = 0.9994;

/// Turns the normal of a contact without friction to that of the face of what no force moves.
pub(super) fn level(context: &mut ContactModificationContext<'_>) {
    let moves = [context.rigid_body1, context.rigid_body2].map(|body| {
        body.and_then(|body| context.bodies.get(body))
            .is_some_and(RigidBody::is_dynamic)
    });
    let side = match moves {
        [false, true] => 0,
        [true, false] => 1,
        _ => return,
    };
    let Some(collider) = context
        .colliders
        .get([context.collider1, context.collider2][side])
    else {
        return;
    };
    let Some(contact) = context.rigid_mut() else {
        return;
    };
    let part = [contact.manifold.subshape1, contact.manifold.subshape2][side];
    let sign = [1.0, -1.0][side];
    let Some(normal) = face_normal(collider, part, *contact.normal * sign) else {
        return;
    };
    *contact.normal = normal * sign;
    for point in contact.solver_contacts.iter_mut() {
        point.dist = (point.anchor2 - point.anchor1).dot(*contact.normal);
    }
}

/// The normal of the face of a collider, or of a part of it, that nearly looks that way; world axes.
fn face_normal(collider: &Collider, part: u32, direction: Vector) -> Option<Vector> {
    let Some(parts) = collider.shape().as_composite_shape() else {
        return face_of(collider.shape(), collider.position(), direction);
    };
    let mut found = None;
    parts.map_part_at(part, &mut |pose: Option<&EnginePose>,
                                  shape: &dyn Shape,
                                  _| {
        let pose = pose.map_or(*collider.position(), |pose| *collider.position() * *pose);
        found = face_of(shape, &pose, direction);
    });
    found
}

fn face_of(shape: &dyn Shape, pose: &EnginePose, direction: Vector) -> Option<Vector> {
    let (polygons, _) = shape.as_polygonal_feature_map()?;
    let local = pose.rotation.inverse() * direction;
    let mut face = PolygonalFeature::default();
    polygons.local_support_feature(local, &mut face);
    if face.num_vertices < 3 {
        return None;
    }
    let [a, b, c, _] = face.vertices;
    let normal = (b - a).cross(c - a).try_normalize()?;
    let normal = normal * normal.dot(local).signum();
    (normal.dot(local) > MIN_NORMAL_COSINE).then(|| pose.rotation * normal)
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Rotation;
    use rapier3d_f64::prelude::{ColliderBuilder, SharedShape};

    use super::*;

    fn tilted(angle: f64) -> Vector {
        Rotation::from_rotation_x(angle) * Vector::Z
    }

    #[test]
    fn a_face_counts_for_what_nearly_looks_its_way() {
        let ground = ColliderBuilder::cuboid(10.0, 10.0, 0.1).build();
        for angle in [0.0, 0.002, -0.03] {
            assert_eq!(
                face_normal(&ground, 0, tilted(angle)),
                Some(Vector::Z),
                "{angle}"
            );
        }
        assert_eq!(face_normal(&ground, 0, tilted(0.05)), None);
        assert_eq!(
            face_normal(&ColliderBuilder::ball(1.0).build(), 0, Vector::Z),
            None
        );
    }

    #[test]
    fn parts_of_a_compound_have_faces_of_their_own() {
        let slope = EnginePose::from_rotation(Rotation::from_rotation_x(0.5));
        let parts =
            [EnginePose::IDENTITY, slope].map(|pose| (pose, SharedShape::cuboid(1.0, 1.0, 0.1)));
        let both = ColliderBuilder::compound(parts.to_vec()).build();
        assert_eq!(face_normal(&both, 0, tilted(0.001)), Some(Vector::Z));
        let normal = face_normal(&both, 1, tilted(0.501)).expect("the second part is a slope");
        assert!((normal - tilted(0.5)).length() < 1e-12);
        assert_eq!(face_normal(&both, 1, Vector::Z), None);
    }
}
