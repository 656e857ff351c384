//! `swanilda replay` with a question: where the run is at a time, when a property changed, when something became true, and who did it.

use std::cell::Cell;
use std::process::ExitCode;
use std::rc::Rc;

use debugger::{Cause, Watch};
use serde_json::{Value, json};
use simulator::{Console, LogLine, Moment, Playback, Silent};

use super::open::open;
use super::{Args, CommandLoop, DIFFERS, print_json};
use crate::cli::interrupt::Interrupt;
use crate::cli::{Outcome, say};

/// Questions about a run.
#[derive(clap::Args)]
pub(super) struct MomentArgs {
    /// Go to this simulated time; the questions are about the run until then
    #[arg(long, value_name = "SECONDS", value_parser = crate::cli::setup::seconds, allow_negative_numbers = true)]
    at: Option<f64>,
    /// Print when a property of an object changed last, and the line that did it, such as /arm/joint:targetPosition
    #[arg(long, value_name = "PROPERTY", conflicts_with = "when")]
    last_change: Option<String>,
    /// Print when a Lua expression became true first, and the line that did it
    #[arg(long, value_name = "EXPRESSION")]
    when: Option<String>,
}

/// What was found: after an iteration, and what did it.
struct Found {
    moment: Moment,
    what: String,
    is_change: bool,
    /// The line of a script; nothing did what the simulation does itself.
    cause: Option<Cause>,
}

impl MomentArgs {
    pub(super) fn is_any(&self) -> bool {
        self.at.is_some() || self.last_change.is_some() || self.when.is_some()
    }

    fn is_reached(&self, moment: Moment) -> bool {
        // Time is a sum of steps; it may fall short of a round number by its rounding errors.
        self.at.is_some_and(|at| moment.time * (1.0 + 1e-12) >= at)
    }

    fn watch(&self) -> Rc<Watch> {
        Rc::new(match (&self.last_change, &self.when) {
            (Some(property), _) => Watch::of_property(property),
            (None, Some(expression)) => Watch::of_expression(expression),
            (None, None) => Watch::of_nothing(),
        })
    }
}

/// Answers the question; exit code 1 when there is no such moment.
pub(super) fn answer(args: &Args) -> Outcome {
    let watch = args.moments.watch();
    let is_over = Rc::<Cell<bool>>::default();
    let console: Box<dyn Console> = match args.moments {
        MomentArgs {
            last_change: None,
            when: None,
            ..
        } if !args.json => Box::new(Printer(Rc::clone(&is_over))),
        _ => Box::new(Silent),
    };
    let debugger = Rc::clone(&watch);
    let (playback, header) = open(&args.capture, args.threads, &Interrupt::none(), |builder| {
        builder.console(console).debugger(debugger)
    })?;
    args.warn_of_version(&header);
    let mut search = Search {
        args: &args.moments,
        watch: &watch,
        playback,
    };
    let found = match (&args.moments.last_change, &args.moments.when) {
        (Some(_), _) => search.last_change(),
        (None, Some(_)) => search.first_truth(),
        (None, None) => search.time(),
    };
    is_over.set(true);
    Ok(match found? {
        Some(found) => {
            found.print(args.json);
            ExitCode::SUCCESS
        }
        None => {
            crate::cli::complain(&search.absence());
            ExitCode::from(DIFFERS)
        }
    })
}

struct Search<'a> {
    args: &'a MomentArgs,
    watch: &'a Watch,
    playback: Playback<CommandLoop>,
}

impl Search<'_> {
    /// One iteration further; false at the end of what is asked about.
    fn advance(&mut self) -> Result<bool, String> {
        if self.args.is_reached(self.moment()) {
            return Ok(false);
        }
        self.playback.advance().map_err(|error| error.to_string())
    }

    fn moment(&self) -> Moment {
        self.playback.moments()[self.playback.turn()]
    }

    fn time(&mut self) -> Result<Option<Found>, String> {
        while self.advance()? {}
        let hash = self.playback.sim().state_hash();
        Ok(self.args.is_reached(self.moment()).then(|| Found {
            moment: self.moment(),
            what: format!("state hash {hash:016x}"),
            is_change: false,
            cause: None,
        }))
    }

    fn last_change(&mut self) -> Result<Option<Found>, String> {
        let mut last = None;
        while self.advance()? {
            if let Some((what, cause)) = self.watch.take_change() {
                last = Some(Found {
                    moment: self.moment(),
                    what,
                    is_change: true,
                    cause,
                });
            }
        }
        Ok(last)
    }

    fn first_truth(&mut self) -> Result<Option<Found>, String> {
        loop {
            let watch = self.watch;
            if self.playback.sim().for_debugger(|sim| watch.is_true(sim)) {
                break;
            }
            if !self.advance()? {
                return Ok(None);
            }
        }
        let moment = self.moment();
        let what = self.args.when.clone().unwrap_or_default();
        Ok(Some(Found {
            moment,
            what: format!("{what} is true"),
            is_change: true,
            cause: self.cause()?,
        }))
    }

    /// What made the expression true in the last iteration.
    fn cause(&mut self) -> Result<Option<Cause>, String> {
        let turn = self.playback.turn();
        let Some(before) = turn.checked_sub(1) else {
            return Ok(None);
        };
        let failed = |error: simulator::Error| error.to_string();
        self.playback.go_to(before).map_err(failed)?;
        self.watch.ask_at_each_call();
        self.playback.advance().map_err(failed)?;
        Ok(self.watch.take_change().and_then(|(_, cause)| cause))
    }

    fn absence(&self) -> String {
        let until = match self.args.at {
            Some(at) if self.args.is_reached(self.moment()) => format!("until {at} s"),
            _ => format!(
                "until the end of the capture, step {} at {:.3} s",
                self.moment().step,
                self.moment().time
            ),
        };
        match (&self.args.last_change, &self.args.when) {
            (Some(property), _) => match self.watch.is_known() {
                true => format!("{property} does not change {until}"),
                false => format!(
                    "there is no property {property} {until}; one is named such as /arm/joint:targetPosition"
                ),
            },
            (None, Some(expression)) => match self.watch.error() {
                Some(error) => format!("{expression} has no value {until}: {error}"),
                None => format!("{expression} is not true {until}"),
            },
            (None, None) => format!("the time is not reached {until}"),
        }
    }
}

impl Found {
    fn print(&self, is_json: bool) {
        let Moment { step, time } = self.moment;
        if is_json {
            let cause = self.cause.as_ref();
            let cause = cause.map_or(
                Value::Null,
                |cause| json!({"script": cause.title, "line": cause.line, "code": cause.code}),
            );
            return print_json(&json!({
                "type": "moment", "step": step, "time": time, "text": self.what, "by": cause,
            }));
        }
        let by = match &self.cause {
            Some(cause) => format!(", by {}:{}\n    {}", cause.title, cause.line, cause.code),
            None if self.is_change => ", by the simulation".into(),
            None => String::new(),
        };
        say(format!("step {step}, {time:.3} s: {}{by}\n", self.what).as_bytes());
    }
}

/// Prints what scripts print, until the answer is found: what they do at the end of the simulator is no part of the run.
struct Printer(Rc<Cell<bool>>);

impl Console for Printer {
    fn print(&mut self, line: &[u8], _: f64) {
        if !self.0.get() {
            say(line);
            say(b"\n");
        }
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !self.0.get() {
            say(format!("{}\n", line.located()).as_bytes());
        }
    }
}
