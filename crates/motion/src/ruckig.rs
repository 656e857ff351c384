//! Jerk-limited trajectories: what `sim.ruckigPos`, `ruckigVel` and `ruckigStep` do, as a value.
//!
//! The planning is rsruckig's. This module reads the flat argument lists, maintains the clock in base
//! cycles as CoppeliaSim does and reports its codes. Positions are in m or rad, times in seconds.

use rsruckig::prelude::{ControlInterface, DataArrayOrVec, InputParameter, Synchronization};
use thiserror::Error;

use super::ruckig_plan::Plan;

/// Flag of `sim.ruckigPos`: n minimum velocities follow the maxima.
pub const FLAG_MIN_VELOCITY: i64 = 0x100;
/// Flag: n minimum accelerations follow (after the minimum velocities, if any).
pub const FLAG_MIN_ACCELERATION: i64 = 0x200;

/// Step result: the target is not reached yet.
pub const RUNNING: i32 = 0;
/// Step result: the target was reached in this step.
pub const REACHED: i32 = 1;
/// Step result: the step is not a multiple of the base cycle. Nothing moved.
pub const BAD_CYCLE_TIME: i32 = -3;
/// Step result: limits or states that no trajectory can have. Nothing moved.
pub const INVALID_INPUT: i32 = -100;

/// Up to this many base cycles per step are added one by one, with the rounding of CoppeliaSim.
const COUNTED_CYCLES: f64 = 1e5;

/// Why a trajectory was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum RuckigError {
    /// A list is shorter than the number of axes and the flags ask for.
    #[error("incorrect table size.")]
    TableSize,
    /// Not finite numbers, no axis, or a base cycle that is not positive.
    #[error("invalid data.")]
    InvalidData,
    /// The planner failed, with the code that `sim.ruckigStep` would return (-100, -101, -110, -111).
    #[error("trajectory generation failed with code {0}.")]
    Failed(i32),
}

/// The result of one step of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct StepResult {
    /// [`RUNNING`], [`REACHED`], [`BAD_CYCLE_TIME`], [`INVALID_INPUT`] or the planner's -101, -110, -111.
    pub code: i32,
    /// n positions, n velocities, n accelerations.
    pub pva: Vec<f64>,
    /// Duration minus elapsed time (s): negative in the last step by the unused time. 0 after a failure.
    pub sync: f64,
}

/// A planned motion of n axes and how far it has been followed.
#[derive(Debug, Clone)]
pub struct Trajectory {
    /// `None` when no axis is selected: over at once.
    plan: Result<Option<Plan<0>>, RuckigError>,
    start: Vec<f64>,
    active: Vec<usize>,
    base_cycle: f64,
    time: f64,
    elapsed: f64,
}

impl Trajectory {
    /// Position motion, `sim.ruckigPos`. With n = `dofs`: `cur_pva` 3n positions, velocities,
    /// accelerations; `max_vaj` 3n limits of velocity, acceleration, jerk, then n minimum velocities and
    /// n minimum accelerations where the flags say so; `selection` n numbers, 0 leaves the axis where it
    /// is; `tgt_pv` 2n positions, velocities. Longer lists are accepted. Flags -1: time synchronisation.
    ///
    /// # Errors
    /// [`RuckigError::TableSize`] and [`RuckigError::InvalidData`]. Limits that cannot be planned with
    /// (zero, negative) are accepted here and reported by [`Trajectory::step`].
    pub fn new_position(
        dofs: usize,
        base_cycle: f64,
        flags: i64,
        cur_pva: &[f64],
        max_vaj: &[f64],
        selection: &[i64],
        tgt_pv: &[f64],
    ) -> Result<Self, RuckigError> {
        let (min_velocity, min_acceleration) = minima(flags);
        let limits = 3 + usize::from(min_velocity) + usize::from(min_acceleration);
        let (cur, max) = (columns(cur_pva, dofs, 3)?, columns(max_vaj, dofs, limits)?);
        let target = columns(tgt_pv, dofs, 2)?;
        let active = active_axes(selection, dofs)?;
        let mut input = input(&active, flags, &cur);
        input.max_velocity = pick(max[0], &active);
        input.max_acceleration = pick(max[1], &active);
        input.max_jerk = pick(max[2], &active);
        input.min_velocity = min_velocity.then(|| pick(max[3], &active));
        input.min_acceleration = min_acceleration.then(|| pick(max[limits - 1], &active));
        input.target_position = pick(target[0], &active);
        input.target_velocity = pick(target[1], &active);
        Self::start(base_cycle, &cur, active, &input)
    }

    /// Velocity motion, `sim.ruckigVel`: like [`Trajectory::new_position`], with `max_aj` 2n limits of
    /// acceleration and jerk (then n minimum accelerations) and `tgt_v` n velocities.
    ///
    /// # Errors
    /// As [`Trajectory::new_position`].
    pub fn new_velocity(
        dofs: usize,
        base_cycle: f64,
        flags: i64,
        cur_pva: &[f64],
        max_aj: &[f64],
        selection: &[i64],
        tgt_v: &[f64],
    ) -> Result<Self, RuckigError> {
        let min_acceleration = minima(flags).1;
        let limits = 2 + usize::from(min_acceleration);
        let (cur, max) = (columns(cur_pva, dofs, 3)?, columns(max_aj, dofs, limits)?);
        let target = columns(tgt_v, dofs, 1)?;
        let active = active_axes(selection, dofs)?;
        let mut input = input(&active, flags, &cur);
        input.control_interface = ControlInterface::Velocity;
        input.max_acceleration = pick(max[0], &active);
        input.max_jerk = pick(max[1], &active);
        input.min_acceleration = min_acceleration.then(|| pick(max[2], &active));
        input.target_velocity = pick(target[0], &active);
        Self::start(base_cycle, &cur, active, &input)
    }

    /// Follows the trajectory for `dt` seconds, in base cycles, up to the first one past the end: a target
    /// velocity is held for the rest of that cycle only.
    pub fn step(&mut self, dt: f64) -> StepResult {
        let Some(cycles) = cycles(dt, self.base_cycle) else {
            return self.result(BAD_CYCLE_TIME, 0.0);
        };
        if let Err(error) = &self.plan {
            return self.result(error.code(), 0.0);
        }
        let duration = self.duration();
        self.elapsed += dt;
        self.time = advance(self.time, duration, self.base_cycle, cycles);
        let code = if self.time > duration {
            REACHED
        } else {
            RUNNING
        };
        self.result(code, duration - self.elapsed)
    }

    /// Length of the motion (s); 0 when it could not be planned.
    pub fn duration(&self) -> f64 {
        self.plan
            .as_ref()
            .ok()
            .and_then(Option::as_ref)
            .map_or(0.0, Plan::duration)
    }

    fn start(
        base_cycle: f64,
        cur: &[&[f64]],
        active: Vec<usize>,
        input: &InputParameter<0>,
    ) -> Result<Self, RuckigError> {
        if !(base_cycle.is_finite() && base_cycle > 0.0) {
            return Err(RuckigError::InvalidData);
        }
        let plan = (!active.is_empty()).then(|| Plan::new(input)).transpose();
        Ok(Self {
            plan,
            start: cur.concat(),
            active,
            base_cycle,
            time: 0.0,
            elapsed: 0.0,
        })
    }

    fn result(&self, code: i32, sync: f64) -> StepResult {
        let mut pva = self.start.clone();
        let dofs = pva.len() / 3;
        if let Ok(Some(plan)) = &self.plan {
            plan.sample(self.time, |i, state| {
                let axis = self.active[i];
                (pva[axis], pva[dofs + axis], pva[2 * dofs + axis]) = state;
            });
        }
        StepResult { code, pva, sync }
    }
}

impl RuckigError {
    fn code(&self) -> i32 {
        if let Self::Failed(code) = self {
            *code
        } else {
            INVALID_INPUT
        }
    }
}

/// Whether minimum velocities and minimum accelerations follow the maxima.
fn minima(flags: i64) -> (bool, bool) {
    let has = |flag| flags >= 0 && flags & flag != 0;
    (has(FLAG_MIN_VELOCITY), has(FLAG_MIN_ACCELERATION))
}

/// 0 and the legacy 2: phase, 1 and the library default -1: time, 3: none.
fn synchronization(flags: i64) -> Synchronization {
    match flags {
        ..0 => Synchronization::Time,
        _ => match flags & 0xff {
            1 => Synchronization::Time,
            3 => Synchronization::None,
            _ => Synchronization::Phase,
        },
    }
}

/// The first `count` lists of `dofs` numbers in `list`.
fn columns(list: &[f64], dofs: usize, count: usize) -> Result<Vec<&[f64]>, RuckigError> {
    let size = dofs.checked_mul(count).ok_or(RuckigError::TableSize)?;
    let used = list.get(..size).ok_or(RuckigError::TableSize)?;
    if dofs == 0 || !used.iter().all(|x| x.is_finite()) {
        return Err(RuckigError::InvalidData);
    }
    Ok(used.chunks_exact(dofs).collect())
}

fn active_axes(selection: &[i64], dofs: usize) -> Result<Vec<usize>, RuckigError> {
    let used = selection.get(..dofs).ok_or(RuckigError::TableSize)?;
    Ok((0..dofs).filter(|axis| used[*axis] != 0).collect())
}

fn pick(column: &[f64], active: &[usize]) -> DataArrayOrVec<f64, 0> {
    DataArrayOrVec::Heap(active.iter().map(|axis| column[*axis]).collect())
}

fn input(active: &[usize], flags: i64, cur: &[&[f64]]) -> InputParameter<0> {
    let mut input = InputParameter::<0>::new(Some(active.len()));
    input.synchronization = synchronization(flags);
    input.current_position = pick(cur[0], active);
    input.current_velocity = pick(cur[1], active);
    input.current_acceleration = pick(cur[2], active);
    input
}

/// How many base cycles `dt` has; `None` when not a whole number of them (to 0.1 %), or none at all.
fn cycles(dt: f64, base_cycle: f64) -> Option<f64> {
    let ratio = dt / base_cycle;
    let whole = ratio.round();
    (ratio.is_finite() && whole >= 1.0 && (ratio - whole).abs() <= 1e-3).then_some(whole)
}

/// The time after `cycles` more base cycles, or after the first of them that lies past `duration`.
fn advance(mut time: f64, duration: f64, base_cycle: f64, cycles: f64) -> f64 {
    if cycles > COUNTED_CYCLES {
        let needed = ((duration - time) / base_cycle).floor() + 1.0;
        return time + needed.clamp(1.0, cycles) * base_cycle;
    }
    for _ in 0..cycles as u32 {
        time += base_cycle;
        if time > duration {
            break;
        }
    }
    time
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    #[track_caller]
    pub fn close(a: &[f64], b: &[f64], tolerance: f64) {
        assert_eq!(a.len(), b.len());
        assert!(
            a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance),
            "{a:?} is not {b:?}"
        );
    }

    fn one_axis(cur: [f64; 3], max: &[f64], flags: i64, target: [f64; 2]) -> Trajectory {
        Trajectory::new_position(1, 1e-4, flags, &cur, max, &[1], &target).expect("valid lists")
    }

    /// Steps of 0.05 s until the end: the count and the last result.
    fn run(trajectory: &mut Trajectory) -> (usize, StepResult) {
        let mut steps = (1..1000).map(|k| (k, trajectory.step(0.05)));
        steps
            .find(|(_, r)| r.code != RUNNING)
            .expect("the motion ends")
    }

    #[test]
    fn position_motion_m1() {
        let mut t = one_axis([0.0; 3], &[0.5, 1.0, 10.0], 0, [1.0, 0.0]);
        let first = t.step(0.05);
        close(&first.pva, &[0.000208333, 0.0125, 0.5], 1e-9);
        close(&[first.sync, t.duration()], &[2.55, 2.6], 1e-9);
        let (steps, last) = run(&mut t);
        assert_eq!((steps + 1, last.code), (52, REACHED));
        close(&last.pva, &[1.0, 0.0, 0.0], 1e-9);
    }

    #[test]
    fn target_velocity_is_held_to_the_end_of_the_cycle() {
        let mut t = one_axis([0.3, -0.2, 0.1], &[0.5, 1.0, 10.0], 0, [-1.0, 0.1]);
        let (steps, last) = run(&mut t);
        assert_eq!(steps, 63);
        close(&last.pva, &[-0.999995692, 0.1, 0.0], 1e-8);
        close(&[last.sync], &[-0.003643083], 1e-8);
    }

    #[test]
    fn minimum_velocity_and_acceleration() {
        let flags = FLAG_MIN_VELOCITY | FLAG_MIN_ACCELERATION;
        let mut t = one_axis([0.0; 3], &[0.5, 1.0, 10.0, -0.2, -0.5], flags, [-1.0, 0.0]);
        close(&t.step(0.05).pva, &[-0.000208333, -0.0125, -0.5], 1e-9);
        let (steps, last) = run(&mut t);
        assert_eq!(steps, 107);
        close(&[last.sync], &[-0.025], 1e-9);
    }

    #[test]
    fn velocity_motion_ends_one_cycle_late() {
        let new = Trajectory::new_velocity;
        let mut t = new(1, 1e-4, -1, &[0.0; 3], &[1.0, 10.0], &[1], &[0.97]).expect("valid lists");
        let (steps, last) = run(&mut t);
        assert_eq!(steps, 22);
        close(&last.pva, &[0.519047, 0.97, 0.0], 1e-9);
        close(&[last.sync], &[-0.03], 1e-9);
    }

    #[test]
    fn phase_synchronisation_m3_and_deselected_axes() {
        let max = [0.5, 0.5, 9.0, 1.0, 1.0, 9.0, 10.0, 10.0, 9.0];
        let target = [1.0, 0.5, 7.0, 0.0, 0.0, 0.0];
        let cur = [0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let new = Trajectory::new_position;
        let mut t = new(3, 1e-4, 0, &cur, &max, &[1, 1, 0], &target).expect("valid lists");
        for _ in 0..60 {
            let r = t.step(0.05);
            close(
                &[r.pva[1], r.pva[2], r.pva[5]],
                &[0.5 * r.pva[0], 0.25, 0.0],
                1e-9,
            );
        }
        let mut none = new(3, 1e-4, 0, &cur, &max, &[0; 3], &target).expect("valid lists");
        assert_eq!(none.step(0.05).code, REACHED);
    }

    #[test]
    fn cycles_and_refusals_m4() {
        let mut t = one_axis([0.0; 3], &[0.5, 1.0, 10.0], 0, [1.0, 0.0]);
        for dt in [0.00005, 0.0, -0.05, f64::NAN, f64::INFINITY] {
            assert_eq!(t.step(dt).code, BAD_CYCLE_TIME);
        }
        assert_eq!(t.step(1e9).code, REACHED);
        let new = |cur: &[f64]| {
            Trajectory::new_position(1, 1e-4, 0, cur, &[0.5, 1.0, 10.0], &[1], &[1.0, 0.0])
        };
        assert_eq!(new(&[0.0, 0.0]).err(), Some(RuckigError::TableSize));
        assert_eq!(
            new(&[0.0, f64::NAN, 0.0]).err(),
            Some(RuckigError::InvalidData)
        );
        for bad in [0.0, -1.0] {
            let mut zero = one_axis([0.0; 3], &[bad, 1.0, 10.0], 0, [1.0, 0.0]);
            assert_eq!(zero.step(0.05).code, INVALID_INPUT);
        }
    }
}
