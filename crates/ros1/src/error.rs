//! What can go wrong.

use std::io;

use thiserror::Error;

/// The result of a call to the network.
pub type Result<T> = std::result::Result<T, Error>;

/// Why something of ROS was not done.
#[derive(Debug, Error)]
pub enum Error {
    /// Not a name of ROS.
    #[error("invalid name: '{0}'")]
    Name(String),
    /// Not of the form `http://host:port`.
    #[error("'{0}' is no address of the form {1}://host:port")]
    Address(String, &'static str),
    /// A host that is not found.
    #[error("host '{0}' is not known: {1}")]
    Host(String, io::Error),
    /// A host outside of this machine, where that was not allowed.
    #[error("{0} is outside of this machine (--ros-network allows that)")]
    Outside(String),
    /// No master answers.
    #[error("no ROS master at {uri}: {problem}")]
    Master {
        /// Its address.
        uri: String,
        /// What happened.
        problem: String,
    },
    /// The master answers that it did not do it.
    #[error("the ROS master refuses {method}: {reason}")]
    Refused {
        /// What was asked for.
        method: String,
        /// What it says.
        reason: String,
    },
    /// No node offers the service.
    #[error("there is no service '{0}'")]
    NoService(String),
    /// The other side of a connection says why it does not go on.
    #[error("{0}")]
    Peer(String),
    /// What came is not what the protocol says.
    #[error("not understood: {0}")]
    Protocol(String),
    /// The system's problem with a connection.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl Error {
    pub(crate) fn protocol(problem: impl Into<String>) -> Self {
        Self::Protocol(problem.into())
    }
}
