//! The names that V-REP and CoppeliaSim up to 4.1 give new objects.

use geometry::primitive::PrimitiveKind;
use scene::joint::JointType;
use scene::shape::Shape;
use scene::{Kind, Object};

/// The name of an object that was just created.
pub(super) fn default_name(object: &Object) -> &'static str {
    match &object.kind {
        Kind::Shape(shape) => shape_name(shape),
        Kind::Joint(joint) => match joint.joint_type {
            JointType::Revolute => "Revolute_joint",
            JointType::Prismatic => "Prismatic_joint",
            JointType::Spherical => "Spherical_joint",
        },
        Kind::Graph(_) => "Graph",
        Kind::Camera(_) => "Camera",
        Kind::Dummy(_) => "Dummy",
        Kind::ProximitySensor(_) => "Proximity_sensor",
        Kind::Path(_) => "Path",
        Kind::VisionSensor(_) => "Vision_sensor",
        Kind::ForceSensor(_) => "Force_sensor",
        Kind::Light(_) => "Light",
        Kind::OcTree(_) => "Octree",
        Kind::PointCloud(_) => "Point_cloud",
        Kind::Script(_) => "Script",
    }
}

fn shape_name(shape: &Shape) -> &'static str {
    let primitive = match &shape.parts[..] {
        [part] => part.primitive.as_ref(),
        _ => None,
    };
    match primitive.map(|primitive| primitive.kind) {
        Some(PrimitiveKind::Plane) => "Plane",
        Some(PrimitiveKind::Disc) => "Disc",
        Some(PrimitiveKind::Cuboid) => "Cuboid",
        Some(PrimitiveKind::Spheroid) => "Sphere",
        Some(PrimitiveKind::Cylinder) => "Cylinder",
        Some(PrimitiveKind::Cone) => "Cone",
        Some(PrimitiveKind::Heightfield) => "Heightfield",
        Some(PrimitiveKind::Capsule) | None => "Shape",
    }
}
