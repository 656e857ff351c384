//! Copies of objects (spec: objects 5): selection, parents, references.

use std::collections::{BTreeMap, BTreeSet};

use bitflags::bitflags;

use crate::appearance::texture_mapping::TextureSource;
use crate::object::script_object::ScriptObject;
use crate::object::viewers::Viewers;
use crate::pose::placement::normalized;
use crate::sensor::Entity;
use crate::shape::Velocity;
use crate::{
    CustomData, DynamicFlags, Handle, Kind, MeasuredVelocity, ModelFlags, Object, Scene,
    SceneResult,
};

bitflags! {
    /// Options of `sim.copyPasteObjects`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct CopyOptions: i64 {
        /// Whole models.
        const MODELS = 0x1;
        /// Scripts are not copied.
        const NO_SCRIPTS = 0x2;
        /// The copies have no custom data.
        const NO_CUSTOM_DATA = 0x4;
        /// The copies have no lists of references.
        const NO_REFERENCES = 0x8;
        /// The copies have no textures.
        const NO_TEXTURES = 0x10;
        /// The copies are no models.
        const NO_MODEL_TAGS = 0x20;
        const _ = !0;
    }
}

impl Scene {
    /// The objects a copy of `handles` consists of, parents before children. Unknown handles are skipped.
    pub fn objects_to_copy(&self, handles: &[Handle], options: CopyOptions) -> Vec<Handle> {
        let known = handles.iter().filter(|&&handle| self.exists(handle));
        let listed: BTreeSet<Handle> = known.copied().collect();
        let mut chosen = if options.contains(CopyOptions::MODELS) {
            self.models_in(&listed)
        } else {
            listed
        };
        let is_script = |h: &Handle| self.object(*h).and_then(Object::script).is_ok();
        if options.contains(CopyOptions::NO_SCRIPTS) {
            chosen.retain(|h| !is_script(h));
        } else {
            let attached: Vec<Handle> =
                chosen.iter().flat_map(|&h| self.proxy_scripts(h)).collect();
            chosen.extend(attached);
        }
        if chosen.len() <= 1 {
            return chosen.into_iter().collect();
        }
        self.all_breadth_first()
            .into_iter()
            .filter(|h| chosen.contains(h))
            .collect()
    }

    /// Everything that belongs to the models among `listed`.
    fn models_in(&self, listed: &BTreeSet<Handle>) -> BTreeSet<Handle> {
        let is_model = |h: &&Handle| self.object(**h).is_ok_and(Object::is_model);
        listed
            .iter()
            .filter(is_model)
            .flat_map(|&base| self.subtree(base))
            .collect()
    }

    /// Attached scripts of `handle`, which are copied with it.
    fn proxy_scripts(&self, handle: Handle) -> Vec<Handle> {
        let children = self.object(handle).map_or(&[][..], Object::children);
        let goes_along = |&&child: &&Handle| {
            self.object(child)
                .and_then(Object::script)
                .is_ok_and(|script: &ScriptObject| script.parent_is_proxy)
        };
        children.iter().filter(goes_along).copied().collect()
    }

    /// Copies objects, listed parents before children. The copies keep their place in the world; those whose ancestors are not
    /// copied become roots. Collections, groups of inverse kinematics, and collision and distance objects that are about copied objects only
    /// are copied with them. Returns original and copy.
    ///
    /// # Errors
    /// When all handles are in use.
    pub fn copy_objects(
        &mut self,
        originals: &[Handle],
        options: CopyOptions,
    ) -> SceneResult<BTreeMap<Handle, Handle>> {
        let (mut copies, mut names) = (BTreeMap::new(), Vec::new());
        let all = originals.iter().try_for_each(|&original| {
            let (copy, name) = self.copy_object(original, &copies, options)?;
            copies.insert(original, copy);
            names.push((copy, name));
            Ok(())
        });
        for &copy in copies.values() {
            self.modify(copy, crate::Field::Other, |object| {
                redirect(object, &copies);
            })?;
        }
        let companions = self.companions_of(&copies);
        let numbers = self.number_names(&names, &companions.names())?;
        self.add_companions(companions, &numbers, &copies)?;
        all.map(|()| copies)
    }

    /// The copy, without a name from before aliases, and that name of the original.
    fn copy_object(
        &mut self,
        original: Handle,
        copies: &BTreeMap<Handle, Handle>,
        options: CopyOptions,
    ) -> SceneResult<(Handle, String)> {
        let parent = self
            .ancestors(original)
            .find_map(|above| copies.get(&above).copied());
        let direct = self
            .object(original)?
            .parent()
            .is_some_and(|above| copies.contains_key(&above));
        // What keeps its parent keeps its pose there: its place in the world would have to be composed of the poses of all above it.
        let world = (!direct).then(|| self.world_pose(original)).transpose()?;
        let mut object = self.object(original)?.clone();
        start_anew(&mut object, options);
        let (local, name) = (object.pose, std::mem::take(&mut object.old_name));
        let copy = self.insert_unnumbered(object)?;
        self.set_parent(copy, parent, false)?;
        let pose = match world {
            None => local,
            Some(world) => self.parent_frame(copy)?.inverse() * world,
        };
        self.object_mut(copy)?.pose = normalized(pose);
        self.store_state_of_copy(copy)?;
        Ok((copy, name))
    }
}

/// Clears what a copy does not inherit: motions, measurements, the physics' results, and what the options strip.
fn start_anew(object: &mut Object, options: CopyOptions) {
    object.measured = MeasuredVelocity::default();
    object.initial = None;
    object.dynamic_flag = DynamicFlags::empty();
    object.dynamics_reset = false;
    match &mut object.kind {
        Kind::Joint(joint) => {
            (joint.motion, joint.error, joint.force, joint.raw_force) = (None, None, None, None);
        }
        Kind::Shape(shape) => {
            shape.velocity = Velocity::default();
            (shape.force, shape.torque) = ([0.0; 3], [0.0; 3]);
            if options.contains(CopyOptions::NO_TEXTURES) {
                shape.parts.iter_mut().for_each(|part| part.texture = None);
            }
        }
        Kind::ForceSensor(sensor) => {
            (sensor.raw, sensor.filtered, sensor.error) = (None, None, None);
        }
        Kind::ProximitySensor(sensor) => sensor.reset(),
        _ => {}
    }
    if options.contains(CopyOptions::NO_CUSTOM_DATA) {
        object.custom_data = CustomData::default();
    }
    if options.contains(CopyOptions::NO_REFERENCES) {
        object.references.clear();
        object.original_references.clear();
    }
    if options.contains(CopyOptions::NO_MODEL_TAGS) {
        object.model_property = ModelFlags::NOT_MODEL;
    }
}

/// References to copied objects follow the copies, others end. Those kept for originals stay.
fn redirect(object: &mut Object, copies: &BTreeMap<Handle, Handle>) {
    let copy_of = |handle: Handle| copies.get(&handle).copied();
    match &mut object.kind {
        Kind::Joint(joint) => {
            joint.dependency = joint.dependency.and_then(|law| {
                Some(crate::joint::JointDependency {
                    master: copy_of(law.master)?,
                    ..law
                })
            });
        }
        Kind::Shape(shape) => {
            for texture in shape
                .parts
                .iter_mut()
                .filter_map(|part| part.texture.as_mut())
            {
                if let TextureSource::Sensor(sensor) = texture.source {
                    texture.source = TextureSource::Sensor(copy_of(sensor).unwrap_or(sensor));
                }
            }
        }
        Kind::Dummy(dummy) => dummy.link = dummy.link.and_then(copy_of),
        Kind::Camera(camera) => camera.tracked = camera.tracked.and_then(copy_of),
        Kind::ProximitySensor(sensor) => sensor.entity = redirected_entity(sensor.entity, copies),
        Kind::VisionSensor(sensor) => sensor.entity = redirected_entity(sensor.entity, copies),
        _ => {}
    }
    if let Viewers::One(viewer) = object.viewers {
        object.viewers = Viewers::One(copy_of(viewer).unwrap_or(viewer));
    }
    for handle in object
        .references
        .iter_mut()
        .flat_map(|(_, list)| list.iter_mut())
    {
        *handle = Handle::from_raw(*handle)
            .and_then(copy_of)
            .map_or(-1, Handle::raw);
    }
}

/// The entity of a copied sensor: the copy of the original's entity, if there is one, else the same entity.
fn redirected_entity(entity: Entity, copies: &BTreeMap<Handle, Handle>) -> Entity {
    entity
        .object()
        .and_then(|handle| copies.get(&handle))
        .map_or(entity, |copy| (*copy).into())
}
