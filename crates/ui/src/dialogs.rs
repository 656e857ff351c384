//! Dialogs that block a script, and banners. Without a person there are answers that were left beforehand, else the defaults.

use std::collections::VecDeque;

use serde_json::{Value, json};

use super::window::Event;
use scene::Data;

/// Dialogs that are remembered.
const MAX_SHOWN: usize = 100;
/// Answers that may wait.
const MAX_ANSWERS: usize = 1000;

/// The kind of a dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DialogKind {
    /// A message with buttons.
    Message,
    /// Names of files.
    File,
    /// A colour.
    Color,
    /// A line of text.
    Input,
}

impl DialogKind {
    const ALL: [Self; 4] = [Self::Message, Self::File, Self::Color, Self::Input];

    /// The name of the function that opens it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Message => "msgBox",
            Self::File => "fileDialog",
            Self::Color => "colorDialog",
            Self::Input => "inputDialog",
        }
    }

    /// The kind with the name of its function, e.g. `msgBox`.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// A dialog that was shown.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownDialog {
    /// Counts from 1.
    pub number: u64,
    /// Its kind.
    pub kind: DialogKind,
    /// The title of its window.
    pub title: String,
    /// What it says.
    pub text: String,
    /// What was answered, as text for people.
    pub answer: String,
}

/// A line of text above all windows, with buttons.
#[derive(Debug, Clone, PartialEq)]
pub struct Banner {
    /// Number that scripts know it by, from 1.
    pub id: i64,
    /// What it says.
    pub text: String,
    /// Key and label of each button.
    pub buttons: Vec<[String; 2]>,
    /// The function to call when a button is pressed; empty for none.
    pub callback: String,
    /// Handle of the script whose function it is.
    pub owner: i64,
}

/// Dialogs and banners of a simulator.
#[derive(Debug, Default)]
pub struct Dialogs {
    answers: VecDeque<(DialogKind, Data)>,
    shown: VecDeque<ShownDialog>,
    count: u64,
    banners: Vec<Banner>,
    last_banner: i64,
}

impl Dialogs {
    /// Leaves an answer for the next dialog of a kind without one.
    ///
    /// # Errors
    /// When too many are waiting.
    pub fn leave_answer(&mut self, kind: DialogKind, answer: Data) -> Result<(), String> {
        if self.answers.len() >= MAX_ANSWERS {
            return Err(format!("{MAX_ANSWERS} answers wait for dialogs already."));
        }
        self.answers.push_back((kind, answer));
        Ok(())
    }

    /// The answer that was left for a dialog of this kind, if there is one.
    pub fn take_answer(&mut self, kind: DialogKind) -> Option<Data> {
        let at = self.answers.iter().position(|(of, _)| *of == kind)?;
        self.answers.remove(at).map(|(_, answer)| answer)
    }

    /// Notes a dialog with its answer, for pages and tests.
    pub fn note(&mut self, kind: DialogKind, title: &str, text: &str, answer: String) {
        self.count += 1;
        if self.shown.len() >= MAX_SHOWN {
            self.shown.pop_front();
        }
        let (title, text) = (title.to_owned(), text.to_owned());
        self.shown.push_back(ShownDialog {
            number: self.count,
            kind,
            title,
            text,
            answer,
        });
    }

    /// The dialogs that were shown; the oldest ones may be gone.
    pub fn shown(&self) -> impl Iterator<Item = &ShownDialog> {
        self.shown.iter()
    }

    /// Shows a banner; its id.
    pub fn add_banner(&mut self, banner: Banner) -> i64 {
        self.last_banner += 1;
        self.banners.push(Banner {
            id: self.last_banner,
            ..banner
        });
        self.last_banner
    }

    /// Whether a banner with that id is shown.
    pub fn has_banner(&self, id: i64) -> bool {
        self.banners.iter().any(|banner| banner.id == id)
    }

    /// Removes a banner; whether there was one with that id.
    pub fn remove_banner(&mut self, id: i64) -> bool {
        let before = self.banners.len();
        self.banners.retain(|banner| banner.id != id);
        self.banners.len() != before
    }

    /// The event of a button of a banner; one without a callback goes away.
    ///
    /// # Errors
    /// When there is no such button.
    pub(super) fn press_banner(&mut self, id: i64, key: &str) -> Result<Option<Event>, String> {
        let found = self.banners.iter().find(|banner| banner.id == id);
        let banner = found
            .ok_or_else(|| format!("there is no banner {id}"))?
            .clone();
        if !banner.buttons.iter().any(|[known, _]| known == key) {
            return Err(format!("banner {id} has no button '{key}'"));
        }
        if banner.callback.is_empty() {
            self.remove_banner(id);
            return Ok(None);
        }
        let args = vec![Data::Int(id), Data::text(key)];
        let (script, handler) = (banner.owner, banner.callback);
        Ok(Some(Event {
            window: None,
            widget: None,
            script,
            handler,
            args,
            evaluates: false,
        }))
    }

    pub(super) fn json(&self) -> Value {
        let shown = |dialog: &ShownDialog| {
            json!({
                "number": dialog.number, "kind": dialog.kind.name(), "title": dialog.title, "text": dialog.text,
                "answer": dialog.answer,
            })
        };
        self.shown.iter().map(shown).collect()
    }

    pub(super) fn banners_json(&self) -> Value {
        let shown = |banner: &Banner| {
            let button = |[key, label]: &[String; 2]| json!({"key": key, "label": label});
            let buttons: Vec<Value> = banner.buttons.iter().map(button).collect();
            json!({"id": banner.id, "text": banner.text, "buttons": buttons})
        };
        self.banners.iter().map(shown).collect()
    }
}
