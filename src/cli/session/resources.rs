//! `--resources`: the folder of an installation of CoppeliaSim that the user has.

use std::path::{Path, PathBuf};

use crate::cli::replay::reads_capture;

/// Where models and Lua files of CoppeliaSim are.
#[derive(Debug, Clone, Default, clap::Args)]
pub(in crate::cli) struct ResourceArgs {
    /// Folder of a CoppeliaSim you have, with its `models` and `lua`: scripts load models and modules from there. Readable with --no-unsafe too
    #[arg(long, value_name = "DIR", env = "SWANILDA_RESOURCES", hide_env_values = true, value_parser = folder)]
    resources: Option<PathBuf>,
}

impl ResourceArgs {
    /// The folder, absolute.
    pub(in crate::cli) fn folder(&self) -> Option<PathBuf> {
        self.resources.clone()
    }
}

fn folder(text: &str) -> Result<PathBuf, String> {
    if !Path::new(text).is_dir() && !reads_capture() {
        return Err("there is no such folder".into());
    }
    std::path::absolute(text).map_err(|error| error.to_string())
}
