//! Messages and message parts.

use std::ffi::c_int;
use std::mem;

use zmq_sys as ffi;

use super::libzmq::RawMessage;
use super::socket::Socket;
use super::{Errno, ZmqResult, c_text};

/// Longest message that can be allocated: no value of a script is longer.
const MAX_SIZE: i64 = 1 << 30;
const DONTWAIT: c_int = ffi::ZMQ_DONTWAIT as c_int;

/// A message. A closed one is empty, and most operations refuse it.
pub struct Message {
    raw: RawMessage,
    is_open: bool,
}

impl Message {
    /// One that must be opened before it is used.
    pub fn closed() -> Self {
        Self {
            raw: RawMessage::new(),
            is_open: false,
        }
    }

    fn with(raw: RawMessage) -> Self {
        Self { raw, is_open: true }
    }

    /// Makes it an empty message.
    pub fn open(&mut self) {
        *self = Self::with(RawMessage::new());
    }

    /// Makes it a message of zeros.
    ///
    /// # Errors
    /// When it is too long.
    pub fn open_with_size(&mut self, size: i64) -> ZmqResult<()> {
        let size = usize::try_from(size)
            .ok()
            .filter(|&size| size as i64 <= MAX_SIZE)
            .ok_or(Errno::NO_MEMORY)?;
        *self = Self::with(RawMessage::with_size(size)?);
        Ok(())
    }

    /// # Errors
    /// When it is closed already.
    pub fn close(&mut self) -> ZmqResult<()> {
        self.require_open()?;
        *self = Self::closed();
        Ok(())
    }

    /// # Errors
    /// When it is closed.
    pub fn require_open(&self) -> ZmqResult<()> {
        if self.is_open {
            Ok(())
        } else {
            Err(Errno::NO_MESSAGE)
        }
    }

    /// The content; empty when it is closed.
    pub fn bytes(&self) -> &[u8] {
        self.raw.bytes()
    }

    /// Bytes of the content.
    pub fn size(&self) -> usize {
        self.raw.size()
    }

    /// Whether more parts of the same message follow.
    pub fn has_more(&self) -> bool {
        self.raw.has_more()
    }

    /// A property of the message, by its number `ZMQ_*`.
    pub fn get(&self, property: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        self.raw.get(property)
    }

    /// Sets a property of the message.
    pub fn set(&mut self, property: c_int, value: c_int) -> ZmqResult<()> {
        self.require_open()?;
        self.raw.set(property, value)
    }

    /// Metadata of the sender.
    pub fn property(&self, name: &str) -> ZmqResult<Vec<u8>> {
        self.require_open()?;
        self.raw.property(&c_text(name)?)
    }

    /// A second message with the same content, which is shared.
    pub fn copy(&mut self) -> ZmqResult<Self> {
        self.require_open()?;
        Ok(Self::with(self.raw.copy()?))
    }

    /// Moves the content into a new message; an empty message remains.
    pub fn take(&mut self) -> ZmqResult<Self> {
        self.require_open()?;
        Ok(Self::with(mem::replace(&mut self.raw, RawMessage::new())))
    }

    /// Replaces the content by that of another message.
    pub fn replace(&mut self, content: Self) -> ZmqResult<()> {
        self.require_open()?;
        *self = content;
        Ok(())
    }

    /// Moves the content into a socket without waiting; an empty message remains. Returns the length.
    pub fn send(&mut self, socket: &Socket, flags: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        self.raw.send(socket.raw(), flags | DONTWAIT)
    }

    /// Receives into this message without waiting. Returns the length of what came.
    pub fn receive(&mut self, socket: &Socket, flags: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        self.raw.receive(socket.raw(), flags | DONTWAIT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_message_is_empty_and_refuses_to_move() {
        let mut message = Message::closed();
        assert_eq!(
            (message.size(), message.bytes(), message.has_more()),
            (0, &[][..], false)
        );
        assert_eq!(
            (message.close(), message.take().err()),
            (Err(Errno::NO_MESSAGE), Some(Errno::NO_MESSAGE))
        );
        message.open();
        assert_eq!(
            (message.close(), message.close()),
            (Ok(()), Err(Errno::NO_MESSAGE))
        );
    }

    #[test]
    fn a_message_made_by_size_holds_zeros() {
        let mut message = Message::closed();
        message.open_with_size(1000).expect("there is room");
        assert_eq!(message.bytes(), [0; 1000]);
        assert_eq!(
            (
                message.copy().expect("open").size(),
                message.take().expect("open").size(),
                message.size()
            ),
            (1000, 1000, 0)
        );
        for size in [-1, i64::MIN, i64::MAX, MAX_SIZE + 1] {
            assert_eq!(message.open_with_size(size), Err(Errno::NO_MEMORY));
        }
    }
}
