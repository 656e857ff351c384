//! Debugging a capture: forward, and back over its checkpoints.

use std::path::Path;
use std::rc::Rc;

use debugger::{Position, Session, Travel};
use simulator::{Playback, Simulator};

use super::Printer;
use crate::cli::interrupt::Interrupt;
use crate::cli::replay::{CommandLoop, open};

/// Plays a capture for a client; the exit code.
pub(super) fn debug(
    file: &Path,
    session: &Rc<Session>,
    interrupt: &Interrupt,
) -> Result<u8, String> {
    session.expect_replay();
    let (playback, _) = open(file, None, interrupt, |builder| {
        let console = Box::new(Printer(Rc::clone(session)));
        builder.console(console).debugger(session.clone())
    })?;
    let mut player = Player { playback, session };
    // With all traps armed, texts of errors may lack names of variables.
    player.playback.sim().tape().tolerate_hashes();
    session.allow_travel();
    while !interrupt.is_requested() && session.ending().is_none() {
        let goes_on = player.advance()?;
        if !player.travel()? && !goes_on {
            player.stop_at_border("the end of the capture");
            if !player.travel()? {
                break;
            }
        }
    }
    // What scripts do at the end of the simulator is no part of the run.
    session.pass();
    Ok(u8::from(player.playback.sim().errors() > 0))
}

struct Player<'a> {
    playback: Playback<CommandLoop>,
    session: &'a Session,
}

impl Player<'_> {
    /// Goes where the client wants to, as long as it wants to; whether it did.
    fn travel(&mut self) -> Result<bool, String> {
        let mut has_travelled = false;
        while let Some(travel) = self.session.take_travel() {
            has_travelled = true;
            self.go_back(travel)?;
        }
        Ok(has_travelled)
    }

    fn go_back(&mut self, travel: Travel) -> Result<(), String> {
        let here = self.session.last_stop();
        match self.search(travel, here)? {
            Some(position) => {
                self.go_to(position.turn - 1)?;
                // Who goes back once does so again. Without a checkpoint here it takes longer.
                let _ = self.playback.add_checkpoint();
                self.session.reach(position);
                self.run_until(|session| {
                    session.is_live() || session.position().turn > position.turn
                })?;
                if !self.session.is_live() && !self.session.wants_travel() {
                    self.stop_at_border("the place is not there again: the run differs");
                }
                Ok(())
            }
            None => {
                self.go_to(0)?;
                self.stop_at_border("the beginning of the capture");
                Ok(())
            }
        }
    }

    /// The last place before a position where the client wants to be: the parts between checkpoints are searched, the last one first.
    fn search(&mut self, travel: Travel, here: Position) -> Result<Option<Position>, String> {
        let mut before = here;
        loop {
            // Before the first place of an iteration are the iterations before.
            let iterations = if before.events == 0 { 2 } else { 1 };
            let Some(last) = before.turn.checked_sub(iterations) else {
                return Ok(None);
            };
            let checkpoint = self.playback.checkpoint_before(last);
            self.move_to_checkpoint(checkpoint)?;
            self.session.search(travel, before);
            self.run_until(Session::has_searched)?;
            if let Some(found) = self.session.found() {
                return Ok(Some(found));
            }
            before = Position {
                turn: checkpoint + 1,
                events: 0,
            };
        }
    }

    fn advance(&mut self) -> Result<bool, String> {
        self.playback.advance().map_err(|error| error.to_string())
    }

    fn run_until(&mut self, is_done: impl Fn(&Session) -> bool) -> Result<(), String> {
        while !is_done(self.session) && self.advance()? {}
        Ok(())
    }

    fn go_to(&mut self, turn: usize) -> Result<(), String> {
        let checkpoint = self.playback.checkpoint_before(turn);
        self.move_to_checkpoint(checkpoint)?;
        self.session.pass();
        let gone = self.playback.go_to(turn);
        gone.map_err(|error| error.to_string())
    }

    fn move_to_checkpoint(&mut self, turn: usize) -> Result<(), String> {
        let gone = self.playback.go_to_checkpoint(turn);
        gone.map_err(|error| error.to_string())?;
        let session = self.session;
        self.playback
            .sim()
            .for_debugger(|sim| session.moved(sim, turn));
        Ok(())
    }

    fn stop_at_border(&mut self, description: &str) {
        let session = self.session;
        let sim: &mut Simulator = self.playback.sim();
        sim.for_debugger(|sim| session.stop_at_border(sim, description));
    }
}
