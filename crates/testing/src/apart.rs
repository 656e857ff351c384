//! A scene that runs by itself, in a simulator of its own: what `swanilda run` does, for tests and batches.

use std::path::Path;

use format::scene_input::SceneInput;
use scene::object::script_object::ScriptType;
use script::TestBench;
use script::test_bench::{RunReport, RunRequest};
use simulator::{Options, RunLimits, RunObserver, RunTotals, ScriptKind, Simulator};

/// Runs the scene that a test requested. The scene's own modules are found beside it.
pub(super) fn run_apart(options: Options, request: &RunRequest) -> Result<RunReport, String> {
    let input = SceneInput::read(&request.scene, &options.permissions)?;
    let data =
        tempfile::tempdir().map_err(|error| format!("no folder for data of scripts: {error}"))?;
    let options = Options {
        data_dir: Some(data.path().to_owned()),
        ..options
    };
    let report = run(options, &input, request, false)?;
    if report.time > request.time_limit {
        return Err(format!(
            "the scene has simulated for more than {} s (--sim-timeout).",
            request.time_limit
        ));
    }
    Ok(report)
}

/// Runs a scene to its end. With `once`, a simulation restarted by a script is not part of it.
pub(super) fn run(
    options: Options,
    input: &SceneInput,
    request: &RunRequest,
    once: bool,
) -> Result<RunReport, String> {
    let bench = TestBench::new(
        request.scene.to_string_lossy().into_owned(),
        request.time_limit,
        None,
    );
    let mut time_limit = TimeLimit {
        options: options.clone(),
        time_limit: request.time_limit,
        time: 0.0,
    };
    let mut sim = Simulator::with_console(options, bench.console());
    fill(&mut sim, input, request)?;
    let has_end = request.steps.is_some() || request.time.is_some();
    let limits = RunLimits {
        steps: request.steps,
        time: request.time,
        idle: request.loops,
        once,
    };
    let totals = if !request.start {
        sim.loop_freely(request.loops, &mut time_limit)
    } else if sim.errors() > 0 && !has_end {
        // Without its script the run might never end.
        RunTotals::default()
    } else {
        sim.run(limits, &mut time_limit)
    };
    let mut report = RunReport {
        steps: totals.steps,
        time: totals.time,
        errors: sim.errors(),
        ..RunReport::default()
    };
    report.params = sim.named_params().into_iter().collect();
    report.params_read = sim.take_params_read();
    report.line_counts = sim.take_line_counts();
    drop(sim);
    report.lines = bench.take_lines();
    Ok(report)
}

fn fill(sim: &mut Simulator, input: &SceneInput, request: &RunRequest) -> Result<(), String> {
    let path = std::path::absolute(&request.scene)
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let about = |error: &dyn std::fmt::Display| format!("{}: {error}", request.scene.display());
    match input {
        SceneInput::File(file) => {
            let scene = file.scene().map_err(|error| about(&error))?;
            if scene.is_model() && !request.empty {
                // An empty scene has room for them.
                let _ = sim.scene_mut().add_default_objects();
            }
            sim.load(scene).map_err(|error| about(&error))?;
            sim.scene_mut()
                .modify_settings(|settings| settings.path.clone_from(&path));
        }
        SceneInput::Script(code) => {
            if !request.empty {
                let _ = sim.scene_mut().add_default_objects();
            }
            sim.scene_mut()
                .modify_settings(|settings| settings.path.clone_from(&path));
            // A script that fails has said so in the log, and is counted.
            let kind = kind_of(request.kind);
            let _ =
                sim.add_script_of_file(kind, &name_of(&request.scene), code, Some(&request.scene));
            if request.kind == ScriptType::AddOn && request.empty {
                // Objects that an add-on created before there was a scene do not belong to it.
                sim.clear_scene();
            }
        }
    }
    Ok(())
}

fn kind_of(script_type: ScriptType) -> ScriptKind {
    match script_type {
        ScriptType::Main => ScriptKind::Main,
        ScriptType::Simulation => ScriptKind::Simulation,
        ScriptType::AddOn => ScriptKind::AddOn,
        ScriptType::Sandbox => ScriptKind::Sandbox,
        _ => ScriptKind::Customization,
    }
}

fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(
        || "Script".into(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}

/// Ends a run when the test has to stop, or has simulated for too long.
struct TimeLimit {
    options: Options,
    time_limit: f64,
    /// Over all simulations of the run.
    time: f64,
}

impl RunObserver for TimeLimit {
    fn should_stop(&self, _: &Simulator) -> bool {
        self.options.stop.load(std::sync::atomic::Ordering::Relaxed) || self.time > self.time_limit
    }

    fn iterated(&mut self, sim: &Simulator, stepped: bool) {
        if stepped {
            self.time += sim.scene().settings().time_step;
        }
    }
}
