//! Force sensors as data: thresholds, filter, readings.

use std::collections::VecDeque;

use crate::Pose;

/// How samples are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filter {
    Average = 0,
    Median = 1,
}

/// A rigid link that measures the load its child applies to its parent, in the sensor's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceSensor {
    pub size: f64,
    pub filter: Filter,
    pub sample_size: usize,
    /// Newtons; None when switched off. The same for the torque in N m.
    pub force_threshold: f64,
    pub force_threshold_enabled: bool,
    pub torque_threshold: f64,
    pub torque_threshold_enabled: bool,
    pub consecutive_violations: u32,
    pub violations: u32,
    /// `(force, torque)`, newest last, at most `sample_size`.
    pub samples: VecDeque<([f64; 3], [f64; 3])>,
    /// Latest value of one sub-step.
    pub raw: Option<([f64; 3], [f64; 3])>,
    pub filtered: Option<([f64; 3], [f64; 3])>,
    /// Deviation of the physics engine's result from the rigid link.
    pub error: Option<Pose>,
}

impl Default for ForceSensor {
    fn default() -> Self {
        Self {
            size: 0.05,
            filter: Filter::Average,
            sample_size: 1,
            force_threshold: 100.0,
            force_threshold_enabled: false,
            torque_threshold: 10.0,
            torque_threshold_enabled: false,
            consecutive_violations: 10,
            violations: 0,
            samples: VecDeque::new(),
            raw: None,
            filtered: None,
            error: None,
        }
    }
}

impl ForceSensor {
    /// More samples are not kept.
    pub const MAX_SAMPLES: usize = 10_000;
}
