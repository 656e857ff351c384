//! Joints, force sensors and dummies.

use std::f64::consts::TAU;

use super::{Context, shape};
use crate::ttt::EngineBlock;
use crate::ttt::chunks::{
    Colour, Dummy as DummyChunk, ForceSensor as ForceSensorChunk, Joint as Chunk,
};
use scene::joint::{Control, Joint};
use scene::object::dummy::Dummy;
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::sensor::force_sensor::ForceSensor;

const CYCLIC: u8 = 0x1;
const MOTOR: u8 = 0x10;
const CONTROL_LOOP: u8 = 0x20;
const HYBRID: u8 = 0x40;
const SPRING: u8 = 0x80;

pub(super) fn joint(context: &Context<'_>, joint: &Joint, colour: Option<Colour>) -> Chunk {
    let [bullet, ode, vortex, newton, mujoco] = shape::blocks(joint);
    let q = joint.spherical;
    Chunk {
        joint_type: Some(joint.joint_type as i32),
        screw_pitch: Some(joint.screw_lead / TAU),
        screw_lead: Some(joint.screw_lead),
        spherical: Some([q.w, q.i, q.j, q.k]),
        switches: Some(switches(joint)),
        switches_2: Some(u8::from(joint.motor_lock) << 1 | u8::from(joint.enforce_limits) << 2),
        colour,
        limits: Some([joint.min, joint.range]),
        position: Some(joint.position),
        ik_max_step: Some(joint.ik.max_step),
        sizes: Some(joint.size),
        ik_weight: Some(joint.ik.weight),
        joint_mode: Some(joint.mode as i32),
        dependency: Some(dependency(context, joint)),
        motor: Some([joint.target_velocity, joint.target_force]),
        spring: Some(joint.spring),
        target_pos: Some(joint.target_position),
        bullet,
        ode,
        vortex,
        newton,
        mujoco,
        max_vel_accel_jerk: Some([joint.max_vel, joint.max_accel, joint.max_jerk]),
        dyn_ctrl_mode: Some(joint.control as i32),
        pos_ctrl_profile: Some(joint.position_profile.into()),
        vel_ctrl_profile: Some(joint.velocity_profile.into()),
        ..Chunk::default()
    }
}

/// Control switches of a joint as before 4.3.
fn switches(joint: &Joint) -> u8 {
    let control = match joint.control {
        Control::Free | Control::Force => 0,
        Control::Velocity => MOTOR,
        Control::Position | Control::PositionOrCallback | Control::Callback => MOTOR | CONTROL_LOOP,
        Control::Spring | Control::SpringOrCallback => MOTOR | CONTROL_LOOP | SPRING,
    };
    control | if joint.cyclic { CYCLIC } else { 0 } | if joint.hybrid { HYBRID } else { 0 }
}

/// Master, coefficient, offset. A joint whose master is not saved depends on none.
fn dependency(context: &Context<'_>, joint: &Joint) -> (i32, [f64; 2]) {
    match joint.dependency {
        Some(law) => (
            context.file_handle(Some(law.master)),
            [law.coefficient, law.offset],
        ),
        None => (-1, [1.0, 0.0]),
    }
}

pub(super) fn force_sensor(sensor: &ForceSensor, colour: Option<Colour>) -> ForceSensorChunk {
    let switches =
        u8::from(sensor.force_threshold_enabled) | u8::from(sensor.torque_threshold_enabled) << 1;
    ForceSensorChunk {
        size: Some(sensor.size),
        switches: Some(switches),
        thresholds: Some((
            [sensor.force_threshold, sensor.torque_threshold],
            sensor.consecutive_violations.cast_signed(),
        )),
        filter: Some([numbers::count_i32(sensor.sample_size), sensor.filter as i32]),
        colour,
        ..ForceSensorChunk::default()
    }
}

pub(super) fn dummy(context: &Context<'_>, dummy: &Dummy, colour: Option<Colour>) -> DummyChunk {
    let (reals, ints) = dummy.engine_rows(Engine::Mujoco);
    DummyChunk {
        size: Some(dummy.size),
        assembly_tag: Some(dummy.assembly_tag.as_str().into()),
        colour,
        linked_dummy: Some(context.file_handle(dummy.link)),
        switches: Some(dummy.path_following.bits),
        path_offsets: Some(dummy.path_following.offsets),
        link_type: Some(dummy.link_type as i32),
        mujoco: Some(EngineBlock { reals, ints }),
        ..DummyChunk::default()
    }
}
