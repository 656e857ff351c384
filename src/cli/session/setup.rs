//! Common set-up of `run` and `serve`: the simulator and its scene.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use super::debugging::DebugArgs;
use super::interrupt::Interrupt;
use super::output::{Format, Output};
use super::progress::Progress;
use super::resources::ResourceArgs;
use super::ros::RosArgs;
use crate::cli::complain;
use capture::Tape;
use format::scene_file::{self, SceneFile};
use format::scene_input::{Bases, SceneInput};
use format::script_file;
use format::ttt::FileError;
use permissions::Permissions;
use script::log::verbosity;
use simulator::{CacheFolder, Error, Limits, Options, ScriptKind, ScriptRef, Simulator};

/// Simulator options
#[derive(clap::Args)]
pub(in crate::cli) struct Setup {
    /// Start with an empty scene instead of the default scene
    #[arg(long)]
    pub empty: bool,
    /// Hold the base of a robot in URDF, SDF or MJCF in place
    #[arg(long)]
    fix_base: bool,
    /// Length of a simulation step
    #[arg(long, value_name = "SECONDS", value_parser = step_length, allow_negative_numbers = true)]
    dt: Option<f64>,
    /// Run in real time
    #[arg(long)]
    realtime: bool,
    /// Seed for the scripts' random numbers
    #[arg(long)]
    pub seed: Option<u32>,
    /// Lua instructions per millisecond of a thread's time slice
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), allow_negative_numbers = true)]
    instructions_per_ms: Option<u64>,
    /// Threads that compute mechanisms and draw pictures; results do not depend on it [default: 1; all processors for pictures]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Memory limit for the Lua code, MiB [default: none; 4096 where an option restricts what scripts may do]
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u32).range(1..))]
    memory: Option<u32>,
    /// Named parameter for scripts (sim.getNamedStringParam); may be repeated
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = named_param)]
    pub define: Vec<(String, String)>,
    /// Folder for persistent data of scripts [default: the user's data folder]
    #[arg(long, value_name = "FOLDER")]
    data_dir: Option<PathBuf>,
    /// Folder for what takes long to compute, such as the convex pieces of meshes; results do not depend on it [default: the user's cache folder]
    #[arg(long, value_name = "FOLDER")]
    cache_dir: Option<PathBuf>,
    /// Keep nothing that takes long to compute for the next run
    #[arg(long, conflicts_with = "cache_dir")]
    no_cache: bool,
    /// Folder with native plugins (libsimName.so), besides the scene's; may be repeated
    #[arg(long, value_name = "FOLDER")]
    plugin_path: Vec<PathBuf>,
    #[command(flatten)]
    resources: ResourceArgs,
    #[command(flatten)]
    pub debug: DebugArgs,
    #[command(flatten)]
    ros: RosArgs,
    /// Lua file to load as an add-on; may be repeated
    #[arg(long, value_name = "FILE")]
    addon: Vec<PathBuf>,
    /// Lua file with faults of sensors, messages, remote clients, motors, bodies and programs, such as `faults.noise('/script', 'sim.readProximitySensor', 0.02)`
    #[arg(long, value_name = "FILE")]
    faults: Option<PathBuf>,
    /// Convert Lua files written for V-REP or early CoppeliaSim, as scripts in old scenes are: old names, threads, changed meanings
    #[arg(long)]
    compat: bool,
    /// Log level: none, errors, warnings, loadinfos, scripterrors, scriptwarnings, scriptinfos, infos, debug, trace, tracelua or traceall
    #[arg(long, value_name = "LEVEL", value_parser = level)]
    verbosity: Option<i64>,
    /// Print JSON lines (output, log and summary) on standard output
    #[arg(long)]
    pub json: bool,
    /// Report errors in CoppeliaSim's words only, without files and hints
    #[arg(long)]
    original_errors: bool,
    /// Suppress status messages and the summary
    #[arg(long, short)]
    pub quiet: bool,
    /// The text of an add-on of the program's own.
    #[arg(skip)]
    pub starter: Option<String>,
}

/// A script file: its name without extension, its text, and where it is.
struct Source {
    name: String,
    code: Vec<u8>,
    path: PathBuf,
}

impl Source {
    /// The add-on that is made of a file of faults; its lines keep their numbers.
    fn of_faults(self) -> Self {
        let (before, after) = ("require('swanilda.faults')(function() ", "\nend)\n");
        Self {
            code: [before.as_bytes(), &self.code, after.as_bytes()].concat(),
            ..self
        }
    }

    fn add(&self, sim: &mut Simulator, kind: ScriptKind) -> Result<ScriptRef, Error> {
        sim.add_script_of_file(kind, &self.name, &self.code, Some(&self.path))
    }
}

/// Parts of the scene.
enum Scene {
    Script(Source),
    File(Box<SceneFile>),
}

/// The files of the command line, read.
#[derive(Default)]
pub(in crate::cli) struct Sources {
    scene: Option<Scene>,
    add_ons: Vec<Source>,
}

impl Setup {
    /// Reads the files of the command line.
    ///
    /// # Errors
    /// When one cannot be read.
    pub(in crate::cli) fn sources(
        &self,
        scene: Option<&Path>,
        tape: &Tape,
    ) -> Result<Sources, String> {
        let permissions = Permissions::all().on_tape(tape);
        let add_ons = self
            .addon
            .iter()
            .map(|path| read(path, &permissions).map(|source| self.up_to_date(source)));
        let mut add_ons = add_ons.collect::<Result<Vec<_>, _>>()?;
        let faults = self.faults.iter().map(|path| read(path, &permissions));
        for source in faults {
            add_ons.push(source?.of_faults());
        }
        let scene = scene
            .map(|path| self.read_scene(path, &permissions))
            .transpose()?
            .map(|scene| match scene {
                Scene::Script(source) => Scene::Script(self.up_to_date(source)),
                file @ Scene::File(_) => file,
            });
        Ok(Sources { scene, add_ons })
    }

    fn read_scene(&self, path: &Path, permissions: &Permissions) -> Result<Scene, String> {
        let unreadable = |error: FileError| format!("cannot read {}: {error}", path.display());
        match SceneInput::read_with(path, bases(self.fix_base), permissions)? {
            SceneInput::Script(code) => Ok(Scene::Script(Source {
                name: name_of(path),
                code,
                path: path.to_owned(),
            })),
            SceneInput::File(file) => {
                file.messages()
                    .iter()
                    .filter(|message| !self.ros.answers(message))
                    .for_each(|message| complain(&format!("{}: {message}", path.display())));
                Ok(Scene::File(Box::new(file.scene().map_err(unreadable)?)))
            }
        }
    }

    fn up_to_date(&self, source: Source) -> Source {
        let is_lua = script_file::language(Some(&source.path), &source.code) == "lua";
        if self.compat && is_lua {
            Source {
                code: scene_file::with_compat(source.code),
                ..source
            }
        } else {
            source
        }
    }

    /// The named parameter of the command line.
    pub(in crate::cli) fn param(&self, name: &str) -> Option<&str> {
        self.define
            .iter()
            .rev()
            .find(|(defined, _)| defined == name)
            .map(|(_, value)| value.as_str())
    }

    /// Whether the log has messages that CoppeliaSim does not have.
    pub(in crate::cli) fn has_own_messages(&self) -> bool {
        !self.original_errors
    }

    pub(in crate::cli) fn output(&self, progress: &Progress, interrupt: &Interrupt) -> Output {
        let format = match (self.json, self.original_errors) {
            (true, _) => Format::Json,
            (false, true) => Format::OriginalText,
            (false, false) => Format::Text,
        };
        Output::new(format, self.quiet, progress.bar(), interrupt.clone())
    }

    pub(in crate::cli) fn options(&self, scene: Option<&Path>, interrupt: &Interrupt) -> Options {
        let mut options = Options {
            named_params: self.define.iter().cloned().collect(),
            data_dir: self.data_dir.clone(),
            cache: self.cache(),
            resources: self.resources.folder(),
            package_dirs: scene.map(Simulator::folder_of_scene).into_iter().collect(),
            plugin_dirs: self.plugin_path.clone(),
            stop: interrupt.flag(),
            original_errors: self.original_errors,
            limits: self.memory.map(Limits::of_mebibytes),
            ros: self
                .ros
                .options(scene.map(Simulator::folder_of_scene).as_deref()),
            ..Options::default()
        };
        options.seed = self.seed.unwrap_or(options.seed);
        options.instructions_per_ms = self
            .instructions_per_ms
            .unwrap_or(options.instructions_per_ms);
        options.render_threads = self
            .threads
            .and_then(|threads| NonZero::new(usize::from(threads)));
        options.threads = options.render_threads.unwrap_or(options.threads);
        options.verbosity = self.verbosity.unwrap_or(options.verbosity);
        options
    }

    /// As a capture is replayed: nothing is kept in files.
    pub(in crate::cli) fn for_replay(&mut self, threads: Option<u16>) {
        (self.no_cache, self.cache_dir) = (true, None);
        self.threads = threads.or(self.threads);
    }

    fn cache(&self) -> CacheFolder {
        match &self.cache_dir {
            Some(folder) => CacheFolder::Folder(folder.clone()),
            None if self.no_cache => CacheFolder::None,
            None => CacheFolder::User,
        }
    }

    /// Add-ons come with the application, so they start first; then the scene and its script.
    pub(in crate::cli) fn fill(
        &self,
        sim: &mut Simulator,
        sources: Sources,
        kind: ScriptKind,
        scene: Option<&Path>,
    ) {
        for source in &sources.add_ons {
            // A script that fails has said so in the log, and is counted.
            let _ = source.add(sim, ScriptKind::AddOn);
        }
        for (name, code) in self.ros.add_ons() {
            let _ = sim.add_script(ScriptKind::AddOn, name, &code);
        }
        if let Some(code) = &self.starter {
            let _ = sim.add_script(ScriptKind::AddOn, "starter", code.as_bytes());
        }
        match sources.scene {
            Some(Scene::File(file)) => self.open(sim, *file),
            Some(Scene::Script(source)) => {
                self.add_default_objects(sim);
                self.apply_settings(sim, scene);
                let _ = source.add(sim, kind);
            }
            None => self.add_default_objects(sim),
        }
        self.apply_settings(sim, scene);
        if kind == ScriptKind::AddOn && self.empty {
            // Objects that an add-on created before there was a scene do not belong to it.
            sim.clear_scene();
        }
    }

    /// Opens a scene of CoppeliaSim, or puts a model on the default floor.
    fn open(&self, sim: &mut Simulator, file: SceneFile) {
        if file.is_model() {
            self.add_default_objects(sim);
        }
        // An add-on that fills the scene leaves no room for more.
        let _ = sim.load(file);
    }

    fn add_default_objects(&self, sim: &mut Simulator) {
        if !self.empty {
            // An add-on that fills the scene leaves no room for more: nothing is missing then.
            let _ = sim.scene_mut().add_default_objects();
        }
    }

    fn apply_settings(&self, sim: &mut Simulator, scene: Option<&Path>) {
        let permissions = Permissions::all().on_tape(sim.tape());
        sim.scene_mut().modify_settings(|settings| {
            settings.time_step = self.dt.unwrap_or(settings.time_step);
            settings.real_time |= self.realtime;
            if let Some(scene) = scene {
                settings.path = permissions
                    .absolute(scene)
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
            }
        });
    }
}

fn read(path: &Path, permissions: &Permissions) -> Result<Source, String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    let code = permissions
        .read_checked(path)
        .map_err(|error| unreadable(error.to_string()))?;
    script_file::check(path, &code).map_err(|reason| unreadable(reason.to_string()))?;
    Ok(Source {
        name: name_of(path),
        code,
        path: path.to_owned(),
    })
}

/// Name of a script that is read from a file.
fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(
        || "Script".into(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}

/// What `--fix-base` means.
pub(in crate::cli) fn bases(are_fixed: bool) -> Bases {
    if are_fixed {
        Bases::Fixed
    } else {
        Bases::AsDescribed
    }
}

/// A number of seconds, zero or more.
pub(in crate::cli) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a number of seconds is needed, zero or more".into()),
    }
}

/// A number of seconds above zero.
pub(in crate::cli) fn step_length(text: &str) -> Result<f64, String> {
    let dt = seconds(text)?;
    if (0.0001..=10.0).contains(&dt) {
        Ok(dt)
    } else {
        Err("a step lasts 0.0001 to 10 seconds".into())
    }
}

pub(in crate::cli) fn named_param(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("NAME=VALUE is needed".into()),
    }
}

fn level(text: &str) -> Result<i64, String> {
    let number = || text.parse().ok().filter(|level| (0..=1000).contains(level));
    let unknown = || {
        format!(
            "the levels are {}",
            verbosity::NAMES.map(|(name, _)| name).join(", ")
        )
    };
    verbosity::from_name(text)
        .or_else(number)
        .ok_or_else(unknown)
}
