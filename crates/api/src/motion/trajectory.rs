//! `sim.*`: time-optimal trajectories.

use api_macro::api;
use motion::spline::Boundary;
use motion::time_optimal::{Limits, TimeOptimalError, TimedPath};

use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![generate_time_optimal_trajectory];

/// Most numbers a trajectory can have: beyond, a mistyped count would fill the memory.
const MAX_NUMBERS: usize = 10_000_000;

/// The fastest motion along a path within limits of velocity and acceleration, from rest to rest.
///
/// @param path flat table of points
/// @param pathLengths from sim.getPathLengths
/// @param minMaxVel minimum and maximum velocity of each axis
/// @param minMaxAccel minimum and maximum acceleration of each axis
/// @param trajPtSamples number of points wanted
/// @param boundaryCondition ends of the spline through the points: 'not-a-knot', 'clamped', 'natural' or 'periodic'
/// @param timeout not used: the calculation takes milliseconds
/// @param calculationScriptHandle not used: there is no script that calculates
/// @return outPath flat table of trajPtSamples points at equal times
/// @return times of the points, seconds
/// @return scriptHandle calculationScriptHandle as given
#[api("sim.generateTimeOptimalTrajectory")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn generate_time_optimal_trajectory(
    cx: &Cx,
    path: Vec<f64>,
    path_lengths: Vec<f64>,
    min_max_vel: Vec<f64>,
    min_max_accel: Vec<f64>,
    #[default(1000)] traj_pt_samples: Number,
    #[default("not-a-knot")] boundary_condition: String,
    #[default(5.0)] timeout: f64,
    #[default(None)] calculation_script_handle: Option<Number>,
) -> Result<(Vec<f64>, Vec<f64>, Option<i64>)> {
    let _ = (cx, timeout);
    let boundary =
        Boundary::from_name(&boundary_condition).ok_or_else(|| unknown(&boundary_condition))?;
    let axes = path.len() / path_lengths.len().max(1);
    let samples = usize::try_from(traj_pt_samples.0)
        .ok()
        .filter(|n| *n >= 2 && n.saturating_mul(axes) <= MAX_NUMBERS);
    let samples = samples.ok_or_else(|| too_many(traj_pt_samples.0))?;
    let (velocity, acceleration) = (limits(&min_max_vel, axes)?, limits(&min_max_accel, axes)?);
    let timed = TimedPath::new(&path, &path_lengths, &velocity, &acceleration, boundary)
        .map_err(refusal)?;
    let times: Vec<f64> = (0..samples)
        .map(|i| timed.duration() * i as f64 / (samples - 1) as f64)
        .collect();
    let points = times.iter().flat_map(|time| timed.at(*time)).collect();
    Ok((
        points,
        times,
        calculation_script_handle.map(|handle| handle.0),
    ))
}

/// Pairs of minimum and maximum; more of them than axes are accepted.
fn limits(pairs: &[f64], axes: usize) -> Result<Limits> {
    let pairs = pairs
        .as_chunks()
        .0
        .get(..axes)
        .ok_or_else(|| refusal(TimeOptimalError::Sizes))?;
    Ok(pairs.to_vec())
}

fn unknown(boundary: &str) -> ApiError {
    ApiError::Other(format!(
        "unknown boundary condition '{boundary}': it is 'not-a-knot', 'clamped', 'natural' or 'periodic'."
    ))
}

fn too_many(samples: i64) -> ApiError {
    ApiError::Other(format!(
        "cannot make {samples} points: at least 2, and at most {MAX_NUMBERS} numbers in all."
    ))
}

fn refusal(error: TimeOptimalError) -> ApiError {
    ApiError::Other(error.to_string())
}
