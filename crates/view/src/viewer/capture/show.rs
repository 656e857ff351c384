//! What pages see of the moment that is shown.

use std::time::Duration;

use super::super::FRAME;
use super::{CaptureViewer, REST, THERE};
use crate::observe::{Played, Source, describe_line};
use script::wall_clock;
use simulator::Loop;

/// The same while it runs ahead and has to come back for it.
const REST_AHEAD: Duration = Duration::from_secs(1);
/// Between two descriptions of the timeline.
const LIST: Duration = Duration::from_millis(250);
/// Lines of the console that pages have.
const LINES: usize = 2000;

impl<L: Loop> CaptureViewer<L> {
    /// Shows the moment if something changed, and now and then without.
    pub(super) fn show(&mut self) -> Result<(), String> {
        let now = wall_clock::now();
        if self.list.is_due(now, LIST) && self.viewer.shared.has_pages() {
            let list = self.frames.describe();
            if self.viewer.shared.mirror().show_list("timeline", &list) {
                self.viewer.server.waker().wake();
            }
        }
        let rest = if self.frames.is_complete() || self.is_playing {
            REST
        } else {
            REST_AHEAD
        };
        let is_due = match self.is_new {
            true => self.viewer.frame.is_due(now, FRAME),
            false => self.rest.is_due(now, rest),
        };
        if !is_due || !self.viewer.shared.has_pages() {
            return Ok(());
        }
        self.come_back()?;
        self.is_new = false;
        self.show_moment();
        Ok(())
    }

    fn show_moment(&mut self) {
        self.show_lines();
        let all = self.frames.count_of_lines(self.frame);
        let errors = self
            .frames
            .lines(0, all)
            .filter(|line| line.is_script_error());
        self.viewer.observer.set_errors(errors);
        let sim = self.playback.as_mut().expect(THERE).sim();
        sim.refresh_poses();
        let seen = {
            let scene = sim.scene();
            let source = Source {
                is_read_only: true,
                played: Some(Played {
                    frame: self.frame,
                    is_playing: self.is_playing,
                    speed: self.speed,
                    goes_on: !self.viewer.is_read_only,
                }),
                ..Source::of(sim, &scene)
            };
            self.viewer.observer.observe(&source, &[])
        };
        let windows = self.viewer.windows.observe_all(sim);
        let found = self.viewer.find_demanded(sim);
        self.viewer.sample(sim);
        self.viewer.publish(seen, windows, found);
    }

    /// The console has the lines up to the moment.
    fn show_lines(&mut self) {
        let all = self.frames.count_of_lines(self.frame);
        let shown = self.lines.replace(all);
        if shown == Some(all) {
            return;
        }
        let from = match shown {
            Some(shown) if shown < all && all - shown < LINES => shown,
            _ => all.saturating_sub(LINES),
        };
        let lines: Vec<String> = self.frames.lines(from, all).map(describe_line).collect();
        self.viewer
            .shared
            .mirror()
            .show_lines(lines, Some(from) == shown);
    }
}
