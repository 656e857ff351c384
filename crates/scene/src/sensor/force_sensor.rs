//! Force sensors as data: thresholds, filter, readings.

use std::collections::VecDeque;

use crate::Pose;

/// How samples are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filter {
    /// The mean of the samples.
    Average = 0,
    /// The median of each component.
    Median = 1,
}

/// A rigid link that measures the load its child applies to its parent, in the sensor's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceSensor {
    /// Size of its symbol, metres.
    pub size: f64,
    /// How the samples become the filtered value.
    pub filter: Filter,
    /// Number of samples that are combined, one per simulation step.
    pub sample_size: usize,
    /// Force beyond which the link is overloaded, N.
    pub force_threshold: f64,
    /// Whether the force threshold applies.
    pub force_threshold_enabled: bool,
    /// Torque beyond which the link is overloaded, N m.
    pub torque_threshold: f64,
    /// Whether the torque threshold applies.
    pub torque_threshold_enabled: bool,
    /// Overloads in a row that call the trigger function of scripts.
    pub consecutive_violations: u32,
    /// Overloads in a row so far.
    pub violations: u32,
    /// `(force, torque)` in N and N m, the newest last, at most `sample_size`.
    pub samples: VecDeque<([f64; 3], [f64; 3])>,
    /// Force and torque of the last dynamics sub-step, N and N m.
    pub raw: Option<([f64; 3], [f64; 3])>,
    /// Force and torque after the filter, N and N m; None before there are enough samples.
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
    /// Largest number of samples kept.
    pub const MAX_SAMPLES: usize = 10_000;
}
