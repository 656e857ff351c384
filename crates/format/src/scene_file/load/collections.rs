//! Collections, which were kept with the scene before 4.2, and the names of all in a file that has objects without being one.

use std::collections::BTreeMap;

use super::HandleMap;
use super::references::numbered;
use crate::ttt::chunks::{Collection as CollectionChunk, CollectionElement};
use crate::ttt::{File, Text};
use scene::tree::companions::Companion;
use scene::{CollectionItem, Handle, Members, Scene, SceneResult};

/// Before the handle of a collection without a name.
pub(in crate::scene_file) const UNNAMED_COLLECTION: &str = "collection";
/// From handles of collections in the file to those of the scene.
pub(super) type CollectionMap = BTreeMap<i32, i64>;

/// The collections of a file in the scene.
pub(super) struct FileCollections {
    pub map: CollectionMap,
    /// In the order of the file.
    handles: Vec<i64>,
}

/// The collections, still without their names.
///
/// # Errors
/// Never: they are in the scene.
pub(super) fn collections(
    scene: &mut Scene,
    file: &File,
    map: &HandleMap,
) -> SceneResult<FileCollections> {
    let (mut by_file, mut handles) = (BTreeMap::new(), Vec::new());
    for chunk in &file.contents.collections {
        let handle = scene
            .collections_mut()
            .add(chunk.flags.unwrap_or(0) & 1 != 0, None);
        let items = chunk
            .elements
            .iter()
            .filter_map(|element| item(element, map));
        scene.collections_mut().get_mut(handle)?.items = items.collect();
        handles.push(handle);
        if let Some(old) = chunk.handle {
            by_file.insert(old, handle);
        }
    }
    Ok(FileCollections {
        map: by_file,
        handles,
    })
}

/// Gives the collections of a file their names, numbered as those of its objects are.
///
/// # Errors
/// Never: the collections are in the scene.
pub(super) fn name(
    scene: &mut Scene,
    file: &File,
    objects: &[Handle],
    collections: &FileCollections,
) -> SceneResult<()> {
    for (chunk, handle) in file.contents.collections.iter().zip(&collections.handles) {
        if let Some(name) = collection_name(chunk) {
            let name = numbered(scene, file, objects, name);
            scene.collections_mut().set_name(*handle, name)?;
        }
    }
    Ok(())
}

/// The names of all in a file that has objects without being one.
pub(super) fn companions(file: &File) -> Vec<(Companion, String)> {
    let contents = &file.contents;
    let text = |text: &Option<Text>| text.as_ref().map(Text::decode);
    let collections = contents.collections.iter().map(collection_name);
    collections
        .map(|name| (Companion::Collection, name))
        .chain(
            contents
                .ik_groups
                .iter()
                .map(|c| (Companion::IkGroup, text(&c.name))),
        )
        .chain(
            contents
                .collisions
                .iter()
                .map(|c| (Companion::Collision, text(&c.name))),
        )
        .chain(
            contents
                .distances
                .iter()
                .map(|c| (Companion::Distance, text(&c.name))),
        )
        .filter_map(|(kind, name)| Some((kind, name?)))
        .collect()
}

/// The name in the file; those that were made up for files without names mean none.
fn collection_name(chunk: &CollectionChunk) -> Option<String> {
    let name = chunk.name.as_ref()?.decode();
    let made_up = format!("{UNNAMED_COLLECTION}{}", chunk.handle.unwrap_or(-1));
    (!name.is_empty() && name != made_up).then_some(name)
}

/// Objects one by one, from a base down, from a tip up, or everything; a base that is gone takes its element with it.
fn item(element: &CollectionElement, map: &HandleMap) -> Option<CollectionItem> {
    let kind = element.kind?;
    let base = map.get(&element.handles?[0]).copied();
    let members = match kind {
        0 => Members::Single(base?),
        1 | 2 => Members::Tree(base?),
        3 | 4 => Members::Chain(base?),
        _ => Members::All,
    };
    let subtract = element.flags.unwrap_or(1) & 1 == 0;
    Some(CollectionItem {
        members,
        subtract,
        exclude_base: matches!(kind, 2 | 4),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{LoadedScript, SceneFile, save};
    use scene::object::dummy::Dummy;
    use scene::object::script_object::ScriptType;
    use scene::tree::ik_groups::{IkElement, IkGroup};
    use scene::{ItemOptions, Kind, ModelFlags};

    /// A model of V-REP's time: a base with a script, a tip, a collection and a group of inverse kinematics.
    fn robot() -> Vec<u8> {
        let mut scene = Scene::new();
        let parts = ["UR10", "UR10_tip"].map(|name| {
            let dummy = Kind::Dummy(Dummy::new(0.01));
            let part = scene.add("part", dummy).unwrap();
            scene.set_old_name(part, name).unwrap();
            part
        });
        let [base, tip] = parts;
        scene.set_parent(tip, Some(base), true).unwrap();
        let is_model = |object: &mut scene::Object| object.model_property = ModelFlags::empty();
        scene.modify(base, scene::Field::Other, is_model).unwrap();
        let arm = scene.collections_mut().add(false, None);
        let tree = CollectionItem::new(Members::Tree(base), ItemOptions::empty());
        scene.collections_mut().get_mut(arm).unwrap().items = vec![tree];
        let collections = scene.collections_mut();
        collections.set_name(arm, "UR10_arm".into()).unwrap();
        scene.ik_groups_mut().add(IkGroup {
            elements: vec![IkElement::new(tip)],
            ..IkGroup::new("UR10_ik")
        });
        let script = LoadedScript {
            script_type: ScriptType::Customization,
            owner: Some(base),
            code: b"x = 1".to_vec(),
            source: None,
            language: "lua".into(),
            disabled: false,
            exec_order: 0,
        };
        save::model(&scene, base, &[script]).unwrap().write()
    }

    #[test]
    fn what_a_model_has_gets_the_number_of_its_objects_with_each_load() {
        let (bytes, mut scene) = (robot(), Scene::new());
        for suffix in ["", "#0", "#1"] {
            let file = SceneFile::read(&bytes).unwrap();
            let loaded = file.add_to(&mut scene, false).unwrap();
            let root = loaded.root.unwrap();
            let name = scene.object(root).unwrap().old_name().to_owned();
            assert_eq!(name, format!("UR10{suffix}"));
            let arm = scene.collections().named(&format!("UR10_arm{suffix}"));
            let members = scene.collection_objects(arm.unwrap()).unwrap();
            assert_eq!(members, loaded.objects);
            let group = scene.ik_groups().named(&format!("UR10_ik{suffix}"));
            let group = scene.ik_groups().get(group.unwrap()).unwrap();
            assert!(loaded.objects.contains(&group.elements[0].tip));
        }
    }
}
