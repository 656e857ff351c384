//! Values as bytes for storage and for other programs. No Lua, no sockets.

pub mod cbor;
pub mod cbor_head;
pub mod number_buffer;
pub mod pack;
