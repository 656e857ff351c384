//! A capture in the viewer: it plays, goes to any moment, and goes on from there.
//!
//! One simulator does all of it. As long as nothing else is to do it runs ahead to the end of the capture, which is how the timeline becomes
//! known; for what a page asks it goes back to the moment that is shown.

mod show;

use std::io;
use std::net::TcpListener;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::frames::Frames;
use super::{FRAME, Timer, Viewer};
use crate::busy::BusySign;
use crate::edit::Editor;
use crate::observe::{Observer, WindowObserver};
use crate::perform::perform;
use crate::request::Action;
use ::capture::Verdict;
use script::log::{RecentLine, verbosity};
use script::wall_clock;
use simulator::{Loop, Playback, Simulator};

/// Work between two polls of the requests of pages.
const PORTION: Duration = Duration::from_millis(15);
/// Between two observations of a moment that stays: for what pages begin to watch.
const REST: Duration = Duration::from_millis(100);
/// Longest work for a step into what is not known yet.
const STEP: Duration = Duration::from_secs(2);
/// Later than that it does not catch up.
const LATE: Duration = Duration::from_millis(250);

/// What scripts do not have when a capture goes on.
const NOTE: &str = "live from here. What the captured run had open is not there: connections and servers, programs and Python scripts, devices. \
                    Scripts that use it get errors until they open it again.";

/// Of the playback.
const THERE: &str = "nothing is being opened";

/// Opens the capture, at its beginning; why it cannot be, in words.
type Open<L> = dyn Fn() -> Result<Playback<L>, String>;

/// Shows a capture to pages.
pub struct CaptureViewer<L> {
    viewer: Viewer,
    /// None only while it is opened again.
    playback: Option<Playback<L>>,
    open: Box<Open<L>>,
    frames: Frames,
    /// The frame that pages are to see.
    frame: usize,
    is_playing: bool,
    /// Beside the wall clock; 0 for as fast as possible.
    speed: f64,
    /// When the next frame is to be shown.
    due: Instant,
    /// Lines that pages have: up to this one.
    lines: Option<usize>,
    /// Something changed that pages do not have yet.
    is_new: bool,
    rest: Timer,
    list: Timer,
}

impl<L: Loop> CaptureViewer<L> {
    /// Serves pages that connect to `listener`. With `is_read_only` they cannot go on from a moment. `open` opens the capture again where
    /// something is open that no snapshot reaches, so that there is no other way back.
    ///
    /// # Errors
    /// When the server cannot start.
    pub fn start(
        mut playback: Playback<L>,
        open: impl Fn() -> Result<Playback<L>, String> + 'static,
        listener: TcpListener,
        is_read_only: bool,
    ) -> io::Result<Self> {
        let mut viewer = Viewer::open(listener, is_read_only)?;
        viewer.observer = Observer::that_rereads();
        viewer.shared.set_capture(true);
        let beginning = playback.moments()[0];
        let frames = Frames::new(playback.sim(), beginning);
        Ok(Self {
            viewer,
            playback: Some(playback),
            open: Box::new(open),
            frames,
            frame: 0,
            is_playing: false,
            speed: 1.0,
            due: wall_clock::now(),
            lines: None,
            is_new: true,
            rest: Timer::default(),
            list: Timer::default(),
        })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        self.viewer.url()
    }

    /// For a thread that watches the simulation's.
    pub fn busy_sign(&self) -> BusySign {
        self.viewer.busy_sign()
    }

    /// Plays so many times as fast as the wall clock; as fast as possible if that is 0.
    pub fn set_speed(&mut self, factor: f64) {
        self.speed = factor;
        self.is_new = true;
    }

    /// Lets time go on.
    pub fn play(&mut self) {
        if self.frames.is_complete() && self.frame == self.frames.last() {
            self.seek(0);
        }
        self.is_playing = true;
        self.schedule(wall_clock::now());
        self.is_new = true;
    }

    /// Answers requests, plays or runs ahead for a moment, and shows what changed. True when a page wants to go on from here.
    ///
    /// # Errors
    /// When a moment cannot be brought back.
    pub fn attend(&mut self) -> Result<bool, String> {
        self.viewer.shared.attend();
        let mut timeout = self.timeout();
        let mut has_answered = false;
        while let Some(pending) = self.viewer.shared.next_request(timeout) {
            timeout = Duration::ZERO;
            has_answered = true;
            let answer = self.answer(&pending.action)?;
            let is_live = pending.action == Action::Live && answer.is_ok();
            pending.answer(answer);
            if is_live {
                self.come_back()?;
                return Ok(true);
            }
        }
        if self.is_playing {
            self.play_on()?;
        } else if !self.frames.is_complete() {
            self.run_ahead()?;
        }
        self.show()?;
        if has_answered {
            self.viewer.server.waker().wake();
        }
        Ok(false)
    }

    /// The simulator at the moment that is shown, which was never captured from now on, and its viewer. It stands still until a page lets it go on.
    pub fn go_live(self) -> (Simulator, Viewer) {
        let Self {
            mut viewer,
            playback,
            speed,
            ..
        } = self;
        let playback = playback.expect(THERE);
        let mut sim = playback.go_live();
        viewer.observer = Observer::default();
        viewer.windows = WindowObserver::default();
        viewer.images_shown.forget();
        viewer.attach(&sim);
        // Pages have them.
        drop(sim.take_recent_lines());
        viewer.lines.push(note_of_life(sim.time()));
        sim.set_pace(speed);
        viewer.hold();
        viewer.shared.set_capture(false);
        viewer.shared.mirror().show_list("timeline", "null");
        (sim, viewer)
    }

    /// How long there is nothing to do.
    fn timeout(&self) -> Duration {
        if self.is_playing {
            return self
                .due
                .saturating_duration_since(wall_clock::now())
                .min(FRAME);
        }
        match (self.frames.is_complete(), self.is_new) {
            (true, false) => REST / 2,
            _ => Duration::ZERO,
        }
    }

    fn answer(&mut self, action: &Action) -> Result<Result<Value, String>, String> {
        match action {
            Action::Play => self.play(),
            Action::Pause => self.pause(),
            Action::Stop => {
                self.pause();
                self.seek(0);
            }
            Action::Step(count) => self.step(*count)?,
            Action::Seek(frame) => self.seek(*frame),
            Action::Speed(factor) => {
                self.set_speed(*factor);
                self.schedule(wall_clock::now());
            }
            Action::Live => {}
            Action::Inspect(_) | Action::Script(_) | Action::Graph(_) => {
                self.come_back()?;
                return Ok(perform(
                    self.playback().sim(),
                    action,
                    &mut Vec::new(),
                    &mut Editor::default(),
                ));
            }
            _ => return Ok(Err("this is a capture: go on from here first".to_owned())),
        }
        Ok(Ok(Value::Bool(true)))
    }

    fn pause(&mut self) {
        self.is_playing = false;
        self.is_new = true;
    }

    fn seek(&mut self, frame: usize) {
        self.frame = frame.min(self.frames.last());
        self.is_new = true;
        self.schedule(wall_clock::now());
    }

    fn step(&mut self, count: i64) -> Result<(), String> {
        self.pause();
        let by = usize::try_from(count.unsigned_abs()).unwrap_or(usize::MAX);
        let frame = match count < 0 {
            true => self.frame.saturating_sub(by),
            false => self.frame.saturating_add(by),
        };
        self.know(frame, STEP)?;
        self.seek(frame);
        Ok(())
    }

    /// The next frame is due after the one that is shown.
    fn schedule(&mut self, from: Instant) {
        let seconds = match self.speed > 0.0 {
            true => self.frames.duration(self.frame) / self.speed,
            false => 0.0,
        };
        self.due = from + Duration::from_secs_f64(seconds.clamp(0.0, 3600.0));
    }

    /// Shows the next frames, as far as they are due.
    fn play_on(&mut self) -> Result<(), String> {
        let begun = wall_clock::now();
        if begun.duration_since(self.due) > LATE {
            self.due = begun;
        }
        while self.due <= wall_clock::now() && begun.elapsed() < PORTION {
            let next = self.frame + 1;
            self.know(next, PORTION)?;
            if next > self.frames.last() {
                self.is_playing &= !self.frames.is_complete();
                self.is_new = true;
                break;
            }
            self.frame = next;
            self.come_back()?;
            self.is_new = true;
            self.schedule(self.due);
        }
        Ok(())
    }

    /// Runs to the end of the capture, a part of the way.
    fn run_ahead(&mut self) -> Result<(), String> {
        self.know(usize::MAX, PORTION)
    }

    /// Runs until that frame is known, or the end, or for so long.
    fn know(&mut self, frame: usize, limit: Duration) -> Result<(), String> {
        if frame <= self.frames.last() || self.frames.is_complete() {
            return Ok(());
        }
        let begun = wall_clock::now();
        self.go_to(self.frames.last_turn())?;
        while frame > self.frames.last() && begun.elapsed() < limit && self.advance()? {}
        Ok(())
    }

    /// The first iteration after those that are known; false at the end.
    fn advance(&mut self) -> Result<bool, String> {
        let playback = self.playback.as_mut().expect(THERE);
        let advanced = playback.advance();
        if !matches!(advanced, Ok(true)) {
            let (outcome, is_wrong) = outcome(playback.end());
            self.frames.end(outcome, is_wrong);
        }
        match advanced {
            Ok(true) => {
                let turn = playback.turn();
                let moment = playback.moments()[turn];
                self.frames.note(playback.sim(), turn, moment);
                return Ok(true);
            }
            // What came of an iteration that was broken off does not count.
            Ok(false) => drop(playback.sim().take_happenings()),
            Err(_) => {
                self.begin_anew()?;
                self.go_to(self.frames.last_turn())?;
            }
        }
        Ok(false)
    }

    /// Goes to the moment that is shown.
    fn come_back(&mut self) -> Result<(), String> {
        self.go_to(self.frames.turn_of(self.frame))
    }

    fn playback(&mut self) -> &mut Playback<L> {
        self.playback.as_mut().expect(THERE)
    }

    /// Opens the capture again, at its beginning.
    fn begin_anew(&mut self) -> Result<(), String> {
        // What was there before makes room, so that the memory of the new simulator is at the same addresses.
        drop(self.playback.take());
        self.playback = Some((self.open)()?);
        self.viewer.observer = Observer::that_rereads();
        Ok(())
    }

    fn go_to(&mut self, turn: usize) -> Result<(), String> {
        if self.playback().turn() == turn {
            return Ok(());
        }
        if self.playback().go_to(turn).is_err() {
            self.begin_anew()?;
            let gone = self.playback().go_to(turn);
            gone.map_err(|error| error.to_string())?;
        }
        // What happens again is known.
        drop(self.playback().sim().take_happenings());
        Ok(())
    }
}

/// Why scripts may fail from now on.
fn note_of_life(time: f64) -> RecentLine {
    RecentLine {
        time,
        level: Some(verbosity::WARNINGS),
        origin: "viewer".to_owned(),
        script: None,
        text: NOTE.to_owned(),
        located: None,
    }
}

/// How a capture has ended, in words, and whether that is wrong.
fn outcome(end: Option<&Verdict>) -> (String, bool) {
    match end {
        None | Some(Verdict::Same { .. }) => ("The capture ends here.".to_owned(), false),
        Some(Verdict::Cut { .. }) => (
            "The capture ends here: its process did not end by itself.".to_owned(),
            false,
        ),
        Some(Verdict::Differs { step, what }) => (
            format!("The run differs from its capture at step {step}: {what}"),
            true,
        ),
        Some(Verdict::Unreadable(reason)) => {
            (format!("The capture cannot be read: {reason}"), true)
        }
    }
}
