//! Trajectories: jerk-limited, time-optimal, and the splines below them.

pub mod ruckig;
pub mod ruckig_plan;
pub mod spline;
pub mod time_optimal;
