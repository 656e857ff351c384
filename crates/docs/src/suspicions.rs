//! What code says that nobody understands: callbacks that nothing calls, modules that are nowhere, names that are nearly those of functions.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use super::lua::tokens::{Kind, Token};
use super::usage::{Support, Use};
use super::{callbacks, modules};
use script::{ReferenceModule, SysCall, nearest};

/// What the names of callbacks begin with.
const PREFIX: &str = "sysCall_";

/// Callbacks that scripts define and the simulator does not know: `sysCall_actution`.
pub(super) fn unknown_callback(tokens: &[Token<'_>], at: usize) -> Option<Use> {
    let Kind::Name(name) = &tokens[at].kind else {
        return None;
    };
    if !name.starts_with(PREFIX) || CALLBACKS.contains(name.as_str()) {
        return None;
    }
    // Far from all callbacks it is a function of the script's own.
    let endings = CALLBACKS
        .iter()
        .filter_map(|known| known.strip_prefix(PREFIX));
    let near = nearest(
        name.strip_prefix(PREFIX)?,
        endings.map(|ending| (ending.to_owned(), format!("{PREFIX}{ending}"))),
    )?;
    Some(Use {
        hint: Some(format!("did you mean {near}?")),
        ..Use::missing(name.clone(), tokens[at].line)
    })
}

/// All callbacks, those of scripts of older versions too.
static CALLBACKS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    let known = SysCall::ALL.iter().map(|callback| callback.name());
    known.chain(callbacks::names()).collect()
});

/// A module that is neither CoppeliaSim's, nor ours, nor a file beside the script.
pub(super) fn unknown_module(name: &str, folder: Option<&Path>, line: usize) -> Option<Use> {
    let folder = folder?;
    let is_known = modules::names().any(|known| known == name)
        || ::modules::registry().module(name).is_some()
        || ReferenceModule::all().any(|module| module.name == name)
        || ::modules::registry().files.contains_key(name)
        || STANDARD.contains(&name);
    if is_known || name.is_empty() || is_beside(folder, name) {
        return None;
    }
    let hint = suggestion(name, ReferenceModule::all().map(|module| module.name));
    Some(Use {
        hint: Some(
            hint.unwrap_or_else(|| {
                "no module of CoppeliaSim, and no file beside the script".into()
            }),
        ),
        ..Use::missing(format!("require '{name}'"), line)
    })
}

/// Modules of Lua itself.
const STANDARD: [&str; 9] = [
    "_G",
    "coroutine",
    "debug",
    "io",
    "math",
    "os",
    "string",
    "table",
    "utf8",
];

/// Whether Lua finds a module in a folder, or in one above it.
fn is_beside(folder: &Path, module: &str) -> bool {
    let place = module.replace('.', "/");
    let files = ["{}.lua", "{}/init.lua", "{}.so", "lua/{}.lua", "{}"];
    folder.ancestors().take(2).any(|folder| {
        files
            .iter()
            .any(|file| folder.join(file.replace("{}", &place)).exists())
    })
}

/// What is said of a module of CoppeliaSim that is not here.
pub(super) fn instead_of_module(name: &str) -> Option<String> {
    let module = ReferenceModule::all().find(|module| module.name == name)?;
    let instead = module.instead.replace('`', "");
    match (module.is_later(), instead.as_str()) {
        (true, _) => Some(format!(
            "of CoppeliaSim 4.11, the version after 4.10; use {instead}"
        )),
        (false, "") => None,
        (false, instead) => Some(format!("use {instead}")),
    }
}

/// The function or constant of a module that was probably meant.
pub(super) fn meant(module: &str, member: &str) -> Option<String> {
    let registry = ::modules::registry();
    let namespace = registry.module(module)?;
    suggestion(member, namespace.names().into_iter()).filter(|_| !namespace.contains(member))
}

fn suggestion<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> Option<String> {
    let near = nearest(wanted, names.map(|name| (name.to_owned(), name.to_owned())))?;
    Some(format!("did you mean {near}?"))
}

/// What is said of a function of the version after 4.10.
pub(super) fn is_later(name: &str) -> Option<String> {
    let (module, member) = name.split_once('.')?;
    let is_later = ::modules::registry().module(module)?.is_later(member);
    is_later.then(|| "of CoppeliaSim 4.11, the version after 4.10".to_owned())
}

impl Use {
    /// What is missing, under a name, in a line.
    pub(super) fn missing(name: String, line: usize) -> Self {
        Self {
            name,
            written: None,
            line,
            support: Support::Missing,
            hint: None,
        }
    }
}
