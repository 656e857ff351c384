//! What a simulator keeps for its scripts beyond the scene.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::Sim;
use super::broadcasts::Broadcasts;
use crate::app_storage::AppStorage;
use crate::log::auxiliary_consoles::AuxiliaryConsoles;
use crate::options::Options;
use crate::random::Random;
use scene::{CustomData, Data, InertValues};
use ui::Ui;

/// Data that scripts store in the application.
#[derive(Default)]
pub struct AppData {
    /// Persistent data beyond the life of the program, including its custom data.
    pub storage: AppStorage,
    /// Raw custom data: it ends with the program.
    pub raw_data: CustomData,
    /// Signals of the application.
    pub signals: CustomData,
    /// Parameters of the command line, and what scripts added.
    pub named_params: BTreeMap<String, Vec<u8>>,
    /// The names of parameters that scripts have read.
    pub params_read: RefCell<BTreeSet<String>>,
    /// Persistent data that is not meant for the file; None hides what the file has.
    pub persistent_data: BTreeMap<String, Option<Vec<u8>>>,
    /// Values that have no effect here, as scripts set them.
    pub inert: InertValues,
    /// Random numbers read as properties.
    pub random: Random,
    /// How many scenes were closed.
    pub closed_scenes: i64,
    /// Numbered switches, numbers and texts that have no effect here, as scripts set them.
    pub idle_params: IdleParams,
    /// The auxiliary consoles of scripts.
    pub consoles: AuxiliaryConsoles,
    /// The windows of scripts.
    pub ui: Rc<RefCell<Ui>>,
    /// The messages that scripts have sent to all others.
    pub(crate) broadcasts: Broadcasts,
}

/// Parameters of the user interface and the like, by number.
#[derive(Default)]
pub struct IdleParams {
    /// `sim.boolparam_*`.
    pub bools: BTreeMap<i64, bool>,
    /// `sim.intparam_*`.
    pub integers: BTreeMap<i64, i64>,
    /// `sim.floatparam_*`.
    pub floats: BTreeMap<i64, f64>,
    /// `sim.arrayparam_*`.
    pub arrays: BTreeMap<i64, [f64; 3]>,
    /// `sim.stringparam_*`.
    pub texts: BTreeMap<i64, Vec<u8>>,
}

impl AppData {
    /// The value of a named parameter for a script.
    pub(crate) fn read_param(&self, name: &str) -> Option<Vec<u8>> {
        let value = self.named_params.get(name)?;
        let mut read = self.params_read.borrow_mut();
        if !read.contains(name) {
            read.insert(name.to_owned());
        }
        Some(value.clone())
    }

    pub(crate) fn new(options: &Options) -> Self {
        let params = options.named_params.iter();
        let named_params = params
            .map(|(name, value)| (name.clone(), value.as_bytes().to_vec()))
            .collect();
        Self {
            named_params,
            storage: AppStorage::new(options.data_dir.as_deref()).restricted(&options.permissions),
            random: Random::new(options.seed),
            inert: installed_folders(options),
            ..Self::default()
        }
    }
}

/// The folders that file dialogs begin with.
fn installed_folders(options: &Options) -> InertValues {
    let mut values = InertValues::default();
    for (name, folder) in [("scenePath", "scenes"), ("modelPath", "models")] {
        if let Some(path) = options.installed(folder) {
            values.set(name, Data::text(&path));
        }
    }
    values
}

impl Sim {
    /// Distinguishes this scene from earlier ones.
    pub fn scene_uid(&self) -> i64 {
        self.app.borrow().closed_scenes + 1
    }

    /// Reads or changes the storage, and logs what went wrong with its file.
    pub(crate) fn with_app_storage<R>(&self, use_it: impl FnOnce(&mut AppStorage) -> R) -> R {
        let (result, notices) = {
            let mut app = self.app.borrow_mut();
            (
                use_it(&mut app.storage),
                std::mem::take(&mut app.storage.notices),
            )
        };
        notices
            .iter()
            .for_each(|(level, text)| self.log(*level, text));
        result
    }

    /// Writes what scripts have changed to the file.
    pub fn save_app_storage(&self) {
        self.with_app_storage(AppStorage::save);
    }
}
