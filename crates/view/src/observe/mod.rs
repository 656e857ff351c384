//! What changed in a simulator since it was last looked at. Runs on the simulation's thread.
//!
//! The journal says which objects changed; those are described anew, and what hangs below moved ones is placed anew. What the journal leaves out, or
//! would have to hold at every step, is compared each time: readings of proximity sensors, images of vision sensors on shapes, drawing objects.

mod button_interfaces;
mod describe;
mod drawings;
mod log;
mod members;
mod meshes;
mod moved;
mod path_lines;
mod reread;
mod scene;
#[cfg(test)]
mod tests;
mod windows;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use ::scene::{Change, Cursor, Field, Handle, Kind, Scene, Topic, Topics, Unread};
use script::log::RecentLine;

use super::blobs::{Blob, Hash};
pub(crate) use button_interfaces::handle_of;
pub(crate) use log::describe as describe_line;
use meshes::Meshes;
use moved::Moved;
use path_lines::PathLines;
use reread::Reread;
pub(crate) use scene::{Played, RECORDING, Source};
pub(crate) use windows::{ObservedWindows, WindowObserver};

/// Changes of what pages show.
pub(crate) const SHOWN: Topics = Topics::TREE
    .with(Topic::Selection)
    .with(Topic::Settings)
    .with_fields(&[
        Field::Alias,
        Field::Pose,
        Field::Layer,
        Field::ObjectProperty,
        Field::ModelProperty,
        Field::Geometry,
        Field::Appearance,
        Field::Texture,
        Field::Joint,
        Field::JointPosition,
        Field::Sensor,
        Field::Script,
        Field::Other,
    ]);

/// What changed. Lists are in the order of handles.
#[derive(Debug, Default)]
pub(crate) struct Observation {
    /// Nothing that was seen before is true any more.
    pub is_another_scene: bool,
    /// Objects and drawing objects are all there are.
    pub is_complete: bool,
    pub objects: Vec<(i64, ObservedObject)>,
    pub removed: Vec<i64>,
    /// World poses: position and quaternion (x, y, z, w).
    pub poses: Vec<(i64, [f32; 7])>,
    /// JSON, by identifier.
    pub drawings: Vec<(i64, Arc<str>)>,
    pub removed_drawings: Vec<i64>,
    /// JSON.
    pub scene: Option<String>,
    /// Seconds.
    pub time: f64,
    pub selection: Option<Vec<i64>>,
    /// JSON.
    pub log: Vec<String>,
}

impl Observation {
    /// Nothing but lines of the log, at a time (seconds).
    pub(crate) fn of_lines(lines: &[RecentLine], time: f64) -> Self {
        Self {
            time,
            log: lines.iter().map(log::describe).collect(),
            ..Self::default()
        }
    }
}

/// An object as pages show it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ObservedObject {
    /// JSON.
    pub text: Arc<str>,
    /// What the text refers to.
    pub blobs: Vec<Arc<Blob>>,
}

/// The last error of a script.
#[derive(Debug, Clone, PartialEq)]
struct ScriptError {
    line: Option<u64>,
    message: String,
}

/// A reader of one simulator.
#[derive(Default)]
pub(crate) struct Observer {
    cursor: Option<Cursor>,
    /// Of an observer that does not use the journal.
    reread: Option<Reread>,
    /// The scene it has read, by its identifier.
    scene_uid: Option<i64>,
    /// Places of objects among their siblings.
    places: BTreeMap<Handle, usize>,
    /// Objects whose appearance changes without the journal saying so: proximity sensors, and shapes that show what a vision sensor sees.
    restless: BTreeSet<Handle>,
    meshes: Meshes,
    moved: Moved,
    script_errors: BTreeMap<i64, ScriptError>,
    /// The texts that these errors are about.
    wrong_texts: BTreeMap<i64, Hash>,
    visibility_layers: u16,
    drawings_seen: u64,
    known_drawings: BTreeSet<i64>,
    path_lines: PathLines,
}

/// Which objects to look at.
#[derive(Default)]
struct Concerned {
    is_complete: bool,
    objects: BTreeSet<Handle>,
    /// Those that moved, perhaps with all below them.
    moved: BTreeSet<Handle>,
    removed: BTreeSet<i64>,
    /// They got another place in the tree; new ones are the last of their siblings.
    new: BTreeSet<Handle>,
    replaced: BTreeSet<Handle>,
    selection: bool,
}

impl Observer {
    /// What changed since the last call; everything at first. Takes time in proportion to that.
    pub(crate) fn observe(&mut self, source: &Source<'_>, lines: &[RecentLine]) -> Observation {
        let scene = source.now.scene;
        let is_another_scene =
            self.scene_uid.replace(source.now.scene_uid) != Some(source.now.scene_uid);
        if is_another_scene {
            self.forget();
        }
        let failed = self.note_errors(lines);
        let mut concerned = self.read_journal(scene);
        concerned
            .objects
            .extend(failed.into_iter().filter(|handle| scene.exists(*handle)));
        concerned.objects.extend(
            self.restless
                .iter()
                .copied()
                .filter(|handle| scene.exists(*handle)),
        );
        let layers = scene.settings().visibility_layers.bits();
        if std::mem::replace(&mut self.visibility_layers, layers) != layers {
            concerned
                .objects
                .extend(scene.objects().map(::scene::Object::handle));
        }
        self.place_in_tree(scene, &mut concerned);
        let complete = concerned.is_complete;
        let (mut drawings, mut removed_drawings) = self.observe_drawings(scene, complete);
        let looked_at = (&concerned.objects, complete);
        self.path_lines
            .observe(scene, looked_at, &mut drawings, &mut removed_drawings);
        Observation {
            is_another_scene,
            is_complete: complete,
            poses: self
                .moved
                .poses(scene, &concerned.moved, complete || self.reread.is_some()),
            objects: self.describe_all(scene, &concerned.objects),
            removed: concerned.removed.into_iter().collect(),
            drawings,
            removed_drawings,
            scene: Some(source.describe()),
            time: source.now.time,
            selection: (complete || concerned.selection).then(|| {
                scene
                    .selection()
                    .iter()
                    .map(|handle| handle.raw())
                    .collect()
            }),
            log: lines.iter().map(log::describe).collect(),
        }
    }

    /// Begins anew with another scene.
    fn forget(&mut self) {
        let errors = std::mem::take(&mut self.script_errors);
        *self = Self {
            scene_uid: self.scene_uid,
            reread: self.reread.as_ref().map(|_| Reread::default()),
            ..Self::default()
        };
        if self.reread.is_some() {
            // They were set for this moment.
            self.script_errors = errors;
        }
    }

    /// Keeps nothing that lies in the memory of the simulator: it may be taken back. The next observation is of everything.
    pub(crate) fn let_go(&mut self, scene: &Scene) {
        let (scene_uid, errors) = (self.scene_uid, std::mem::take(&mut self.script_errors));
        self.forget();
        (self.scene_uid, self.script_errors) = (scene_uid, errors);
        scene.journal().drop_readers();
    }

    /// The journal need not keep anything for this reader until it looks again; then it looks at everything.
    pub(crate) fn pause(&mut self) {
        self.cursor = None;
    }

    /// What the journal says.
    fn read_journal(&mut self, scene: &Scene) -> Concerned {
        let mut concerned = Concerned::default();
        if self.reread.is_some() {
            self.reread(scene, &mut concerned);
            return concerned;
        }
        let cursor = self
            .cursor
            .get_or_insert_with(|| scene.journal().follow(SHOWN));
        match scene.journal().read(cursor) {
            Unread::Everything => self.concern_everything(scene, &mut concerned),
            Unread::Changes(changes) => changes.for_each(|change| concerned.note(change)),
        }
        concerned.objects.retain(|handle| scene.exists(*handle));
        concerned
    }

    fn concern_everything(&mut self, scene: &Scene, concerned: &mut Concerned) {
        concerned.is_complete = true;
        concerned
            .objects
            .extend(scene.objects().map(::scene::Object::handle));
        self.places.clear();
        self.restless.retain(|handle| scene.exists(*handle));
    }

    /// Brings places among siblings up to date; siblings that got another one are concerned, too. After one is gone the others keep theirs,
    /// since only their order counts.
    fn place_in_tree(&mut self, scene: &Scene, concerned: &mut Concerned) {
        if concerned.is_complete {
            let parents = scene
                .objects()
                .filter(|object| !object.children().is_empty());
            let families = parents
                .map(::scene::Object::children)
                .chain([scene.roots()]);
            self.places = families
                .flat_map(|family| family.iter().copied().zip(0..))
                .collect();
            return;
        }
        for &handle in &concerned.new {
            let Ok(siblings) = scene.siblings(handle) else {
                continue;
            };
            let place = siblings
                .iter()
                .rposition(|sibling| *sibling == handle)
                .unwrap_or(0);
            self.places.insert(handle, place);
        }
        for handle in &concerned.replaced {
            for (&sibling, place) in scene.siblings(*handle).unwrap_or(&[]).iter().zip(0..) {
                if self.places.insert(sibling, place) != Some(place) {
                    concerned.objects.insert(sibling);
                }
            }
        }
    }

    /// Remembers the last errors of scripts; returns whose.
    fn note_errors(&mut self, lines: &[RecentLine]) -> Vec<Handle> {
        let failures = lines.iter().filter(|line| line.is_script_error());
        let errors = failures.filter_map(|line| {
            let error = ScriptError {
                line: log::line_of(&line.text),
                message: line.text.clone(),
            };
            Some((line.script?, error))
        });
        let mut failed = Vec::new();
        for (script, error) in errors {
            failed.extend(Handle::from_raw(script));
            self.script_errors.insert(script, error);
            self.wrong_texts.remove(&script);
        }
        failed
    }

    fn describe_all(
        &mut self,
        scene: &Scene,
        handles: &BTreeSet<Handle>,
    ) -> Vec<(i64, ObservedObject)> {
        let described = handles.iter().filter_map(|&handle| {
            let object = scene.object(handle).ok()?;
            if is_restless(&object.kind) {
                self.restless.insert(handle);
            } else {
                self.restless.remove(&handle);
            }
            let error = self.script_errors.get(&handle.raw());
            let error = error.filter(|_| is_about(object, &mut self.wrong_texts));
            let place = self.places.get(&handle).copied().unwrap_or(0);
            Some((
                handle.raw(),
                describe::object(scene, object, place, error, &mut self.meshes),
            ))
        });
        let described = described.collect();
        self.meshes.drop_unused();
        described
    }
}

/// Whether the appearance of such an object changes without the journal saying so.
fn is_restless(kind: &Kind) -> bool {
    match kind {
        Kind::ProximitySensor(_) => true,
        Kind::Shape(shape) => shape.parts.iter().any(meshes::is_screen),
        _ => false,
    }
}

impl Concerned {
    fn note(&mut self, change: &Change) {
        match *change {
            Change::Added(handle) => {
                self.objects.insert(handle);
                self.moved.insert(handle);
                self.new.insert(handle);
            }
            Change::Removed(handle, _) => drop(self.removed.insert(handle.raw())),
            Change::Modified(handle, field) => self.note_field(handle, field),
            Change::Selection => self.selection = true,
            Change::Settings | Change::Stored { .. } => {}
        }
    }

    fn note_field(&mut self, handle: Handle, field: Field) {
        if field != Field::Pose {
            self.objects.insert(handle);
        }
        if field == Field::Parent {
            self.replaced.insert(handle);
        }
        if matches!(
            field,
            Field::Parent
                | Field::Pose
                | Field::Geometry
                | Field::Joint
                | Field::JointPosition
                | Field::Other
        ) {
            self.moved.insert(handle);
        }
    }
}

/// Whether the last error of a script is about the text that it has: an error is about the text that the script had when it was seen first.
fn is_about(object: &::scene::Object, wrong_texts: &mut BTreeMap<i64, Hash>) -> bool {
    let Kind::Script(script) = &object.kind else {
        return false;
    };
    let version = Hash::of(&script.code);
    *wrong_texts.entry(object.handle().raw()).or_insert(version) == version
}
