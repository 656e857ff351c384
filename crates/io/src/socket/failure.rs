//! Socket errors, with LuaSocket's messages.

use std::io;

use rustix::io::Errno;

/// A failure scripts see as nil and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Failure {
    /// The time limit has passed.
    Timeout,
    /// The connection is closed.
    Closed,
    /// The simulator is being stopped: an error in the script, so that loops end.
    Interrupted,
    /// More data than a Lua string takes.
    TooLong,
    /// Any other failure, by its text.
    Words(String),
}

impl Failure {
    /// A failure with that text.
    pub fn words(text: &str) -> Self {
        Self::Words(text.to_owned())
    }

    /// The system's error for an operation on a socket that is not open.
    pub(super) fn not_open() -> Self {
        io::Error::from(Errno::BADF).into()
    }

    /// The text scripts compare.
    pub fn text(&self) -> &str {
        match self {
            Self::Timeout => "timeout",
            Self::Closed => "closed",
            Self::Interrupted => "interrupted",
            Self::TooLong => "not enough memory",
            Self::Words(text) => text,
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match Errno::from_io_error(&error) {
            Some(Errno::ADDRINUSE) => Self::words("address already in use"),
            Some(Errno::ISCONN) => Self::words("already connected"),
            Some(Errno::ACCESS) => Self::words("permission denied"),
            Some(Errno::CONNREFUSED) => Self::words("connection refused"),
            Some(Errno::CONNABORTED | Errno::CONNRESET | Errno::PIPE) => Self::Closed,
            Some(Errno::TIMEDOUT) => Self::Timeout,
            _ => Self::Words(system_words(&error)),
        }
    }
}

impl From<Errno> for Failure {
    fn from(error: Errno) -> Self {
        io::Error::from(error).into()
    }
}

/// The system's text of an error, without the number that Rust adds.
pub(super) fn system_words(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error")
        .next()
        .unwrap_or_default()
        .to_owned()
}

/// Whether a call that never blocks has to be repeated once the socket is ready.
pub(super) fn is_pending(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted
    ) || Errno::from_io_error(error) == Some(Errno::INPROGRESS)
}

#[cfg(test)]
mod tests {
    use std::io;

    use rustix::io::Errno;

    use super::Failure;

    #[test]
    fn failures_have_the_words_scripts_compare() {
        let words = |errno: Errno| Failure::from(errno).text().to_owned();
        assert_eq!(words(Errno::CONNREFUSED), "connection refused");
        assert_eq!(words(Errno::CONNRESET), "closed");
        assert_eq!(words(Errno::BADF), "Bad file descriptor");
        assert_eq!(Failure::from(io::Error::other("odd")).text(), "odd");
    }
}
