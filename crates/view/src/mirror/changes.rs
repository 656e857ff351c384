//! What changed since a revision, and its messages.

use std::fmt::Write as _;
use std::sync::Arc;

use super::Revision;

/// A message of the protocol.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Message {
    /// JSON.
    Text(String),
    /// It begins with its kind.
    Binary(Vec<u8>),
}

/// What changed since a revision. Entries are texts of JSON.
#[derive(Debug, Default)]
pub(crate) struct Changes {
    /// The state they lead to.
    pub revision: Revision,
    /// The reader forgets all it knows.
    pub is_snapshot: bool,
    pub(super) scene: Option<Arc<str>>,
    pub(super) objects: Vec<Arc<str>>,
    pub(super) removed: Vec<i64>,
    pub(super) drawings: Vec<Arc<str>>,
    pub(super) removed_drawings: Vec<i64>,
    pub(super) windows: Vec<Arc<str>>,
    pub(super) removed_windows: Vec<String>,
    pub(super) lists: Vec<(&'static str, Arc<str>)>,
    pub(super) selection: Option<Vec<i64>>,
    pub(super) log: Vec<Arc<str>>,
    /// The lines take the place of all that the reader has.
    pub(super) is_log_anew: bool,
    /// A message.
    pub(super) poses: Option<Vec<u8>>,
}

impl Changes {
    /// The messages that make a reader see them: a text, and the poses.
    pub fn messages(self) -> Vec<Message> {
        let text = self.text().map(Message::Text);
        text.into_iter()
            .chain(self.poses.map(Message::Binary))
            .collect()
    }

    /// The text; none if only poses changed.
    fn text(&self) -> Option<String> {
        let kind = if self.is_snapshot {
            "snapshot"
        } else {
            "update"
        };
        let mut text = format!("{{\"type\":\"{kind}\"");
        let empty = text.len();
        if let Some(scene) = &self.scene {
            member(&mut text, "scene", scene);
        }
        self.list(&mut text, "objects", &self.objects);
        self.list(&mut text, "removed", &self.removed);
        self.list(&mut text, "drawings", &self.drawings);
        self.list(&mut text, "removedDrawings", &self.removed_drawings);
        self.list(&mut text, "windows", &self.windows);
        self.list(&mut text, "removedWindows", &self.removed_windows);
        for (name, list) in &self.lists {
            member(&mut text, name, list);
        }
        if let Some(selection) = &self.selection {
            list(&mut text, "selection", selection);
        }
        if self.is_log_anew {
            member(&mut text, "logBegins", "true");
        }
        self.list(&mut text, "log", &self.log);
        let is_empty = text.len() == empty && !self.is_snapshot;
        text.push('}');
        (!is_empty).then_some(text)
    }

    /// A list; an empty one only in a snapshot.
    fn list(&self, text: &mut String, name: &str, items: &[impl std::fmt::Display]) {
        if self.is_snapshot || !items.is_empty() {
            list(text, name, items);
        }
    }
}

fn member(text: &mut String, name: &str, value: &str) {
    for part in [",\"", name, "\":", value] {
        text.push_str(part);
    }
}

fn list(text: &mut String, name: &str, items: &[impl std::fmt::Display]) {
    member(text, name, "[");
    for (at, item) in items.iter().enumerate() {
        let comma = if at > 0 { "," } else { "" };
        write!(text, "{comma}{item}").expect("strings take all");
    }
    text.push(']');
}
