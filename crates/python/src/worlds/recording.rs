//! Recordings of a simulator, which `swanilda view` plays.

use std::fs::File;
use std::path::{Path, PathBuf};

use pyo3::PyResult;
use view::recording::RunRecorder;

use crate::errors::Error;
use crate::options::recorded;
use crate::worlds::World;

/// Why a simulator that is recorded does not go back.
pub const GOES_FORWARD: &str = "a simulator that is recorded cannot be brought back and has no branches: end_recording() first.";

/// A file that gets every step.
pub struct Recording {
    path: PathBuf,
    recorder: RunRecorder<File>,
}

impl World {
    /// Records from the present state on; the recording before is complete then.
    ///
    /// # Errors
    /// When the file cannot be written, or the simulator has branches.
    pub fn record(&self, path: PathBuf, images: bool) -> PyResult<()> {
        if self.has_branches() {
            return Err(Error::new_err(GOES_FORWARD));
        }
        self.finish_recording()?;
        let file = File::create(&path).map_err(|error| cannot_write(&path, &error))?;
        let recorder = RunRecorder::start(&*self.borrow()?, file, recorded(images));
        let recorder = recorder.map_err(|error| cannot_write(&path, &error))?;
        self.recording.replace(Some(Recording { path, recorder }));
        Ok(())
    }

    /// Completes the file, if there is one.
    ///
    /// # Errors
    /// When it could not be written, at any time.
    pub fn finish_recording(&self) -> PyResult<()> {
        let simulator = self.borrow()?;
        let Some(recording) = self.recording.take() else {
            return Ok(());
        };
        let finished = recording.recorder.finish(&simulator);
        finished
            .map(drop)
            .map_err(|error| cannot_write(&recording.path, &error))
    }

    /// Whether it may be brought back to another moment.
    ///
    /// # Errors
    /// When it is recorded.
    pub fn check_not_recorded(&self) -> PyResult<()> {
        match &*self.recording.borrow() {
            Some(_) => Err(Error::new_err(GOES_FORWARD)),
            None => Ok(()),
        }
    }
}

fn cannot_write(path: &Path, error: &std::io::Error) -> pyo3::PyErr {
    pyo3::exceptions::PyOSError::new_err(format!("cannot write {}: {error}", path.display()))
}
