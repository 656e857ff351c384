//! The functions of libzmq, with types that make them safe to call.
//!
//! The only file that calls libzmq. A [`RawContext`] and a [`RawSocket`] are owners; libzmq sees them through [`ContextRef`] and [`SocketRef`],
//! which cannot outlive them. A [`RawMessage`] is always initialised. A context may end before its sockets: libzmq frees it after
//! the last of them, and until then each call on them answers `ETERM`.

use std::ffi::{CStr, CString, c_char, c_int, c_long, c_short, c_void};
use std::marker::PhantomData;
use std::ptr::NonNull;

use zmq_sys::{zmq_msg_t, zmq_pollitem_t};

use super::{Errno, ZmqResult};

/// A context. It is never freed unless it is terminated.
#[repr(transparent)]
pub(super) struct RawContext(NonNull<c_void>);

/// A context for the duration of a call.
#[repr(transparent)]
struct ContextRef<'a>(NonNull<c_void>, PhantomData<&'a RawContext>);

/// A socket, closed when it is dropped.
#[repr(transparent)]
pub(super) struct RawSocket(NonNull<c_void>);

/// A socket for the duration of a call.
#[repr(transparent)]
struct SocketRef<'a>(NonNull<c_void>, PhantomData<&'a RawSocket>);

/// A message, initialised and never closed before it is dropped.
#[repr(transparent)]
pub(super) struct RawMessage(zmq_msg_t);

/// Text that ends with NUL.
#[repr(transparent)]
struct Text<'a>(NonNull<c_char>, PhantomData<&'a CStr>);

// SAFETY: as declared in zmq.h; the types above are pointers, and null is None. The functions declared safe only need what the types
// say: a context or socket that is still there, an initialised message, a text. They copy texts, and report everything else as an error.
unsafe extern "C" {
    safe fn zmq_errno() -> c_int;
    safe fn zmq_version(major: &mut c_int, minor: &mut c_int, patch: &mut c_int);
    safe fn zmq_has(capability: Text<'_>) -> c_int;
    fn zmq_strerror<'a>(errno: c_int) -> Option<Text<'a>>;
    fn zmq_z85_encode(text: *mut u8, bytes: *const u8, length: usize) -> *mut u8;
    fn zmq_z85_decode(bytes: *mut u8, text: Text<'_>) -> *mut u8;

    safe fn zmq_ctx_new() -> Option<RawContext>;
    safe fn zmq_ctx_get(context: ContextRef<'_>, option: c_int) -> c_int;
    safe fn zmq_ctx_set(context: ContextRef<'_>, option: c_int, value: c_int) -> c_int;
    safe fn zmq_ctx_shutdown(context: ContextRef<'_>) -> c_int;
    fn zmq_ctx_term(context: ContextRef<'_>) -> c_int;

    safe fn zmq_socket(context: ContextRef<'_>, kind: c_int) -> Option<RawSocket>;
    safe fn zmq_bind(socket: SocketRef<'_>, endpoint: Text<'_>) -> c_int;
    safe fn zmq_unbind(socket: SocketRef<'_>, endpoint: Text<'_>) -> c_int;
    safe fn zmq_connect(socket: SocketRef<'_>, endpoint: Text<'_>) -> c_int;
    safe fn zmq_disconnect(socket: SocketRef<'_>, endpoint: Text<'_>) -> c_int;
    safe fn zmq_socket_monitor(
        socket: SocketRef<'_>,
        endpoint: Option<Text<'_>>,
        events: c_int,
    ) -> c_int;
    fn zmq_setsockopt(
        socket: SocketRef<'_>,
        option: c_int,
        value: *const u8,
        length: usize,
    ) -> c_int;
    fn zmq_getsockopt(
        socket: SocketRef<'_>,
        option: c_int,
        value: *mut u8,
        length: &mut usize,
    ) -> c_int;
    fn zmq_send(socket: SocketRef<'_>, bytes: *const u8, length: usize, flags: c_int) -> c_int;
    fn zmq_recv(socket: SocketRef<'_>, bytes: *mut u8, room: usize, flags: c_int) -> c_int;
    fn zmq_poll(items: *mut PollItem<'_>, count: c_int, milliseconds: c_long) -> c_int;
    fn zmq_close(socket: SocketRef<'_>) -> c_int;

    safe fn zmq_msg_init(message: &mut zmq_msg_t) -> c_int;
    safe fn zmq_msg_init_size(message: &mut zmq_msg_t, size: usize) -> c_int;
    safe fn zmq_msg_size(message: &RawMessage) -> usize;
    safe fn zmq_msg_more(message: &RawMessage) -> c_int;
    safe fn zmq_msg_get(message: &RawMessage, property: c_int) -> c_int;
    safe fn zmq_msg_set(message: &mut RawMessage, property: c_int, value: c_int) -> c_int;
    safe fn zmq_msg_gets<'a>(message: &'a RawMessage, name: Text<'_>) -> Option<Text<'a>>;
    safe fn zmq_msg_copy(copy: &mut RawMessage, message: &mut RawMessage) -> c_int;
    safe fn zmq_msg_send(message: &mut RawMessage, socket: SocketRef<'_>, flags: c_int) -> c_int;
    safe fn zmq_msg_recv(message: &mut RawMessage, socket: SocketRef<'_>, flags: c_int) -> c_int;
    fn zmq_msg_data(message: *mut RawMessage) -> *mut u8;
    fn zmq_msg_close(message: &mut RawMessage) -> c_int;
}

impl Errno {
    /// Why the last call of libzmq on this thread failed.
    fn last() -> Self {
        Self(zmq_errno())
    }
}

/// The result of a call; -1 if it failed.
fn check(returned: c_int) -> ZmqResult<c_int> {
    if returned == -1 {
        Err(Errno::last())
    } else {
        Ok(returned)
    }
}

/// The text of an error.
pub fn strerror(errno: c_int) -> String {
    // SAFETY: the text is valid until the next call on this thread, and is copied before.
    let text = unsafe { zmq_strerror(errno) }
        .map(Text::into_bytes)
        .unwrap_or_default();
    String::from_utf8_lossy(&text).into_owned()
}

/// Major, minor and patch number of libzmq.
pub fn version() -> (c_int, c_int, c_int) {
    let (mut major, mut minor, mut patch) = (0, 0, 0);
    zmq_version(&mut major, &mut minor, &mut patch);
    (major, minor, patch)
}

/// Whether libzmq was built with a capability.
pub fn has(capability: &str) -> bool {
    CString::new(capability).is_ok_and(|capability| zmq_has(Text::new(&capability)) != 0)
}

/// Bytes as printable text, five characters for four bytes (ZeroMQ RFC 32). None unless their number is a multiple of 4.
pub fn z85_encode(bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.is_empty() || !bytes.len().is_multiple_of(4) {
        return None;
    }
    let mut text = vec![0; bytes.len() / 4 * 5 + 1];
    // SAFETY: libzmq writes five characters for four bytes, and NUL.
    let written = unsafe { zmq_z85_encode(text.as_mut_ptr(), bytes.as_ptr(), bytes.len()) };
    text.pop();
    (!written.is_null()).then_some(text)
}

/// The bytes that `z85_encode` turned into `text`; None if there are none.
pub fn z85_decode(text: &[u8]) -> Option<Vec<u8>> {
    if text.is_empty() || !text.len().is_multiple_of(5) {
        return None;
    }
    let mut bytes = vec![0; text.len() / 5 * 4];
    let text = CString::new(text).ok()?;
    // SAFETY: libzmq writes four bytes for five characters.
    let written = unsafe { zmq_z85_decode(bytes.as_mut_ptr(), Text::new(&text)) };
    (!written.is_null()).then_some(bytes)
}

impl<'a> Text<'a> {
    fn new(text: &'a CStr) -> Self {
        Self(NonNull::from(text).cast(), PhantomData)
    }

    fn into_bytes(self) -> Vec<u8> {
        // SAFETY: made of a `CStr`, or by libzmq as one that is valid for the lifetime.
        unsafe { CStr::from_ptr(self.0.as_ptr()) }
            .to_bytes()
            .to_vec()
    }
}

// SAFETY: contexts may be used from any thread.
unsafe impl Send for RawContext {}

impl RawContext {
    pub(super) fn new() -> ZmqResult<Self> {
        zmq_ctx_new().ok_or_else(Errno::last)
    }

    fn borrowed(&self) -> ContextRef<'_> {
        ContextRef(self.0, PhantomData)
    }

    pub(super) fn get(&self, option: c_int) -> ZmqResult<c_int> {
        check(zmq_ctx_get(self.borrowed(), option))
    }

    pub(super) fn set(&self, option: c_int, value: c_int) -> ZmqResult<()> {
        check(zmq_ctx_set(self.borrowed(), option, value)).map(drop)
    }

    pub(super) fn shutdown(&self) -> ZmqResult<()> {
        check(zmq_ctx_shutdown(self.borrowed())).map(drop)
    }

    pub(super) fn socket(&self, kind: c_int) -> ZmqResult<RawSocket> {
        zmq_socket(self.borrowed(), kind).ok_or_else(Errno::last)
    }

    /// Waits until all its sockets are closed and their messages are sent, and frees it.
    pub(super) fn terminate(self) {
        // SAFETY: the context is not used afterwards. A signal may interrupt the call, which then has to be repeated.
        while unsafe { zmq_ctx_term(self.borrowed()) } == -1 && Errno::last() == Errno::INTERRUPTED
        {
        }
    }
}

// SAFETY: a socket may move to another thread where that is synchronised, as a move in Rust is.
unsafe impl Send for RawSocket {}

impl RawSocket {
    fn borrowed(&self) -> SocketRef<'_> {
        SocketRef(self.0, PhantomData)
    }

    pub(super) fn bind(&self, endpoint: &CStr) -> ZmqResult<()> {
        check(zmq_bind(self.borrowed(), Text::new(endpoint))).map(drop)
    }

    pub(super) fn unbind(&self, endpoint: &CStr) -> ZmqResult<()> {
        check(zmq_unbind(self.borrowed(), Text::new(endpoint))).map(drop)
    }

    pub(super) fn connect(&self, endpoint: &CStr) -> ZmqResult<()> {
        check(zmq_connect(self.borrowed(), Text::new(endpoint))).map(drop)
    }

    pub(super) fn disconnect(&self, endpoint: &CStr) -> ZmqResult<()> {
        check(zmq_disconnect(self.borrowed(), Text::new(endpoint))).map(drop)
    }

    /// Publishes events of its connections at an endpoint; without one, no longer.
    pub(super) fn monitor(&self, endpoint: Option<&CStr>, events: c_int) -> ZmqResult<()> {
        check(zmq_socket_monitor(
            self.borrowed(),
            endpoint.map(Text::new),
            events,
        ))
        .map(drop)
    }

    pub(super) fn set(&self, option: c_int, value: &[u8]) -> ZmqResult<()> {
        // SAFETY: the value has that many bytes, which are copied.
        check(unsafe { zmq_setsockopt(self.borrowed(), option, value.as_ptr(), value.len()) })
            .map(drop)
    }

    /// Writes the value of an option into `value`; returns its length.
    pub(super) fn get(&self, option: c_int, value: &mut [u8]) -> ZmqResult<usize> {
        let mut length = value.len();
        // SAFETY: libzmq writes at most `length` bytes.
        check(unsafe { zmq_getsockopt(self.borrowed(), option, value.as_mut_ptr(), &mut length) })?;
        Ok(length)
    }

    /// Sends a message part; returns its length.
    pub(super) fn send(&self, bytes: &[u8], flags: c_int) -> ZmqResult<c_int> {
        // SAFETY: there are that many bytes, which are copied.
        check(unsafe { zmq_send(self.borrowed(), bytes.as_ptr(), bytes.len(), flags) })
    }

    /// Receives a message part into `bytes`, which may be too short; returns the length of the part.
    pub(super) fn receive(&self, bytes: &mut [u8], flags: c_int) -> ZmqResult<usize> {
        // SAFETY: libzmq writes at most `bytes.len()` bytes.
        let length =
            check(unsafe { zmq_recv(self.borrowed(), bytes.as_mut_ptr(), bytes.len(), flags) })?;
        Ok(length as usize)
    }
}

impl Drop for RawSocket {
    fn drop(&mut self) {
        // SAFETY: the socket is not used afterwards. It fails only for what is no socket.
        unsafe { zmq_close(self.borrowed()) };
    }
}

/// A socket to wait for, with the events to wait for.
#[repr(transparent)]
pub(super) struct PollItem<'a>(zmq_pollitem_t, PhantomData<&'a RawSocket>);

impl<'a> PollItem<'a> {
    pub(super) fn new(socket: &'a RawSocket, events: c_short) -> Self {
        Self(
            zmq_pollitem_t {
                socket: socket.0.as_ptr(),
                events,
                ..Default::default()
            },
            PhantomData,
        )
    }

    pub(super) fn is_for(&self, socket: &RawSocket) -> bool {
        self.0.socket == socket.0.as_ptr()
    }

    pub(super) fn add_events(&mut self, events: c_short) {
        self.0.events |= events;
    }

    /// The events that the socket is ready for.
    pub(super) fn ready(&self) -> c_short {
        self.0.revents
    }
}

/// Waits until one of the sockets is ready, at most that many milliseconds; without a limit if they are negative.
pub(super) fn poll_items(items: &mut [PollItem<'_>], milliseconds: c_long) -> ZmqResult<()> {
    // SAFETY: there are that many items, whose sockets cannot be closed meanwhile.
    check(unsafe { zmq_poll(items.as_mut_ptr(), items.len() as c_int, milliseconds) }).map(drop)
}

impl RawMessage {
    /// An empty message.
    pub(super) fn new() -> Self {
        let mut raw = zmq_msg_t::default();
        // It never fails.
        zmq_msg_init(&mut raw);
        Self(raw)
    }

    /// A message of zeros.
    pub(super) fn with_size(size: usize) -> ZmqResult<Self> {
        let mut raw = zmq_msg_t::default();
        check(zmq_msg_init_size(&mut raw, size))?;
        let mut message = Self(raw);
        // SAFETY: there is room for that many bytes, which are written before anybody can read them.
        unsafe { zmq_msg_data(&raw mut message).write_bytes(0, size) };
        Ok(message)
    }

    pub(super) fn bytes(&self) -> &[u8] {
        // SAFETY: libzmq does not change the message here. The content stays until the message changes, which borrows it.
        unsafe {
            let data = zmq_msg_data((&raw const *self).cast_mut());
            if data.is_null() {
                &[]
            } else {
                std::slice::from_raw_parts(data, self.size())
            }
        }
    }

    pub(super) fn size(&self) -> usize {
        zmq_msg_size(self)
    }

    pub(super) fn has_more(&self) -> bool {
        zmq_msg_more(self) != 0
    }

    pub(super) fn get(&self, property: c_int) -> ZmqResult<c_int> {
        check(zmq_msg_get(self, property))
    }

    pub(super) fn set(&mut self, property: c_int, value: c_int) -> ZmqResult<()> {
        check(zmq_msg_set(self, property, value)).map(drop)
    }

    pub(super) fn property(&self, name: &CStr) -> ZmqResult<Vec<u8>> {
        zmq_msg_gets(self, Text::new(name))
            .map(Text::into_bytes)
            .ok_or_else(Errno::last)
    }

    /// A second message that shares the content.
    pub(super) fn copy(&mut self) -> ZmqResult<Self> {
        let mut copy = Self::new();
        check(zmq_msg_copy(&mut copy, self))?;
        Ok(copy)
    }

    /// Moves the content into a socket; returns its length.
    pub(super) fn send(&mut self, socket: &RawSocket, flags: c_int) -> ZmqResult<c_int> {
        check(zmq_msg_send(self, socket.borrowed(), flags))
    }

    /// Replaces the content by a message part from a socket; returns its length.
    pub(super) fn receive(&mut self, socket: &RawSocket, flags: c_int) -> ZmqResult<c_int> {
        check(zmq_msg_recv(self, socket.borrowed(), flags))
    }
}

impl Drop for RawMessage {
    fn drop(&mut self) {
        // SAFETY: releases the content; the message is not used afterwards. It never fails for an initialised message.
        unsafe { zmq_msg_close(self) };
    }
}
