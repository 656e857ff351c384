//! `swanilda run --branch-at`: one past, many futures, a table of results.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use super::{Args, SCRIPT_ERROR, end};
use crate::cli::session::Session;
use crate::cli::setup::seconds;
use crate::cli::{Outcome, batch, complain};
use simulator::{Options, Run, RunTotals, Simulator, Snapshot};
use testing::batch::{Batch, Row, Store, results};

/// Where the help text lists them.
const HEADING: &str = "Branches";

/// Futures of a run.
#[derive(clap::Args)]
pub(super) struct BranchArgs {
    /// Run up to this simulated time once, and from there to the end for each combination of --sweep
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true, help_heading = HEADING, requires = "sweep",
        conflicts_with_all = ["no_start", "record", "graph", "hash_file", "expect_hash", "capture", "view", "video"])]
    branch_at: Option<f64>,
    /// Named parameter and the values that it has from --branch-at on, such as kp=1,2,5; may be repeated to run every combination
    #[arg(long, value_name = "NAME=V1,V2,...", value_parser = batch::sweep, help_heading = HEADING, requires = "branch_at")]
    sweep: Vec<(String, Vec<String>)>,
    /// Folder for the results of --branch-at
    #[arg(long, value_name = "FOLDER", default_value = "results", help_heading = HEADING, requires = "branch_at")]
    out: PathBuf,
    /// Overwrite results of other runs
    #[arg(long, help_heading = HEADING, requires = "branch_at")]
    force: bool,
}

impl BranchArgs {
    pub(super) fn is_asked_for(&self) -> bool {
        self.branch_at.is_some()
    }

    fn batch(&self, args: &Args) -> Batch {
        Batch {
            scene: args.scene.clone(),
            seeds: vec![args.setup.seed.unwrap_or(Options::default().seed)],
            sweeps: self.sweep.clone(),
            fixed: args.setup.define.iter().cloned().collect(),
            time: args.limits().time,
            branch_at: self.branch_at,
        }
    }
}

/// Runs up to the branch, then each future; the exit code reports the outcome.
pub(super) fn run(args: &Args, mut sim: Simulator, mut session: Session<'_>) -> Outcome {
    let begun = Instant::now();
    let batch = args.branches.batch(args);
    let (out, force) = (&args.branches.out, args.branches.force);
    if !force {
        Store::check(out, &batch).map_err(|error| error.to_string())?;
    }
    let past = match past(args, &mut sim, &mut session)? {
        Ok(past) => past,
        Err(code) => return Ok(ExitCode::from(code)),
    };
    let store = Store::open(out, &batch, force);
    let mut store = store.map_err(|error| error.to_string())?;
    store.clear().map_err(|error| error.to_string())?;
    let mut branches = Branches {
        args,
        past,
        batch,
        totals: RunTotals::default(),
        errors: 0,
        read: BTreeSet::new(),
    };
    branches.futures(&mut sim, &mut session, &mut store)?;
    let code = branches.report(sim, &session, &store)?;
    let (totals, errors) = (branches.totals, branches.errors);
    let output = session.output;
    output.summary(totals, None, begun.elapsed(), errors, code);
    Ok(ExitCode::from(code))
}

/// What all futures have in common.
struct Past {
    run: Run,
    moment: Snapshot,
    errors: u64,
    error: Option<String>,
}

/// Runs up to the branch. There is an exit code where the run does not come so far, and that has been said.
fn past(
    args: &Args,
    sim: &mut Simulator,
    session: &mut Session<'_>,
) -> Result<Result<Past, u8>, String> {
    let time = args.branches.branch_at.unwrap_or_default();
    let has_failed = |sim: &Simulator| {
        let text = format!("A script failed before the time of --branch-at, {time} s.");
        session.output.note(&text, sim.time());
        Ok(Err(SCRIPT_ERROR))
    };
    if sim.errors() > 0 {
        return has_failed(sim);
    }
    let mut run = Run::begin(sim, args.limits());
    if !run.go_to(sim, time, session) {
        session.progress.finish();
        let ended = run.totals().time;
        return if session.interrupt.is_requested() {
            Ok(Err(session.interrupt.exit_code()))
        } else if sim.errors() > 0 {
            has_failed(sim)
        } else {
            Err(format!(
                "the run has ended after {ended:.3} s, before the time of --branch-at, {time} s"
            ))
        };
    }
    // What was read before is the same in all futures.
    sim.take_params_read();
    Ok(Ok(Past {
        run,
        moment: sim.snapshot().map_err(|error| error.to_string())?,
        errors: sim.errors(),
        error: session.output.take_error(),
    }))
}

/// The futures, as they are run one after the other.
struct Branches<'a> {
    args: &'a Args,
    past: Past,
    batch: Batch,
    /// Of the past and all futures so far.
    totals: RunTotals,
    errors: u64,
    /// Parameters that a future has read.
    read: BTreeSet<String>,
}

impl Branches<'_> {
    fn futures(
        &mut self,
        sim: &mut Simulator,
        session: &mut Session<'_>,
        store: &mut Store,
    ) -> Result<(), String> {
        let runs = self.batch.runs();
        (self.totals, self.errors) = (self.past.run.totals(), self.past.errors);
        let fallen = session.fallen.clone();
        for run in &runs {
            sim.restore(&self.past.moment)
                .map_err(|error| error.to_string())?;
            session.output.branch(run, runs.len(), sim.time());
            session.fallen = fallen.clone();
            session.hashes = self.args.hashes.start()?;
            for (name, value) in &run.params {
                sim.set_named_param(name, value);
            }
            let totals = self.past.run.clone().finish(sim, session);
            session.progress.finish();
            if session.interrupt.is_requested() {
                return Ok(());
            }
            let row = self.row(run, sim, session, totals);
            session.output.hash(session.hashes.last());
            session.output.row(&row);
            store.add(row).map_err(|error| error.to_string())?;
        }
        Ok(())
    }

    fn row(
        &mut self,
        run: &testing::batch::Run,
        sim: &mut Simulator,
        session: &Session<'_>,
        totals: RunTotals,
    ) -> Row {
        let past = self.past.run.totals();
        self.totals.steps += totals.steps - past.steps;
        self.totals.time += totals.time - past.time;
        self.errors += sim.errors() - self.past.errors;
        self.read.extend(sim.take_params_read());
        let error = session.output.take_error();
        let has_failed = sim.errors() > 0;
        Row {
            run: run.clone(),
            error: has_failed.then(|| first_line(self.past.error.clone().or(error))),
            steps: totals.steps,
            time: totals.time,
            results: results(sim.named_params()),
        }
    }

    /// Says where the table is; the exit code.
    fn report(&self, sim: Simulator, session: &Session<'_>, store: &Store) -> Result<u8, String> {
        let (_, code) = end(sim, &Ok(()), session.interrupt);
        session
            .output
            .table(&batch::finished(store, self.batch.runs().len())?);
        if session.interrupt.is_requested() {
            return Ok(code);
        }
        self.warn_of_unread();
        Ok(u8::from(store.failed() > 0) * SCRIPT_ERROR)
    }

    /// Names the swept parameters that no future has read: its rows are all the same.
    fn warn_of_unread(&self) {
        let names = self.batch.sweeps.iter().map(|(name, _)| name);
        for name in names.filter(|name| !self.read.contains(*name)) {
            complain(&format!(
                "no script has read the parameter {name} after the time of --branch-at; a value that was read before does not change any more: read it with sim.getNamedStringParam('{name}') when it is needed"
            ));
        }
    }
}

fn first_line(error: Option<String>) -> String {
    let text = error.unwrap_or_else(|| "a script raised an error.".to_owned());
    text.lines().next().unwrap_or_default().to_owned()
}
