//! The options about state hashes.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

use simulator::hash_file::{Comparison, HashWriter, Verdict};
use simulator::{SimulationState, Simulator};

/// Hashes of the state that scripts can observe.
#[derive(clap::Args)]
pub(in crate::cli) struct HashArgs {
    /// Print the hash of the state after the last step: runs that are the same have the same one
    #[arg(long, conflicts_with = "view")]
    hash: bool,
    /// Write the hash of the state after each step, for --expect-hash
    #[arg(long, value_name = "FILE", conflicts_with_all = ["view", "expect_hash"])]
    hash_file: Option<PathBuf>,
    /// End at the first step whose state is not that of a file of --hash-file, and say what differs
    #[arg(long, value_name = "FILE", conflicts_with = "view")]
    expect_hash: Option<PathBuf>,
}

/// What becomes of the hashes of a run's steps.
pub(in crate::cli) struct Hashes {
    /// The last step and its hash, where it is to be printed.
    last: Option<Option<(u64, u64)>>,
    file: Target,
    /// The step that differs, or why a file cannot be used.
    end: Option<End>,
}

/// Why a run does not go on.
enum End {
    Differs(String),
    Failed(String),
}

/// The file of hashes.
enum Target {
    None,
    Written(PathBuf, Box<HashWriter<BufWriter<File>>>),
    Expected(PathBuf, Box<Comparison<BufReader<File>>>),
}

/// The outcome of a comparison.
pub(in crate::cli) struct Compared {
    pub is_equal: bool,
    pub text: String,
}

impl HashArgs {
    /// Opens the files.
    ///
    /// # Errors
    /// When that fails.
    pub(in crate::cli) fn start(&self) -> Result<Hashes, String> {
        Ok(Hashes {
            last: self.hash.then_some(None),
            file: self.target()?,
            end: None,
        })
    }

    /// As a capture is replayed: no files.
    pub(in crate::cli) fn without_files(&mut self) {
        (self.hash_file, self.expect_hash) = (None, None);
    }

    fn target(&self) -> Result<Target, String> {
        if let Some(path) = &self.hash_file {
            let file = File::create(path)
                .map(BufWriter::new)
                .and_then(HashWriter::new);
            let writer = file.map_err(|error| failed(path, &error))?;
            return Ok(Target::Written(path.clone(), Box::new(writer)));
        }
        let Some(path) = &self.expect_hash else {
            return Ok(Target::None);
        };
        let file = File::open(path).map_err(|error| failed(path, &error))?;
        let comparison = Comparison::new(BufReader::new(file));
        let comparison = comparison.map_err(|error| failed(path, &error))?;
        Ok(Target::Expected(path.clone(), Box::new(comparison)))
    }
}

impl Hashes {
    /// Whether the run needs not go on.
    pub(in crate::cli) fn end_the_run(&self) -> bool {
        self.end.is_some()
    }

    /// Writes or compares the state after a step. The end of a simulation restores what was before it, which is no step. The last steps of a run
    /// that is as long as was asked for, `at_end`, are not compared: a longer one does not stop there.
    pub(in crate::cli) fn observe(&mut self, sim: &Simulator, at_end: bool) {
        if self.end.is_some() || sim.state() == SimulationState::Stopped {
            return;
        }
        match &mut self.file {
            Target::None => {}
            Target::Written(path, writer) => {
                if let Err(error) = writer.add(sim) {
                    self.end = Some(End::Failed(failed(path, &error)));
                }
            }
            Target::Expected(..) if at_end && sim.state().is_stopping() => {}
            Target::Expected(path, comparison) => match comparison.compare(sim) {
                Ok(Verdict::Differs(difference)) => {
                    self.end = Some(End::Differs(format!("{}: {difference}.", path.display())));
                }
                Ok(Verdict::Equal | Verdict::EndOfFile) => {}
                Err(error) => self.end = Some(End::Failed(failed(path, &error))),
            },
        }
        // Every run ends with a stop of some steps, unless a script ends the program.
        if let Some(last) = &mut self.last
            && (sim.state().is_stopping() || sim.quit_requested())
        {
            *last = Some((sim.steps(), sim.state_hash()));
        }
    }

    /// The last step and its hash, if they are to be printed and there was a step.
    pub(in crate::cli) fn last(&self) -> Option<(u64, u64)> {
        self.last.flatten()
    }

    /// Completes the file; the outcome of a comparison.
    ///
    /// # Errors
    /// When a file could not be written or read.
    pub(in crate::cli) fn finish(self) -> Result<Option<Compared>, String> {
        match (self.end, self.file) {
            (Some(End::Failed(reason)), _) => Err(reason),
            (Some(End::Differs(text)), _) => Ok(Some(Compared {
                is_equal: false,
                text,
            })),
            (None, Target::None) => Ok(None),
            (None, Target::Written(path, writer)) => {
                let written = writer.finish();
                written.map_err(|error| failed(&path, &error))?;
                Ok(None)
            }
            (None, Target::Expected(path, comparison)) => compared(&path, *comparison).map(Some),
        }
    }
}

fn compared(path: &Path, mut comparison: Comparison<BufReader<File>>) -> Result<Compared, String> {
    let equal = comparison.equal_steps();
    let has_more = comparison
        .has_more()
        .map_err(|error| failed(path, &error))?;
    let path = path.display();
    if equal == 0 {
        return Err(format!("{path}: no step was compared"));
    }
    let more = if has_more { ", which has more" } else { "" };
    Ok(Compared {
        is_equal: true,
        text: format!("The states after {equal} steps are those of {path}{more}."),
    })
}

fn failed(path: &Path, error: &dyn std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}
