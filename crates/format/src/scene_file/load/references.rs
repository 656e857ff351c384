//! References by file handle: links, masters, entities, targets.

use super::HandleMap;
use super::collections::{CollectionMap, FileCollections, collections};
use crate::ttt::chunks::{Common, Joint as JointChunk};
use crate::ttt::tree::{Class, Object as FileObject};
use crate::ttt::{Counted, EngineBlock, File, Text};
use scene::joint::{JointDependency, JointMode};
use scene::object::viewers::Viewers;
use scene::sensor::Entity;
use scene::tree::calculation_objects::CalculationObject;
use scene::{Field, Handle, ReferenceLists, References, Scene, SceneResult, name_suffix, special};

/// Larger numbers are handles of collections.
const LAST_OBJECT: i32 = 999_999;
/// Instead of the handle of who sees an object.
const NOBODY: i32 = -2;

pub(super) fn connect(
    scene: &mut Scene,
    file: &File,
    objects: &[Handle],
    map: &HandleMap,
) -> SceneResult<FileCollections> {
    let collections = collections(scene, file, map)?;
    let entity = |handle: i32| match handle {
        0..=LAST_OBJECT => map
            .get(&handle)
            .map_or(Entity::ALL, |object| (*object).into()),
        _ => collections
            .map
            .get(&handle)
            .map_or(Entity::ALL, |collection| Entity::from_raw(*collection)),
    };
    for (object, handle) in file.contents.objects.iter().zip(objects) {
        connect_one(scene, object, *handle, map)?;
        watch(scene, object, *handle, entity)?;
        scene.modify(*handle, Field::Other, |new| {
            new.viewers = viewers(&object.common, map, &collections.map);
        })?;
        for (tag, list) in lists(&object.common, map, &collections.map) {
            scene.set_references(*handle, References::Following, &tag, &list)?;
        }
        for (tag, list) in original_lists(&object.common, file, objects) {
            scene.set_references(*handle, References::Original, &tag, &list)?;
        }
    }
    Ok(collections)
}

/// Collision and distance objects, which were kept with the scene before 4.2. One whose first entity is gone is left out; without a second
/// one everything else is meant. Their names are numbered as those of the objects of the file are.
pub(super) fn calculation_objects(
    scene: &mut Scene,
    file: &File,
    objects: &[Handle],
    map: &HandleMap,
    collections: &CollectionMap,
) {
    let entity = |handle: i32| match handle {
        0..=LAST_OBJECT => map.get(&handle).map(|object| object.raw()),
        _ => collections.get(&handle).copied(),
    };
    let entities = |handles: Option<[i32; 3]>| {
        let [first, second, _] = handles?;
        Some([entity(first)?, entity(second).unwrap_or(special::ALL)])
    };
    let text = |text: &Option<Text>| text.as_ref().map(Text::decode).unwrap_or_default();
    for chunk in &file.contents.collisions {
        let Some(entities) = entities(chunk.entities_and_handle) else {
            continue;
        };
        let name = numbered(scene, file, objects, text(&chunk.name));
        scene.collision_objects_mut().add(CalculationObject {
            name,
            persistent_uid: text(&chunk.persistent_id),
            entities,
            threshold: 0.0,
            explicit: false,
            switches: chunk.flags.unwrap_or(0),
            result: None,
        });
    }
    for chunk in &file.contents.distances {
        let Some(entities) = entities(chunk.entities_and_handle) else {
            continue;
        };
        let name = numbered(scene, file, objects, text(&chunk.name));
        scene.distance_objects_mut().add(CalculationObject {
            name,
            persistent_uid: text(&chunk.persistent_id),
            entities,
            threshold: chunk
                .threshold
                .filter(|threshold| threshold.is_finite())
                .unwrap_or(0.0),
            explicit: false,
            switches: chunk.flags.unwrap_or(0),
            result: None,
        });
    }
}

/// A name of the file with the suffix that objects with the same suffix have in the scene.
pub(super) fn numbered(scene: &Scene, file: &File, objects: &[Handle], name: String) -> String {
    let (own, stem) = name_suffix(&name);
    let has_it = |object: &FileObject| {
        object
            .common
            .name
            .as_ref()
            .is_some_and(|name| name_suffix(&name.decode()).0 == own)
    };
    let at = file.contents.objects.iter().position(has_it);
    let object = at.and_then(|at| scene.object(objects[at]).ok());
    match object.map_or(own, |object| name_suffix(object.old_name()).0) {
        new if new == own => name,
        -1 => stem.to_owned(),
        new => format!("{stem}#{new}"),
    }
}

fn connect_one(
    scene: &mut Scene,
    object: &FileObject,
    handle: Handle,
    map: &HandleMap,
) -> SceneResult<()> {
    match &object.class {
        Class::Dummy(dummy) => {
            if let Some(partner) = dummy.linked_dummy.and_then(|partner| map.get(&partner)) {
                let link_type = scene.object(handle)?.dummy()?.link_type;
                // Only a dummy can be a partner; else the file is wrong, and the dummy stays unlinked.
                if scene.object(*partner)?.dummy().is_ok() {
                    scene.link_dummies(handle, Some(*partner))?;
                    scene.set_link_type(handle, link_type)?;
                }
            }
        }
        Class::Joint(joint) => {
            let is_joint = |of: Handle| scene.object(of).is_ok_and(|object| object.joint().is_ok());
            let dependency =
                dependency(joint, map).filter(|law| law.master != handle && is_joint(law.master));
            if let Some(law) = dependency {
                scene.break_dependency_cycle(handle, law.master)?;
            }
            scene.try_modify(handle, Field::Joint, |object| {
                let joint = object.joint_mut()?;
                joint.dependency = dependency;
                if joint.dependency.is_some() && joint.mode == JointMode::Kinematic {
                    joint.mode = JointMode::Dependent;
                }
                Ok(())
            })?;
        }
        Class::Camera(camera) => {
            if let Some(tracked) = camera
                .tracked_and_size
                .and_then(|(tracked, _)| map.get(&tracked))
            {
                scene.track(handle, tracked.raw())?;
            }
        }
        Class::Graph(_) => scene.try_modify(handle, Field::Other, |object| {
            let sources = object
                .graph_mut()?
                .streams_mut()
                .iter_mut()
                .filter_map(|stream| stream.source.as_mut());
            sources.for_each(|source| {
                source.object = source
                    .object
                    .and_then(|o| map.get(&o.0.cast_signed()).copied());
            });
            Ok(())
        })?,
        _ => {}
    }
    Ok(())
}

/// The master of a joint; older files say it in the parameters of MuJoCo, Vortex or Newton.
fn dependency(joint: &JointChunk, map: &HandleMap) -> Option<JointDependency> {
    if let Some((master, [coefficient, offset])) = joint.dependency
        && let Some(master) = map.get(&master)
    {
        return Some(JointDependency {
            master: *master,
            offset,
            coefficient,
        });
    }
    let pair = |block: &Option<EngineBlock>, master: usize, coefficient: usize, offset: usize| {
        let block = block.as_ref()?;
        let real = |at: usize| block.reals.get(at).copied().unwrap_or(0.0);
        let master = *map.get(block.ints.get(master)?)?;
        Some(JointDependency {
            master,
            offset: real(offset),
            coefficient: real(coefficient),
        })
    };
    // The polynomial of MuJoCo begins with the offset; Vortex and Newton have factor and offset.
    pair(&joint.mujoco, 1, 23, 22)
        .or_else(|| pair(&joint.vortex, 5, 47, 48))
        .or_else(|| pair(&joint.newton, 1, 0, 1))
}

/// Sets the entity of a sensor.
fn watch(
    scene: &mut Scene,
    object: &FileObject,
    handle: Handle,
    entity: impl Fn(i32) -> Entity,
) -> SceneResult<()> {
    let seen = match &object.class {
        Class::ProximitySensor(sensor) => sensor.detectable,
        Class::VisionSensor(sensor) => sensor.renderable,
        _ => None,
    };
    let Some(seen) = seen.filter(|seen| *seen >= 0).map(entity) else {
        return Ok(());
    };
    scene.modify(handle, Field::Sensor, |object| {
        if let Ok(sensor) = object.proximity_sensor_mut() {
            sensor.entity = seen;
        } else if let Ok(sensor) = object.vision_sensor_mut() {
            sensor.entity = seen;
        }
    })
}

/// Which cameras and sensors see an object; all where the one that saw it is gone.
fn viewers(common: &Common, map: &HandleMap, collections: &CollectionMap) -> Viewers {
    match common.authorized_viewable.unwrap_or(-1) {
        NOBODY => Viewers::None,
        handle @ 0..=LAST_OBJECT => map
            .get(&handle)
            .map_or(Viewers::All, |viewer| Viewers::One(*viewer)),
        handle => collections
            .get(&handle)
            .map_or(Viewers::All, |collection| Viewers::Collection(*collection)),
    }
}

/// Objects and collections; -1 stands for what is gone.
fn lists(common: &Common, map: &HandleMap, collections: &CollectionMap) -> ReferenceLists {
    let new = |handle: &i32| match handle {
        0..=LAST_OBJECT => map.get(handle).map_or(-1, |object| object.raw()),
        _ => collections.get(handle).copied().unwrap_or(-1),
    };
    let untagged = common.references.iter().map(|Counted(all)| {
        (
            String::new(),
            all.iter().map(|[_, handle, _]| new(handle)).collect(),
        )
    });
    let tagged = common
        .tagged_references
        .iter()
        .map(|(tag, Counted(all))| (tag.decode(), all.iter().map(new).collect()));
    untagged
        .chain(tagged)
        .filter(|(_, list): &(String, Vec<i64>)| !list.is_empty())
        .collect()
}

/// Originals are known by their persistent identity: what a model refers to may be in the scene already.
fn original_lists(common: &Common, file: &File, objects: &[Handle]) -> ReferenceLists {
    let by_id = |id: &[u8]| {
        let same = |o: &FileObject| {
            o.common
                .persistent_id
                .as_ref()
                .is_some_and(|own| own.0 == id)
        };
        let at = file.contents.objects.iter().position(same);
        at.map_or(-1, |at| objects[at].raw())
    };
    let untagged = common.original_references.iter().map(|Counted(all)| {
        (
            String::new(),
            all.iter()
                .map(|r| r.persistent_id.as_ref().map_or(-1, |id| by_id(&id.0)))
                .collect(),
        )
    });
    let tagged = common.tagged_original_references.iter();
    let tagged = tagged.map(|(tag, Counted(all))| {
        (
            tag.decode(),
            all.iter().map(|(_, id)| by_id(&id.0)).collect(),
        )
    });
    untagged
        .chain(tagged)
        .filter(|(_, list): &(String, Vec<i64>)| !list.is_empty())
        .collect()
}
