//! One run of a scene from its start to its end.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::super::Config;
use super::super::case::{Outcome, Status, TestCase};
use crate::format::scene_file::{SceneFile, is_scene, read_file};
use crate::format::ttt::FileResult;
use crate::script::TestBench;
use crate::{Limits, Options, ScriptKind, SimulationState, Simulator};

/// Named parameters that begin so are results.
const RESULT: &str = "result.";

/// A scene's file, read.
#[derive(Debug)]
pub(in super::super) struct Scene {
    path: PathBuf,
    bytes: Vec<u8>,
}

/// A run to make.
#[derive(Debug, Clone)]
pub(in super::super) struct Job {
    pub case: Arc<TestCase>,
    pub scene: Arc<Scene>,
    pub params: BTreeMap<String, String>,
    pub time: Option<f64>,
}

impl Scene {
    /// # Errors
    /// When it cannot be read, or is a damaged file of CoppeliaSim.
    pub(super) fn read(path: &Path) -> io::Result<Self> {
        let about =
            |error: &dyn std::fmt::Display| io::Error::other(format!("cannot read {}: {error}", path.display()));
        let bytes = std::fs::read(path).map_err(|error| about(&error))?;
        let scene = Self { path: std::path::absolute(path)?, bytes };
        scene.file().map_err(|error| about(&error))?;
        Ok(scene)
    }

    /// What a file of CoppeliaSim holds; None for a Lua file.
    fn file(&self) -> FileResult<Option<SceneFile>> {
        if !is_scene(&self.bytes) {
            return Ok(None);
        }
        SceneFile::new(read_file(&self.bytes, self.path.parent())?).map(Some)
    }

    fn put_into(&self, sim: &mut Simulator) -> Result<(), String> {
        sim.scene_mut().modify_settings(|settings| settings.path = self.path.to_string_lossy().into_owned());
        let file = self.file().map_err(|error| error.to_string())?;
        if file.as_ref().is_none_or(SceneFile::is_model) {
            // An empty scene has room for them.
            let _ = sim.scene_mut().add_default_objects();
        }
        if let Some(file) = file {
            return sim.load(file).map_err(|error| error.to_string());
        }
        sim.add_script(ScriptKind::Customization, "Script", &self.bytes).map(drop).map_err(|error| error.to_string())
    }
}

/// Runs the scene until it ends, is out of time or is told to `stop`.
pub(in super::super) fn simulate(config: &Config, job: &Job, stop: &Arc<AtomicBool>) -> Outcome {
    let bench = TestBench::new(job.case.file.to_string_lossy().into_owned(), f64::INFINITY);
    let options = Options {
        seed: job.case.seed,
        stop: Arc::clone(stop),
        limits: Some(Limits { memory: config.allowance.memory }),
        named_params: job.params.clone(),
        package_dirs: job.scene.path.parent().map(Path::to_owned).into_iter().collect(),
        ..Options::default()
    };
    let mut sim = Simulator::with_console(options, bench.console());
    let mut outcome = Outcome::new(Arc::clone(&job.case), Status::Passed, "");
    match job.scene.put_into(&mut sim) {
        Ok(()) if sim.errors() == 0 => (outcome.steps, outcome.time) = run(&mut sim, job.time, stop),
        Ok(()) => {}
        Err(reason) => (outcome.status, outcome.message) = (Status::Error, reason),
    }
    outcome.results = results(&sim);
    outcome.console = bench.take_lines();
    if sim.errors() > 0 {
        let error = outcome.console.iter().find(|line| line.level == "error");
        outcome.message = error.map_or_else(|| "a script raised an error.".into(), |line| line.text.clone());
        outcome.status = Status::Error;
    }
    outcome
}

/// Steps made and seconds simulated until the end. A paused run is ended, since nobody would resume it.
fn run(sim: &mut Simulator, limit: Option<f64>, stop: &AtomicBool) -> (u64, f64) {
    sim.start();
    let (mut steps, mut time) = (0, 0.0);
    let mut asked = false;
    while sim.state() != SimulationState::Stopped && !sim.quit_requested() {
        // Time is a sum of steps; it may fall short of a round number by its rounding errors.
        let late = limit.is_some_and(|limit| sim.time() * (1.0 + 1e-12) >= limit);
        if asked || late || sim.state() == SimulationState::Paused || stop.load(Ordering::Relaxed) {
            asked = true;
            sim.request_stop();
        }
        sim.pass();
        if sim.steps() < steps {
            // The scene has started anew.
            break;
        }
        (steps, time) = (sim.steps(), sim.time());
    }
    (steps, time)
}

fn results(sim: &Simulator) -> BTreeMap<String, String> {
    let named = sim.named_params().into_iter();
    named.filter_map(|(name, value)| Some((name.strip_prefix(RESULT)?.to_owned(), value))).collect()
}
