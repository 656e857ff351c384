//! Properties of the application.

use std::collections::BTreeMap;

use super::access::{Accessor, subject_properties};
use crate::scene::{CustomData, Kept, Namespace};
use crate::script::error::ApiError;
use crate::script::events::Protocol;

/// What scripts keep with the application.
#[derive(Default)]
pub(crate) struct AppData {
    pub custom_data: CustomData,
    pub signals: CustomData,
    /// Parameters of the command line, and what scripts added.
    pub named_params: BTreeMap<String, Vec<u8>>,
    /// What scripts keep beyond the life of a scene.
    pub persistent_data: BTreeMap<String, Vec<u8>>,
    /// Values that have no effect here, as scripts set them.
    pub kept: Kept,
    /// Numbered switches, numbers and texts that have no effect here, as scripts set them.
    pub idle_params: IdleParams,
}

/// Parameters of the user interface and the like, by number.
#[derive(Default)]
pub(crate) struct IdleParams {
    pub bools: BTreeMap<i64, bool>,
    pub integers: BTreeMap<i64, i64>,
    pub floats: BTreeMap<i64, f64>,
    pub arrays: BTreeMap<i64, [f64; 3]>,
    pub texts: BTreeMap<i64, Vec<u8>>,
}

impl AppData {
    pub(crate) fn new(params: &BTreeMap<String, String>) -> Self {
        let named_params = params.iter().map(|(name, value)| (name.clone(), value.as_bytes().to_vec())).collect();
        Self { named_params, ..Self::default() }
    }

    pub(crate) fn named_values(&self, namespace: Namespace) -> &CustomData {
        match namespace {
            Namespace::CustomData => &self.custom_data,
            Namespace::Signal => &self.signals,
        }
    }

    pub(crate) fn named_values_mut(&mut self, namespace: Namespace) -> &mut CustomData {
        match namespace {
            Namespace::CustomData => &mut self.custom_data,
            Namespace::Signal => &mut self.signals,
        }
    }
}

pub(super) const APP: &[Accessor] = subject_properties! {
    "consoleVerbosity": i64, |s| s.sim.verbosity.get(), |s, level| s.sim.verbosity.set(level);
    "protocolVersion": i64, |s| s.sim.events.protocol.get() as i64, |s, number| {
        let protocol = Protocol::from_number(number).ok_or(ApiError::PropertyNotWritable)?;
        s.sim.set_event_protocol(protocol);
    };
    "processId": i64, |_s| i64::from(std::process::id());
    "canSave": bool, |_s| true;
};
