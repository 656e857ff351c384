//! `swanilda batch`: one scene, many runs, a table of results.

mod ray;

use std::collections::{BTreeMap, BTreeSet};
use std::io::IsTerminal;
use std::num::NonZero;
use std::path::PathBuf;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Outcome;
use super::capture::captures;
use super::interrupt::Interrupt;
use super::permissions::PermissionArgs;
use super::resources::ResourceArgs;
use super::setup::{named_param, seconds};
use capture::{Header, Tape};
use simulator::Options;
use testing::batch::{self, Batch, Finished, Run, Store};
use testing::{Allowance, Config};

/// Exit code when some runs failed.
const FAILED: u8 = 1;
/// Exit code after ctrl-c, as shells expect it.
const INTERRUPTED: u8 = 130;
/// Seeds of one batch.
const MAX_SEEDS: u32 = 10_000_000;

/// Run a scene many times with different seeds and parameters
///
/// Scripts read parameters and report results with the module swanilda.batch. An interrupted batch resumes where it stopped.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, or a folder made by unpack
    scene: PathBuf,
    /// Seeds: a range such as 0..99 (both ends included), or a list such as 1,2,3
    #[arg(long, value_name = "SEEDS", value_parser = seeds)]
    seeds: Option<Seeds>,
    /// Parameter and its values, such as kp=1,2,5; may be repeated to run every combination
    #[arg(long, value_name = "NAME=V1,V2,...", value_parser = sweep)]
    sweep: Vec<(String, Vec<String>)>,
    /// Parameter with the same value in all runs; may be repeated
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = named_param)]
    define: Vec<(String, String)>,
    /// Number of runs in parallel [default: number of processors]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..), conflicts_with = "ray")]
    jobs: Option<u16>,
    /// Threads of each run that compute mechanisms; results do not depend on it
    #[arg(long, value_name = "N", default_value = "1", conflicts_with = "ray")]
    threads: NonZero<usize>,
    /// Folder for the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    out: PathBuf,
    /// Stop each run after this much simulated time
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    time: Option<f64>,
    /// Wall-clock time limit per run
    #[arg(long, value_name = "SECONDS", default_value = "3600", value_parser = seconds, allow_negative_numbers = true)]
    timeout: f64,
    /// Memory limit for the Lua code of a run, MiB
    #[arg(long, value_name = "MIB", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "ray")]
    memory: u32,
    /// Make the runs on a cluster of Ray, with Python's package swanilda: its address, or local
    #[arg(long, value_name = "ADDRESS")]
    ray: Option<String>,
    /// Capture runs that fail, to run them again with `swanilda replay FILE`: a file for each, in this folder [default FOLDER: batch-captures]
    #[arg(long, value_name = "FOLDER", num_args = 0..=1, require_equals = true, default_missing_value = "batch-captures", conflicts_with = "ray")]
    capture_failures: Option<PathBuf>,
    /// Start over and overwrite existing results
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    resources: ResourceArgs,
    #[command(flatten)]
    permissions: PermissionArgs,
}

/// A list of seeds; a type of its own, since clap takes a plain list for a repeated option.
#[derive(Debug, Clone)]
struct Seeds(Vec<u32>);

/// Runs the batch; the exit code reports the outcome.
pub(super) fn batch(args: &Args) -> Outcome {
    let interrupt = Interrupt::install(INTERRUPTED);
    let code = run(args, &interrupt)?;
    // At once: a run that could not be ended may still keep a thread.
    std::process::exit(i32::from(super::code_of_loss().unwrap_or(code)))
}

fn run(args: &Args, interrupt: &Interrupt) -> Result<u8, String> {
    let batch = args.batch();
    if let Some(address) = &args.ray {
        if args.permissions.is_restricted() {
            return Err("--ray knows no restrictions of permissions.".into());
        }
        return ray::run(&batch, address, &args.out, args.timeout, args.force);
    }
    let runs = batch.runs();
    let mut store =
        Store::open(&args.out, &batch, args.force).map_err(|error| error.to_string())?;
    if let Some(notice) = &store.notice {
        super::complain(notice);
    }
    let missing = store.missing(&runs);
    let bar = bar(&runs, &missing);
    let mut lost = None;
    let mut read = BTreeSet::new();
    let config = Config {
        captures: captures(args.capture_failures.as_ref())?,
        ..args.config(interrupt)
    };
    batch::run(&config, &batch, &missing, &mut |finished| {
        read.extend(finished.params_read.iter().cloned());
        if let Some(text) = failure(&finished) {
            bar.suspend(|| super::complain(&text));
        }
        bar.inc(1);
        lost = lost.take().or(store.add(finished.row).err());
    })?;
    bar.finish_and_clear();
    if let Some(error) = lost {
        return Err(error.to_string());
    }
    if !missing.is_empty() && !interrupt.is_requested() {
        warn_of_unread(&batch, &read);
    }
    let line = finished(&store, runs.len())?;
    super::say((line + "\n").as_bytes());
    let failed = store.failed();
    Ok(if interrupt.is_requested() {
        INTERRUPTED
    } else {
        u8::from(failed > 0) * FAILED
    })
}

/// What is said of a run that has failed.
fn failure(finished: &Finished<'_>) -> Option<String> {
    let run = &finished.row.run;
    let error = finished.row.error.as_ref()?;
    let capture = finished.capture.map_or_else(String::new, |capture| {
        format!("; swanilda replay {}", capture.display())
    });
    Some(format!(
        "run {} (seed {}): {error}{capture}",
        run.number, run.seed
    ))
}

/// Makes the run of a capture again, and prints what its scripts print.
///
/// # Errors
/// When it is no capture of a run.
pub(super) fn replay(args: &Args, header: &Header, tape: &Tape) -> Result<(), String> {
    let config = args.config(&Interrupt::install(INTERRUPTED));
    let outcome = batch::replay(&config, &args.batch(), header, tape)?;
    super::test::print(&outcome, "the run has failed");
    Ok(())
}

/// Writes the table; the line that says so.
///
/// # Errors
/// When it cannot be written.
pub(super) fn finished(store: &Store, runs: usize) -> Result<String, String> {
    let table = store.finish().map_err(|error| error.to_string())?;
    let (done, failed) = (store.rows().count(), store.failed());
    let table = table.display();
    Ok(format!(
        "{done} of {runs} runs done, {failed} failed: {table}"
    ))
}

/// Names the swept parameters that no run has read: its rows differ by chance only, or not at all.
fn warn_of_unread(batch: &Batch, read: &BTreeSet<String>) {
    for (name, _) in batch.sweeps.iter().filter(|(name, _)| !read.contains(name)) {
        super::complain(&format!(
            "no run has read the parameter {name}; scripts read it with sim.getNamedStringParam('{name}') or, after batch = require 'swanilda.batch', with batch.param('{name}')"
        ));
    }
}

fn bar(runs: &[Run], missing: &[Run]) -> ProgressBar {
    let hidden = !std::io::stderr().is_terminal();
    let target = if hidden {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(runs.len() as u64), target);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {eta} left");
    bar.set_style(style.expect("the template is well-formed"));
    bar.with_position((runs.len() - missing.len()) as u64)
}

impl Args {
    fn batch(&self) -> Batch {
        Batch {
            scene: self.scene.clone(),
            seeds: self
                .seeds
                .clone()
                .map_or_else(|| vec![Options::default().seed], |seeds| seeds.0),
            sweeps: self.sweep.clone(),
            fixed: self.define.iter().cloned().collect::<BTreeMap<_, _>>(),
            time: self.time,
            branch_at: None,
        }
    }

    fn config(&self, interrupt: &Interrupt) -> Config {
        let jobs = self.jobs.map_or_else(super::test::processors, usize::from);
        let allowance = Allowance {
            wall: Duration::from_secs_f64(self.timeout),
            simulated: f64::INFINITY,
            memory: (self.memory as usize) << 20,
        };
        Config {
            threads: self.threads,
            permissions: self.permissions.permissions(),
            resources: self.resources.folder(),
            ..Config::new(jobs, allowance, interrupt.flag())
        }
    }
}

fn seeds(text: &str) -> Result<Seeds, String> {
    let wrong = || "seeds are written 0..99 or 1,2,3".to_owned();
    if let Some((first, last)) = text.split_once("..") {
        let (first, last): (u32, u32) = (
            first.parse().map_err(|_| wrong())?,
            last.parse().map_err(|_| wrong())?,
        );
        return match last.checked_sub(first) {
            Some(count) if count < MAX_SEEDS => Ok(Seeds((first..=last).collect())),
            _ => Err(wrong()),
        };
    }
    let list: Result<Vec<u32>, _> = text.split(',').map(str::parse).collect();
    list.map(Seeds).map_err(|_| wrong())
}

pub(super) fn sweep(text: &str) -> Result<(String, Vec<String>), String> {
    match text.split_once('=') {
        Some((name, values)) if !name.is_empty() => Ok((
            name.to_owned(),
            values.split(',').map(str::to_owned).collect(),
        )),
        _ => Err("NAME=V1,V2,... is needed".into()),
    }
}
