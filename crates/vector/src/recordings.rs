//! Episodes as recordings, which `swanilda view` plays.

use std::fs::File;
use std::path::{Path, PathBuf};

use simulator::Simulator;
use view::recording::{Recorded, RunRecorder};

/// The next episode of a world, as a file.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The number of the world.
    pub world: usize,
    /// Of the file, which is made or emptied at once.
    pub path: PathBuf,
    /// What is in it.
    pub recorded: Recorded,
}

/// The recording of a world's present episode, and that of its next one.
#[derive(Default)]
pub(crate) struct Recordings {
    next: Option<Opened>,
    present: Option<Running>,
}

/// A file that has nothing yet.
struct Opened {
    path: PathBuf,
    file: File,
    recorded: Recorded,
}

/// A file that gets every step.
struct Running {
    path: PathBuf,
    recorder: RunRecorder<File>,
}

impl Recordings {
    /// Opens the file of the next episode.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn open(&mut self, recording: &Recording) -> Result<(), String> {
        let path = recording.path.clone();
        let file = File::create(&path).map_err(|error| cannot_write(&path, &error))?;
        self.next = Some(Opened {
            path,
            file,
            recorded: recording.recorded,
        });
        Ok(())
    }

    /// Begins with the present state, if a file is open.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn begin(&mut self, simulator: &Simulator) -> Result<(), String> {
        let Some(opened) = self.next.take() else {
            return Ok(());
        };
        let recorder = RunRecorder::start(simulator, opened.file, opened.recorded);
        let recorder = recorder.map_err(|error| cannot_write(&opened.path, &error))?;
        self.present = Some(Running {
            path: opened.path,
            recorder,
        });
        Ok(())
    }

    /// Marks the present time as that of a failure.
    pub(crate) fn mark_failure(&self, reason: &str) {
        if let Some(running) = &self.present {
            running.recorder.mark_failure(reason);
        }
    }

    /// Completes the file of the present episode, if there is one.
    ///
    /// # Errors
    /// When it could not be written, at any time.
    pub(crate) fn finish(&mut self, simulator: &Simulator) -> Result<(), String> {
        let Some(running) = self.present.take() else {
            return Ok(());
        };
        let finished = running.recorder.finish(simulator);
        finished
            .map(drop)
            .map_err(|error| cannot_write(&running.path, &error))
    }
}

fn cannot_write(path: &Path, error: &std::io::Error) -> String {
    format!("cannot write {}: {error}", path.display())
}
