//! The loops of commands that are captured, iteration by iteration.

use simulator::{Loop, Run, RunObserver, Simulator};

use crate::cli::live::{Live, Viewed};
use crate::cli::session::END;

/// The loop of a command; a copy of it goes on from the same moment.
#[derive(Clone)]
pub(in crate::cli) enum CommandLoop {
    /// `run`.
    Run(Run),
    /// `run --view`.
    Viewed(Viewed),
    /// `run --no-start`, with so many iterations left.
    Free { left: u64 },
    /// `serve` and `view`.
    Live,
}

/// Nothing happens around a replay but what the capture says.
struct Quiet;

impl RunObserver for Quiet {
    fn should_stop(&self, sim: &Simulator) -> bool {
        sim.tape().signal(END, || false)
    }
}

impl Loop for CommandLoop {
    fn iterate(&mut self, sim: &mut Simulator) -> bool {
        match self {
            Self::Run(run) => run.iterate(sim, &mut Quiet),
            Self::Viewed(viewed) => viewed.iterate(sim, &mut Live::new(None), || false),
            Self::Free { left } => {
                let goes_on = *left > 0 && !sim.quit_requested() && !Quiet.should_stop(sim);
                if goes_on {
                    *left -= 1;
                    sim.iterate();
                }
                goes_on
            }
            Self::Live => {
                let goes_on = !Quiet.should_stop(sim) && !sim.quit_requested();
                if goes_on {
                    Live::new(None).iterate(sim);
                }
                goes_on
            }
        }
    }
}
