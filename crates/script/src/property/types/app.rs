//! Properties of the application.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::rc::Rc;

use geometry::pose::quaternion_to_array;

use super::access::{Accessor, Subject, subject_properties};
use super::{PropertyValue, Quaternion};
use crate::error::{ApiError, ApiResult};
use crate::events::Protocol;
use crate::files::app_storage::AppStorage;
use crate::lifecycle::random::Random;
use crate::log::auxiliary_consoles::AuxiliaryConsoles;
use crate::log::verbosity;
use crate::person::Ask;
use crate::present::Watching;
use crate::sim::{Options, Sim};
use crate::video::Videos;
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
    /// The videos that the user and scripts record.
    pub videos: Videos,
    /// The windows of scripts.
    pub ui: Rc<RefCell<Ui>>,
    /// Who answers dialogs, if anybody does.
    pub person: Option<Rc<Ask>>,
    /// Who is shown the state after each step.
    pub watching: Watching,
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

pub(in crate::property) const APP: &[Accessor] = subject_properties! {
    "sessionId": String, |s| s.sim.session_id();
    "platform": i64, |_s| platform();
    "protocolVersion": i64, |s| s.sim.events.protocol.get() as i64, |s, number| {
        let protocol = Protocol::from_number(number).ok_or(ApiError::PropertyNotWritable)?;
        s.sim.set_event_protocol(protocol);
    };
    "processId": i64, |_s| i64::from(std::process::id());
    "execUnsafe": bool, |s| s.sim.options.permissions.can_run();
    "execUnsafeExt": bool, |s| s.sim.options.permissions.can_run();
    "consoleVerbosity": i64, |s| s.sim.log.verbosity(), |s, level| s.sim.log.set_verbosity(level);
};

/// Levels by their name, to be written only.
pub(in crate::property) const VERBOSITY_WORDS: &[Accessor] = &[
    Accessor {
        name: "consoleVerbosityStr",
        read: None,
        write: Some(set_console_level),
    },
    Accessor {
        name: "statusbarVerbosityStr",
        read: None,
        write: Some(|s, word| set_level(s, "statusbarVerbosity", word)),
    },
    Accessor {
        name: "dialogVerbosityStr",
        read: None,
        write: Some(|s, word| set_level(s, "dialogVerbosity", word)),
    },
];

/// Folders of this program, and of the user's installation of CoppeliaSim: empty without one, as what they hold is part of the program.
pub(in crate::property) const PATHS: &[Accessor] = subject_properties! {
    "appPath": String, |s| installed(&s.sim.options, "").unwrap_or_else(program_folder);
    "resourcePath": String, |s| installed(&s.sim.options, "").unwrap_or_default();
    "luaPath": String, |s| installed(&s.sim.options, "lua").unwrap_or_default();
    "pythonPath": String, |s| installed(&s.sim.options, "python").unwrap_or_default();
    "mujocoPath": String, |s| installed(&s.sim.options, "mujoco").unwrap_or_default();
    "systemPath": String, |s| installed(&s.sim.options, "system").unwrap_or_default();
    "addOnPath": String, |s| installed(&s.sim.options, "addOns").unwrap_or_default();
    "tempPath": String, |_s| temporary_folder();
    "sceneTempPath": String, |_s| temporary_folder();
    "settingsPath": String, |s| text_of(s.sim.options.data_dir.as_deref());
};

/// Each read returns a new value, from the generator of the application.
pub(in crate::property) const RANDOM: &[Accessor] = subject_properties! {
    "randomQuaternion": Quaternion, |s| Quaternion(quaternion_to_array(&s.sim.app.borrow_mut().random.rotation()));
    "randomFloat": f64, |s| s.sim.app.borrow_mut().random.next();
    "randomString": String, |s| s.sim.app.borrow_mut().random.string(RANDOM_LETTERS);
};

/// Letters and digits of a random string.
const RANDOM_LETTERS: usize = 16;

/// `sim.platform_*`: 0 Windows, 1 macOS, 2 Linux.
fn platform() -> i64 {
    match std::env::consts::OS {
        "windows" => 0,
        "macos" => 1,
        _ => 2,
    }
}

fn level_of(word: Data) -> ApiResult<i64> {
    let word = String::from_data(word).ok_or(ApiError::PropertyType)?;
    verbosity::from_name(&word).ok_or(ApiError::PropertyNotWritable)
}

fn set_console_level(subject: &Subject<'_>, word: Data) -> ApiResult<()> {
    subject.sim.log.set_verbosity(level_of(word)?);
    Ok(())
}

fn set_level(subject: &Subject<'_>, property: &'static str, word: Data) -> ApiResult<()> {
    subject
        .sim
        .app
        .borrow_mut()
        .inert
        .set(property, level_of(word)?.into());
    Ok(())
}

fn program_folder() -> String {
    text_of(std::env::current_exe().unwrap_or_default().parent())
}

fn temporary_folder() -> String {
    text_of(Some(&std::env::temp_dir()))
}

/// Empty for none.
/// The folders that file dialogs begin with.
fn installed_folders(options: &Options) -> InertValues {
    let mut values = InertValues::default();
    for (name, folder) in [("scenePath", "scenes"), ("modelPath", "models")] {
        if let Some(path) = installed(options, folder) {
            values.set(name, Data::text(&path));
        }
    }
    values
}

/// A folder of the installation of CoppeliaSim; None without an installation.
fn installed(options: &Options, folder: &str) -> Option<String> {
    let resources = options.resources.as_deref()?;
    Some(text_of(Some(&if folder.is_empty() {
        resources.to_owned()
    } else {
        resources.join(folder)
    })))
}

fn text_of(path: Option<&Path>) -> String {
    path.map_or_else(String::new, |path| path.to_string_lossy().into_owned())
}

impl Sim {
    /// Distinguishes this run of this simulator from others.
    fn session_id(&self) -> String {
        format!(
            "{:x}-{:x}",
            std::process::id(),
            std::ptr::from_ref(self).addr()
        )
    }
}
