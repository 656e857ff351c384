//! Properties of shapes.

use super::access::{Accessor, object_properties};
use super::{PoseArray, Quaternion, Vector3};
use crate::scene::SceneError;
use crate::scene::pose::{pose_to_array, quaternion_to_array};

pub(super) const SHAPE: &[Accessor] = object_properties! {
    "respondableMask": i64, |o| o.shape()?.dynamics.respondable_mask,
        Dynamics |o, mask| o.shape_mut()?.dynamics.respondable_mask = mask;
    "startInDynSleepMode": bool, |o| o.shape()?.dynamics.start_asleep,
        Dynamics |o, on| o.shape_mut()?.dynamics.start_asleep = on;
    "dynamic": bool, |o| !o.shape()?.dynamics.is_static, Dynamics |o, on| o.shape_mut()?.dynamics.is_static = !on;
    "kinematic": bool, |o| o.shape()?.dynamics.kinematic, Dynamics |o, on| o.shape_mut()?.dynamics.kinematic = on;
    "respondable": bool, |o| o.shape()?.dynamics.respondable, Dynamics |o, on| o.shape_mut()?.dynamics.respondable = on;
    "setToDynamicWithParent": bool, |o| o.shape()?.dynamics.dynamic_when_parented,
        Dynamics |o, on| o.shape_mut()?.dynamics.dynamic_when_parented = on;
    "initLinearVelocity": Vector3, |o| Vector3(o.shape()?.dynamics.initial_velocity.linear),
        Dynamics |o, v| o.shape_mut()?.dynamics.initial_velocity.linear = v.0;
    "initAngularVelocity": Vector3, |o| Vector3(o.shape()?.dynamics.initial_velocity.angular),
        Dynamics |o, v| o.shape_mut()?.dynamics.initial_velocity.angular = v.0;
    "dynLinearVelocity": Vector3, |o| Vector3(o.shape()?.velocity.linear);
    "dynAngularVelocity": Vector3, |o| Vector3(o.shape()?.velocity.angular);
    "convex": bool, |o| o.shape()?.is_convex();
    "primitive": bool, |o| o.shape()?.is_pure();
    "compound": bool, |o| o.shape()?.is_compound();
};

pub(super) const BOX: &[Accessor] = object_properties! {
    "bbPose": PoseArray, |o| PoseArray(pose_to_array(&o.shape()?.bounding_box.pose));
    "bbHSize": Vector3, |o| Vector3(o.shape()?.bounding_box.size.map(|extent| extent / 2.0));
};

pub(super) const MASS: &[Accessor] = object_properties! {
    "mass": f64, |o| o.shape()?.mass.mass, Dynamics |o, mass| o.shape_mut()?.mass.set_mass(mass);
    "centerOfMass": Vector3, |o| Vector3(o.shape()?.mass.com), Dynamics |o, com| o.shape_mut()?.mass.com = com.0;
    "inertia": Vec<f64>, |o| o.shape()?.mass.absolute_inertia().to_vec(), Dynamics |o, tensor| {
        let mass = &mut o.shape_mut()?.mass;
        let tensor: &[f64; 9] = tensor.first_chunk().ok_or(SceneError::InvalidData)?;
        mass.set_absolute_inertia(tensor, &mass.com_matrix());
    };
    "principalMomentOfInertia": Vec<f64>, |o| o.shape()?.mass.principal_axes().1.to_vec();
    "pmiQuaternion": Quaternion, |o| Quaternion(quaternion_to_array(&o.shape()?.mass.principal_axes().0));
};
