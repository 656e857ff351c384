//! Recordings of failed tests: one to play and one that plays in any browser.

use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::case::{Outcome, TestCase};
use format::scene_file::write_whole;
use simulator::Simulator;
use view::recording::{self, Recorded, Recording, RunRecorder};

/// A test that is being recorded.
pub(super) struct TestRecording {
    recorder: RunRecorder<File>,
    file: NamedTempFile,
}

impl TestRecording {
    /// # Errors
    /// When there is no place for it.
    pub(super) fn start(sim: &Simulator) -> std::io::Result<Self> {
        let file = NamedTempFile::new()?;
        let recorder = RunRecorder::start(sim, file.reopen()?, Recorded::default())?;
        Ok(Self { recorder, file })
    }

    /// Keeps it in `folder` if the test has failed.
    pub(super) fn finish(self, sim: &Simulator, outcome: &mut Outcome, folder: &Path) {
        if !outcome.is_bad() {
            // It is removed with its file.
            let _ = self.recorder.finish(sim);
            return;
        }
        self.recorder.mark_failure(&outcome.message);
        let kept = self
            .recorder
            .finish(sim)
            .and_then(|_| keep(&self.file, &outcome.test, folder));
        match kept {
            Ok(page) => outcome.recording = Some(page),
            Err(error) => {
                outcome.message += &format!("\n(its recording cannot be written: {error})");
            }
        }
    }
}

/// Writes the recording and its page; the path of the page.
fn keep(file: &NamedTempFile, test: &TestCase, folder: &Path) -> std::io::Result<PathBuf> {
    std::fs::create_dir_all(folder)?;
    let path = folder.join(test.file_stem());
    write_whole(&path.with_extension("swr"), &std::fs::read(file.path())?)?;
    let mut recording =
        Recording::open(BufReader::new(file.reopen()?)).map_err(std::io::Error::other)?;
    let mut page = BufWriter::new(Vec::new());
    recording::html(&mut recording, &view::page_file, &mut page).map_err(std::io::Error::other)?;
    page.flush()?;
    let page_path = path.with_extension("html");
    write_whole(&page_path, page.get_ref())?;
    Ok(page_path)
}
