//! The timeline of a capture: the moments that differ, what was printed up to each, and what happened where.
//!
//! Iterations that change nothing, as those of a simulator that waits, are no frames of their own.

use std::collections::{BTreeSet, VecDeque};

use serde_json::{Value, json};

use crate::recording::{MarkKind, path};
use script::log::RecentLine;
use simulator::{Happenings, Moment, Simulator};

/// Lines of the log that are kept.
const MAX_LINES: usize = 200_000;
/// Marks of one kind.
const MAX_MARKS: usize = 1000;
/// How long a change is shown during which no simulated time passes, seconds.
const STILL: f64 = 0.05;

/// A moment that differs from the one before.
#[derive(Debug, Clone, Copy)]
struct Frame {
    /// Iterations up to it.
    turn: usize,
    moment: Moment,
    /// Lines up to it.
    lines: usize,
}

/// Something that happened.
struct Mark {
    frame: usize,
    time: f64,
    kind: MarkKind,
    text: String,
    handle: Option<i64>,
}

/// All moments that were reached so far.
pub(super) struct Frames {
    /// At least the beginning.
    frames: Vec<Frame>,
    /// The last iteration that was noted.
    turn: usize,
    lines: VecDeque<RecentLine>,
    /// Lines before those.
    gone: usize,
    marks: Vec<Mark>,
    /// How many changes of the scene there were at the last moment.
    changes: u64,
    signals: BTreeSet<String>,
    contacts: BTreeSet<[i64; 2]>,
    /// How the capture ends, once that is known.
    outcome: Option<String>,
}

impl Frames {
    /// The beginning.
    pub(super) fn new(sim: &Simulator, moment: Moment) -> Self {
        let mut frames = Self {
            frames: Vec::new(),
            turn: 0,
            lines: VecDeque::new(),
            gone: 0,
            marks: Vec::new(),
            changes: 0,
            signals: BTreeSet::new(),
            contacts: BTreeSet::new(),
            outcome: None,
        };
        frames.note(sim, 0, moment);
        frames
    }

    /// Notes the moment after another iteration.
    pub(super) fn note(&mut self, sim: &Simulator, turn: usize, moment: Moment) {
        let happened = sim.take_happenings();
        let changes = sim.scene().journal().total_of(crate::observe::SHOWN);
        let last = self.frames.last().map(|frame| frame.moment);
        let is_same = last == Some(moment) && changes == self.changes && happened.lines.is_empty();
        (self.turn, self.changes) = (turn, changes);
        if is_same {
            return;
        }
        self.frames.push(Frame {
            turn,
            moment,
            lines: 0,
        });
        if last.is_some_and(|last| moment.time < last.time) {
            // Another simulation: shapes touch for the first time again.
            self.contacts.clear();
        }
        self.mark(sim, &happened);
        self.add_lines(happened.lines);
    }

    fn add_lines(&mut self, lines: Vec<RecentLine>) {
        self.lines.extend(lines);
        let surplus = self.lines.len().saturating_sub(MAX_LINES);
        self.lines.drain(..surplus);
        self.gone += surplus;
        let all = self.gone + self.lines.len();
        if let Some(frame) = self.frames.last_mut() {
            frame.lines = all;
        }
    }

    /// Marks errors, signals that come and go, messages, and shapes that touch each other for the first time.
    fn mark(&mut self, sim: &Simulator, happened: &Happenings) {
        for line in happened.lines.iter().filter(|line| line.is_script_error()) {
            self.add_mark(MarkKind::Error, line.text.clone(), line.script);
        }
        let before = std::mem::replace(&mut self.signals, happened.signals.clone());
        for name in happened.signals.difference(&before) {
            self.add_mark(MarkKind::Signal, name.clone(), None);
        }
        for name in before.difference(&happened.signals) {
            self.add_mark(MarkKind::Signal, format!("{name} is cleared"), None);
        }
        for name in &happened.broadcasts {
            self.add_mark(MarkKind::Broadcast, name.clone(), None);
        }
        for pair in &happened.contacts {
            if self.contacts.insert(pair.map(scene::Handle::raw)) {
                let [first, second] = pair.map(|handle| path(&sim.scene(), handle));
                self.add_mark(
                    MarkKind::Contact,
                    format!("{first} and {second}"),
                    Some(pair[0].raw()),
                );
            }
        }
    }

    fn add_mark(&mut self, kind: MarkKind, text: String, handle: Option<i64>) {
        let frame = self.last();
        let count = self.marks.iter().filter(|mark| mark.kind == kind).count();
        if count < MAX_MARKS {
            self.marks.push(Mark {
                frame,
                time: self.frames[frame].moment.time,
                kind,
                text,
                handle,
            });
        }
    }

    /// The capture ends with the last moment. What is `wrong` is marked.
    pub(super) fn end(&mut self, outcome: String, is_wrong: bool) {
        if is_wrong {
            self.add_mark(MarkKind::Failure, outcome.clone(), None);
        }
        self.outcome = Some(outcome);
    }

    /// Whether the end is known.
    pub(super) fn is_complete(&self) -> bool {
        self.outcome.is_some()
    }

    /// The last frame.
    pub(super) fn last(&self) -> usize {
        self.frames.len() - 1
    }

    /// The last iteration that was noted.
    pub(super) fn last_turn(&self) -> usize {
        self.turn
    }

    /// Iterations up to a frame.
    pub(super) fn turn_of(&self, frame: usize) -> usize {
        self.frames[frame].turn
    }

    /// How long a frame is shown at the speed of the simulation, seconds.
    pub(super) fn duration(&self, frame: usize) -> f64 {
        let next = self.frames.get(frame + 1).unwrap_or(&self.frames[frame]);
        let passed = next.moment.time - self.frames[frame].moment.time;
        if passed > 0.0 { passed } else { STILL }
    }

    /// How many lines there are up to a frame.
    pub(super) fn count_of_lines(&self, frame: usize) -> usize {
        self.frames[frame].lines
    }

    /// Lines by their numbers, those that are still there.
    pub(super) fn lines(&self, from: usize, to: usize) -> impl Iterator<Item = &RecentLine> {
        let place = |number: usize| number.saturating_sub(self.gone).min(self.lines.len());
        self.lines.range(place(from)..place(to).max(place(from)))
    }

    /// For pages: JSON.
    pub(super) fn describe(&self) -> String {
        let marks = self.marks.iter().map(Mark::describe);
        let value = json!({
            "frames": self.frames.len(),
            "end": self.frames[self.last()].moment.time,
            "complete": self.is_complete(),
            "marks": marks.collect::<Vec<_>>(),
            "outcome": self.outcome,
        });
        value.to_string()
    }
}

impl Mark {
    fn describe(&self) -> Value {
        json!({
            "frame": self.frame, "time": self.time, "kind": self.kind.name(), "text": self.text, "handle": self.handle,
        })
    }
}
