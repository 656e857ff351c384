//! The process of an interface: its start, and what comes of it.

use std::io::ErrorKind;
use std::time::Duration;

use heap::resource::Resource;
use io::{PeerError, PeerProcess};
use scene::Data;

use super::message::Message;
use crate::Cx;
use script::{LaunchError, start_python};
use wire::marshal::Encoder;

/// The modules that a process begins with; the last one runs.
const FIRST: [(&str, &str); 2] = [
    (
        "swanilda_qml_link",
        include_str!("child/swanilda_qml_link.py"),
    ),
    ("swanilda_qml", include_str!("child/swanilda_qml.py")),
];
/// Those that need Qt, in the order of their dependencies.
const PARTS: [(&str, &str); 3] = [
    (
        "swanilda_qml_windows",
        include_str!("child/swanilda_qml_windows.py"),
    ),
    (
        "swanilda_qml_items",
        include_str!("child/swanilda_qml_items.py"),
    ),
    (
        "swanilda_qml_interface",
        include_str!("child/swanilda_qml_interface.py"),
    ),
];
/// How long a process may take for an answer. Scenes wait for it, and machines are slow.
pub(super) const LIMIT: Duration = Duration::from_secs(30);

/// Why there is no process: sentences for people.
#[derive(Debug, thiserror::Error)]
pub(super) enum NoProcess {
    #[error("Interfaces in QML are programs: {0}.")]
    Denied(String),
    #[error(
        "{0}. QML needs PySide6: install it with 'pip install swanilda[qml]', or name a Python that has it with -D python=PATH."
    )]
    Lacks(String),
    #[error("{0}")]
    Ended(String),
}

/// A running process. Dropping it ends it.
pub(super) struct Process {
    peer: PeerProcess,
    /// No snapshot has it.
    _open: Resource,
}

impl Process {
    /// Starts one, and waits until it has said what it can.
    pub(super) fn start(cx: &Cx) -> Result<(Self, [i64; 3]), NoProcess> {
        let peer = start_python(cx.env(), &FIRST).map_err(|error| match error {
            LaunchError::Denied(denied) => NoProcess::Denied(denied.to_string()),
            other => NoProcess::Lacks(other.to_string().trim_end_matches('.').to_owned()),
        })?;
        let _open = Resource::new(|| "an interface in QML".to_owned());
        let mut process = Self { peer, _open };
        let part =
            |(name, text): (&str, &str)| Data::Array(vec![Data::text(name), Data::text(text)]);
        let mut parts = Encoder::default();
        parts.list(&PARTS.map(part));
        process
            .send(&parts.into_bytes())
            .map_err(NoProcess::Ended)?;
        let first = process.wait(cx).map_err(NoProcess::Ended)?;
        match Message::decode(&first) {
            Ok(Message::Hello(version)) => Ok((process, version)),
            Ok(Message::Lacks(what)) => Err(NoProcess::Lacks(what)),
            _ => Err(NoProcess::Ended(
                "The interface begins with what cannot be read.".into(),
            )),
        }
    }

    /// # Errors
    /// When the process has ended.
    pub(super) fn send(&mut self, message: &[u8]) -> Result<(), String> {
        let sent = self.peer.send(message);
        sent.map_err(|error| self.ended(&error))
    }

    /// A message that is there.
    ///
    /// # Errors
    /// When the process has ended.
    pub(super) fn next(&mut self) -> Result<Option<Vec<u8>>, String> {
        let received = self.peer.receive(Duration::ZERO);
        received.map_err(|error| self.ended(&error))
    }

    /// The next message, within a limit.
    ///
    /// # Errors
    /// When the process has ended or does not answer, and when the program is to end.
    pub(super) fn wait(&mut self, cx: &Cx) -> Result<Vec<u8>, String> {
        let next = || self.next().transpose();
        let message = cx.wait_for(Some(LIMIT), next);
        let message = message.map_err(|error| error.to_string())?;
        message.unwrap_or_else(|| {
            Err(format!(
                "The interface has not answered within {} s.",
                LIMIT.as_secs()
            ))
        })
    }

    /// What it wrote beside its messages since the last time: warnings of Qt's libraries, errors of Python.
    pub(super) fn said(&self) -> Option<String> {
        let (text, _) = self.peer.take_output();
        let text = String::from_utf8_lossy(&text).trim_end().to_owned();
        (!text.is_empty()).then_some(text)
    }

    /// Why it has ended, with its last words.
    fn ended(&mut self, error: &PeerError) -> String {
        match error {
            PeerError::Io(error) if error.kind() == ErrorKind::WouldBlock => {
                return "The interface reads nothing any more: it is ended.".into();
            }
            error if !is_closed(error) => return format!("The interface has ended: {error}."),
            _ => {}
        }
        let status = self.peer.wait_for_end(Duration::from_secs(1));
        let words = String::from_utf8_lossy(&self.peer.last_output())
            .trim_end()
            .to_owned();
        let how = status.map_or_else(String::new, |status| format!(" ({status})"));
        format!("The process of the interface has ended{how}. {words}")
            .trim_end()
            .to_owned()
    }
}

/// Whether the other side is gone, perhaps without having read everything.
fn is_closed(error: &PeerError) -> bool {
    match error {
        PeerError::Closed => true,
        PeerError::Io(error) => matches!(
            error.kind(),
            ErrorKind::ConnectionReset | ErrorKind::BrokenPipe
        ),
        PeerError::TooLong => false,
    }
}
