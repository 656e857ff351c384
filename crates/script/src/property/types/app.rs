//! Properties of the application.

use std::path::Path;

use geometry::pose::quaternion_to_array;

use super::access::{Accessor, Subject, subject_properties};
use super::{PropertyValue, Quaternion};
use crate::error::{ApiError, ApiResult};
use crate::event_stream::Protocol;
use crate::host::Sim;
use crate::log::verbosity;
use scene::Data;

pub(in crate::property) const APP: &[Accessor] = subject_properties! {
    "sessionId": String, |s| s.sim.session_id();
    "platform": i64, |_s| platform();
    "protocolVersion": i64, |s| s.sim.events.protocol.get() as i64, |s, number| {
        let protocol = Protocol::from_number(number).ok_or(ApiError::PropertyNotWritable)?;
        s.sim.events.request_protocol(protocol);
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
    "appPath": String, |s| s.sim.options.installed("").unwrap_or_else(program_folder);
    "resourcePath": String, |s| s.sim.options.installed("").unwrap_or_default();
    "luaPath": String, |s| s.sim.options.installed("lua").unwrap_or_default();
    "pythonPath": String, |s| s.sim.options.installed("python").unwrap_or_default();
    "mujocoPath": String, |s| s.sim.options.installed("mujoco").unwrap_or_default();
    "systemPath": String, |s| s.sim.options.installed("system").unwrap_or_default();
    "addOnPath": String, |s| s.sim.options.installed("addOns").unwrap_or_default();
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
