//! One run of a scene from its start to its end.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::super::Config;
use super::super::apart;
use super::super::case::{Outcome, Status, TestCase};
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
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let input = SceneInput::read(path, &Permissions::all())?;
        if let SceneInput::File(file) = &input {
            // A damaged file is reported before anything runs.
            file.scene()
                .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        }
        Ok(Self {
            path: std::path::absolute(path).map_err(|error| error.to_string())?,
            input,
        })
    }
}

/// Runs a scene to its end. Setting `stop` ends it wherever it is.
pub(in super::super) fn simulate(config: &Config, job: &Job, stop: &Arc<AtomicBool>) -> Outcome {
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
        permissions: folder.map_or_else(
            || config.permissions.clone(),
            |folder| config.permissions_in(folder),
        ),
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
