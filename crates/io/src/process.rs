//! Programs on this machine: run to their end with input and output, or left to run. Every child is reaped.

use std::io::{self, Read, Write};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};

use heap::resource::Resource;
use heap::{Outer, brought_in, outside};

/// Maximum size of each of the two outputs of a program.
pub(crate) const MAX_OUTPUT: usize = 256 << 20;

/// Why a program gave no result. In the words of CoppeliaSim.
#[derive(Debug, thiserror::Error)]
pub enum ProcessError {
    /// The system could not start the program.
    #[error("waitForStarted timed out: {0}")]
    NotStarted(#[from] io::Error),
    /// The program ended without an exit code: a signal ended it.
    #[error("the process crashed")]
    Crashed,
    /// One of the outputs is too large.
    #[error("the process wrote more than 256 MiB")]
    TooMuchOutput,
}

/// A program to run, with its options.
#[derive(Debug, Default)]
pub struct Program {
    /// The file of the program, relative to the working directory of the simulator, or a bare name.
    pub path: String,
    /// The arguments, without the name of the program.
    pub args: Vec<String>,
    /// Whether a bare name is looked up in the folders of the system.
    pub search_path: bool,
    /// The working directory; None for that of the simulator.
    pub working_dir: Option<String>,
    /// On Windows: in a window of its own.
    pub new_console: bool,
}

impl Program {
    fn command(&self) -> io::Result<Command> {
        let path = if self.search_path {
            PathBuf::from(&self.path)
        } else {
            std::path::absolute(&self.path)?
        };
        let mut command = Command::new(path);
        command.args(&self.args);
        if let Some(folder) = &self.working_dir {
            command.current_dir(folder);
        }
        #[cfg(windows)]
        if self.new_console {
            use std::os::windows::process::CommandExt;
            const CREATE_NEW_CONSOLE: u32 = 0x10;
            command.creation_flags(CREATE_NEW_CONSOLE);
        }
        Ok(command)
    }

    /// Starts it with `input`; what it writes is read while it runs, so that neither side waits for the other.
    pub fn run(&self, input: Vec<u8>) -> Result<Run, ProcessError> {
        let mut command = self.command()?;
        let child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let mut child = Process::new(child);
        let (stdin, stdout, stderr) = (
            child.0.stdin.take(),
            child.0.stdout.take(),
            child.0.stderr.take(),
        );
        if let Some(mut stdin) = stdin {
            outside(|| {
                let input = input.clone();
                // A program that does not want its input is not at fault. Its end closes the pipe, which ends the thread.
                Builder::new()
                    .spawn(move || drop(stdin.write_all(&input)))
                    .map(drop)
            })?;
        }
        Ok(Run {
            out: Collected::of(stdout)?,
            err: Collected::of(stderr)?,
            child,
        })
    }

    /// Starts it with the outputs of this program. Its input is open and empty.
    pub fn start(&self) -> Result<Process, ProcessError> {
        Ok(Process::new(self.command()?.stdin(Stdio::piped()).spawn()?))
    }

    /// Starts it detached: it outlives the simulator.
    pub fn launch(&self) -> io::Result<()> {
        let mut child = self.command()?.stdin(Stdio::null()).spawn()?;
        // A process that has ended must be reaped; that may be after the end of the simulator.
        outside(|| Builder::new().spawn(move || drop(child.wait())).map(drop))
    }
}

/// A program that runs, or ran. It is killed when it is dropped.
pub struct Process(
    Child,
    #[expect(dead_code, reason = "it is there as long as the process")] Resource,
);

impl Process {
    fn new(child: Child) -> Self {
        let resource = Resource::new(|| format!("process {}", child.id()));
        Self(child, resource)
    }
}

impl Process {
    /// The system's identifier of the process.
    pub fn id(&self) -> u32 {
        self.0.id()
    }

    /// The exit code, once the program has ended.
    pub fn exit_code(&mut self) -> Option<Result<i32, ProcessError>> {
        match self.0.try_wait() {
            Ok(status) => status.map(exit_code),
            Err(error) => Some(Err(error.into())),
        }
    }

    /// Ends it at once.
    pub fn kill(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

fn exit_code(status: ExitStatus) -> Result<i32, ProcessError> {
    status.code().ok_or(ProcessError::Crashed)
}

/// A program whose outputs are collected.
pub struct Run {
    child: Process,
    out: Collected,
    err: Collected,
}

impl Run {
    /// The exit code, once the program has ended.
    pub fn exit_code(&mut self) -> Option<Result<i32, ProcessError>> {
        if self.out.is_too_much() || self.err.is_too_much() {
            return Some(Err(ProcessError::TooMuchOutput));
        }
        self.child.exit_code()
    }

    /// Whether both outputs are closed. Those of a program that has ended may be held open by another one it has started.
    pub fn outputs_are_complete(&self) -> bool {
        self.out.is_complete() && self.err.is_complete()
    }

    /// Standard output and error output.
    pub fn outputs(&self) -> Result<(Vec<u8>, Vec<u8>), ProcessError> {
        if self.out.is_too_much() || self.err.is_too_much() {
            return Err(ProcessError::TooMuchOutput);
        }
        Ok((self.out.take(), self.err.take()))
    }
}

/// The bytes of one output, gathered by a thread, which may outlive the simulator: another program may hold the output open.
struct Collected {
    bytes: Outer<Arc<Mutex<Vec<u8>>>>,
    thread: Option<Outer<JoinHandle<()>>>,
}

impl Collected {
    fn of(pipe: Option<impl Read + Send + 'static>) -> io::Result<Self> {
        outside(|| {
            let bytes = Arc::new(Mutex::new(Vec::new()));
            let theirs = Arc::clone(&bytes);
            let thread = pipe
                .map(|pipe| Builder::new().spawn(move || collect(pipe, &theirs)))
                .transpose()?;
            Ok(Self {
                bytes: Outer::new(bytes),
                thread: thread.map(Outer::new),
            })
        })
    }

    fn is_complete(&self) -> bool {
        let is_finished = |thread: &Outer<JoinHandle<()>>| thread.with(JoinHandle::is_finished);
        self.thread.as_ref().is_none_or(is_finished)
    }

    fn is_too_much(&self) -> bool {
        lock(self.bytes.get()).len() > MAX_OUTPUT
    }

    fn take(&self) -> Vec<u8> {
        brought_in(|| std::mem::take(&mut *lock(self.bytes.get())))
    }
}

/// Reads to the end, or a little more than the maximum.
fn collect(mut pipe: impl Read, bytes: &Mutex<Vec<u8>>) {
    let mut part = vec![0; 1 << 16];
    loop {
        match pipe.read(&mut part) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Ok(0) | Err(_) => return,
            Ok(count) => {
                let mut bytes = lock(bytes);
                bytes.extend_from_slice(&part[..count]);
                if bytes.len() > MAX_OUTPUT {
                    return;
                }
            }
        }
    }
}

/// Whole even if a thread that held it panicked: bytes are only added.
fn lock(bytes: &Mutex<Vec<u8>>) -> MutexGuard<'_, Vec<u8>> {
    bytes.lock().unwrap_or_else(PoisonError::into_inner)
}
