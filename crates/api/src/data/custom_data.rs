//! `sim.*`: custom data as bytes under a tag, and data that outlives the program.
//!
//! On objects and the scene the same store holds the properties below `customData.`: a buffer property and the tag of its name are one.
//! The table and buffer forms are written in Lua.

use std::collections::BTreeSet;

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::{CustomData, Data, Edit, Namespace, SceneError, special};
use script::{Bytes, Number, PropertyTarget, StorageSection};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    write_custom_string_data,
    read_custom_string_data,
    read_custom_data_tags,
    persistent_data_write,
    persistent_data_read,
    get_persistent_data_tags,
];

/// Option of `sim.persistentDataWrite`: the file too.
const IN_FILE: i64 = 1;

/// The owner of raw custom data.
enum Owner {
    /// An object or the scene.
    Scene(PropertyTarget),
    /// The application, until the program ends.
    App,
    /// The application, beyond the end of the program.
    AppStorage,
}

fn owner(cx: &Cx, raw: i64) -> Result<Owner> {
    match raw {
        special::APP_STORAGE => Ok(Owner::AppStorage),
        special::APP => Ok(Owner::App),
        special::SCENE => Ok(Owner::Scene(PropertyTarget::Scene)),
        _ => match cx.property_target(raw) {
            Ok(target @ PropertyTarget::Object(_)) => Ok(Owner::Scene(target)),
            _ => Err(SceneError::NoSuchObject.into()),
        },
    }
}

/// Writes custom data.
///
/// @param objectHandle object, sim.handle_scene, sim.handle_app or sim.handle_appstorage
/// @param tagName its name; tags that begin or end with `@tmp` are not saved; an empty one removes all tags
/// @param data empty or nil: removes the tag
/// @return result 1
#[api("sim.writeCustomStringData")]
fn write_custom_string_data(
    cx: &mut Cx,
    object_handle: Number,
    tag_name: String,
    #[default(None)] data: Option<Bytes>,
) -> Result<i64> {
    let owner = owner(cx, object_handle.0)?;
    let bytes = data.map(|data| data.0).filter(|bytes| !bytes.is_empty());
    if matches!(owner, Owner::AppStorage) {
        write_app_storage(cx, &tag_name, bytes);
        return Ok(1);
    }
    let edit = if tag_name.is_empty() {
        Edit::Clear
    } else {
        Edit::Tag(&tag_name, bytes.map(Data::Buffer))
    };
    match owner {
        Owner::Scene(target) => drop(cx.edit_named_values(&target, Namespace::CustomData, edit)?),
        Owner::App | Owner::AppStorage => drop(cx.app_mut().raw_data.edit(edit)),
    }
    Ok(1)
}

fn write_app_storage(cx: &mut Cx, tag: &str, bytes: Option<Vec<u8>>) {
    cx.change_storage(|storage| {
        if !tag.is_empty() {
            return storage.set_block(StorageSection::Tags, tag, bytes);
        }
        let tags: Vec<String> = storage
            .blocks(StorageSection::Tags)
            .keys()
            .cloned()
            .collect();
        tags.iter()
            .for_each(|tag| storage.set_block(StorageSection::Tags, tag, None));
    });
}

/// Custom data as a string.
///
/// @param objectHandle object, sim.handle_scene, sim.handle_app or sim.handle_appstorage
/// @param tagName its name
/// @return data nil if there is none, or no such object
#[api("sim.readCustomStringData")]
fn read_custom_string_data(cx: &Cx, object_handle: Number, tag_name: String) -> Result<Data> {
    let read = |values: &CustomData| match values.get(&tag_name) {
        Some(Data::Buffer(bytes)) => Some(bytes.clone()),
        _ => None,
    };
    let Ok(owner) = owner(cx, object_handle.0) else {
        return Ok(Data::Nil);
    };
    let bytes = match owner {
        Owner::Scene(target) => cx.named_values(&target, Namespace::CustomData, read)?,
        Owner::App => read(&cx.app().raw_data),
        Owner::AppStorage => cx.stored_block(StorageSection::Tags, &tag_name),
    };
    Ok(bytes.map_or(Data::Nil, Data::Text))
}

/// Tags of custom data in the order of their creation. Those of typed properties have a mark in front.
///
/// @param objectHandle object, sim.handle_scene, sim.handle_app or sim.handle_appstorage
/// @return tags
#[api("sim.readCustomDataTags")]
fn read_custom_data_tags(cx: &Cx, object_handle: Number) -> Result<Vec<String>> {
    let tags = |values: &CustomData| values.tags().collect();
    match owner(cx, object_handle.0)? {
        Owner::Scene(target) => cx.named_values(&target, Namespace::CustomData, tags),
        Owner::App => Ok(tags(&cx.app().raw_data)),
        Owner::AppStorage => Ok(cx.stored_tags(StorageSection::Tags)),
    }
}

/// Stores data in the application, independent of the open scene.
///
/// @param dataTag its name
/// @param dataValue empty: removes the tag
/// @param options 1: keep it in a file too, for other runs of the program
#[api("sim.persistentDataWrite")]
fn persistent_data_write(
    cx: &mut Cx,
    data_tag: String,
    data_value: Bytes,
    #[default(0)] options: Number,
) -> Result<()> {
    let value = Some(data_value.0).filter(|bytes| !bytes.is_empty());
    if options.0 & IN_FILE == 0 {
        cx.app_mut().persistent_data.insert(data_tag, value);
        return Ok(());
    }
    cx.app_mut().persistent_data.remove(&data_tag);
    cx.change_storage(|storage| storage.set_block(StorageSection::Persistent, &data_tag, value));
    Ok(())
}

/// Data kept with the application.
///
/// @param dataTag its name
/// @return dataValue nothing if there is none
#[api("sim.persistentDataRead")]
fn persistent_data_read(cx: &Cx, data_tag: String) -> Result<Option<Bytes>> {
    let until_the_end = cx.app().persistent_data.get(&data_tag).cloned();
    let in_file = || cx.stored_block(StorageSection::Persistent, &data_tag);
    Ok(until_the_end.unwrap_or_else(in_file).map(Bytes))
}

/// Names of the data kept with the application.
///
/// @return tags in alphabetical order
#[api("sim.getPersistentDataTags")]
fn get_persistent_data_tags(cx: &Cx) -> Result<Vec<String>> {
    let mut tags = BTreeSet::from_iter(cx.stored_tags(StorageSection::Persistent));
    for (tag, value) in &cx.app().persistent_data {
        match value {
            Some(_) => tags.insert(tag.clone()),
            None => tags.remove(tag),
        };
    }
    Ok(Vec::from_iter(tags))
}
