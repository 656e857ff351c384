//! The protocol of the legacy remote API (`simx...`), server side: bytes in, commands out; results in, bytes out (spec:
//! legacy-remote-api). It knows neither sockets nor what commands mean.

mod bytes;
mod message;
mod packets;
mod pending;
mod session;
mod splits;

pub use bytes::{ByteOrder, FieldReader, FieldWriter};
pub use message::{Command, Stamp};
pub use packets::{Packets, cut};
pub use session::{Answer, Received, Session};

/// The version of the protocol that both sides report.
pub const VERSION: u8 = 11;

/// Bytes of one message, and of one command, that are accepted.
pub(crate) const MAX_SIZE: usize = 256 << 20;

/// Commands of one message, and commands that wait, that are accepted.
pub(crate) const MAX_COMMANDS: usize = 10_000;

/// Why a connection is closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Violation {
    /// Bytes that are no message of this protocol.
    #[error("the data is not of the legacy remote API.")]
    Malformed,
    /// A message or a command that is too large.
    #[error("the data is larger than {MAX_SIZE} bytes.")]
    TooLarge,
    /// Too many commands in a message, or waiting.
    #[error("there are more than {MAX_COMMANDS} commands.")]
    TooMany,
}
