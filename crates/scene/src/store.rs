//! The scene: its parts, and access to its objects.
//!
//! Each part owns its data: the objects ([`Objects`]), who refers to whom, the selection, collections, drawing objects, textures. What concerns several
//! parts, such as adding and removing objects, is a method of [`Scene`], as is everything that the journal records.

use super::appearance::texture_mapping::Textures;
use super::drawing::Drawings;
use super::joint::dependency::DependentJoints;
use super::object::identity;
use super::object::objects::Objects;
use super::object::{Kind, Object};
use super::shape::mesh_owners::MeshOwners;
use super::shape::primitives::PrimitiveMeshes;
use super::shape::{Part, Shape};
use super::tree::button_interfaces::ButtonInterfaces;
use super::tree::calculation_objects::{CollisionObjects, DistanceObjects};
use super::tree::collection::Collections;
use super::tree::ik_groups::IkGroups;
use super::tree::namesakes::Namesakes;
use super::tree::old_names::OldNames;
use super::tree::references::Referrers;
use super::tree::selection::Selection;
use super::{Change, CustomData, Field, Handle, InertValues, Journal, SceneResult, Settings, Uid};

/// Identifiers of meshes begin above all handles and their flags: both name targets of properties.
pub const FIRST_MESH_UID: Uid = 100_000_000;

/// A scene: its objects and its settings.
#[derive(Debug, Default)]
pub struct Scene {
    pub(super) objects: Objects,
    last_uid: Uid,
    mesh_owners: MeshOwners,
    pub(super) primitive_meshes: PrimitiveMeshes,
    pub(super) old_names: OldNames,
    pub(super) roots: Vec<Handle>,
    pub(super) namesakes: Namesakes,
    pub(super) selection: Selection,
    pub(super) collections: Collections,
    pub(super) drawings: Drawings,
    pub(super) collision_objects: CollisionObjects,
    pub(super) distance_objects: DistanceObjects,
    pub(super) ik_groups: IkGroups,
    pub(super) button_interfaces: ButtonInterfaces,
    pub(super) referrers: Referrers,
    pub(super) dependent_joints: DependentJoints,
    /// A simulation runs: new objects remember their state.
    pub(super) in_run: bool,
    settings: Settings,
    pub(super) journal: Journal,
    /// Custom data of the scene itself (`sim.handle_scene`).
    pub custom_data: CustomData,
    /// Signals of the scene itself; they are not saved.
    pub signals: CustomData,
    pub(super) textures: Textures,
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
        let handle = self.objects.free_handle()?;
        object.old_name = self
            .old_names
            .claim(std::mem::take(&mut object.old_name), handle);
        self.enlist(handle, object)?;
        Ok(handle)
    }

    /// Adds an object whose name from before aliases is still to be found, by [`Scene::number_names`].
    pub(super) fn insert_unnumbered(&mut self, mut object: Object) -> SceneResult<Handle> {
        let handle = self.objects.free_handle()?;
        object.old_name.clear();
        self.enlist(handle, object)?;
        Ok(handle)
    }

    /// Puts an object among the roots.
    fn enlist(&mut self, handle: Handle, mut object: Object) -> SceneResult<()> {
        object.handle = handle;
        object.children.clear();
        self.identify(&mut object);
        self.referrers.note(&object);
        self.objects.insert(object);
        self.join_siblings(handle, None)?;
        self.note(Change::Added(handle));
        Ok(())
    }

    /// Assigns identifiers to a new object. A copy keeps the DNA of its original.
    fn identify(&mut self, object: &mut Object) {
        object.uid = self.new_uid();
        object.persistent_uid = identity::persistent_uid(object.uid);
        if object.dna.is_empty() {
            object.dna = identity::dna(object.uid);
        }
        if let Kind::Shape(shape) = &mut object.kind {
            self.identify_meshes(object.handle, shape);
        }
    }

    /// Assigns identifiers to the meshes of a shape that is added to the scene.
    fn identify_meshes(&mut self, handle: Handle, shape: &mut Shape) {
        for part in &mut shape.parts {
            part.uid = FIRST_MESH_UID + self.new_uid();
        }
        self.mesh_owners.note(handle, shape);
    }

    /// Replaces the parts of a shape: the object stays, its meshes are new.
    ///
    /// # Errors
    /// When the object is no shape.
    pub fn morph_shape(&mut self, handle: Handle, mut shape: Shape) -> SceneResult<()> {
        let own = self.objects.get(handle)?.shape()?;
        let textures: Vec<i64> = own.texture_ids().collect();
        self.mesh_owners.forget(own);
        self.identify_meshes(handle, &mut shape);
        self.reshape(handle, |own| {
            *own = shape;
            Ok(())
        })?;
        self.forget_unused_textures(&textures);
        Ok(())
    }

    /// The shape a mesh belongs to, and which of its meshes it is.
    pub fn mesh(&self, uid: Uid) -> Option<(Handle, usize)> {
        let handle = self.mesh_owners.of(uid)?;
        let index = self
            .object(handle)
            .ok()?
            .shape()
            .ok()?
            .parts
            .iter()
            .position(|part| part.uid == uid)?;
        Some((handle, index))
    }

    /// Changes one mesh of a shape as `field` says; None when there is no such mesh.
    pub fn modify_mesh<R>(
        &mut self,
        uid: Uid,
        field: Field,
        change: impl FnOnce(&mut Part) -> R,
    ) -> Option<R> {
        let (handle, index) = self.mesh(uid)?;
        let Kind::Shape(shape) = &mut self.object_changing(handle, field).ok()?.kind else {
            return None;
        };
        let result = change(shape.parts.get_mut(index)?);
        self.note_modified(handle, field);
        Some(result)
    }

    /// A fresh unique identifier; objects and meshes share the counter.
    pub(crate) fn new_uid(&mut self) -> Uid {
        self.last_uid += 1;
        self.last_uid
    }

    /// The object with that handle.
    ///
    /// # Errors
    /// [`SceneError::NoSuchObject`](crate::SceneError::NoSuchObject).
    pub fn object(&self, handle: Handle) -> SceneResult<&Object> {
        self.objects.get(handle)
    }

    /// Whether there is an object with that handle.
    pub fn exists(&self, handle: Handle) -> bool {
        self.object(handle).is_ok()
    }

    /// Changes one aspect of an object. All changes except those of the tree go through here.
    pub fn modify<R>(
        &mut self,
        handle: Handle,
        field: Field,
        change: impl FnOnce(&mut Object) -> R,
    ) -> SceneResult<R> {
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
        debug_assert!(
            field.can_move() || frames == Some(object.frames()),
            "a change of {field:?} moved an object"
        );
        self.note_modified(handle, field);
        Ok(result)
    }

    fn note_modified(&mut self, handle: Handle, field: Field) {
        let moves_only = matches!(field, Field::Pose | Field::JointPosition);
        if !moves_only && let Ok(object) = self.objects.get(handle) {
            self.referrers.note(object);
        }
        self.note(Change::Modified(handle, field));
    }

    /// Unrecorded access, for the operations of this module that note their change themselves.
    pub(super) fn object_mut(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        self.objects.get_mut(handle)
    }

    /// The same for what cannot move the object or what hangs on it.
    pub(super) fn object_in_place(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        self.objects.get_in_place(handle)
    }

    /// The object, of which `field` is about to change.
    fn object_changing(&mut self, handle: Handle, field: Field) -> SceneResult<&mut Object> {
        if field.can_move() {
            self.object_mut(handle)
        } else {
            self.object_in_place(handle)
        }
    }

    /// Notes a change in the journal.
    pub(super) fn note(&mut self, change: Change) {
        self.journal.note(change);
    }

    /// Removes an object that no list contains any more.
    pub(super) fn erase(&mut self, handle: Handle) {
        let Some(object) = self.objects.remove(handle) else {
            return;
        };
        self.old_names.release(&object.old_name);
        if let Kind::Shape(shape) = &object.kind {
            self.mesh_owners.forget(shape);
            self.forget_unused_textures(&shape.texture_ids().collect::<Vec<_>>());
        }
        self.note(Change::Removed(handle, object.uid()));
    }

    /// All objects in the order of their creation.
    pub fn objects(&self) -> impl Iterator<Item = &Object> {
        self.objects.iter()
    }

    /// The object at a position in the order of creation, among those of type `object_type` (`sim.sceneobject_*`, or `sim.handle_all`).
    pub fn nth_of_type(&self, object_type: i64, position: usize) -> Option<Handle> {
        let object_type = match object_type {
            super::special::ALL => None,
            number => Some(usize::try_from(number).ok()?),
        };
        self.objects.nth(object_type, position)
    }

    /// Whether there are proximity or vision sensors.
    pub fn has_sensors(&self) -> bool {
        self.objects.has_sensors()
    }

    /// Number of objects.
    pub fn len(&self) -> usize {
        self.objects.len()
    }

    /// Whether there are no objects.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The object with that identifier.
    pub fn by_uid(&self, uid: Uid) -> Option<Handle> {
        self.objects.by_uid(uid)
    }

    /// Settings of the simulation, the physics and the display.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes settings, and notes that in the journal.
    pub fn modify_settings<R>(&mut self, change: impl FnOnce(&mut Settings) -> R) -> R {
        let result = change(&mut self.settings);
        self.note(Change::Settings);
        result
    }

    /// The journal of changes.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }

    /// The journal, to note changes of data that the scene does not hold, and to take digests.
    pub fn journal_mut(&mut self) -> &mut Journal {
        &mut self.journal
    }
}
