//! Progress of a long run with a known end, on a terminal.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use simulator::{RunLimits, Simulator};

/// Runs shorter than this show nothing.
const SHOW_DELAY: Duration = Duration::from_secs(1);

/// The bar and what it counts.
pub(in crate::cli) struct Progress {
    bar: ProgressBar,
    limits: RunLimits,
    begun: Instant,
    /// Whether the bar may appear.
    waiting: bool,
}

impl Progress {
    /// A bar that stays hidden at first; for good when `hidden`, without a known end, or without a terminal.
    pub(in crate::cli) fn new(limits: RunLimits, hidden: bool) -> Self {
        let length = limits.steps.or(limits.time.map(milliseconds));
        let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::hidden());
        let waiting = !hidden && length.is_some() && std::io::stderr().is_terminal();
        Self {
            bar,
            limits,
            begun: Instant::now(),
            waiting,
        }
    }

    /// Whether the run is as long as was asked for.
    pub(in crate::cli) fn is_at_end(&self, sim: &Simulator) -> bool {
        self.limits.are_reached(sim)
    }

    /// The bar, for callers that write to the terminal while it shows.
    pub(in crate::cli) fn bar(&self) -> ProgressBar {
        self.bar.clone()
    }

    pub(in crate::cli) fn show(&mut self, sim: &Simulator) {
        if self.waiting && self.begun.elapsed() > SHOW_DELAY {
            self.waiting = false;
            let style = ProgressStyle::with_template("{bar:40} {percent}% {msg}, {eta} left");
            self.bar
                .set_style(style.expect("the template is well-formed"));
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        if !self.bar.is_hidden() {
            let done = if self.limits.steps.is_some() {
                sim.steps()
            } else {
                milliseconds(sim.time())
            };
            self.bar.set_message(format!("{:.2} s", sim.time()));
            self.bar.set_position(done);
        }
    }

    pub(in crate::cli) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn milliseconds(seconds: f64) -> u64 {
    (seconds * 1000.0) as u64
}
