//! `swanilda diff`: what is different between two scenes.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::{Outcome, files, say};
use format::scene_outline::{Outline, differences};

/// Exit code when the scenes differ.
const DIFFERENT: u8 = 1;

/// Compare two scenes or models: objects added, removed, moved and changed, and scripts line by line
#[derive(clap::Args)]
pub(super) struct Args {
    /// A .ttt or .ttm file, or a folder made by unpack
    old: PathBuf,
    new: PathBuf,
}

/// Exit codes as for `diff`: 0 if equal, 1 if different.
pub(super) fn diff(args: &Args) -> Outcome {
    let report = differences(&outline(&args.old)?, &outline(&args.new)?);
    say(report.as_bytes());
    Ok(if report.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(DIFFERENT)
    })
}

pub(super) fn outline(path: &Path) -> Result<Outline, String> {
    Outline::new(files::scene(path)?).map_err(|error| format!("{}: {error}", path.display()))
}
