//! `simIK`: forward and inverse kinematics of mechanisms that are modelled in environments of their own (spec: kinematics).
//!
//! The solver is that of `kinematics`; the crate `ik` copies chains of the scene. What calls scripts again and again or needs other modules (options, postures that a callback
//! accepts, paths, overlays) is in `lua/modules/simIK.lua`.

mod elements;
mod environments;
mod groups;
mod joints;
mod objects;
mod poses;
mod scene;
mod solving;

use geometry::pose::{
    euler::rotation_from_euler, pose_from_array, pose_from_matrix, quaternion_from_array,
};
use geometry::{Finite, Pose};
use kinematics::{Frame, KinematicsError, ObjectId};
use nalgebra::UnitQuaternion;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use ::scene::{SceneError, special};
use environments::{Held, environment};

/// The module `simIK`.
pub static MODULE: Module = Module {
    about: "Forward and inverse kinematics of mechanisms.",
    functions: &[
        ("Environments", environments::FUNCTIONS),
        ("Objects", objects::FUNCTIONS),
        ("Poses", poses::FUNCTIONS),
        ("Joints", joints::FUNCTIONS),
        ("Groups", groups::FUNCTIONS),
        ("Elements", elements::FUNCTIONS),
        ("Calculations", solving::FUNCTIONS),
        ("Scene", scene::FUNCTIONS),
    ],
    constants: include_str!("constants.tsv"),
    aliases: include_str!("aliases.tsv"),
    plugin_errors: true,
    ..Module::new("simIK")
};

/// Reads or changes an environment.
fn with<R>(
    cx: &Cx,
    handle: i64,
    work: impl FnOnce(&mut Held) -> kinematics::Result<R>,
) -> Result<R> {
    let held = environment(cx, handle)?;
    let mut held = held.try_borrow_mut().map_err(|_| busy())?;
    Ok(work(&mut held)?)
}

fn busy() -> ApiError {
    refused("the environment is being calculated.")
}

fn refused(why: &str) -> ApiError {
    SceneError::Refused(why.into()).into()
}

fn object(raw: i64) -> kinematics::Result<ObjectId> {
    ObjectId::from_raw(raw).ok_or(KinematicsError::NoSuchObject)
}

/// An object, or none where a script says -1.
fn optional(raw: i64) -> kinematics::Result<Option<ObjectId>> {
    if raw == special::WORLD {
        Ok(None)
    } else {
        object(raw).map(Some)
    }
}

fn raw(id: Option<ObjectId>) -> i64 {
    id.map_or(-1, ObjectId::raw)
}

fn frame(raw: i64) -> kinematics::Result<Frame> {
    match raw {
        special::WORLD => Ok(Frame::World),
        special::PARENT => Ok(Frame::Parent),
        _ => object(raw).map(Frame::Object),
    }
}

/// A pose of seven numbers, or a matrix of twelve.
fn transform(numbers: &[f64]) -> Result<Pose> {
    let numbers = numbers.finite().ok_or(KinematicsError::NotFinite)?;
    match (numbers.first_chunk::<12>(), numbers.first_chunk::<7>()) {
        (Some(matrix), _) => Ok(pose_from_matrix(matrix)),
        (None, Some(pose)) => Ok(pose_from_array(pose)),
        (None, None) => Err(ApiError::TableSize),
    }
}

/// Three Euler angles, or a quaternion of four numbers.
fn rotation(numbers: &[f64]) -> Result<UnitQuaternion<f64>> {
    let numbers = numbers.finite().ok_or(KinematicsError::NotFinite)?;
    match (numbers.first_chunk::<4>(), numbers.first_chunk::<3>()) {
        (Some(quaternion), _) => Ok(quaternion_from_array(quaternion)),
        (None, Some(angles)) => Ok(rotation_from_euler(angles)),
        (None, None) => Err(ApiError::TableSize),
    }
}

fn finite<T: Finite>(value: T) -> Result<T> {
    Ok(value.finite().ok_or(KinematicsError::NotFinite)?)
}
