//! Properties of the application.

use std::collections::BTreeMap;

use super::access::{Accessor, subject_properties};
use crate::scene::{CustomData, Kept};
use crate::script::app_storage::AppStorage;
use crate::script::error::ApiError;
use crate::script::events::Protocol;
use crate::script::sim::Options;

/// What scripts keep with the application.
#[derive(Default)]
pub(crate) struct AppData {
    /// What outlives the program, its custom data among it.
    pub storage: AppStorage,
    /// Raw custom data: it ends with the program.
    pub raw_data: CustomData,
    pub signals: CustomData,
    /// Parameters of the command line, and what scripts added.
    pub named_params: BTreeMap<String, Vec<u8>>,
    /// Persistent data that is not meant for the file; None hides what the file has.
    pub persistent_data: BTreeMap<String, Option<Vec<u8>>>,
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
    pub(crate) fn new(options: &Options) -> Self {
        let params = options.named_params.iter();
        let named_params = params.map(|(name, value)| (name.clone(), value.as_bytes().to_vec())).collect();
        Self { named_params, storage: AppStorage::new(options.data_dir.as_deref()), ..Self::default() }
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
