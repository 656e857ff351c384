//! Force sensors as data: thresholds, filter, readings.

use std::collections::VecDeque;

use crate::Pose;

/// How samples are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceFilter {
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
    pub filter: ForceFilter,
    /// Number of the latest samples that are combined.
    pub sample_size: usize,
    /// Magnitude of the filtered force that counts as a violation, N.
    pub force_threshold: f64,
    /// Whether the force threshold applies.
    pub force_threshold_enabled: bool,
    /// Magnitude of the filtered torque that counts as a violation, N m.
    pub torque_threshold: f64,
    /// Whether the torque threshold applies.
    pub torque_threshold_enabled: bool,
    /// Filtered values in a row beyond a threshold that call the trigger function of scripts.
    pub consecutive_violations: u32,
    /// Filtered values in a row so far that exceed a threshold.
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
            filter: ForceFilter::Average,
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
