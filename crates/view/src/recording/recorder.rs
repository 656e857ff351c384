//! Records a simulator: what it shows after each step goes to a file.

use std::io::Write;

use super::{Mark, MarkKind, Writer, graphs};
use crate::images::Images;
use crate::mirror::Revision;
use crate::mirror::{Message, Mirror};
use crate::observe::{Observation, Observer, Source};
use scene::Scene;
use script::log::RecentLine;

/// A recording in the making. Nothing of the clock or of this machine is in it: the same simulation is the same bytes.
pub(crate) struct Recorder<W> {
    observer: Observer,
    mirror: Mirror,
    /// What the file has.
    seen: Revision,
    writer: Writer<W>,
    /// Duration of the simulations before the present one, seconds.
    before: f64,
    /// Of the last message in the present simulation, seconds.
    last: f64,
    /// What of the images of vision sensors is in the chunk; None if they are not recorded.
    images: Option<Images>,
}

/// What is recorded of a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Recorded {
    /// Objects, windows, graphs and the log.
    #[default]
    Scene,
    /// Also the images of vision sensors.
    SceneAndImages,
}

impl<W: Write> Recorder<W> {
    /// Begins with the present state.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn new(
        file: W,
        source: &Source<'_>,
        lines: &[RecentLine],
        recorded: Recorded,
    ) -> std::io::Result<Self> {
        let writer = Writer::new(file, &source.name(), source.now.scene.settings().time_step)?;
        let (observer, mirror) = (Observer::default(), Mirror::default());
        let images = (recorded == Recorded::SceneAndImages).then(Images::default);
        let mut recorder = Self {
            images,
            observer,
            mirror,
            seen: 0,
            writer,
            before: 0.0,
            last: source.now.time,
        };
        recorder.record(source, lines)?;
        Ok(recorder)
    }

    /// Adds what changed since the last call.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn record(
        &mut self,
        source: &Source<'_>,
        lines: &[RecentLine],
    ) -> std::io::Result<()> {
        if source.now.time < self.last {
            // Another simulation has begun: the timeline goes on.
            self.before += self.last;
        }
        self.last = source.now.time;
        self.mark_errors(lines);
        let seen = self.observer.observe(source, lines);
        self.add(seen)?;
        self.add_images(source.now.scene)
    }

    fn add(&mut self, seen: Observation) -> std::io::Result<()> {
        if !self.mirror.apply(seen) {
            return Ok(());
        }
        let time = self.time();
        let is_snapshot = self.writer.chunk_is_full(time);
        if is_snapshot {
            self.writer.end_chunk()?;
            if let Some(images) = &mut self.images {
                images.forget();
            }
        }
        for blob in self.mirror.blobs_since(self.seen) {
            self.writer.add_blob(time, blob)?;
        }
        let changes = match is_snapshot {
            true => self.mirror.snapshot_with_lines_since(self.seen),
            false => self.mirror.changes_since(self.seen),
        };
        let Some(changes) = changes else {
            return Ok(());
        };
        self.seen = changes.revision;
        changes
            .messages()
            .iter()
            .try_for_each(|message| self.writer.add(time, message))
    }

    fn add_images(&mut self, scene: &Scene) -> std::io::Result<()> {
        let time = self.time();
        let new = self
            .images
            .as_mut()
            .map(|images| images.of_all(scene, time))
            .unwrap_or_default();
        new.into_iter()
            .try_for_each(|image| self.writer.add(time, &Message::Binary(image)))
    }

    /// Of the timeline, seconds.
    fn time(&self) -> f64 {
        self.before + self.last
    }

    fn mark_errors(&mut self, lines: &[RecentLine]) {
        for line in lines.iter().filter(|line| line.is_script_error()) {
            self.mark(MarkKind::Error, &line.text, line.script);
        }
    }

    /// Notes what happened now.
    pub(crate) fn mark(&mut self, kind: MarkKind, text: &str, handle: Option<i64>) {
        self.writer.mark(Mark {
            time: self.time(),
            kind,
            text: text.to_owned(),
            handle,
        });
    }

    /// Completes the file, with the last lines of the log and what graphs have recorded.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn finish(mut self, scene: &Scene, lines: &[RecentLine]) -> std::io::Result<W> {
        self.mark_errors(lines);
        self.add(Observation::of_lines(lines, self.last))?;
        if let Some(graphs) = graphs::message(scene) {
            self.writer.add(self.time(), &Message::Text(graphs))?;
        }
        self.writer.finish()
    }
}
