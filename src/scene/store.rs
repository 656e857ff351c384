//! The object store: adding, finding and changing objects.

use std::collections::{BTreeMap, BTreeSet};

use super::pose::world::Moves;
use super::shape::Part;
use super::shape::Shape;
use super::tree::identity;
use super::tree::object::{Kind, Object};
use super::{Change, CustomData, Field, Handle, InertValues, Journal, SceneError, SceneResult, Settings, Uid};

/// Identifiers of meshes begin above all handles and their flags: both name targets of properties.
pub const FIRST_MESH_UID: Uid = 100_000_000;

/// A scene: its objects and its settings.
#[derive(Debug, Default)]
pub struct Scene {
    slots: Vec<Option<Box<Object>>>,
    live: usize,
    next_handle: u32,
    by_uid: BTreeMap<Uid, Handle>,
    next_uid: Uid,
    /// Which shape each mesh belongs to.
    meshes: BTreeMap<Uid, Handle>,
    sensors: usize,
    pub(super) roots: Vec<Handle>,
    pub(super) selection: Vec<Handle>,
    pub(super) collections: BTreeMap<i64, super::Collection>,
    /// Objects that may keep handles of others, so that not all have to be asked when one is removed.
    pub(super) referrers: BTreeSet<Handle>,
    /// Collections ever made.
    pub(super) collections_made: i64,
    pub(super) followers: super::joint::dependency::Followers,
    /// A simulation runs: new objects remember their state.
    pub(super) in_run: bool,
    settings: Settings,
    pub(super) journal: Journal,
    pub(super) moves: Moves,
    /// Custom data of the scene itself (`sim.handle_scene`).
    pub custom_data: CustomData,
    /// Signals of the scene itself; they are not saved.
    pub signals: CustomData,
    pub(super) textures: BTreeMap<i64, super::appearance::texture::Texture>,
    /// Values of the scene itself that have no effect here, as scripts set them.
    pub inert: InertValues,
}

impl Scene {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an object as the last root, at the world's origin.
    ///
    /// # Errors
    /// When all handles are in use.
    pub fn add(&mut self, alias: &str, kind: Kind) -> SceneResult<Handle> {
        self.insert(Object::new(Handle(0), 0, alias, kind))
    }

    /// Adds `object` as the last root, under a new handle and identifier and without family.
    pub(super) fn insert(&mut self, mut object: Object) -> SceneResult<Handle> {
        let handle = self.free_handle()?;
        (object.handle, object.parent) = (handle, None);
        object.children.clear();
        self.identify(&mut object);
        let index = handle.index();
        if index >= self.slots.len() {
            self.slots.resize_with(index + 1, || None);
        }
        self.sensors += usize::from(is_sensor(&object.kind));
        if object.refers() {
            self.referrers.insert(handle);
        }
        self.by_uid.insert(object.uid, handle);
        self.moves.note(&mut object);
        self.slots[index] = Some(Box::new(object));
        self.live += 1;
        self.roots.push(handle);
        self.note(Change::Added(handle));
        Ok(handle)
    }

    /// Gives an object that comes into the scene its identifiers. A copy keeps the DNA of its original.
    fn identify(&mut self, object: &mut Object) {
        object.uid = self.new_uid();
        object.persistent_uid = identity::persistent_uid(object.uid);
        if object.dna.is_empty() {
            object.dna = identity::dna(object.uid);
        }
        self.name_meshes(object);
    }

    /// Assigns identifiers to the meshes of a shape that is added to the scene.
    fn name_meshes(&mut self, object: &mut Object) {
        let handle = object.handle;
        if let Kind::Shape(shape) = &mut object.kind {
            self.name_parts(handle, shape);
        }
    }

    fn name_parts(&mut self, handle: Handle, shape: &mut Shape) {
        for part in &mut shape.parts {
            part.uid = FIRST_MESH_UID + self.new_uid();
            self.meshes.insert(part.uid, handle);
        }
    }

    /// Replaces the parts of a shape: the object stays, its meshes are new.
    ///
    /// # Errors
    /// When the object is no shape.
    pub fn morph_shape(&mut self, handle: Handle, mut shape: Shape) -> SceneResult<()> {
        let own = self.object(handle)?.shape()?;
        let old: Vec<Uid> = own.parts.iter().map(|part| part.uid).collect();
        let textures: Vec<i64> = own.texture_ids().collect();
        self.name_parts(handle, &mut shape);
        for uid in old {
            self.meshes.remove(&uid);
        }
        self.reshape(handle, |own| {
            *own = shape;
            Ok(())
        })?;
        self.forget_unused_textures(&textures);
        Ok(())
    }

    /// The shape a mesh belongs to, and which of its meshes it is.
    pub fn mesh(&self, uid: Uid) -> Option<(Handle, usize)> {
        let handle = *self.meshes.get(&uid)?;
        let index = self.object(handle).ok()?.shape().ok()?.parts.iter().position(|part| part.uid == uid)?;
        Some((handle, index))
    }

    /// Changes one mesh of a shape as `field` says; None when there is no such mesh.
    pub fn modify_mesh<R>(&mut self, uid: Uid, field: Field, change: impl FnOnce(&mut Part) -> R) -> Option<R> {
        let (handle, index) = self.mesh(uid)?;
        let Kind::Shape(shape) = &mut self.object_changing(handle, field).ok()?.kind else { return None };
        let result = change(shape.parts.get_mut(index)?);
        self.note_modified(handle, field);
        Some(result)
    }

    /// Handles rise and start over at the end of the range, so that a freed one is not met again soon.
    fn free_handle(&mut self) -> SceneResult<Handle> {
        if self.live >= Handle::END as usize {
            return Err(SceneError::TooManyObjects);
        }
        loop {
            let handle = Handle(self.next_handle);
            self.next_handle = (self.next_handle + 1) % Handle::END;
            if self.slots.get(handle.index()).is_none_or(Option::is_none) {
                return Ok(handle);
            }
        }
    }

    /// The next new object gets this handle, if it is free.
    #[cfg(test)]
    pub(super) fn start_handles_at(&mut self, handle: Handle) {
        self.next_handle = handle.0;
    }

    /// A fresh unique identifier; meshes and scripts draw from the same counter.
    pub fn new_uid(&mut self) -> Uid {
        self.next_uid += 1;
        self.next_uid
    }

    pub fn object(&self, handle: Handle) -> SceneResult<&Object> {
        self.slots.get(handle.index()).and_then(Option::as_deref).ok_or(SceneError::NoSuchObject)
    }

    pub fn exists(&self, handle: Handle) -> bool {
        self.object(handle).is_ok()
    }

    /// Changes one aspect of an object: the one gate for everything that is not a change of the tree.
    pub fn modify<R>(&mut self, handle: Handle, field: Field, change: impl FnOnce(&mut Object) -> R) -> SceneResult<R> {
        self.try_modify(handle, field, |object| Ok(change(object)))
    }

    /// Like [`modify`](Self::modify) for changes that may be refused; a refused one is not recorded.
    pub fn try_modify<R>(
        &mut self,
        handle: Handle,
        field: Field,
        change: impl FnOnce(&mut Object) -> SceneResult<R>,
    ) -> SceneResult<R> {
        let object = self.object_changing(handle, field)?;
        let frames = cfg!(debug_assertions).then(|| object.frames());
        let result = change(object)?;
        debug_assert!(field.can_move() || frames == Some(object.frames()), "a change of {field:?} moved an object");
        self.note_modified(handle, field);
        Ok(result)
    }

    fn note_modified(&mut self, handle: Handle, field: Field) {
        let moves_only = matches!(field, Field::Pose | Field::JointPosition);
        if !moves_only && self.object(handle).is_ok_and(Object::refers) {
            self.referrers.insert(handle);
        }
        self.note(Change::Modified(handle, field));
    }

    /// Unrecorded access, for the operations of this module that note their change themselves.
    pub(super) fn object_mut(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        let object = slot_mut(&mut self.slots, handle)?;
        self.moves.note(object);
        Ok(object)
    }

    /// The same for what cannot move the object or what hangs on it.
    pub(super) fn object_in_place(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        slot_mut(&mut self.slots, handle)
    }

    /// The object, of which `field` is about to change.
    fn object_changing(&mut self, handle: Handle, field: Field) -> SceneResult<&mut Object> {
        if field.can_move() { self.object_mut(handle) } else { self.object_in_place(handle) }
    }

    /// Notes a change in the journal.
    pub(super) fn note(&mut self, change: Change) {
        self.journal.note(change);
    }

    /// Forgets an object that is in no list any more.
    pub(super) fn erase(&mut self, handle: Handle) {
        if let Some(object) = self.slots.get_mut(handle.index()).and_then(Option::take) {
            self.live -= 1;
            self.sensors -= usize::from(is_sensor(&object.kind));
            self.by_uid.remove(&object.uid());
            if let Kind::Shape(shape) = &object.kind {
                for part in &shape.parts {
                    self.meshes.remove(&part.uid);
                }
                self.forget_unused_textures(&shape.texture_ids().collect::<Vec<_>>());
            }
            self.note(Change::Removed(handle, object.uid()));
        }
    }

    /// All objects in the order of their creation.
    pub fn objects(&self) -> impl Iterator<Item = &Object> {
        self.by_uid.values().filter_map(|&handle| self.object(handle).ok())
    }

    /// Whether there are proximity or vision sensors.
    pub fn has_sensors(&self) -> bool {
        self.sensors > 0
    }

    /// Number of objects.
    pub fn len(&self) -> usize {
        self.live
    }

    pub fn is_empty(&self) -> bool {
        self.live == 0
    }

    pub fn by_uid(&self, uid: Uid) -> Option<Handle> {
        self.by_uid.get(&uid).copied()
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    pub fn modify_settings<R>(&mut self, change: impl FnOnce(&mut Settings) -> R) -> R {
        let result = change(&mut self.settings);
        self.note(Change::Settings);
        result
    }

    /// What changed, for those who follow the scene.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }

    pub(crate) fn journal_mut(&mut self) -> &mut Journal {
        &mut self.journal
    }
}

fn slot_mut(slots: &mut [Option<Box<Object>>], handle: Handle) -> SceneResult<&mut Object> {
    slots.get_mut(handle.index()).and_then(Option::as_deref_mut).ok_or(SceneError::NoSuchObject)
}

fn is_sensor(kind: &Kind) -> bool {
    matches!(kind, Kind::ProximitySensor(_) | Kind::VisionSensor(_))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tree::dummy::Dummy;

    fn dummy(scene: &mut Scene) -> SceneResult<Handle> {
        scene.add("dummy", Kind::Dummy(Dummy::new(0.01)))
    }

    #[test]
    fn handles_start_over_at_the_end_and_skip_those_in_use() {
        let mut scene = Scene::new();
        assert_eq!(dummy(&mut scene), Ok(Handle(0)));
        scene.next_handle = Handle::END - 1;
        assert_eq!(dummy(&mut scene), Ok(Handle(Handle::END - 1)));
        assert_eq!(dummy(&mut scene), Ok(Handle(1)));
    }

    #[test]
    fn a_full_scene_says_so() {
        let mut scene = Scene::new();
        scene.live = Handle::END as usize;
        assert_eq!(dummy(&mut scene), Err(SceneError::TooManyObjects));
    }
}
