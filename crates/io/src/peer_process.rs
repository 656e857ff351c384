//! A program that works for a script: frames over a socket pair, and no life of its own.
//!
//! The program's standard input is one socket, for frames: a length of four bytes, little-endian, then the content. Its standard output is
//! another one, on which nobody writes: it closes with the simulator, however that ends, and the program's guardian then kills what there
//! is. What the program and those it starts write is collected from standard error. What frames say is not known here.

use std::collections::VecDeque;
use std::io::{self, Read, Write};
use std::net::Shutdown;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::Builder;
use std::time::Duration;

use heap::{Outer, brought_in, outside};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use rustix::net::{RecvFlags, recv};

/// The longest frame.
const MAX_FRAME: usize = 256 << 20;
/// Bytes of the program's output that are kept until they are read.
const MAX_OUTPUT: usize = 64 << 10;
/// A program that reads nothing for so long has failed.
const WRITE_LIMIT: Duration = Duration::from_secs(10);
/// How long a read waits. A wait that is not shorter needs no poll before it reads.
const READ_TIME: Duration = Duration::from_millis(20);
/// A program whose connection was closed has this time to end by itself: to write its files, for instance.
const GRACE: Duration = Duration::from_millis(300);
/// How often a read polls before it sleeps: waking up takes longer than most answers.
const POLLS: usize = 60;
/// The guardian has this time to end everything.
const GUARDIAN_LIMIT: Duration = Duration::from_secs(2);
const PAUSE: Duration = Duration::from_millis(2);

/// Why the connection has ended.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The program has closed its side, or has ended.
    #[error("the connection is closed")]
    Closed,
    /// A frame of more than 256 MiB was announced.
    #[error("a message is longer than 256 MiB")]
    TooLong,
    /// An error of the system.
    #[error("{0}")]
    Io(#[from] io::Error),
}

/// A running program. Dropping it ends the program and all that it has started.
pub struct PeerProcess {
    socket: UnixStream,
    lifeline: Option<UnixStream>,
    child: Child,
    output: Outer<Arc<Mutex<Output>>>,
    /// What was received and is no whole frame yet, or belongs to later frames.
    received: Vec<u8>,
    part: Vec<u8>,
}

/// What the program wrote beside its frames.
#[derive(Default)]
struct Output {
    bytes: VecDeque<u8>,
    lost: usize,
    /// There is no more to come.
    is_complete: bool,
}

impl PeerProcess {
    /// Starts `program` with `args`, and with these variables beside those of the simulator.
    ///
    /// # Errors
    /// When there is no such program, or no room for one more.
    pub fn start(
        program: &str,
        args: &[&str],
        working_dir: Option<&Path>,
        variables: &[(&str, &str)],
    ) -> io::Result<Self> {
        let (socket, theirs) = UnixStream::pair()?;
        let (lifeline, their_lifeline) = UnixStream::pair()?;
        socket.set_write_timeout(Some(WRITE_LIMIT))?;
        socket.set_read_timeout(Some(READ_TIME))?;
        let mut command = Command::new(program);
        command
            .args(args)
            .envs(variables.iter().copied())
            .stdin(OwnedFd::from(theirs))
            .stdout(OwnedFd::from(their_lifeline))
            .stderr(Stdio::piped());
        if let Some(folder) = working_dir {
            command.current_dir(folder);
        }
        let mut child = command.spawn()?;
        let pipe = child.stderr.take();
        let output = outside(|| collected(pipe))?;
        Ok(Self {
            socket,
            lifeline: Some(lifeline),
            child,
            output: Outer::new(output),
            received: Vec::new(),
            part: vec![0; 1 << 16],
        })
    }

    /// Sends one frame.
    ///
    /// # Errors
    /// When the program has ended, or reads nothing.
    pub fn send(&mut self, content: &[u8]) -> Result<(), PeerError> {
        let length = u32::try_from(content.len())
            .ok()
            .filter(|_| content.len() <= MAX_FRAME);
        let length = length.ok_or(PeerError::TooLong)?.to_le_bytes();
        Ok(self.socket.write_all(&[&length, content].concat())?)
    }

    /// The next frame; None when none comes within `limit`, or within 20 milliseconds.
    ///
    /// # Errors
    /// When the program has ended, or sends what is no frame.
    pub fn receive(&mut self, limit: Duration) -> Result<Option<Vec<u8>>, PeerError> {
        loop {
            if let Some(frame) = self.next_frame()? {
                return Ok(Some(frame));
            }
            if self.read_what_is_there(if limit < READ_TIME { 1 } else { POLLS })? {
                continue;
            }
            if limit < READ_TIME && !self.is_readable(limit)? {
                return Ok(None);
            }
            match self.socket.read(&mut self.part) {
                Ok(0) => return Err(PeerError::Closed),
                Ok(count) => self.received.extend_from_slice(&self.part[..count]),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Ok(None),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Reads without sleeping, polling at most that often; false when there is nothing.
    fn read_what_is_there(&mut self, polls: usize) -> Result<bool, PeerError> {
        for _ in 0..polls {
            match recv(&self.socket, &mut self.part[..], RecvFlags::DONTWAIT) {
                Ok((0, _)) => return Err(PeerError::Closed),
                Ok((count, _)) => {
                    self.received.extend_from_slice(&self.part[..count]);
                    return Ok(true);
                }
                Err(Errno::AGAIN) => std::thread::yield_now(),
                Err(Errno::INTR) => {}
                Err(error) => return Err(io::Error::from(error).into()),
            }
        }
        Ok(false)
    }

    fn is_readable(&self, limit: Duration) -> io::Result<bool> {
        let limit = Timespec::try_from(limit).map_err(io::Error::other)?;
        let mut fds = [PollFd::new(&self.socket, PollFlags::IN)];
        match poll(&mut fds, Some(&limit)) {
            Ok(count) => Ok(count > 0),
            Err(Errno::INTR) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    /// A frame that has been received completely.
    fn next_frame(&mut self) -> Result<Option<Vec<u8>>, PeerError> {
        let Some((length, rest)) = self.received.split_first_chunk() else {
            return Ok(None);
        };
        let length = u32::from_le_bytes(*length) as usize;
        if length > MAX_FRAME {
            return Err(PeerError::TooLong);
        }
        let Some(frame) = rest.get(..length).map(<[u8]>::to_vec) else {
            return Ok(None);
        };
        self.received.drain(..length + 4);
        Ok(Some(frame))
    }

    /// What the program wrote beside its frames since the last time, and how many bytes of that were lost since they were too many.
    pub fn take_output(&self) -> (Vec<u8>, usize) {
        brought_in(|| {
            let mut output = locked(self.output.get());
            (
                std::mem::take(&mut output.bytes).into(),
                std::mem::take(&mut output.lost),
            )
        })
    }

    /// The same of a program that has ended, whose last words are on their way.
    #[allow(
        clippy::disallowed_methods,
        reason = "they come in a moment, which nothing depends on"
    )]
    pub fn last_output(&self) -> Vec<u8> {
        let is_complete = || locked(self.output.get()).is_complete;
        let mut left = GUARDIAN_LIMIT;
        while !left.is_zero() && !is_complete() {
            std::thread::sleep(PAUSE);
            left = left.saturating_sub(PAUSE);
        }
        self.take_output().0
    }

    /// The status with which the program ended; None while it runs, for at most `limit`.
    #[allow(
        clippy::disallowed_methods,
        reason = "a program that ends takes a moment, which nothing depends on"
    )]
    pub fn wait_for_end(&mut self, limit: Duration) -> Option<ExitStatus> {
        let mut left = limit;
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Err(_) => return None,
                Ok(None) if left.is_zero() => return None,
                Ok(None) => std::thread::sleep(PAUSE),
            }
            left = left.saturating_sub(PAUSE);
        }
    }

    /// Ends the program and all that it has started, at once.
    pub fn kill(&mut self) {
        self.lifeline = None;
        if self.wait_for_end(GUARDIAN_LIMIT).is_none() {
            // The guardian process does not respond either.
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

impl Drop for PeerProcess {
    fn drop(&mut self) {
        // Shutting down fails only if the connection is closed already.
        let _ = self.socket.shutdown(Shutdown::Both);
        let _ = self.wait_for_end(GRACE);
        self.kill();
    }
}

/// What a thread collects from `pipe`. It may outlive the simulator: another program may hold the pipe open.
fn collected(pipe: Option<ChildStderr>) -> io::Result<Arc<Mutex<Output>>> {
    let output = Arc::<Mutex<Output>>::default();
    if let Some(pipe) = pipe {
        let output = Arc::clone(&output);
        Builder::new().spawn(move || collect(pipe, &output))?;
    }
    Ok(output)
}

/// Whole even if a thread that held it panicked: bytes are only added or taken.
fn locked(output: &Mutex<Output>) -> MutexGuard<'_, Output> {
    output.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Reads to the end; what nobody takes in time is lost.
fn collect(mut pipe: impl Read, output: &Mutex<Output>) {
    let mut part = vec![0; 1 << 12];
    loop {
        match pipe.read(&mut part) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Ok(0) | Err(_) => return locked(output).is_complete = true,
            Ok(count) => {
                let mut output = locked(output);
                let kept = count.min(MAX_OUTPUT - output.bytes.len());
                output.bytes.extend(&part[..kept]);
                output.lost += count - kept;
            }
        }
    }
}
