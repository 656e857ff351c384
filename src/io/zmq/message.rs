//! Messages and message parts.

use std::ffi::{CStr, c_int};

use zmq_sys as ffi;

use super::socket::Socket;
use super::{Errno, ZmqResult, c_text, check};

/// Longest message that can be allocated: no value of a script is longer.
const MAX_SIZE: i64 = 1 << 30;

/// A message. While it is closed, as it is at first, libzmq has an empty one in its place: it ends the program when it is asked
/// about one that is not initialised.
pub(crate) struct Message {
    raw: ffi::zmq_msg_t,
    is_open: bool,
}

// Every call relies on `raw` being initialised, which `closed` makes sure of and nothing undoes.
impl Message {
    /// One that must be opened before it is used.
    pub(crate) fn closed() -> Self {
        let mut raw = ffi::zmq_msg_t::default();
        // SAFETY: initialises the structure; it never fails.
        unsafe { ffi::zmq_msg_init(&raw mut raw) };
        Self { raw, is_open: false }
    }

    /// Makes it an empty message.
    pub(crate) fn open(&mut self) {
        *self = Self::closed();
        self.is_open = true;
    }

    /// Makes it a message of zeros.
    ///
    /// # Errors
    /// When there is no room for so many.
    pub(crate) fn open_with_size(&mut self, size: i64) -> ZmqResult<()> {
        let size = usize::try_from(size).ok().filter(|&size| size as i64 <= MAX_SIZE).ok_or(Errno::NO_MEMORY)?;
        let mut raw = ffi::zmq_msg_t::default();
        // SAFETY: initialises the structure, or fails. What it has room for is filled before anybody can read it.
        unsafe {
            check(ffi::zmq_msg_init_size(&raw mut raw, size))?;
            ffi::zmq_msg_data(&raw mut raw).cast::<u8>().write_bytes(0, size);
        }
        *self = Self { raw, is_open: true };
        Ok(())
    }

    /// # Errors
    /// When it is closed already.
    pub(crate) fn close(&mut self) -> ZmqResult<()> {
        self.require_open()?;
        *self = Self::closed();
        Ok(())
    }

    /// # Errors
    /// When it is closed.
    pub(crate) fn require_open(&self) -> ZmqResult<()> {
        if self.is_open { Ok(()) } else { Err(Errno::NO_MESSAGE) }
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        // SAFETY: libzmq wants to write, but only asks. The content stays until the message changes, which borrows it.
        unsafe {
            let data = ffi::zmq_msg_data((&raw const self.raw).cast_mut());
            if data.is_null() { &[] } else { std::slice::from_raw_parts(data.cast(), self.size()) }
        }
    }

    pub(crate) fn size(&self) -> usize {
        // SAFETY: reads only.
        unsafe { ffi::zmq_msg_size(&raw const self.raw) }
    }

    /// Whether more parts of the same message follow.
    pub(crate) fn has_more(&self) -> bool {
        // SAFETY: reads only.
        unsafe { ffi::zmq_msg_more(&raw const self.raw) != 0 }
    }

    pub(crate) fn get(&self, property: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        // SAFETY: reads only.
        check(unsafe { ffi::zmq_msg_get(&raw const self.raw, property) })
    }

    pub(crate) fn set(&mut self, property: c_int, value: c_int) -> ZmqResult<()> {
        self.require_open()?;
        // SAFETY: writes to the structure.
        check(unsafe { ffi::zmq_msg_set(&raw mut self.raw, property, value) }).map(drop)
    }

    /// Metadata of the sender.
    pub(crate) fn property(&self, name: &str) -> ZmqResult<Vec<u8>> {
        self.require_open()?;
        let name = c_text(name)?;
        // SAFETY: the text libzmq returns lives as long as the message, and is copied.
        let text = unsafe { ffi::zmq_msg_gets(&raw const self.raw, name.as_ptr()) };
        if text.is_null() {
            return Err(Errno::last());
        }
        // SAFETY: as above; it ends with NUL.
        Ok(unsafe { CStr::from_ptr(text) }.to_bytes().to_vec())
    }

    /// A second message with the same content.
    pub(crate) fn copy(&mut self) -> ZmqResult<Self> {
        self.require_open()?;
        let mut copy = Self::closed();
        // SAFETY: both are initialised. The content is counted, not copied: libzmq writes the count of both.
        check(unsafe { ffi::zmq_msg_copy(&raw mut copy.raw, &raw mut self.raw) })?;
        copy.is_open = true;
        Ok(copy)
    }

    /// The content, which leaves an empty message behind.
    pub(crate) fn take(&mut self) -> ZmqResult<Self> {
        self.require_open()?;
        let mut taken = Self::closed();
        // SAFETY: both are initialised.
        check(unsafe { ffi::zmq_msg_move(&raw mut taken.raw, &raw mut self.raw) })?;
        taken.is_open = true;
        Ok(taken)
    }

    /// Puts the content of another in the place of its own.
    pub(crate) fn replace(&mut self, content: Self) -> ZmqResult<()> {
        self.require_open()?;
        *self = content;
        Ok(())
    }

    /// Hands the content to a socket without waiting, which leaves an empty message behind. Returns its length.
    pub(crate) fn send(&mut self, socket: &Socket, flags: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        let flags = flags | ffi::ZMQ_DONTWAIT as c_int;
        // SAFETY: the socket lives.
        check(unsafe { ffi::zmq_msg_send(&raw mut self.raw, socket.raw(), flags) })
    }

    /// Receives into this message without waiting. Returns the length of what came.
    pub(crate) fn receive(&mut self, socket: &Socket, flags: c_int) -> ZmqResult<c_int> {
        self.require_open()?;
        let flags = flags | ffi::ZMQ_DONTWAIT as c_int;
        // SAFETY: the socket lives.
        check(unsafe { ffi::zmq_msg_recv(&raw mut self.raw, socket.raw(), flags) })
    }
}

impl Drop for Message {
    fn drop(&mut self) {
        // SAFETY: releases the content; it never fails for an initialised message.
        unsafe { ffi::zmq_msg_close(&raw mut self.raw) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_message_is_empty_and_refuses_to_move() {
        let mut message = Message::closed();
        assert_eq!((message.size(), message.bytes(), message.has_more()), (0, &[][..], false));
        assert_eq!((message.close(), message.take().err()), (Err(Errno::NO_MESSAGE), Some(Errno::NO_MESSAGE)));
        message.open();
        assert_eq!((message.close(), message.close()), (Ok(()), Err(Errno::NO_MESSAGE)));
    }

    #[test]
    fn a_message_made_by_size_holds_zeros() {
        let mut message = Message::closed();
        message.open_with_size(1000).expect("there is room");
        assert_eq!(message.bytes(), [0; 1000]);
        assert_eq!(
            (message.copy().expect("open").size(), message.take().expect("open").size(), message.size()),
            (1000, 1000, 0)
        );
        for size in [-1, i64::MIN, i64::MAX, MAX_SIZE + 1] {
            assert_eq!(message.open_with_size(size), Err(Errno::NO_MEMORY));
        }
    }
}
