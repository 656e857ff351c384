//! Trajectories within limits: jerk-limited motion of several axes, the fastest motion along a path, cubic splines.
//!
//! This crate does not depend on a robot or a scene: an axis is a number that changes with time.
//!
//! | to plan | look at |
//! |---|---|
//! | a motion to positions or velocities, limited in velocity, acceleration and jerk, stepped online | [`ruckig::Trajectory`] |
//! | one cycle of a single axis under the same limits | [`ruckig_plan::position_step`], [`ruckig_plan::velocity_step`] |
//! | the fastest motion along a given path, limited in velocity and acceleration | [`time_optimal::TimedPath`] |
//! | a smooth curve through configurations | [`spline::CubicSpline`] |
//!
//! # Units
//!
//! Radians or metres per axis, and seconds. Axes may mix both: they meet in their durations only.
//!
//! # Methods
//!
//! - Jerk-limited motion is planned by rsruckig, a port of Ruckig (L. Berscheid and T. Kröger, *Jerk-limited real-time trajectory
//!   generation with arbitrary target states*, RSS 2021). Added here: flat argument lists, a clock that counts base cycles, and a range
//!   of magnitudes (1e-12 to 1e12) within which no power overflows.
//! - Time-optimal motion is TOPP-RA (H. Pham and Q.-C. Pham, *A new approach to time-optimal path parameterization based on reachability
//!   analysis*, IEEE Transactions on Robotics, 2018) on a grid of 2000 intervals and at least 4 per piece of the path. It starts and
//!   ends at rest.
//! - Splines have continuous second derivatives, with the end conditions that SciPy's `CubicSpline` names.
//!
//! # Limits and determinism
//!
//! No input panics; what cannot be planned is an error with the reason. No clock is read, and nothing is iterated until a time runs out: the
//! same input has the same bits on every run.
//!
//! ```
//! use motion::ruckig::{REACHED, Trajectory};
//!
//! // One axis from rest at 0 to rest at 1 with at most 0.5 /s, 1 /s² and 10 /s³, in base cycles of 0.1 ms.
//! let mut motion = Trajectory::new_position(1, 1e-4, 0, &[0.0; 3], &[0.5, 1.0, 10.0], &[1], &[1.0, 0.0])?;
//! assert!((motion.duration() - 2.6).abs() < 1e-9);
//! let last = (0..).map(|_| motion.step(0.05)).find(|step| step.code == REACHED).expect("it ends");
//! assert!((last.pva[0] - 1.0).abs() < 1e-9);
//! # Ok::<(), motion::ruckig::RuckigError>(())
//! ```

pub mod ruckig;
pub mod ruckig_plan;
pub mod spline;
pub mod time_optimal;
