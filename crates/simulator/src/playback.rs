//! Playing a capture: any moment of it again.
//!
//! A capture is replayed iteration by iteration. Every few milliseconds of work a checkpoint is taken, a snapshot of the simulator with the
//! place on its tape; a moment is reached from the checkpoint before it. With more than enough of them, every second one goes.

use std::collections::BTreeMap;
use std::time::Duration;

use capture::{Mark, Verdict};
use script::wall_clock;

use super::{Error, Simulator, Snapshot};

/// Work between two checkpoints: what going to a moment costs at most, beside the restore.
const INTERVAL: Duration = Duration::from_millis(20);
/// Most checkpoints.
const MAX_CHECKPOINTS: usize = 512;
/// Most memory of all checkpoints, bytes.
const MAX_MEMORY: usize = 1 << 30;

/// The loop of the command that was captured. Its state is a part of each moment.
pub trait Loop: Clone {
    /// One iteration; false when it was over before.
    fn iterate(&mut self, sim: &mut Simulator) -> bool;
}

/// After an iteration of the loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Simulation steps since the start of the simulation.
    pub step: u64,
    /// Simulated time, seconds.
    pub time: f64,
}

struct Checkpoint<L> {
    snapshot: Snapshot,
    mark: Mark,
    run: L,
}

/// A capture that is played.
pub struct Playback<L> {
    sim: Simulator,
    run: L,
    /// Iterations that the simulator has done.
    turn: usize,
    /// After each iteration that was ever done; the first one is the beginning.
    moments: Vec<Moment>,
    checkpoints: BTreeMap<usize, Checkpoint<L>>,
    interval: Duration,
    /// Work since the last checkpoint.
    work: Duration,
    /// How the capture has ended, once that was reached.
    end: Option<Verdict>,
}

impl<L: Loop> Playback<L> {
    /// The beginning of a capture. The tape of the simulator replays it; `run` is the loop of its command.
    ///
    /// Where something is open that no snapshot reaches, it goes forward only.
    pub fn new(sim: Simulator, run: L) -> Self {
        let moment = Moment::of(&sim);
        let mut playback = Self {
            sim,
            run,
            turn: 0,
            moments: vec![moment],
            checkpoints: BTreeMap::new(),
            interval: INTERVAL,
            work: Duration::ZERO,
            end: None,
        };
        // Without it there is no way back, which is said when somebody wants to go there.
        let _ = playback.add_checkpoint();
        playback
    }

    /// The simulator at the present moment.
    pub fn sim(&mut self) -> &mut Simulator {
        &mut self.sim
    }

    /// Iterations up to the present moment.
    pub fn turn(&self) -> usize {
        self.turn
    }

    /// The moments after all iterations that were done so far, the beginning first.
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    /// How the capture has ended; None as long as its end was not reached.
    pub fn end(&self) -> Option<&Verdict> {
        self.end.as_ref()
    }

    /// Whether the present moment is the last one.
    pub fn is_at_end(&self) -> bool {
        self.end.is_some() && self.turn + 1 == self.moments.len()
    }

    /// The next iteration; false at the end.
    ///
    /// # Errors
    /// When the moment before the end cannot be brought back.
    pub fn advance(&mut self) -> Result<bool, Error> {
        if self.is_at_end() {
            return Ok(false);
        }
        let begun = wall_clock::now();
        let goes_on = self.run.iterate(&mut self.sim);
        if self.sim.is_abandoned() {
            return Ok(false);
        }
        self.work += begun.elapsed();
        let verdict = self.sim.tape().verdict();
        if !goes_on || verdict.is_some() {
            let steps = self.sim.tape().steps();
            let was_broken_off = verdict.is_some();
            self.end = Some(verdict.unwrap_or(Verdict::Same { steps }));
            if was_broken_off {
                // It has nothing for the last iteration, or something else.
                self.go_to(self.turn)?;
            }
            return Ok(false);
        }
        self.turn += 1;
        if self.turn == self.moments.len() {
            self.moments.push(Moment::of(&self.sim));
        }
        if self.work >= self.interval && !self.checkpoints.contains_key(&self.turn) {
            // Where there can be none, a file is open for example, an earlier one is as good.
            let _ = self.add_checkpoint();
        }
        Ok(true)
    }

    /// Goes to the moment after an iteration, or to the last one before it.
    ///
    /// # Errors
    /// When something is open that no snapshot reaches.
    pub fn go_to(&mut self, turn: usize) -> Result<(), Error> {
        let is_ahead =
            turn >= self.turn && !self.sim.is_abandoned() && self.sim.tape().verdict().is_none();
        let nearest = self.checkpoint_before(turn);
        if !is_ahead || nearest > self.turn {
            self.go_to_checkpoint(nearest)?;
        }
        while self.turn < turn && self.advance()? {}
        Ok(())
    }

    /// The last checkpoint up to a moment.
    pub fn checkpoint_before(&self, turn: usize) -> usize {
        let found = self.checkpoints.range(..=turn).next_back();
        found.map_or(0, |(turn, _)| *turn)
    }

    /// Goes to a moment that has a checkpoint.
    ///
    /// # Errors
    /// When something is open that no snapshot reaches, or there is no such checkpoint.
    pub fn go_to_checkpoint(&mut self, turn: usize) -> Result<(), Error> {
        let Some(checkpoint) = self.checkpoints.get(&turn) else {
            // What is open now was probably open then.
            self.sim.snapshot()?;
            let none = format!("there is no checkpoint after iteration {turn}.");
            return Err(Error::NoSnapshot(none));
        };
        self.sim.restore(&checkpoint.snapshot)?;
        let moved = self.sim.tape().go_to(&checkpoint.mark);
        moved.map_err(|error| Error::Unreadable(error.to_string()))?;
        self.run = checkpoint.run.clone();
        self.turn = turn;
        self.work = Duration::ZERO;
        Ok(())
    }

    /// The simulator goes on from the present moment as one that was never captured: what comes from outside comes from there again. A
    /// request to end the program is withdrawn.
    pub fn go_live(self) -> Simulator {
        self.sim.tape().go_live();
        self.sim.inside().clock.set_quit_requested(false);
        self.sim
    }

    /// Makes the present moment a checkpoint.
    ///
    /// # Errors
    /// When there can be no snapshot.
    pub fn add_checkpoint(&mut self) -> Result<(), Error> {
        let snapshot = self.sim.snapshot()?;
        let none = || Error::NoSnapshot("the simulator replays no capture.".to_owned());
        let mark = self.sim.tape().mark().ok_or_else(none)?;
        let run = self.run.clone();
        self.checkpoints.insert(
            self.turn,
            Checkpoint {
                snapshot,
                mark,
                run,
            },
        );
        self.work = Duration::ZERO;
        self.thin_out();
        Ok(())
    }

    /// Drops every second checkpoint where there are too many.
    fn thin_out(&mut self) {
        let count = self.checkpoints.len();
        // Memory is counted now and then: all pages are looked at.
        let is_large = || {
            let own = self
                .checkpoints
                .values()
                .map(|checkpoint| checkpoint.snapshot.own_bytes());
            count.is_multiple_of(16) && own.sum::<usize>() > MAX_MEMORY
        };
        if count <= MAX_CHECKPOINTS && !is_large() {
            return;
        }
        let mut keeps = false;
        self.checkpoints.retain(|_, _| {
            keeps = !keeps;
            keeps
        });
        self.interval *= 2;
    }
}

impl Moment {
    fn of(sim: &Simulator) -> Self {
        Self {
            step: sim.steps(),
            time: sim.time(),
        }
    }
}
