//! Where there are no socket pairs that a program can have as its standard input, scripts have no processes.

use std::convert::Infallible;
use std::io;
use std::path::Path;
use std::process::ExitStatus;
use std::time::Duration;

/// Why the connection has ended.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The program has ended.
    #[error("the connection is closed")]
    Closed,
}

/// A running program: there is none.
pub struct PeerProcess(Infallible);

impl PeerProcess {
    /// # Errors
    /// Always.
    pub(crate) fn start(
        _: &str,
        _: &[&str],
        _: Option<&Path>,
        _: &[(&str, &str)],
    ) -> io::Result<Self> {
        Err(io::Error::new(
            io::ErrorKind::Unsupported,
            "scripts have no processes of their own on this system so far",
        ))
    }

    pub(crate) fn send(&mut self, _: &[u8]) -> Result<(), PeerError> {
        match self.0 {}
    }

    pub(crate) fn receive(&mut self, _: Duration) -> Result<Option<Vec<u8>>, PeerError> {
        match self.0 {}
    }

    pub(crate) fn take_output(&self) -> (Vec<u8>, usize) {
        match self.0 {}
    }

    pub(crate) fn last_output(&self) -> Vec<u8> {
        match self.0 {}
    }

    pub(crate) fn wait_for_end(&mut self, _: Duration) -> Option<ExitStatus> {
        match self.0 {}
    }

    pub(crate) fn kill(&mut self) {
        match self.0 {}
    }
}
