//! The options of a simulator.

mod cache;
mod waiting;

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr};
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::log::verbosity;
use crate::random::Random;
use crate::ros_options::RosOptions;
pub use cache::CacheFolder;
use permissions::Permissions;

/// The options of a simulator.
#[derive(Debug, Clone)]
pub struct Options {
    /// Seed of every script's random numbers.
    pub seed: u32,
    /// Log lines above this level are not shown.
    pub verbosity: i64,
    /// Named parameters scripts read.
    pub named_params: BTreeMap<String, String>,
    /// Folder of the data scripts keep beyond the life of the program; None: where the system keeps the user's.
    pub data_dir: Option<std::path::PathBuf>,
    /// Where to keep what takes long to compute, for itself and for other processes.
    pub cache: CacheFolder,
    /// Folder of an installation of CoppeliaSim, with its `models` and `lua`. Scripts read it where they may read the scene's folder.
    pub resources: Option<std::path::PathBuf>,
    /// Folders `require` looks into first.
    pub package_dirs: Vec<std::path::PathBuf>,
    /// Folders with native plugins, besides the scene's.
    pub plugin_dirs: Vec<std::path::PathBuf>,
    /// A file that names the function of a plugin that is running, for whoever looks at it after a crash.
    pub plugin_note: Option<std::path::PathBuf>,
    /// Lua instructions a thread may run per millisecond of its time slice.
    pub instructions_per_ms: u64,
    /// Permissions of scripts: files, programs, the network.
    pub permissions: Permissions,
    /// Set it to end calls that wait for the world outside: they raise an error.
    pub stop: Arc<AtomicBool>,
    /// Limits of resources that scripts may use; None: no limit.
    pub limits: Option<Limits>,
    /// Whether to count the lines of scripts that run. Scripts are slower meanwhile.
    pub count_lines: bool,
    /// Whether processes of scripts in Python listen for a debugger of Python (debugpy).
    pub debug_python: bool,
    /// The Python of the program around the simulator, for programs that work for scripts.
    pub python: Option<String>,
    /// Whether the error for a missing module has CoppeliaSim's text, with every place that was searched.
    pub original_errors: bool,
    /// Whether `simOMPL.compute` sets its task up first, as in CoppeliaSim up to 4.1.
    pub sets_up_plans: bool,
    /// Threads that draw pictures and divide meshes into convex pieces; None for as many as there are processor cores. Results do not depend on it.
    pub render_threads: Option<NonZero<usize>>,
    /// Threads that compute mechanisms that are apart, such as robots. Results do not depend on it.
    pub threads: NonZero<usize>,
    /// The address on which servers of scripts listen.
    pub listen_address: IpAddr,
    /// Origins of web pages that may use the remote API, besides those of this machine; `*` for all.
    pub web_origins: Vec<String>,
    /// How scripts take part in networks of ROS.
    pub ros: RosOptions,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: Random::DEFAULT_SEED,
            verbosity: verbosity::SCRIPT_INFOS,
            named_params: BTreeMap::new(),
            data_dir: None,
            cache: CacheFolder::default(),
            resources: None,
            package_dirs: Vec::new(),
            plugin_dirs: Vec::new(),
            plugin_note: None,
            instructions_per_ms: 100_000,
            permissions: Permissions::all(),
            stop: Arc::default(),
            limits: None,
            count_lines: false,
            debug_python: false,
            python: None,
            original_errors: false,
            sets_up_plans: false,
            render_threads: None,
            threads: NonZero::<usize>::MIN,
            listen_address: Ipv4Addr::LOCALHOST.into(),
            web_origins: Vec::new(),
            ros: RosOptions::default(),
        }
    }
}

/// Limits for scripts that may not end. Lua code runs slower under them, since it is checked every thousand instructions:
/// by then `Options::stop` ends it too, wherever it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes all scripts together may have.
    pub memory: usize,
}

impl Limits {
    /// So many MiB for all scripts together.
    pub fn of_mebibytes(count: u32) -> Self {
        Self {
            memory: (count as usize) << 20,
        }
    }
}

impl Options {
    /// A folder of the installation of CoppeliaSim, or the installation itself for an empty name; None without an installation.
    pub(crate) fn installed(&self, folder: &str) -> Option<String> {
        let resources = self.resources.as_deref()?;
        let path = if folder.is_empty() {
            resources.to_owned()
        } else {
            resources.join(folder)
        };
        Some(path.to_string_lossy().into_owned())
    }

    /// The library of a plugin: beside the scene, in the folders of the user, beside the program, in an installation of CoppeliaSim.
    pub(crate) fn plugin_file(&self, name: &str) -> Result<PathBuf, String> {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        if name.is_empty() || name.starts_with('.') || !name.chars().all(is_plain) {
            return Err("a plugin's name consists of letters, digits, `_`, `-` and `.`".into());
        }
        let beside = std::env::current_exe()
            .ok()
            .and_then(|program| Some(program.parent()?.to_owned()));
        let folders = self
            .package_dirs
            .iter()
            .chain(&self.plugin_dirs)
            .chain(&beside)
            .chain(&self.resources);
        let file = format!(
            "{}{name}{}",
            std::env::consts::DLL_PREFIX,
            std::env::consts::DLL_SUFFIX
        );
        let folders: Vec<_> = folders.collect();
        folders
            .iter()
            .map(|folder| folder.join(&file))
            .find(|path| path.is_file())
            .ok_or_else(|| {
                let searched: Vec<_> = folders
                    .iter()
                    .map(|folder| folder.display().to_string())
                    .collect();
                format!(
                    "there is no file {file} in {}; name its folder with --plugin-path",
                    searched.join(", ")
                )
            })
    }
}
