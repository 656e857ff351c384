//! The option about recordings.

use std::fs::File;
use std::path::PathBuf;

use simulator::Simulator;
use view::recording::{Recorded, RunRecorder};

/// A recording of the run.
#[derive(clap::Args)]
pub(in crate::cli) struct RecordArgs {
    /// Record the run, to look at it again with `swanilda view FILE` and `swanilda export FILE`
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Record what vision sensors see as well
    #[arg(long, requires = "record")]
    record_images: bool,
}

impl RecordArgs {
    pub(in crate::cli) fn is_asked_for(&self) -> bool {
        self.record.is_some()
    }

    /// Begins the file with the present state.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(in crate::cli) fn start(
        &self,
        sim: &Simulator,
    ) -> Result<Option<RunRecorder<File>>, String> {
        let recorded = if self.record_images {
            Recorded::SceneAndImages
        } else {
            Recorded::Scene
        };
        let start = |path: &PathBuf| {
            File::create(path).and_then(|file| RunRecorder::start(sim, file, recorded))
        };
        let recorder = self.record.as_ref().map(start);
        recorder.transpose().map_err(|error| self.failed(&error))
    }

    /// Completes the file.
    ///
    /// # Errors
    /// When it could not be written, at any time.
    pub(in crate::cli) fn finish(
        &self,
        sim: &Simulator,
        recorder: Option<RunRecorder<File>>,
    ) -> Result<(), String> {
        let finished = recorder.map(|recorder| recorder.finish(sim)).transpose();
        finished.map(drop).map_err(|error| self.failed(&error))
    }

    fn failed(&self, error: &std::io::Error) -> String {
        let path = self.record.clone().unwrap_or_default();
        format!("cannot write {}: {error}", path.display())
    }
}
