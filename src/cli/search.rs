//! `swanilda search`: searches for cases in which properties fail.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use super::interrupt::Interrupt;
use super::setup::seconds;
use super::test::{self, CommonArgs};
use format::scene_file::write_whole;
use testing::{Config, Outcome, PropertyReport, SearchOptions};

/// How long a search goes on that nobody has limited, seconds.
const TIME: f64 = 60.0;

/// Search for cases in which properties of tests fail
///
/// Tries values that t.property draws: bounds, random ones, those near the least robustness and those that reach new lines of scripts. The simplest
/// failing case is shown, kept in .swanilda/failures, and tried first by the next run.
///
/// Exit codes: 0 nothing found, 1 some failed, 2 interrupted, 4 wrong usage, 5 no properties found.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    pub common: CommonArgs,
    /// How long to search for each property [default: 60, without --cases]
    #[arg(long, value_name = "SECONDS", value_parser = duration, allow_negative_numbers = true)]
    time: Option<f64>,
    /// How many cases to try for each property; with the same seed, the result is always the same
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    cases: Option<u32>,
    /// Folder for the cases of each property: a table (CSV) and a picture
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
}

/// Seconds, with or without their unit.
fn duration(text: &str) -> Result<f64, String> {
    seconds(text.strip_suffix('s').unwrap_or(text))
}

/// Searches; the exit code reports what was found.
pub(super) fn search(args: &Args) -> ExitCode {
    if let Err(reason) = args.common.reports.check() {
        return test::refuse(&reason);
    }
    let interrupt = Interrupt::install(test::INTERRUPTED);
    match run(args, &args.config(&interrupt)) {
        // At once: a case that could not be ended may still keep a thread.
        Ok(code) => std::process::exit(i32::from(super::code_of_loss().unwrap_or(code))),
        Err(reason) => test::refuse(&reason),
    }
}

fn run(args: &Args, config: &Config) -> Result<u8, String> {
    let reports = &args.common.reports;
    let summary =
        testing::run(config, &mut reports.reporter(true)).map_err(|error| error.to_string())?;
    reports.write(&summary)?;
    let outcomes = summary.outcomes.iter();
    let searched = outcomes.filter_map(|outcome| Some((outcome, outcome.property.as_ref()?)));
    let searched: Vec<_> = searched.collect();
    reports.print(&table(&searched));
    if let Some(folder) = &args.out {
        for (outcome, property) in &searched {
            write_cases(folder, outcome, property)
                .map_err(|error| format!("{}: {error}", folder.display()))?;
        }
    }
    Ok(test::exit_code(config, &summary))
}

impl Args {
    fn config(&self, interrupt: &Interrupt) -> Config {
        let time = self.time.or(self.cases.is_none().then_some(TIME));
        Config {
            // One property after the other, each on all threads.
            jobs: 1,
            search: Some(SearchOptions {
                jobs: self.common.jobs(),
                time: time.map(Duration::from_secs_f64),
                cases: self.cases.map(|cases| cases as usize),
            }),
            ..self.common.config(interrupt)
        }
    }
}

/// A line for each property.
fn table(searched: &[(&Outcome, &PropertyReport)]) -> String {
    let mut text = format!(
        "{:>8}  {:>9}  {:>12}  {:>6}  property\n",
        "cases", "discarded", "robustness", "lines"
    );
    for (outcome, property) in searched {
        let robustness = match property.robustness {
            number if number.is_finite() => format!("{number:.6}"),
            _ => "-".into(),
        };
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:>8}  {:>9}  {robustness:>12}  {:>6}  {}{}",
            property.cases,
            property.discarded,
            property.lines,
            outcome.test.id(),
            if outcome.is_bad() { "  FAILED" } else { "" }
        );
    }
    text
}

/// Writes the cases of a property as a table and a picture.
fn write_cases(folder: &Path, outcome: &Outcome, property: &PropertyReport) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let path = folder.join(outcome.test.file_stem());
    write_whole(&path.with_extension("csv"), property.csv().as_bytes())?;
    if let Some(picture) = property.picture() {
        write_whole(&path.with_extension("svg"), picture.as_bytes())?;
    }
    Ok(())
}
