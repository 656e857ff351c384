//! Going to other moments of a capture.
//!
//! Code cannot run backwards. The replay is brought back to a checkpoint and runs again, first to search for the place to go to, then to
//! it. Whoever has the replay does that, with the functions here: a [`Travel`] is what the client wants.

use std::rc::Rc;

use script::{Place, Sim};
use serde_json::json;

use super::stop::{Reason, Stop, origin};
use super::{Position, Session};
use crate::request::event;
use crate::stepping::{Mode, Origin};

/// Where a client wants to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Travel {
    /// To the line before, in this function or the one that called it.
    StepBack,
    /// To the last place before this one where something stops the code.
    ReverseContinue,
}

/// What code runs for.
#[derive(Debug, Default)]
pub(super) enum Goal {
    /// For the client, who sees it for the first time.
    #[default]
    Live,
    /// To find the place to go to: the last one before a position.
    Search {
        before: Position,
        /// A step back ends in the coroutine where it begins, where there is one.
        origin: Option<Origin>,
        travel: Travel,
        found: Option<Position>,
    },
    /// To stop at a position.
    Reach(Position),
    /// To get past what was seen before.
    Pass,
}

impl Goal {
    pub(super) fn is_live(&self) -> bool {
        matches!(self, Self::Live)
    }
}

impl Session {
    /// What is debugged is a capture, which is loaded next.
    pub fn expect_replay(&self) {
        self.can_travel.set(false);
        if !self.is_replay.replace(true) && self.has_client.get() {
            self.send(event(
                "capabilities",
                json!({"capabilities": {"supportsStepBack": true}}),
            ));
        }
    }

    /// The capture is loaded: the client can go to all that comes.
    pub fn allow_travel(&self) {
        self.can_travel.set(true);
    }

    /// Whether the client sees the run for the first time, or again.
    pub fn is_live(&self) -> bool {
        self.goal.borrow().is_live()
    }

    /// What comes is on the way to a place, and stops nowhere.
    pub fn pass(&self) {
        self.goal.replace(Goal::Pass);
    }

    /// Whether the client wants to go elsewhere.
    pub fn wants_travel(&self) -> bool {
        self.travel.get().is_some()
    }

    /// Where the client wants to go, once; the code has been broken off for that.
    pub fn take_travel(&self) -> Option<Travel> {
        self.travel.take()
    }

    /// Begins a search for the last place before a position. The replay is brought to an earlier moment next.
    pub fn search(&self, travel: Travel, before: Position) {
        let (_, origin) = self.last_stop.get();
        self.goal.replace(Goal::Search {
            before,
            origin,
            travel,
            found: None,
        });
    }

    /// Whether a search has come to its end.
    pub fn has_searched(&self) -> bool {
        match &*self.goal.borrow() {
            Goal::Search { before, .. } => self.position.get() >= *before,
            _ => true,
        }
    }

    /// The place that a search has found.
    pub fn found(&self) -> Option<Position> {
        match &*self.goal.borrow() {
            Goal::Search { found, .. } => *found,
            _ => None,
        }
    }

    /// The code runs to a position, and stops there. The replay is brought to an earlier moment next.
    pub fn reach(&self, position: Position) {
        self.goal.replace(Goal::Reach(position));
    }

    /// The replay was brought to the moment after an iteration.
    pub fn moved(&self, sim: &Rc<Sim>, turn: usize) {
        let events = 0;
        self.position.set(Position { turn, events });
        self.pause_is_late.set(false);
        self.last_error.borrow_mut().clear();
        self.data.borrow_mut().refresh(sim);
        self.arm_all(Some(sim));
    }

    /// The replay is at its beginning or its end: the client inspects it, and may go elsewhere.
    pub fn stop_at_border(&self, sim: &Rc<Sim>, description: &str) {
        self.goal.replace(Goal::Live);
        self.advance();
        let stop = Stop {
            script: None,
            origin: None,
            error: None,
        };
        let reason = Reason {
            description: Some(description.to_owned()),
            ..Reason::new("pause")
        };
        self.stopped_at_position(sim, stop, &reason);
    }

    /// Whether what happens may stop the code.
    pub(super) fn listens(&self, sim: &Sim) -> bool {
        !self.ignores_code.get() && !sim.is_abandoned() && !self.is_past_goal()
    }

    /// A search that has come to the place where it began has nothing more to do.
    fn is_past_goal(&self) -> bool {
        match &*self.goal.borrow() {
            Goal::Search { before, .. } => self.position.get() >= *before,
            Goal::Reach(goal) => self.position.get() != *goal,
            Goal::Live => false,
            Goal::Pass => true,
        }
    }

    /// Notes a line that a step back may end at.
    pub(super) fn note_line(&self, place: &Place<'_>) {
        let now = self.position.get();
        if let Goal::Search {
            travel: Travel::StepBack,
            origin: wanted,
            found,
            ..
        } = &mut *self.goal.borrow_mut()
        {
            let is_one = wanted.is_none_or(|wanted| {
                let here = origin(place);
                here.script == wanted.script
                    && here.level.coroutine == wanted.level.coroutine
                    && here.level.below <= wanted.level.below
            });
            if is_one {
                *found = Some(now);
            }
        }
    }

    /// What would stop the code if it ran for the client. A search notes it; the code stops if it is the place to go to.
    pub(super) fn reaches(&self) -> bool {
        let now = self.position.get();
        let mut goal = self.goal.borrow_mut();
        match &mut *goal {
            Goal::Search { travel, found, .. } => {
                if *travel == Travel::ReverseContinue {
                    *found = Some(now);
                }
                false
            }
            Goal::Reach(..) => {
                *goal = Goal::Live;
                true
            }
            Goal::Live => true,
            Goal::Pass => false,
        }
    }

    /// The mode in which the line at the goal stops the code.
    pub(super) fn mode_now(&self) -> Mode {
        match &*self.goal.borrow() {
            Goal::Reach(..) => Mode::Into,
            _ => self.mode.get(),
        }
    }
}
