//! Joints, force sensors and dummies (spec: scene-files 7.2, scene-files 7.4).

use std::f64::consts::{PI, TAU};

use super::{Context, material};
use crate::ttt::chunks::{Dummy as DummyChunk, ForceSensor as ForceSensorChunk, Joint as Chunk};
use crate::ttt::{Text, unit_quaternion};
use scene::joint::{Control, Joint, JointMode, JointType};
use scene::object::dummy::{Dummy, LinkType};
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::path_object::PathFollowing;
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};

/// The step of the physics that gains were multiplied by before 3.1.1.
const OLD_STEP: f64 = 0.005;
/// Since this serialization spring constants and gains per engine say it all.
const MAX_FORCE: f64 = 1000.0;

pub(super) fn joint(context: &Context<'_>, chunk: &Chunk) -> Joint {
    let joint_type = chunk.joint_type.unwrap_or_default().into();
    let joint_type = JointType::from_code(joint_type).unwrap_or(JointType::Revolute);
    let mode = JointMode::of_file(chunk.joint_mode.unwrap_or_default());
    let mut joint = Joint::new(joint_type, mode);
    joint.hybrid = chunk.switches.unwrap_or(0) & 0x40 != 0;
    limits(&mut joint, chunk);
    position(&mut joint, chunk);
    control(&mut joint, chunk);
    gains(&mut joint, chunk);
    if let Some([length, diameter]) = chunk
        .sizes
        .filter(|sizes| sizes.iter().all(|s| s.is_finite()))
    {
        joint.size = [length, diameter];
    }
    material::load_all(
        &mut joint,
        [
            &chunk.bullet,
            &chunk.ode,
            &chunk.vortex,
            &chunk.newton,
            &chunk.mujoco,
        ],
    );
    debug_assert!(context.header.serialization > 0);
    joint
}

fn limits(joint: &mut Joint, chunk: &Chunk) {
    joint.cyclic = chunk.switches.unwrap_or(0) & 0x1 != 0;
    if let Some([min, range]) = chunk
        .limits
        .filter(|limits| limits.iter().all(|l| l.is_finite()))
    {
        (joint.min, joint.range) = (min, range);
    }
    joint.enforce_limits = chunk.switches_2.unwrap_or(0) & 0x4 != 0;
    let fast = [TAU; 3];
    [joint.max_vel, joint.max_accel, joint.max_jerk] = chunk.max_vel_accel_jerk.unwrap_or(fast);
    // Up to 4.3 joints that physics moved had a velocity limit of their own.
    let physical = joint.hybrid || joint.mode == JointMode::Dynamic;
    if let Some(limit) = chunk
        .upper_velocity_limit
        .filter(|limit| physical && *limit > 0.0)
    {
        joint.max_vel = limit.into();
    }
}

fn position(joint: &mut Joint, chunk: &Chunk) {
    joint.position = chunk.position.filter(|p| p.is_finite()).unwrap_or(0.0);
    if let Some(rotation) = chunk.spherical {
        joint.spherical = unit_quaternion(rotation);
    }
    let lead = chunk
        .screw_lead
        .or(chunk.screw_pitch.map(|pitch| pitch * TAU))
        .unwrap_or(0.0);
    joint.screw_lead = if joint.is_revolute() && lead.is_finite() {
        lead
    } else {
        0.0
    };
    joint.ik.weight = chunk
        .ik_weight
        .filter(|weight| weight.is_finite())
        .unwrap_or(joint.ik.weight);
    joint.ik.max_step = chunk
        .ik_max_step
        .filter(|step| step.is_finite())
        .unwrap_or(joint.ik.max_step);
    joint.target_position = chunk.target_pos.filter(|p| p.is_finite()).unwrap_or(0.0);
}

fn control(joint: &mut Joint, chunk: &Chunk) {
    let [velocity, force] = chunk.motor.unwrap_or([0.0, MAX_FORCE]);
    joint.target_velocity = velocity;
    // Velocity and force push the same way.
    joint.target_force = if velocity * force < 0.0 {
        -force
    } else {
        force
    };
    joint.control = chunk
        .dyn_ctrl_mode
        .map_or_else(|| old_control(chunk), Control::of_file);
    joint.motor_lock = chunk.switches_2.unwrap_or(0) & 0x2 != 0;
    let smooth = chunk.switches_3.is_some_and(|switches| switches & 1 != 0);
    joint.position_profile = smooth || chunk.pos_ctrl_profile.unwrap_or(0) != 0;
    joint.velocity_profile = smooth || chunk.vel_ctrl_profile.unwrap_or(0) != 0;
}

/// Before 4.3: a motor, a control loop for it, which may be a spring.
fn old_control(chunk: &Chunk) -> Control {
    let on = |bit: u8| chunk.switches.unwrap_or(0) >> bit & 1 == 1;
    match (on(4), on(5), on(7)) {
        (false, ..) => Control::Free,
        (true, _, true) => Control::SpringOrCallback,
        (true, true, false) => Control::PositionOrCallback,
        (true, false, false) => Control::Velocity,
    }
}

/// Spring constants and gains; before 4.4 one set of gains for all engines, before 3.1.1 in other units.
fn gains(joint: &mut Joint, chunk: &Chunk) {
    let old = chunk.old_pid.map(|pid| pid.map(f64::from));
    let oldest = chunk
        .oldest_pid
        .map(|[p, i, d]| [p.into(), f64::from(i) / OLD_STEP, f64::from(d) / OLD_STEP]);
    let pid = old.or(oldest);
    if let Some(pid) = pid {
        joint.gains = [pid; 5];
    }
    match chunk.spring {
        Some(spring) => joint.spring = spring,
        None if chunk.switches.unwrap_or(0) & 0xb0 == 0xb0 => {
            spring_of_gains(joint, pid.unwrap_or([0.1, 0.0, 0.0]));
        }
        None => {}
    }
}

/// A spring was once a control loop whose gains were shares of the greatest force.
fn spring_of_gains(joint: &mut Joint, [p, i, d]: [f64; 3]) {
    joint.spring = [joint.target_force * p, joint.target_force * d];
    let unit = if joint.is_revolute() { PI * 2.0 } else { 1.0 };
    let ratio = p.abs().max(d.abs()) * unit;
    if ratio > 1.0 {
        joint.gains = [[p / ratio, i / ratio, d / ratio]; 5];
        joint.target_force *= ratio;
    }
}

pub(super) fn force_sensor(chunk: &ForceSensorChunk) -> ForceSensor {
    let mut sensor = ForceSensor::default();
    sensor.size = chunk.size.unwrap_or(sensor.size);
    let old = chunk
        .old_thresholds
        .map(|(thresholds, violations)| (thresholds.map(f64::from), violations));
    if let Some(([force, torque], violations)) = chunk.thresholds.or(old) {
        (sensor.force_threshold, sensor.torque_threshold) = (force, torque);
        sensor.consecutive_violations = violations.max(1).cast_unsigned();
    }
    let switches = chunk.switches.unwrap_or(0);
    (
        sensor.force_threshold_enabled,
        sensor.torque_threshold_enabled,
    ) = (switches & 1 != 0, switches & 2 != 0);
    if let Some([samples, filter]) = chunk.filter {
        sensor.sample_size = usize::try_from(samples)
            .unwrap_or(1)
            .clamp(1, ForceSensor::MAX_SAMPLES);
        sensor.filter = if filter == 1 {
            ForceFilter::Median
        } else {
            ForceFilter::Average
        };
    }
    sensor
}

/// Without its partner, which may come later.
pub(super) fn dummy(chunk: &DummyChunk) -> Dummy {
    let mut dummy = Dummy::new(chunk.size.unwrap_or(0.01));
    dummy.link_type = chunk
        .link_type
        .and_then(|code| LinkType::from_code(code.into()))
        .unwrap_or(LinkType::Default);
    if let Some(tag) = chunk.assembly_tag.as_ref().map(Text::decode) {
        dummy.assembly_tag = tag;
    }
    dummy.path_following = PathFollowing {
        bits: chunk.switches.unwrap_or(0) & PathFollowing::BITS,
        offsets: chunk
            .path_offsets
            .or(chunk.path_off.map(|offset| [offset.into(); 2]))
            .unwrap_or_default(),
    };
    if let Some(mujoco) = &chunk.mujoco {
        dummy.load_engine(Engine::Mujoco, &mujoco.reals, &mujoco.ints);
    }
    dummy
}
