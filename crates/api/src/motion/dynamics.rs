//! `sim.*`: forces, velocities, contacts, readings of joints and force sensors.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::{Field, Handle, Object, SceneError, flag, special};
use script::{Number, ObjectRef};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    add_force,
    add_force_and_torque,
    get_velocity,
    reset_dynamic_object,
    is_dynamically_enabled,
    get_contact_info,
    read_force_sensor,
    break_force_sensor,
    get_joint_force,
];

/// Adds a force to a shape for the next dynamics call. Static shapes do not feel it.
///
/// @param shapeHandle the shape, optionally with sim.handleflag_resetforce and sim.handleflag_resettorque
/// @param position where the force acts, relative to the centre of mass, in the axes of the shape, metres
/// @param force in the axes of the shape, newtons
#[api("sim.addForce")]
fn add_force(
    cx: &mut Cx,
    shape_handle: ObjectRef,
    position: [f64; 3],
    force: [f64; 3],
) -> Result<i64> {
    let rotation = cx.scene().world_pose(shape_handle.handle)?.rotation;
    let world = |v: nalgebra::Vector3<f64>| -> [f64; 3] { (rotation * v).into() };
    let (lever, force) = (
        nalgebra::Vector3::from(position),
        nalgebra::Vector3::from(force),
    );
    accumulate(cx, shape_handle, world(force), world(lever.cross(&force)))
}

/// Adds a force and a torque to a shape for the next dynamics call; they act at its centre of mass. Static shapes do not feel them.
///
/// @param shapeHandle the shape, optionally with sim.handleflag_resetforce and sim.handleflag_resettorque
/// @param force world axes, newtons
/// @param torque world axes, newton metres
#[api("sim.addForceAndTorque")]
fn add_force_and_torque(
    cx: &mut Cx,
    shape_handle: ObjectRef,
    #[default([0.0; 3])] force: [f64; 3],
    #[default([0.0; 3])] torque: [f64; 3],
) -> Result<i64> {
    accumulate(cx, shape_handle, force, torque)
}

fn accumulate(cx: &mut Cx, target: ObjectRef, force: [f64; 3], torque: [f64; 3]) -> Result<i64> {
    let resets = (
        target.has(flag::RESET_FORCE),
        target.has(flag::RESET_TORQUE),
    );
    cx.scene_mut()
        .try_modify(target.handle, Field::Pose, |object| {
            let shape = object.shape_mut()?;
            if resets.0 {
                shape.force = [0.0; 3];
            }
            if resets.1 {
                shape.torque = [0.0; 3];
            }
            for axis in 0..3 {
                shape.force[axis] += force[axis];
                shape.torque[axis] += torque[axis];
            }
            Ok(())
        })?;
    Ok(1)
}

/// Velocity of a shape as the last dynamics call left it, at its centre of mass.
///
/// @param shapeHandle the shape
/// @return linearVelocity world axes, m/s
/// @return angularVelocity world axes, rad/s
#[api("sim.getVelocity")]
fn get_velocity(cx: &Cx, shape_handle: Handle) -> Result<([f64; 3], [f64; 3])> {
    let velocity = cx.scene().object(shape_handle)?.shape()?.velocity;
    Ok((velocity.linear, velocity.angular))
}

/// Resets an object in the physics at the next dynamics call: it loses its velocity.
///
/// @param objectHandle the object, with sim.handleflag_model also everything below it, or sim.handle_all
#[api("sim.resetDynamicObject")]
fn reset_dynamic_object(cx: &mut Cx, object_handle: Number) -> Result<i64> {
    let object_handle = object_handle.0;
    let scene = &mut *cx.scene_mut();
    let objects = match Handle::from_raw(object_handle) {
        _ if object_handle == special::ALL => scene.objects().map(Object::handle).collect(),
        Some(handle) if object_handle & MODEL != 0 => scene.subtree(handle),
        Some(handle) => vec![handle],
        None => return Err(SceneError::NoSuchObject.into()),
    };
    for handle in objects {
        scene.modify(handle, Field::Dynamics, |object| {
            object.dynamics_reset = true;
        })?;
    }
    Ok(1)
}

/// `sim.handleflag_model`.
const MODEL: i64 = 0x80_0000;

/// Whether a shape, joint or force sensor is dynamically simulated. False while the simulation is stopped.
///
/// @param objectHandle the object
/// @return enabled whether it takes part
#[api("sim.isDynamicallyEnabled")]
fn is_dynamically_enabled(cx: &Cx, object_handle: Handle) -> Result<bool> {
    cx.scene().object(object_handle)?;
    Ok(cx
        .dynamics()
        .is_some_and(|dynamics| dynamics.simulates(object_handle)))
}

/// A contact of the last dynamics call. Four empty tables when there is none with that index.
///
/// @param dynamicPass index of the sub-step, from 0, or sim.handle_all
/// @param objectHandle a shape, or sim.handle_all; the shape then comes first in the result
/// @param index from 0; sim.handleflag_extended may be added, which changes nothing
/// @return collidingObjects the two shapes
/// @return collisionPoint world, metres
/// @return reactionForce what the second shape does to the first, world axes, newtons
/// @return normalVector points to the first shape, world axes
#[api("sim.getContactInfo")]
fn get_contact_info(
    cx: &Cx,
    dynamic_pass: i64,
    object_handle: i64,
    index: i64,
) -> Result<ContactInfo> {
    let shape = if object_handle == special::ALL {
        None
    } else {
        Some(existing(cx, object_handle)?)
    };
    let dynamics = cx.dynamics();
    let contacts = dynamics.iter().flat_map(|dynamics| dynamics.contacts());
    let found = contacts
        .filter(|contact| {
            dynamic_pass == special::ALL || dynamic_pass == i64::from(contact.sub_step)
        })
        .filter(|contact| shape.is_none_or(|shape| contact.shapes.contains(&shape)))
        .nth(usize::try_from(index & !flag::EXTENDED).unwrap_or(usize::MAX));
    let Some(contact) = found else {
        return Ok(Default::default());
    };
    let contact = shape.map_or(contact, |shape| contact.seen_from(shape));
    Ok((
        contact.shapes.to_vec(),
        contact.point.to_vec(),
        contact.force.to_vec(),
        contact.normal.to_vec(),
    ))
}

type ContactInfo = (Vec<Handle>, Vec<f64>, Vec<f64>, Vec<f64>);

fn existing(cx: &Cx, raw: i64) -> Result<Handle> {
    let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
    cx.scene().object(handle)?;
    Ok(handle)
}

/// The measurement of a force sensor, in its own frame: the load of its child on its parent.
///
/// @param objectHandle the force sensor; with sim.handleflag_rawvalue the value of the last sub-step
/// @return result bit 0: there is data; bit 1: the sensor holds nothing
/// @return forceVector newtons
/// @return torqueVector newton metres
#[api("sim.readForceSensor")]
fn read_force_sensor(cx: &Cx, object_handle: ObjectRef) -> Result<(i64, [f64; 3], [f64; 3])> {
    let scene = cx.scene();
    let object = scene.object(object_handle.handle)?;
    let sensor = object.force_sensor()?;
    let reading = if object_handle.has(flag::RAW_VALUE) {
        sensor.raw
    } else {
        sensor.filtered
    };
    let running = !cx.clock().is_stopped();
    let broken = running && object.children().is_empty();
    let (force, torque) = reading.unwrap_or_default();
    Ok((
        i64::from(reading.is_some()) | i64::from(broken) << 1,
        force,
        torque,
    ))
}

/// Breaks a force sensor: what it holds becomes a root of the scene, where it is.
///
/// @param objectHandle the force sensor
#[api("sim.breakForceSensor")]
fn break_force_sensor(cx: &mut Cx, object_handle: Handle) -> Result<i64> {
    let scene = &mut *cx.scene_mut();
    let object = scene.object(object_handle)?;
    object.force_sensor()?;
    for child in object.children().to_vec() {
        scene.set_parent(child, None, true)?;
    }
    Ok(1)
}

/// Force or torque a joint's motor has exerted on the joint's parent, along its z axis: the mean of the last dynamics call.
///
/// @param jointHandle the joint; with sim.handleflag_rawvalue the value of the last sub-step
/// @return forceOrTorque newtons or newton metres
#[api("sim.getJointForce")]
fn get_joint_force(cx: &Cx, joint_handle: ObjectRef) -> Result<f64> {
    let scene = cx.scene();
    let joint = scene.object(joint_handle.handle)?.joint()?;
    let force = if joint_handle.has(flag::RAW_VALUE) {
        joint.raw_force
    } else {
        joint.force
    };
    Ok(force.unwrap_or(0.0))
}
