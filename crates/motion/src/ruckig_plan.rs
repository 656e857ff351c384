//! Planning by rsruckig, guarded against numbers that it cannot handle, and single steps of one joint.

use rsruckig::prelude::{
    ControlInterface, InputParameter, Ruckig, RuckigErrorHandler, RuckigResult,
};

use super::ruckig::{INVALID_INPUT, RuckigError};

/// Largest magnitude that is planned with, and the inverse of the smallest limit: beyond, powers overflow.
const MAX_MAGNITUDE: f64 = 1e12;

/// One joint, one step: plans from (`pos`, `vel`, `acc`) to rest at `target` within the limits and returns
/// position, velocity, acceleration after `dt` seconds. Past the end it rests.
///
/// # Errors
/// [`RuckigError::InvalidData`] for numbers that are not finite or a negative `dt`,
/// [`RuckigError::Failed`] for limits that are not positive or motions that cannot be planned.
#[expect(
    clippy::too_many_arguments,
    reason = "the state and the limits of one joint, read at one place"
)]
pub fn position_step(
    pos: f64,
    vel: f64,
    acc: f64,
    target: f64,
    max_vel: f64,
    max_acc: f64,
    max_jerk: f64,
    dt: f64,
) -> Result<(f64, f64, f64), RuckigError> {
    let mut input = InputParameter::<1>::new(None);
    (input.max_velocity[0], input.target_position[0]) = (max_vel, target);
    axis_step(input, [pos, vel, acc], [max_acc, max_jerk], dt)
}

/// Like [`position_step`], from (`pos`, `vel`, `acc`) to the velocity `target_vel`, which is then held.
///
/// # Errors
/// As [`position_step`].
pub fn velocity_step(
    pos: f64,
    vel: f64,
    acc: f64,
    target_vel: f64,
    max_acc: f64,
    max_jerk: f64,
    dt: f64,
) -> Result<(f64, f64, f64), RuckigError> {
    let mut input = InputParameter::<1>::new(None);
    input.control_interface = ControlInterface::Velocity;
    input.target_velocity[0] = target_vel;
    axis_step(input, [pos, vel, acc], [max_acc, max_jerk], dt)
}

fn axis_step(
    mut input: InputParameter<1>,
    state: [f64; 3],
    limits: [f64; 2],
    dt: f64,
) -> Result<(f64, f64, f64), RuckigError> {
    (input.current_position[0], input.current_velocity[0]) = (state[0], state[1]);
    input.current_acceleration[0] = state[2];
    (input.max_acceleration[0], input.max_jerk[0]) = (limits[0], limits[1]);
    if !dt.is_finite() || dt < 0.0 || !lists(&input).all(|x| x.is_finite()) {
        return Err(RuckigError::InvalidData);
    }
    let mut result = state.into();
    Plan::new(&input)?.sample(dt, |_, state| result = state);
    Ok(result)
}

/// A computed trajectory of the library.
#[derive(Debug, Clone)]
pub(crate) struct Plan<const N: usize>(rsruckig::prelude::Trajectory<N>);

impl<const N: usize> Plan<N> {
    pub(crate) fn new(input: &InputParameter<N>) -> Result<Self, RuckigError> {
        if !plannable(input) {
            return Err(RuckigError::Failed(INVALID_INPUT));
        }
        let dofs = Some(input.degrees_of_freedom);
        let mut trajectory = rsruckig::prelude::Trajectory::new(dofs);
        let result = Ruckig::<N, Codes>::new(dofs, 0.0).calculate(input, &mut trajectory);
        match result {
            Ok(RuckigResult::Working | RuckigResult::Finished)
                if trajectory.duration.is_finite() =>
            {
                Ok(Self(trajectory))
            }
            Ok(RuckigResult::Working | RuckigResult::Finished) => Err(RuckigError::Failed(
                RuckigResult::ErrorTrajectoryDuration as i32,
            )),
            Ok(failure) => Err(RuckigError::Failed(failure as i32)),
            Err(_) => Err(RuckigError::Failed(INVALID_INPUT)),
        }
    }

    pub(crate) fn duration(&self) -> f64 {
        self.0.duration
    }

    /// Calls `each` with the axis and its position, velocity, acceleration at `time`.
    pub(crate) fn sample(&self, time: f64, mut each: impl FnMut(usize, (f64, f64, f64))) {
        self.0
            .state_to_integrate_from(time, &mut 0, |axis, t, p, v, a, j| {
                each(axis, rsruckig::util::integrate(t, p, v, a, j));
            });
    }
}

/// Lets the planner return its code where it fails, and an error for input it refuses.
struct Codes;

impl RuckigErrorHandler for Codes {
    fn handle_validation_error(message: &str) -> Result<(), rsruckig::prelude::RuckigError> {
        Err(rsruckig::prelude::RuckigError::ValidationError(
            message.to_owned(),
        ))
    }

    fn handle_calculator_error(_: &str) -> Result<(), rsruckig::prelude::RuckigError> {
        Ok(())
    }
}

/// Every number that describes the motion, limits last.
fn lists<const N: usize>(input: &InputParameter<N>) -> impl Iterator<Item = &f64> {
    let states = input
        .current_position
        .iter()
        .chain(input.current_velocity.iter());
    let states = states.chain(input.current_acceleration.iter());
    let targets = input
        .target_position
        .iter()
        .chain(input.target_velocity.iter());
    let minima = input
        .min_velocity
        .iter()
        .chain(&input.min_acceleration)
        .flat_map(|m| m.iter());
    states.chain(targets).chain(minima).chain(maxima(input))
}

fn maxima<const N: usize>(input: &InputParameter<N>) -> impl Iterator<Item = &f64> {
    let velocity = match input.control_interface {
        ControlInterface::Velocity => [].iter(),
        _ => input.max_velocity.iter(),
    };
    velocity
        .chain(input.max_acceleration.iter())
        .chain(input.max_jerk.iter())
}

fn plannable<const N: usize>(input: &InputParameter<N>) -> bool {
    lists(input).all(|x| x.abs() <= MAX_MAGNITUDE)
        && maxima(input).all(|x| *x >= 1.0 / MAX_MAGNITUDE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ruckig::tests::close;

    #[test]
    fn single_steps_of_a_joint() {
        let step = position_step(0.0, 0.0, 0.0, 1.0, 0.5, 1.0, 10.0, 0.05).expect("plannable");
        close(&<[f64; 3]>::from(step), &[0.000208333, 0.0125, 0.5], 1e-9);
        let end = position_step(0.999, 0.0, 0.0, 1.0, 0.5, 1.0, 10.0, 5.0).expect("plannable");
        close(&<[f64; 3]>::from(end), &[1.0, 0.0, 0.0], 1e-9);
        let held = velocity_step(2.0, 1.0, 0.0, 1.0, 2.0, 20.0, 0.05).expect("plannable");
        close(&<[f64; 3]>::from(held), &[2.05, 1.0, 0.0], 1e-12);
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            assert!(position_step(0.0, 0.0, 0.0, 1.0, 0.5, 1.0, bad, 0.05).is_err());
            assert!(velocity_step(0.0, 0.0, 0.0, 1.0, bad, 10.0, 0.05).is_err());
        }
    }
}
