//! The add-ons in the folder of the library: files of their users, which scripts and programs call by name.

use std::fs;
use std::path::{Path, PathBuf};

use format::scene_file::with_compat;
use simulator::{ScriptKind, Simulator};

/// What the names of add-ons begin with; the rest is the name of the script.
const PREFIX: &str = "simAddOnScript";

/// Starts every `simAddOnScript_NAME.lua` of a folder, in the order of their names. They are of CoppeliaSim 4.1, so they are converted
/// as scripts in old scenes are.
///
/// # Errors
/// When one cannot be read.
pub(crate) fn start(simulator: &mut Simulator, root: &Path) -> Result<(), String> {
    for path in files(root) {
        let code =
            fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        // One that fails has said so in the log.
        let _ = simulator.add_script_of_file(
            ScriptKind::AddOn,
            &name(&path),
            &with_compat(code),
            Some(&path),
        );
    }
    Ok(())
}

/// A folder that is not there has none.
fn files(root: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(root).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| is_add_on(path))
        .collect();
    files.sort();
    files
}

fn is_add_on(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with(PREFIX) && name.ends_with(".lua") && name.len() > PREFIX.len() + ".lua".len()
}

/// `simAddOnScript_PyRep.lua` is `PyRep`, as is `simAddOnScript-PyRep.lua`.
fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = stem.trim_start_matches(PREFIX);
    name.trim_start_matches(['_', '-', ' ']).to_owned()
}
