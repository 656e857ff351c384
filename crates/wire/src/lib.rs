//! Values as bytes for storage and for other programs. No Lua, no sockets.

#![warn(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss
)]

pub mod cbor;
pub mod cbor_head;
pub mod marshal;
pub mod mime;
pub mod number_buffer;
pub mod pack;
pub mod simx;

use scene::Data;

/// Bytes that are not taken for data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unreadable {
    /// Not of the format, or nested too deeply.
    #[error("invalid data.")]
    Malformed,
    /// More elements than a script's value may have.
    #[error("the data has more than {} elements.", Data::MAX_ITEMS)]
    TooMany,
}
