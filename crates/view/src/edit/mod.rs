//! What pages change in a scene, with undo and redo; and files that they load and save.
//!
//! Changes are functions of `edits.lua`, which lives in the sandbox. While the simulation is stopped each of them begins with a snapshot
//! of the simulator: that is what undo brings back, whatever the change did. Changes of one gesture, such as the moves of one drag, are
//! one step of undo.

mod files;
mod history;
mod pulls;
#[cfg(test)]
mod tests;

use serde_json::{Value, json};

pub(crate) use files::{Files, Uploads};
use history::History;
pub(crate) use pulls::Pulls;

use scene::sensor::{Camera, Light, LightType};
use scene::{Data, Handle, Kind};
use script::{SimulationState, data_of_json};
use simulator::{ScriptKind, ScriptRef, Simulator};

use crate::request::Action;

/// The changes of pages.
#[derive(Default)]
pub(crate) struct Editor {
    history: History,
    helper: Option<ScriptRef>,
    /// The page that asks.
    author: Option<u64>,
    /// The scene when it was loaded or saved the last time, or before the first change since then.
    base: Option<Vec<u8>>,
}

/// What a change did.
struct Done {
    label: String,
    result: Value,
}

impl Editor {
    /// Whether carrying it out takes or brings back a snapshot, before which observers let go of the simulator.
    pub(crate) fn takes_snapshot(&self, sim: &Simulator, action: &Action) -> bool {
        match action {
            Action::Undo { .. } | Action::Redo { .. } => true,
            _ => is_undone(sim, action) && !self.history.continues(gesture(action)),
        }
    }

    /// What pages see of it, as members of the scene.
    pub(crate) fn describe(&self, sim: &Simulator) -> Value {
        let captured = sim.tape().is_on().then_some("the run is captured");
        json!({
            "undo": self.history.undo_label(),
            "redo": self.history.redo_label(),
            "undoBy": self.history.undo_author(),
            "redoBy": self.history.redo_author(),
            "noUndo": captured.or(self.history.refusal()),
            "changes": self.history.changes(),
        })
    }

    /// Carries out `work`, which can be undone then.
    ///
    /// # Errors
    /// Those of the work; the scene is what it was then.
    pub(crate) fn record(
        &mut self,
        sim: &mut Simulator,
        action: &Action,
        work: impl FnOnce(&mut Self, &mut Simulator) -> Result<(String, Value), String>,
    ) -> Result<Value, String> {
        self.prepare(sim)?;
        let gesture = gesture(action);
        if !is_undone(sim, action) {
            return work(self, sim).map(|(_, result)| result);
        }
        let is_new = !self.history.continues(gesture);
        let before = if is_new {
            self.history.snapshot(sim)
        } else {
            None
        };
        let outcome = work(self, sim);
        match (&outcome, before) {
            (Ok((label, _)), before) => self.history.note(before, label, gesture, self.author),
            (Err(_), Some(before)) if action.is_edit() => history::bring_back(sim, &before)?,
            (Err(_), _) => {}
        }
        outcome.map(|(_, result)| result)
    }

    /// Before the first change.
    fn prepare(&mut self, sim: &mut Simulator) -> Result<(), String> {
        let reason = |error: simulator::Error| error.to_string();
        if self.helper.is_none() {
            let code = include_bytes!("edits.lua");
            self.helper = Some(
                sim.add_script(ScriptKind::Sandbox, "swanilda view", code)
                    .map_err(reason)?,
            );
        }
        if self.base.is_none() && sim.state() == SimulationState::Stopped {
            self.base = Some(files::bytes_of(sim)?);
        }
        Ok(())
    }

    /// An edit of the protocol by its name.
    pub(crate) fn edit(
        &mut self,
        sim: &mut Simulator,
        action: &Action,
        name: &str,
        arguments: &Value,
    ) -> Result<Value, String> {
        self.record(sim, action, |editor, sim| {
            let done = match (name, arguments["kind"].as_str()) {
                ("add", Some(kind)) if is_made_here(kind) => editor.add(sim, kind, arguments)?,
                _ => editor.call(sim, name, arguments)?,
            };
            Ok((done.label, done.result))
        })
    }

    /// A camera or light, for which scripts have no function.
    fn add(&self, sim: &mut Simulator, kind: &str, arguments: &Value) -> Result<Done, String> {
        let (alias, object) = match kind {
            "camera" => ("Camera", Kind::Camera(Box::<Camera>::default())),
            kind => ("Light", Kind::Light(Box::new(Light::new(light_type(kind))))),
        };
        let handle = sim
            .scene_mut()
            .add(alias, object)
            .map_err(|error| error.to_string())?;
        let mut arguments = arguments.clone();
        arguments["handle"] = handle.raw().into();
        self.call(sim, "adopt", &arguments)
    }

    /// Calls a function of `edits.lua`, and selects what it says.
    fn call(&self, sim: &mut Simulator, name: &str, arguments: &Value) -> Result<Done, String> {
        let result = self.function(sim, name, arguments)?;
        if let Some(selection) = result["selection"].as_array() {
            select(sim, selection);
        }
        let label = result["label"].as_str().unwrap_or(name).to_owned();
        Ok(Done { label, result })
    }

    /// The value of a function of `edits.lua`.
    ///
    /// # Errors
    /// What the function says, in a sentence.
    pub(crate) fn function(
        &self,
        sim: &mut Simulator,
        name: &str,
        arguments: &Value,
    ) -> Result<Value, String> {
        let helper = self.helper.as_ref().ok_or("there were no changes yet")?;
        if !name.bytes().all(|byte| byte.is_ascii_alphabetic()) {
            return Err(format!("unknown edit: {name}"));
        }
        let function = format!("package.loaded.swanilda_edits.{name}");
        let results = sim.call(helper, &function, &[data_of_json(arguments)]);
        let results = results.map_err(|error| error.to_string())?;
        let result = results
            .into_iter()
            .next()
            .map_or(Value::Null, |result| json_of(&result));
        match result["failed"].as_str() {
            Some(error) => Err(without_place(error)),
            None => Ok(result),
        }
    }

    /// Pulls at a shape during the next step: the force.
    pub(crate) fn pull(&mut self, sim: &mut Simulator, arguments: &Value) -> Result<Value, String> {
        if !sim.state().is_advancing() {
            return Err(
                "nothing moves while the simulation stands still: start it to pull at things"
                    .into(),
            );
        }
        self.prepare(sim)?;
        self.function(sim, "pull", arguments)
    }

    /// The page that asks for what comes.
    pub(crate) fn set_author(&mut self, author: Option<u64>) {
        self.author = author;
    }

    /// Takes back the last change; without `others` nothing that another page has done: the answer says so then.
    pub(crate) fn undo(&mut self, sim: &mut Simulator, others: bool) -> Result<Value, String> {
        need_stopped(sim)?;
        self.history.undo(sim, self.only(others))
    }

    /// The same for the last one that was taken back.
    pub(crate) fn redo(&mut self, sim: &mut Simulator, others: bool) -> Result<Value, String> {
        need_stopped(sim)?;
        self.history.redo(sim, self.only(others))
    }

    /// The page whose changes are meant, unless all are.
    fn only(&self, others: bool) -> Option<u64> {
        self.author.filter(|_| !others)
    }
}

/// Of the scene; those that are gone are left out.
fn select(sim: &mut Simulator, handles: &[Value]) {
    let handles: Vec<Handle> = handles
        .iter()
        .filter_map(|handle| Handle::from_raw(handle.as_i64()?))
        .collect();
    sim.scene_mut().select(&handles);
}

fn need_stopped(sim: &Simulator) -> Result<(), String> {
    if sim.state() == SimulationState::Stopped {
        return Ok(());
    }
    Err("stop the simulation first: what was changed while it runs is gone then".into())
}

/// Whether it is something that can be undone: while the simulation is stopped. A capture repeats what happened, which has no undo.
fn is_undone(sim: &Simulator, action: &Action) -> bool {
    action.is_undoable() && sim.state() == SimulationState::Stopped && !sim.tape().is_on()
}

/// What changes have in common that are one step of undo.
fn gesture(action: &Action) -> Option<u64> {
    match action {
        Action::Edit { gesture, .. } | Action::Set { gesture, .. } => *gesture,
        _ => None,
    }
}

fn is_made_here(kind: &str) -> bool {
    matches!(
        kind,
        "camera" | "omniLight" | "spotLight" | "directionalLight"
    )
}

fn light_type(kind: &str) -> LightType {
    match kind {
        "spotLight" => LightType::Spot,
        "directionalLight" => LightType::Directional,
        _ => LightType::Omnidirectional,
    }
}

/// An error of `edits.lua` without its place there, which is of no use to people.
fn without_place(error: &str) -> String {
    let place = error
        .strip_prefix("[string \"")
        .and_then(|rest| rest.split_once("]:"));
    let text = place.and_then(|(_, rest)| rest.split_once(": "));
    text.map_or(error, |(_, text)| text).to_owned()
}

fn json_of(value: &Data) -> Value {
    crate::perform::json_of(value)
}
