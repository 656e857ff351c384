//! Properties of shapes.

use geometry::Finite;
use geometry::pose::quaternion_to_array;

use super::access::{Accessor, object_properties, refused};
use super::{Color, Quaternion, Vector3};
use crate::error::ApiError;
use scene::Field;
use scene::shape::RespondableMask;

pub(in crate::property) const SHAPE: &[Accessor] = object_properties! {
    "respondableMask": i64, |o| o.shape()?.dynamics.respondable_mask.0,
        Dynamics |o, mask| o.shape_mut()?.dynamics.respondable_mask = RespondableMask(mask);
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
    "meshes": Vec<i64>, |o| o.shape()?.parts.iter().map(|part| part.uid).collect();
    "convex": bool, |o| o.shape()?.is_convex();
    "primitive": bool, |o| o.shape()?.is_pure();
    "compound": bool, |o| o.shape()?.is_compound();
};

/// A row that changes every mesh of a shape and cannot be read.
macro_rules! applied {
    ($($name:literal: $ty:ty, $field:ident |$part:ident, $v:ident| $set:expr;)*) => { &[ $(
        Accessor {
            name: $name,
            read: None,
            write: Some(|subject, data| {
                let $v = <$ty as super::PropertyValue>::from_data(data).ok_or(ApiError::PropertyType)?;
                let handle = subject.object()?;
                subject.sim.scene.borrow_mut().try_modify(handle, Field::$field, |object| {
                    object.shape_mut()?.parts.iter_mut().for_each(|$part| $set);
                    Ok(())
                })?;
                Ok(())
            }),
        },
    )* ] };
}

pub(in crate::property) const APPLY: &[Accessor] = applied! {
    "applyCulling": bool, Appearance |part, on| part.appearance.culling = on;
    "applyShadingAngle": f64, Appearance |part, angle| part.appearance.shading_angle = angle;
    "applyShowEdges": bool, Appearance |part, on| part.appearance.edges = on;
    "applyColor.diffuse": Color, Appearance |part, rgb| part.appearance.colour.ambient_diffuse = rgb.to_f32();
    "applyColor.specular": Color, Appearance |part, rgb| part.appearance.colour.specular = rgb.to_f32();
    "applyColor.emission": Color, Appearance |part, rgb| part.appearance.colour.emission = rgb.to_f32();
    "applyColor.transparency": f64, Appearance |part, transparency| {
        part.appearance.colour.opacity = 1.0 - numbers::single(transparency);
    };
    "flipFaces": bool, Geometry |part, on| if on { part.flip_faces() };
};

pub(in crate::property) const MASS: &[Accessor] = object_properties! {
    "mass": f64, |o| o.shape()?.mass.mass, Geometry |o, mass| {
        o.shape_mut()?.mass.set_mass(mass.finite().ok_or_else(refused)?);
        o.dynamics_reset = true;
    };
    "centerOfMass": Vector3, |o| Vector3(o.shape()?.mass.com), Geometry |o, com| {
        o.shape_mut()?.mass.com = com.0;
        o.dynamics_reset = true;
    };
    // Per unit of mass, unlike sim.getShapeInertia.
    "inertia": Vec<f64>, |o| { let mass = &o.shape()?.mass; mass.absolute_inertia().map(|moment| moment / mass.mass).to_vec() },
    Geometry |o, tensor| {
        let mass = &mut o.shape_mut()?.mass;
        let tensor: &[f64; 9] = tensor.first_chunk().ok_or_else(refused)?;
        mass.set_absolute_inertia(&tensor.map(|moment| moment * mass.mass), &mass.com_matrix());
        o.dynamics_reset = true;
    };
    "principalMomentOfInertia": Vec<f64>, |o| o.shape()?.mass.principal_axes().1.to_vec();
    "pmiQuaternion": Quaternion, |o| Quaternion(quaternion_to_array(&o.shape()?.mass.principal_axes().0));
};
