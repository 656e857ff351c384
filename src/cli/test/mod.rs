//! `swanilda test`: runs the tests in Lua files.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use super::capture::captures;
use super::interrupt::Interrupt;
use super::permissions::PermissionArgs;
use super::resources::ResourceArgs;
use super::setup::seconds;
use capture::{Header, Tape};
use simulator::Options;
use testing::{self, Allowance, Config, FailingCases, Outcome, Summary};

mod coverage;
mod failure;
mod init;
mod isolate;
mod paint;
mod reports;
mod terminal;
mod watch;

use reports::ReportArgs;
use watch::Watch;

/// Exit codes, the same as pytest's.
const FAILED: u8 = 1;
pub(super) const INTERRUPTED: u8 = 2;
/// Exit code for a wrong command line.
pub(super) const USAGE: u8 = 4;
const NO_TESTS: u8 = 5;
/// Folder of failing cases of properties, below the current one.
const FAILURES: &str = ".swanilda/failures";

/// Run the tests in Lua files
///
/// Exit codes: 0 all passed, 1 some failed, 2 interrupted, 4 wrong usage, 5 no tests found.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    pub common: CommonArgs,
    /// List the tests without running them
    #[arg(long, conflicts_with_all = ["tap", "json"])]
    list: bool,
    /// Stop after the first failure
    #[arg(long)]
    fail_fast: bool,
    /// Run only share I of N, to split the tests among machines
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(usize, usize)>,
    /// Run each test N times, increasing the seed by one each time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// Record golden traces instead of comparing with them
    #[arg(long)]
    update_golden: bool,
    /// Folder for plots of golden traces that differ
    #[arg(long, value_name = "FOLDER", default_value = "test-results")]
    artifacts: PathBuf,
    /// Capture tests that fail, to run them again with `swanilda replay FILE`: a file for each, in this folder [default FOLDER: test-captures]
    #[arg(long, value_name = "FOLDER", num_args = 0..=1, require_equals = true, default_missing_value = "test-captures")]
    capture_failures: Option<PathBuf>,
    /// Measure line coverage of scripts and Lua files and write it in LCOV format [default FILE: lcov.info]
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = "lcov.info")]
    coverage: Option<PathBuf>,
    /// Run each test in a child process, so that a crash in native code ends this test only
    #[arg(long)]
    isolate: bool,
    /// Run the tests again whenever a file next to or below them changes
    #[arg(long, conflicts_with_all = ["tap", "json"])]
    watch: bool,
    /// Create an example test and a CI workflow in the current folder
    #[arg(long)]
    init: bool,
}

/// Options of `swanilda test` and `swanilda search`.
#[derive(clap::Args)]
pub(super) struct CommonArgs {
    /// Test files, or folders to search for *_test.lua and test_*.lua
    #[arg(default_value = ".")]
    paths: Vec<PathBuf>,
    /// Number of simulators that run at a time [default: number of processors]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Threads of each of them that compute mechanisms; results do not depend on it
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZero<usize>,
    /// Run only tests whose `file::name` contains TEXT; may be repeated
    #[arg(long, value_name = "TEXT")]
    filter: Vec<String>,
    /// Seed for random numbers, injected faults and the values of properties
    #[arg(long)]
    seed: Option<u32>,
    /// Wall-clock time limit per test, and per case of a property
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds, allow_negative_numbers = true)]
    timeout: f64,
    /// Simulated time limit per test
    #[arg(long, value_name = "SECONDS", default_value = "3600", value_parser = seconds, allow_negative_numbers = true)]
    sim_timeout: f64,
    /// Memory limit for the Lua code of a test, MiB
    #[arg(long, value_name = "MIB", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..))]
    memory: u32,
    /// Record tests that fail: a recording and a page that plays it for each, in this folder [default FOLDER: test-recordings]
    #[arg(long, value_name = "FOLDER", num_args = 0..=1, require_equals = true, default_missing_value = "test-recordings")]
    record_failures: Option<PathBuf>,
    #[command(flatten)]
    pub reports: ReportArgs,
    #[command(flatten)]
    resources: ResourceArgs,
    #[command(flatten)]
    permissions: PermissionArgs,
}

/// Runs the tests; the exit code reports the outcome.
pub(super) fn test(args: &Args) -> ExitCode {
    if args.init {
        return init();
    }
    if let Err(reason) = args.common.reports.check() {
        return refuse(&reason);
    }
    let interrupt = Interrupt::install(INTERRUPTED);
    let mut config = args.config(&interrupt);
    match captures(args.capture_failures.as_ref()) {
        Ok(captures) => config.captures = captures,
        Err(reason) => return refuse(&reason),
    }
    if args.isolate && isolate::restrict(&mut config) {
        isolate::run(&config);
    }
    if !args.isolate && !args.list && !args.common.reports.streams() {
        isolate::after_crash();
    }
    let ran = match (args.list, args.watch) {
        (true, _) => list(&config),
        (_, true) => watch(args, &config, &interrupt),
        _ => run(args, &config),
    };
    match ran {
        // At once: a test that could not be ended may still keep a thread.
        Ok(code) => std::process::exit(i32::from(super::code_of_loss().unwrap_or(code))),
        Err(reason) => refuse(&reason),
    }
}

fn run(args: &Args, config: &Config) -> Result<u8, String> {
    let summary = testing::run(config, &mut args.common.reports.reporter(false))
        .map_err(|error| error.to_string())?;
    args.common.reports.write(&summary)?;
    if let (Some(coverage), Some(file)) = (&summary.coverage, &config.coverage) {
        coverage.write(file).map_err(|error| error.to_string())?;
        args.common
            .reports
            .print(&coverage::summary(coverage, file));
    }
    Ok(exit_code(config, &summary))
}

/// Runs the tests of a capture again, and prints what they and their scripts print.
///
/// # Errors
/// When it is no capture of tests.
pub(super) fn replay(args: &CommonArgs, header: &Header, tape: &Tape) -> Result<(), String> {
    let mut config = args.config(&Interrupt::install(INTERRUPTED));
    (config.record_failures, config.failing_cases) = (None, None);
    for outcome in testing::replay(&config, header, tape)? {
        print(&outcome, "the test has failed");
    }
    Ok(())
}

/// Prints what scripts have printed, and why something has failed.
pub(super) fn print(outcome: &Outcome, failed: &str) {
    for line in &outcome.console {
        super::say(format!("{}\n", line.text).as_bytes());
    }
    if outcome.is_bad() {
        super::complain(&format!("{failed}: {}", outcome.message));
    }
}

/// Runs the tests of a capture again, and records those that fail in a folder. The recording of the last one, and what is wrong with it.
///
/// # Errors
/// When it is no capture of tests, or nothing fails.
pub(super) fn record(
    args: &CommonArgs,
    header: &Header,
    tape: &Tape,
    folder: &Path,
) -> Result<(PathBuf, String), String> {
    let mut config = args.config(&Interrupt::none());
    (config.record_failures, config.failing_cases) = (Some(folder.to_owned()), None);
    let failed = testing::replay(&config, header, tape)?
        .into_iter()
        .rfind(testing::Outcome::is_bad)
        .ok_or("the test of the capture passes now: there is nothing to show")?;
    let page = failed.recording.ok_or(failed.message.clone())?;
    Ok((page.with_extension("swr"), failed.message))
}

/// Where failing cases of properties are kept.
fn failing_cases() -> Result<FailingCases, String> {
    let folder = PathBuf::from(FAILURES);
    let captures = captures(Some(&folder))?.ok_or("failing cases have no folder")?;
    Ok(FailingCases { folder, captures })
}

fn watch(args: &Args, config: &Config, interrupt: &Interrupt) -> Result<u8, String> {
    let watch = Watch::new(&config.paths).map_err(|error| error.to_string())?;
    let mut code = run(args, config)?;
    while let Some(changed) = watch.next(interrupt) {
        super::say(format!("\n{} has changed\n", changed.display()).as_bytes());
        code = run(args, config)?;
    }
    Ok(code)
}

fn init() -> ExitCode {
    match init::write(Path::new("")) {
        Ok(written) => {
            written
                .iter()
                .for_each(|path| super::say(format!("wrote {}\n", path.display()).as_bytes()));
            ExitCode::SUCCESS
        }
        Err(error) => refuse(&error.to_string()),
    }
}

impl Args {
    fn config(&self, interrupt: &Interrupt) -> Config {
        Config {
            shard: self.shard,
            repeat: self.repeat,
            fail_fast: self.fail_fast,
            update_golden: self.update_golden,
            artifacts: self.artifacts.clone(),
            coverage: self.coverage.clone(),
            isolate: self.isolate.then_some(isolate::command),
            ..self.common.config(interrupt)
        }
    }
}

impl CommonArgs {
    /// All tests of the files, each once.
    pub(super) fn config(&self, interrupt: &Interrupt) -> Config {
        let allowance = Allowance {
            wall: Duration::from_secs_f64(self.timeout),
            simulated: self.sim_timeout,
            memory: (self.memory as usize) << 20,
        };
        Config {
            paths: self.paths.clone(),
            threads: self.threads,
            filters: self.filter.clone(),
            seed: self.seed.unwrap_or(Options::default().seed),
            record_failures: self.record_failures.clone(),
            // Without an own command line there are no captures, nor cases that are tried first.
            failing_cases: failing_cases().ok(),
            permissions: self.permissions.permissions(),
            resources: self.resources.folder(),
            ..Config::new(self.jobs(), allowance, interrupt.flag())
        }
    }

    /// How many simulators run at a time.
    pub(super) fn jobs(&self) -> usize {
        self.jobs.map_or_else(processors, usize::from)
    }
}

pub(super) fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn list(config: &Config) -> Result<u8, String> {
    let tests = testing::list(config).map_err(|error| error.to_string())?;
    let lines: String = tests.iter().map(|test| test.id() + "\n").collect();
    super::say(lines.as_bytes());
    Ok(if tests.is_empty() { NO_TESTS } else { 0 })
}

pub(super) fn exit_code(config: &Config, summary: &Summary) -> u8 {
    match summary {
        _ if config.interrupted.load(Ordering::Relaxed) => INTERRUPTED,
        summary if !summary.is_good() => FAILED,
        summary if summary.outcomes.is_empty() => NO_TESTS,
        _ => 0,
    }
}

pub(super) fn refuse(reason: &str) -> ExitCode {
    super::complain(reason);
    ExitCode::from(USAGE)
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text
        .split_once('/')
        .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    parts
        .filter(|&(i, n)| 1 <= i && i <= n)
        .ok_or_else(|| "I/N is needed, such as 1/3".into())
}
