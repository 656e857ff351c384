//! One page: what it has seen, its requests, the replies.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex};

use serde_json::{Value, json};

use super::{PageId, Pending, Shared, lock, reply};
use crate::edit::Uploads;
use crate::mirror::{Message, Revision};
use crate::request::{Action, Request};
use crate::sample::Following;
use io::{SiteMessage, Visitor};
use script::syntax_error;

/// A connected page.
pub(super) struct Page {
    id: PageId,
    shared: Arc<Shared>,
    seen: Revision,
    /// What it watches, with the revision of the last image.
    watched: BTreeMap<i64, Revision>,
    inspected: Option<(i64, Revision)>,
    /// The last contacts, while they are shown.
    contacts: Option<Revision>,
    /// What it follows, and how many steps it has seen.
    following: (Following, u64),
    replies: Arc<Mutex<VecDeque<String>>>,
    /// The last change of what the simulation is busy with.
    busy: u64,
    /// Who it is, as it says.
    author: Option<u64>,
    /// Files that it is about to load.
    uploads: Uploads,
}

impl Page {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        let id = shared.add_page();
        Self {
            id,
            shared,
            seen: 0,
            watched: BTreeMap::new(),
            inspected: None,
            contacts: None,
            following: (Following::default(), 0),
            replies: Arc::default(),
            busy: 0,
            author: None,
            uploads: Uploads::default(),
        }
    }

    /// Carries out what concerns only this page; otherwise returns what is for the simulation.
    fn perform(&mut self, mut request: Request) -> Result<Option<Request>, String> {
        if !self.shared.permits(&request.action) {
            return Err("this page may only read".to_owned());
        }
        if matches!(request.action, Action::Debug(_)) && !self.shared.has_debugger() {
            return Err("pages have no debugger here".to_owned());
        }
        match &mut request.action {
            Action::Author(number) => self.author = Some(*number),
            Action::Upload { name, data } => self.uploads.add(name, data)?,
            Action::Load { files, .. } => {
                *files = self.uploads.take();
                return Ok(Some(request));
            }
            Action::Watch(handles) => {
                self.watched = handles
                    .iter()
                    .map(|handle| (*handle, self.watched.get(handle).copied().unwrap_or(0)))
                    .collect();
                let sensors = self.watched.keys().copied().collect();
                self.shared
                    .change_demand(self.id, |demand| demand.sensors = sensors);
            }
            Action::Show { contacts } => {
                self.contacts = contacts.then_some(0);
                self.shared
                    .change_demand(self.id, |demand| demand.contacts = *contacts);
            }
            Action::Sample(following) => {
                // Before the simulation knows of it, so that no step is missed.
                self.following = (following.clone(), self.shared.samples().taken());
                self.shared.follow(self.id, following.items.clone());
            }
            Action::Inspect(handle) => {
                let now = self.shared.mirror().revision();
                self.inspected = handle.map(|handle| (handle, now));
                self.shared
                    .change_demand(self.id, |demand| demand.inspected = *handle);
                return Ok(Some(request));
            }
            // It needs no simulation, and so an answer comes also while that is busy.
            Action::Check { code, is_python } => {
                if *is_python {
                    self.check_python(code, &request.id)?;
                } else {
                    lock(&self.replies).push_back(reply(&request.id, Ok(checked(code))));
                }
                return Ok(None);
            }
            _ => return Ok(Some(request)),
        }
        lock(&self.replies).push_back(reply(&request.id, Ok(Value::Bool(true))));
        Ok(None)
    }

    /// The answer comes from a thread of its own.
    fn check_python(&self, code: &str, id: &Value) -> Result<(), String> {
        let (replies, shared) = (Arc::clone(&self.replies), Arc::clone(&self.shared));
        let id = id.clone();
        self.shared.python.check(code, move |error| {
            lock(&replies).push_back(reply(&id, Ok(error.unwrap_or_default())));
            shared.wake();
        })
    }

    /// Images, contacts and values that this page asked for.
    fn on_demand(&mut self) -> Vec<SiteMessage> {
        let mut messages = Vec::new();
        let mirror = self.shared.mirror();
        for (sensor, seen) in &mut self.watched {
            if let Some((revision, image)) = mirror.image_since(*sensor, *seen) {
                *seen = revision;
                messages.push(SiteMessage::Binary(image.to_vec()));
            }
        }
        if let Some(seen) = &mut self.contacts
            && let Some((revision, contacts)) = mirror.contacts_since(*seen)
        {
            *seen = revision;
            messages.push(SiteMessage::Binary(contacts.to_vec()));
        }
        let (following, seen) = &mut self.following;
        let samples = self.shared.samples();
        messages.extend(samples.message(following, *seen).map(SiteMessage::Text));
        *seen = samples.taken();
        if let Some((handle, seen)) = &mut self.inspected
            && let Some((revision, rows)) = mirror.rows_since(*handle, *seen)
        {
            *seen = revision;
            let rows = rows.join(",");
            messages.push(SiteMessage::Text(format!(
                "{{\"type\":\"properties\",\"handle\":{handle},\"values\":[{rows}]}}"
            )));
        }
        messages
    }
}

/// The error in a text that is no Lua; null where it is.
fn checked(code: &str) -> Value {
    match syntax_error(code.as_bytes()) {
        Some(error) => json!({ "line": error.line, "message": error.message }),
        None => Value::Null,
    }
}

impl Visitor for Page {
    fn receive(&mut self, message: &[u8]) {
        let outcome = match Request::parse(message) {
            Ok(request) => {
                let id = request.id.clone();
                self.perform(request).map_err(|reason| (id, reason))
            }
            Err(refusal) => Err((refusal.id, refusal.reason)),
        };
        let refused = match outcome {
            Ok(None) => None,
            Ok(Some(Request { id, action })) => {
                let replies = Arc::clone(&self.replies);
                let accepted = self.shared.submit(Pending {
                    id: id.clone(),
                    action,
                    author: self.author,
                    replies,
                });
                (!accepted).then(|| {
                    (
                        id,
                        "the simulator has too many requests to answer".to_owned(),
                    )
                })
            }
            Err(refused) => Some(refused),
        };
        if let Some((id, reason)) = refused {
            lock(&self.replies).push_back(reply(&id, Err(reason)));
        }
    }

    fn messages(&mut self) -> Vec<SiteMessage> {
        let changes = self.shared.mirror().changes_since(self.seen);
        let mut messages = Vec::new();
        if let Some(changes) = changes {
            self.seen = changes.revision;
            messages.extend(changes.messages().into_iter().map(|message| match message {
                Message::Text(text) => SiteMessage::Text(text),
                Message::Binary(bytes) => SiteMessage::Binary(bytes),
            }));
        }
        messages.extend(self.on_demand());
        messages.extend(lock(&self.replies).drain(..).map(SiteMessage::Text));
        if let Some((change, sentence)) = self.shared.busy_since(self.busy) {
            self.busy = change;
            messages.push(SiteMessage::Text(
                json!({ "type": "busy", "text": sentence }).to_string(),
            ));
        }
        if let Some(reason) = self.shared.end_reason() {
            messages.push(SiteMessage::Text(
                json!({ "type": "end", "reason": reason }).to_string(),
            ));
        }
        messages
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.shared.remove_page(self.id);
    }
}
