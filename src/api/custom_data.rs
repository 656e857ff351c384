//! `sim.*`: custom data as bytes under a tag.
//!
//! The same store holds the properties below `customData.`: a buffer property and the tag of its name are one. The table and buffer
//! forms are written in Lua.

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Result, functions};
use crate::scene::{Data, Edit, Namespace, SceneError, special};
use crate::script::{Bytes, Number, Target};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    write_custom_string_data,
    read_custom_string_data,
    read_custom_data_tags,
    persistent_data_write,
    persistent_data_read,
    get_persistent_data_tags,
];

/// Data of the application that outlives the program.
const APP_STORAGE: i64 = -15;

/// What custom data belongs to: an object, the scene or the application.
fn owner(cx: &Cx, raw: i64) -> Result<Target> {
    match raw {
        APP_STORAGE => Err(ApiError::NotImplemented("custom data of sim.handle_appstorage".into())),
        special::APP => Ok(Target::App),
        special::SCENE => Ok(Target::Scene),
        _ => match cx.sim().property_target(raw, cx.script()) {
            Ok(target @ Target::Object(_)) => Ok(target),
            _ => Err(SceneError::NoSuchObject.into()),
        },
    }
}

/// Writes custom data.
///
/// @param objectHandle object, sim.handle_scene or sim.handle_app
/// @param tagName its name; tags that begin or end with `@tmp` are not saved; an empty one removes all tags
/// @param data empty or nil: removes the tag
#[api("sim.writeCustomStringData")]
fn write_custom_string_data(
    cx: &mut Cx,
    object_handle: Number,
    tag_name: String,
    #[default(None)] data: Option<Bytes>,
) -> Result<()> {
    let target = owner(cx, object_handle.0)?;
    let bytes = data.map(|data| data.0).filter(|bytes| !bytes.is_empty());
    let edit = if tag_name.is_empty() { Edit::Clear } else { Edit::Tag(&tag_name, bytes.map(Data::Buffer)) };
    cx.sim().edit_named_values(&target, Namespace::CustomData, edit)?;
    Ok(())
}

/// Custom data as a string.
///
/// @param objectHandle object, sim.handle_scene or sim.handle_app
/// @param tagName its name
/// @return data nil if there is none
#[api("sim.readCustomStringData")]
fn read_custom_string_data(cx: &Cx, object_handle: Number, tag_name: String) -> Result<Data> {
    let target = owner(cx, object_handle.0)?;
    cx.sim().with_named_values(&target, Namespace::CustomData, |values| match values.get(&tag_name) {
        Some(Data::Buffer(bytes)) => Data::Text(bytes.clone()),
        _ => Data::Nil,
    })
}

/// Tags of custom data in the order of their creation. Those of typed properties have a mark in front.
///
/// @param objectHandle object, sim.handle_scene or sim.handle_app
/// @return tags
#[api("sim.readCustomDataTags")]
fn read_custom_data_tags(cx: &Cx, object_handle: Number) -> Result<Vec<String>> {
    let target = owner(cx, object_handle.0)?;
    cx.sim().with_named_values(&target, Namespace::CustomData, |values| values.tags().map(str::to_owned).collect())
}

/// Keeps data with the application, whatever scene is open.
///
/// @param dataTag its name
/// @param dataValue empty: removes the tag
/// @param options 1: keep it in a file too, which is not built
#[api("sim.persistentDataWrite")]
fn persistent_data_write(
    cx: &mut Cx,
    data_tag: String,
    data_value: Bytes,
    #[default(0)] options: Number,
) -> Result<()> {
    if options.0 & 1 != 0 {
        return Err(ApiError::NotImplemented("persistent data in a file".into()));
    }
    let mut app = cx.sim().app.borrow_mut();
    if data_value.0.is_empty() {
        app.persistent_data.remove(&data_tag);
    } else {
        app.persistent_data.insert(data_tag, data_value.0);
    }
    Ok(())
}

/// Data kept with the application.
///
/// @param dataTag its name
/// @return dataValue nothing if there is none
#[api("sim.persistentDataRead")]
fn persistent_data_read(cx: &Cx, data_tag: String) -> Result<Option<Bytes>> {
    Ok(cx.sim().app.borrow().persistent_data.get(&data_tag).cloned().map(Bytes))
}

/// Names of the data kept with the application.
///
/// @return tags in alphabetical order
#[api("sim.getPersistentDataTags")]
fn get_persistent_data_tags(cx: &Cx) -> Result<Vec<String>> {
    Ok(cx.sim().app.borrow().persistent_data.keys().cloned().collect())
}
