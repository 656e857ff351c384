//! What viewers and recorders see of a simulator, and do to it.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::Simulator;
use dynamics::Contact;
use scene::object::script_object::ScriptType;
use scene::{Data, Handle, Scene, ValueType};
use script::log::RecentLine;
use script::property_table::{ValueSource, flags};
use script::{ApiError, Ask, Present, Sim, Situation, SysCall, Watcher, python_command};

/// A property of an object, of the scene or of the application.
#[derive(Clone)]
pub struct PropertyRow {
    /// Its name, without the class.
    pub name: String,
    /// The class it belongs to.
    pub class: &'static str,
    /// The type of its value.
    pub ty: ValueType,
    /// The value now.
    pub value: Data,
    /// Whether scripts can set it.
    pub is_writable: bool,
    /// What it is, in a sentence; empty for properties of scripts.
    pub description: &'static str,
    /// Whether anything here depends on it; others are kept for scripts and files.
    pub has_effect: bool,
}

/// What scripts and physics have done, for those who watch a run.
#[derive(Debug, Clone, Default)]
pub struct Happenings {
    /// Lines of the log and prints since the last time.
    pub lines: Vec<RecentLine>,
    /// The names of all signals there are.
    pub signals: BTreeSet<String>,
    /// Names of the messages that scripts sent to all others since the last time.
    pub broadcasts: Vec<String>,
    /// Shapes that touched each other in the last sub-step of the physics, the smaller handle first.
    pub contacts: BTreeSet<[Handle; 2]>,
}

/// Properties whose value is long, or expensive, or is another one each time it is read.
const NOT_SHOWN: &[&str] = &[
    "randomQuaternion",
    "randomFloat",
    "randomString",
    "modelHash",
    "voxels",
    "points",
    "colors",
    "imageBuffer",
    "depthBuffer",
    "volume_edges",
    "volume_closeEdges",
    "code",
    "dna",
];

impl Simulator {
    /// Keeps lines of the log from now on, for [`take_recent_lines`](Self::take_recent_lines).
    pub fn keep_recent_lines(&self) {
        self.inside().log.keep_recent();
    }

    /// Lines of the log and prints since the last call.
    pub fn take_recent_lines(&self) -> Vec<RecentLine> {
        self.copied(|sim| sim.log.take_recent())
    }

    /// Lines, signals, messages and contacts up to now. Lines and messages are kept from [`Builder::observed`](super::Builder::observed) on.
    pub fn take_happenings(&self) -> Happenings {
        self.copied(|sim| {
            sim.with_present(|present| Happenings {
                lines: present.lines.clone(),
                signals: present.signals.clone(),
                broadcasts: present.broadcasts.clone(),
                contacts: present.contacts.clone(),
            })
        })
    }

    /// Computes the poses of all objects. What is read of the [scene](Self::scene) until something moves needs no room in the memory of
    /// the simulator any more, which is to be taken back.
    pub fn refresh_poses(&self) {
        self.copied(|sim| {
            let scene = sim.scene.borrow();
            for object in scene.objects() {
                // It is kept beside the object.
                let _ = scene.world_pose(object.handle());
            }
        });
    }

    /// Sets the function that shows dialogs of scripts to users and returns their answers.
    pub fn set_person(&self, ask: Rc<Ask>) {
        self.inside().set_person(ask);
    }

    /// Whether nobody but scripts looks at the scene from now on, so that what scripts cannot read need not be computed: particles that only pages and recordings show.
    pub fn set_unseen(&self, is_unseen: bool) {
        self.inside().set_unseen(is_unseen);
    }

    /// Shows the state after each step from now on; None ends that.
    pub fn watch(&self, watcher: Option<Watcher>) {
        self.inside().watch(watcher);
    }

    /// Calls `observe` with the present state, and the lines of the log since the last time.
    pub fn with_present<T>(&self, observe: impl FnOnce(&Present<'_>) -> T) -> T {
        self.parts.sim.with_present(observe)
    }

    /// This simulator with its scene as it is now.
    pub fn situation<'a>(&self, scene: &'a Scene) -> Situation<'a> {
        self.parts.sim.situation(scene)
    }

    /// Identifies the scene: it changes when another scene is loaded.
    pub fn scene_uid(&self) -> i64 {
        self.inside().scene_uid()
    }

    /// The properties of an object, or of what else has properties (`sim.handle_app`, `sim.handle_scene`), without those that are long.
    ///
    /// # Errors
    /// When there is nothing with that handle.
    pub fn property_rows(&self, handle: i64) -> Result<Vec<PropertyRow>, ApiError> {
        self.copied(|sim| property_rows(sim, handle))
    }

    /// The value of a property now.
    ///
    /// # Errors
    /// When there is nothing with that handle, or it has no such property that can be read.
    pub fn property_value(&self, handle: i64, name: &str) -> Result<Data, ApiError> {
        let sandbox = self.detached(ScriptType::Sandbox);
        self.copied(|sim| {
            let target = sim.property_target(handle, &sandbox)?;
            let info = sim.property_info(&target, name);
            let (ty, _) = info.ok_or(ApiError::UnknownProperty)?;
            sim.read_property(&target, name, ty)
        })
    }

    /// The type of a property.
    ///
    /// # Errors
    /// When there is nothing with that handle, or it has no such property.
    pub fn property_type(&self, handle: i64, name: &str) -> Result<ValueType, ApiError> {
        let sandbox = self.detached(ScriptType::Sandbox);
        self.copied(|sim| {
            let target = sim.property_target(handle, &sandbox)?;
            let info = sim.property_info(&target, name);
            info.map(|(ty, _)| ty).ok_or(ApiError::UnknownProperty)
        })
    }

    /// Name, language and text of a script.
    ///
    /// # Errors
    /// When there is no script with that handle.
    pub fn script_text(&self, handle: i64) -> Result<(String, String, Vec<u8>), ApiError> {
        let script = self.found(handle)?;
        Ok(self.copied(|sim| sim.text_of(&script)))
    }

    /// The Python that programs for a script get, with its arguments; None where programs must not be started.
    ///
    /// # Errors
    /// When there is no script with that handle.
    pub fn python_command(&self, handle: i64) -> Result<Option<Vec<String>>, ApiError> {
        let script = self.found(handle)?;
        Ok(self.copied(|sim| python_command(sim, &script)))
    }

    /// Calls `sysCall_userConfig` of a script, as a double click on its symbol does; whether it has such a function.
    ///
    /// # Errors
    /// When there is no script with that handle.
    pub fn configure(&mut self, script: i64) -> Result<bool, ApiError> {
        let script = self.found(script)?;
        Ok(self.inside().deliver(&script, SysCall::UserConfig, &[]).ran)
    }

    /// Starts or resumes the simulation, beyond a pause that [`step_and_pause`](Self::step_and_pause) has set.
    pub fn play(&mut self) {
        self.inside().play();
    }

    /// Starts or resumes the simulation for that many steps, and pauses it.
    pub fn step_and_pause(&mut self, steps: u64) {
        self.inside().step_and_pause(steps);
    }

    /// Asks for the end of the run, also of one that is about to pause.
    pub fn stop_in_place_of_pause(&mut self) {
        self.inside().stop_in_place_of_pause();
    }

    /// Runs so many times as fast as the wall clock from now on; as fast as possible if that is 0.
    pub fn set_pace(&mut self, factor: f64) {
        self.inside().set_pace(factor);
    }

    /// Evaluates what a person has typed, as the commander does: an expression is printed.
    ///
    /// # Errors
    /// When the sandbox cannot run.
    pub fn evaluate(&mut self, code: &str) -> Result<(), super::Error> {
        let sandbox = self.the(ScriptType::Sandbox);
        self.call(&sandbox, "_evalExec", &[Data::text(code)])
            .map(drop)
    }

    /// The handle of the sandbox.
    pub fn sandbox(&self) -> i64 {
        self.the(ScriptType::Sandbox).handle()
    }

    /// The contacts of the last sub-step of the physics.
    pub fn last_contacts(&self) -> Vec<Contact> {
        let dynamics = self.parts.sim.dynamics.borrow();
        let all: Vec<Contact> = dynamics
            .iter()
            .flat_map(dynamics::Dynamics::contacts)
            .collect();
        let last = all.last().map(|contact| contact.sub_step);
        all.into_iter()
            .filter(|contact| Some(contact.sub_step) == last)
            .collect()
    }
}

/// The properties of what has that handle, as [`Simulator::property_rows`].
///
/// # Errors
/// When there is nothing with that handle.
pub fn property_rows(sim: &Rc<Sim>, handle: i64) -> Result<Vec<PropertyRow>, ApiError> {
    let sandbox = sim
        .scripts
        .detached(ScriptType::Sandbox)
        .ok_or(ApiError::NoSuchScript)?;
    let target = sim.property_target(handle, &sandbox)?;
    let (before, after) = sim.rows_of(&target)?;
    let is_shown = |name: &str| !NOT_SHOWN.contains(&name);
    let statics = before
        .iter()
        .chain(after)
        .filter(|row| row.flags & flags::DEPRECATED == 0 && is_shown(row.name));
    let mut rows: Vec<PropertyRow> = statics
        .filter_map(|row| {
            let value = sim.read_row(&target, row).ok()?;
            let is_writable = row.flags & flags::NOT_WRITABLE == 0;
            Some(PropertyRow {
                name: row.name.to_owned(),
                class: row.class,
                ty: row.ty,
                value,
                is_writable,
                description: row.description,
                has_effect: has_effect(&row.source),
            })
        })
        .collect();
    for name in sim.stored_names(&target) {
        let Some((ty, _)) = sim.property_info(&target, &name) else {
            continue;
        };
        let Ok(value) = sim.read_property(&target, &name, ty) else {
            continue;
        };
        rows.push(PropertyRow {
            name,
            class: "data",
            ty,
            value,
            is_writable: true,
            description: "",
            has_effect: true,
        });
    }
    Ok(rows)
}

fn has_effect(source: &ValueSource) -> bool {
    match source {
        ValueSource::Inert(_) => false,
        ValueSource::Engine(param) => param.works,
        ValueSource::Works(_) | ValueSource::Constant(_) | ValueSource::Opposite(_) => true,
    }
}

/// The function with which scripts read a property of that type.
pub fn property_getter(ty: ValueType) -> &'static str {
    access(ty).0
}

/// The function with which scripts set a property of that type.
pub fn property_setter(ty: ValueType) -> &'static str {
    access(ty).1
}

fn access(ty: ValueType) -> (&'static str, &'static str) {
    match ty {
        ValueType::Bool => ("sim.getBoolProperty", "sim.setBoolProperty"),
        ValueType::Int => ("sim.getIntProperty", "sim.setIntProperty"),
        ValueType::Long => ("sim.getLongProperty", "sim.setLongProperty"),
        ValueType::Float => ("sim.getFloatProperty", "sim.setFloatProperty"),
        ValueType::String => ("sim.getStringProperty", "sim.setStringProperty"),
        ValueType::Buffer => ("sim.getBufferProperty", "sim.setBufferProperty"),
        ValueType::Table => ("sim.getTableProperty", "sim.setTableProperty"),
        ValueType::Vector2 => ("sim.getVector2Property", "sim.setVector2Property"),
        ValueType::Vector3 => ("sim.getVector3Property", "sim.setVector3Property"),
        ValueType::Quaternion => ("sim.getQuaternionProperty", "sim.setQuaternionProperty"),
        ValueType::Pose => ("sim.getPoseProperty", "sim.setPoseProperty"),
        ValueType::Color => ("sim.getColorProperty", "sim.setColorProperty"),
        ValueType::FloatArray => ("sim.getFloatArrayProperty", "sim.setFloatArrayProperty"),
        ValueType::IntArray => ("sim.getIntArrayProperty", "sim.setIntArrayProperty"),
        ValueType::IntArray2 => ("sim.getIntArray2Property", "sim.setIntArray2Property"),
    }
}
