//! `swanilda init`: lets an editor with the Lua language server complete `sim` in a folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::json;

use super::{Outcome, say};

/// Where the stubs go, seen from the folder.
const STUBS: &str = ".swanilda/stubs";

/// Write editor settings and stubs so that `sim` is completed
#[derive(clap::Args)]
pub(super) struct Args {
    /// Folder to set up [default: the current one]
    #[arg(default_value = ".")]
    folder: PathBuf,
    /// Overwrite existing files
    #[arg(long)]
    force: bool,
}

pub(super) fn init(args: &Args) -> Outcome {
    let stubs = docs::stubs()
        .into_iter()
        .map(|(path, text)| (args.folder.join(STUBS).join(path), text));
    let files: Vec<_> = std::iter::once((args.folder.join(".luarc.json"), settings()))
        .chain(stubs)
        .collect();
    if let Some((path, _)) = files.iter().find(|(path, _)| path.exists() && !args.force) {
        return Err(format!("{} exists; --force overwrites it", path.display()));
    }
    for (path, text) in &files {
        write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    let folder = args.folder.join(STUBS);
    let line = format!(
        "wrote {} and {} files below {}\n",
        files[0].0.display(),
        files.len() - 1,
        folder.display()
    );
    say(line.as_bytes());
    Ok(ExitCode::SUCCESS)
}

fn write(path: &Path, text: &str) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)
}

/// Settings of the language server. Scripts define callbacks and keep handles as globals, which is no mistake: the calls between scripts
/// are to global functions. Modules are globals as long as a script requires none.
fn settings() -> String {
    let modules = docs::module_names()
        .into_iter()
        .filter(|name| name.starts_with("sim"));
    let globals: Vec<String> = std::iter::once("sim".to_owned()).chain(modules).collect();
    let settings = json!({
        "runtime.version": "Lua 5.4",
        "workspace.library": [STUBS],
        "diagnostics.globals": globals,
        "diagnostics.disable": ["lowercase-global"],
    });
    format!("{settings:#}\n")
}
