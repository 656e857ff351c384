//! `sim.*`: trajectories with limited velocity, acceleration and jerk.
//!
//! A trajectory belongs to the script that made it and is dropped with its state.

use std::cell::RefCell;
use std::rc::Rc;

use api_macro::api;
use motion::ruckig::{BAD_CYCLE_TIME, RuckigError, Trajectory};

use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::{ByHandle, Number};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![ruckig_pos, ruckig_vel, ruckig_step, ruckig_remove];

/// Plans a motion to positions.
///
/// @param dofs number of axes
/// @param baseCycleTime seconds; step times are multiples of it
/// @param flags sim.ruckig_*, -1 for time synchronisation
/// @param currentPosVelAccel positions, then velocities, then accelerations
/// @param maxVelAccelJerk limits, then minima where the flags say so
/// @param selection 0 leaves an axis out
/// @param targetPosVel positions, then velocities
/// @return handle for sim.ruckigStep
#[api("sim.ruckigPos")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn ruckig_pos(
    cx: &mut Cx,
    dofs: Number,
    base_cycle_time: f64,
    flags: Number,
    current_pos_vel_accel: Vec<f64>,
    max_vel_accel_jerk: Vec<f64>,
    selection: Vec<i64>,
    target_pos_vel: Vec<f64>,
) -> Result<i64> {
    let trajectory = Trajectory::new_position(
        axes(dofs),
        base_cycle_time,
        flags.0,
        &current_pos_vel_accel,
        &max_vel_accel_jerk,
        &selection,
        &target_pos_vel,
    );
    Ok(trajectories(cx)
        .borrow_mut()
        .add(trajectory.map_err(refusal)?))
}

/// Plans a change of velocities.
///
/// @param dofs number of axes
/// @param baseCycleTime seconds; step times are multiples of it
/// @param flags sim.ruckig_*, -1 for time synchronisation
/// @param currentPosVelAccel positions, then velocities, then accelerations
/// @param maxAccelJerk limits, then minimum accelerations where the flags say so
/// @param selection 0 leaves an axis out
/// @param targetVel velocities
/// @return handle for sim.ruckigStep
#[api("sim.ruckigVel")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn ruckig_vel(
    cx: &mut Cx,
    dofs: Number,
    base_cycle_time: f64,
    flags: Number,
    current_pos_vel_accel: Vec<f64>,
    max_accel_jerk: Vec<f64>,
    selection: Vec<i64>,
    target_vel: Vec<f64>,
) -> Result<i64> {
    let trajectory = Trajectory::new_velocity(
        axes(dofs),
        base_cycle_time,
        flags.0,
        &current_pos_vel_accel,
        &max_accel_jerk,
        &selection,
        &target_vel,
    );
    Ok(trajectories(cx)
        .borrow_mut()
        .add(trajectory.map_err(refusal)?))
}

/// Follows a trajectory.
///
/// @param handle from sim.ruckigPos or sim.ruckigVel
/// @param cycleTime seconds to advance by
/// @return result 0 running, 1 there, negative on failure
/// @return newPosVelAccel positions, then velocities, then accelerations
/// @return synchronizationTime seconds left; negative in the last step
#[api("sim.ruckigStep")]
fn ruckig_step(cx: &mut Cx, handle: Number, cycle_time: f64) -> Result<(i64, Vec<f64>, f64)> {
    let trajectories = trajectories(cx);
    let mut trajectories = trajectories.borrow_mut();
    let step = trajectories
        .get_mut(handle.0)
        .ok_or_else(unknown)?
        .step(cycle_time);
    match step.code {
        BAD_CYCLE_TIME => Err(ApiError::Other(
            "specified cycle time is not a multiple of the base cycle time.".into(),
        )),
        code => Ok((code.into(), step.pva, step.sync)),
    }
}

/// Removes a trajectory.
///
/// @param handle from sim.ruckigPos or sim.ruckigVel
/// @return result 1
#[api("sim.ruckigRemove")]
fn ruckig_remove(cx: &mut Cx, handle: Number) -> Result<i64> {
    trajectories(cx)
        .borrow_mut()
        .remove(handle.0)
        .map(drop)
        .ok_or_else(unknown)?;
    Ok(1)
}

/// The trajectories of the calling script.
fn trajectories(cx: &Cx) -> Rc<RefCell<ByHandle<Trajectory>>> {
    cx.script_state()
}

fn axes(dofs: Number) -> usize {
    usize::try_from(dofs.0).unwrap_or(0)
}

fn unknown() -> ApiError {
    ApiError::Other("Ruckig object does not exist.".into())
}

fn refusal(error: RuckigError) -> ApiError {
    match error {
        RuckigError::TableSize => ApiError::TableSize,
        _ => ApiError::Other(error.to_string()),
    }
}
