//! One run of a scene from its start to its end.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::super::Config;
use super::super::apart;
use super::super::captures::TestCapture;
use super::super::case::{Outcome, Status, TestCase};
use capture::Tape;
use format::scene_input::SceneInput;
use permissions::Permissions;
use scene::object::script_object::ScriptType;
use script::test_bench::{RunReport, RunRequest};
use simulator::{Limits, Options};

/// A scene that has been read.
#[derive(Debug)]
pub(in super::super) struct Scene {
    path: PathBuf,
    input: SceneInput,
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
    pub(super) fn read(path: &Path, tape: &Tape) -> Result<Self, String> {
        let input = SceneInput::read(path, &Permissions::all().on_tape(tape))?;
        if let SceneInput::File(file) = &input {
            // A damaged file is reported before anything runs.
            file.scene()
                .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        }
        let path = std::path::absolute(path).map_err(|error| error.to_string())?;
        Ok(Self { path, input })
    }
}

/// Facts of a capture's header: the number of the run, and where its scene was.
pub(super) const RUN: &str = "run";
pub(super) const PLACE: &str = "scene";

/// Runs a scene to its end; a run that fails is captured where that is asked for. Setting `stop` ends it wherever it is.
pub(in super::super) fn simulate(config: &Config, job: &Job, stop: &Arc<AtomicBool>) -> Outcome {
    let Some(captures) = &config.captures else {
        return simulate_on(config, job, stop, &Tape::default());
    };
    let failed = |reason: String| Outcome::new(Arc::clone(&job.case), Status::Error, &reason);
    let place = job.scene.path.to_string_lossy().into_owned();
    let facts = [(RUN, job.case.index.to_string()), (PLACE, place)];
    let mut capture = match TestCapture::of_facts(captures, facts) {
        Ok(capture) => capture,
        Err(error) => return failed(format!("the run cannot be captured: {error}")),
    };
    // The capture has the files of the scene as well.
    let scene = match Scene::read(&job.scene.path, capture.tape()) {
        Ok(scene) => Arc::new(scene),
        Err(reason) => return failed(reason),
    };
    let job = Job {
        scene,
        ..job.clone()
    };
    let mut outcome = simulate_on(config, &job, stop, capture.tape());
    capture.note(&mut outcome);
    outcome
}

/// The same; everything comes from outside by the tape.
pub(super) fn simulate_on(
    config: &Config,
    job: &Job,
    stop: &Arc<AtomicBool>,
    tape: &Tape,
) -> Outcome {
    let folder = job.scene.path.parent();
    let options = Options {
        seed: job.case.seed,
        stop: Arc::clone(stop),
        threads: config.threads,
        limits: Some(Limits {
            memory: config.allowance.memory,
        }),
        named_params: job.params.clone(),
        package_dirs: folder.map(Path::to_owned).into_iter().collect(),
        permissions: folder
            .map_or_else(
                || config.permissions.clone(),
                |folder| config.permissions_in(folder),
            )
            .on_tape(tape),
        resources: config.resources.clone(),
        ..Options::default()
    };
    let mut outcome = Outcome::new(Arc::clone(&job.case), Status::Passed, "");
    match apart::run(options, &job.scene.input, &job.request(), true) {
        Ok(report) => conclude(&mut outcome, report),
        Err(reason) => (outcome.status, outcome.message) = (Status::Error, reason),
    }
    outcome
}

impl Job {
    /// A paused run is stopped, since it would never resume.
    fn request(&self) -> RunRequest {
        RunRequest {
            scene: self.scene.path.clone(),
            kind: ScriptType::Customization,
            empty: false,
            start: true,
            loops: 0,
            steps: None,
            time: self.time,
            time_limit: f64::INFINITY,
        }
    }
}

fn conclude(outcome: &mut Outcome, report: RunReport) {
    (outcome.steps, outcome.time, outcome.console) = (report.steps, report.time, report.lines);
    outcome.params_read = report.params_read;
    outcome.results = super::results(report.params);
    if report.errors > 0 {
        let error = outcome.console.iter().find(|line| line.level == "error");
        outcome.message = error.map_or_else(
            || "a script raised an error.".into(),
            |line| line.located.clone().unwrap_or_else(|| line.text.clone()),
        );
        outcome.status = Status::Error;
    }
}
