//! `sim.*`: collections of objects.

use api_macro::api;

use crate::old::calculation_objects::handle_of;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{
    CollectionItem, CollectionOptions, Data, Handle, ItemOptions, Members, Object, Scene,
    SceneError, is_legal_old_name, special,
};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_collection,
    get_collection_handle,
    get_collection_name,
    set_collection_name,
    remove_collection,
    destroy_collection,
    empty_collection,
    add_item_to_collection,
    add_object_to_collection,
    get_collection_objects,
];

/// Creates an empty collection. It ends with the script that created it.
///
/// V-REP gave a name first: such a collection stays with the scene.
///
/// @param options 1: its members override their collidable, measurable and detectable flags
/// @param oldOptions the options, after a name
/// @return collectionHandle the collection
#[api("sim.createCollection")]
fn create_collection(
    cx: &mut Cx,
    #[default(Data::Nil)] options: Data,
    #[default(0)] old_options: Number,
) -> Result<i64> {
    let overrides = |bits: i64| {
        CollectionOptions::from_bits_retain(bits).contains(CollectionOptions::OVERRIDES)
    };
    if let Data::Text(name) = &options {
        let name = legal_name(&cx.scene(), &String::from_utf8_lossy(name))?;
        let mut scene = cx.scene_mut();
        let handle = scene.collections_mut().add(overrides(old_options.0), None);
        scene.collections_mut().set_name(handle, name)?;
        return Ok(handle);
    }
    let bits = match options {
        Data::Nil => 0,
        number => numbers::truncated(number.as_f64().ok_or(ApiError::NotA {
            position: 1,
            expected: "integer",
        })?),
    };
    let owner = cx.script().id;
    Ok(cx
        .scene_mut()
        .collections_mut()
        .add(overrides(bits), Some(owner)))
}

fn legal_name(scene: &Scene, name: &str) -> Result<String> {
    if !is_legal_old_name(name) || scene.collections().named(name).is_some() {
        return Err(SceneError::IllegalCollectionName.into());
    }
    Ok(name.to_owned())
}

/// A collection of an old scene.
///
/// @param collectionName its name; with `@silentError`: -1 if there is none
/// @return collectionHandle its handle
#[api("sim.getCollectionHandle")]
fn get_collection_handle(cx: &Cx, collection_name: String) -> Result<i64> {
    handle_of(
        cx,
        &collection_name,
        |scene, name| scene.collections().named(name),
        SceneError::NoSuchCollection,
    )
}

/// The name of a collection of an old scene.
///
/// @param collectionHandle the collection
/// @return collectionName empty without one
#[api("sim.getCollectionName")]
fn get_collection_name(cx: &Cx, collection_handle: Number) -> Result<String> {
    Ok(cx
        .scene()
        .collections()
        .get(collection_handle.0)?
        .name
        .clone())
}

/// Names a collection, as in old scenes.
///
/// @param collectionHandle the collection
/// @param collectionName a legal name that no other collection has
/// @return result 1
#[api("sim.setCollectionName")]
fn set_collection_name(
    cx: &mut Cx,
    collection_handle: Number,
    collection_name: String,
) -> Result<i64> {
    let present = cx
        .scene()
        .collections()
        .get(collection_handle.0)?
        .name
        .clone();
    if present != collection_name {
        let name = legal_name(&cx.scene(), &collection_name)?;
        cx.scene_mut()
            .collections_mut()
            .set_name(collection_handle.0, name)?;
    }
    Ok(1)
}

/// Removes a collection, or all; their objects stay.
///
/// @param collectionHandle the collection, or sim.handle_all
/// @return result 1
#[api("sim.removeCollection")]
fn remove_collection(cx: &mut Cx, collection_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    match collection_handle.0 {
        special::ALL => scene.collections_mut().clear(),
        handle => scene.collections_mut().remove(handle)?,
    }
    Ok(1)
}

/// Removes a collection; its objects stay.
///
/// @param collectionHandle the collection
#[api("sim.destroyCollection")]
fn destroy_collection(cx: &mut Cx, collection_handle: Number) -> Result<()> {
    Ok(cx
        .scene_mut()
        .collections_mut()
        .remove(collection_handle.0)?)
}

/// Removes all items from a collection.
///
/// @param collectionHandle the collection
#[api("sim.emptyCollection")]
fn empty_collection(cx: &mut Cx, collection_handle: Number) -> Result<()> {
    cx.scene_mut()
        .collections_mut()
        .get_mut(collection_handle.0)?
        .items
        .clear();
    Ok(())
}

/// Adds to a collection, or subtracts from it.
///
/// @param collectionHandle the collection
/// @param what sim.handle_single, _tree, _chain or _all
/// @param objectHandle where a tree or chain starts; -1 for all
/// @param options 1: subtract; 2: without the object itself
#[api("sim.addItemToCollection")]
fn add_item_to_collection(
    cx: &mut Cx,
    collection_handle: Number,
    what: Number,
    object_handle: Number,
    options: Number,
) -> Result<()> {
    let base = || {
        let base = Handle::from_raw(object_handle.0).ok_or(SceneError::NoSuchObject)?;
        cx.scene().object(base).map(Object::handle)
    };
    let members = match what.0 {
        special::ALL => Members::All,
        special::SINGLE => Members::Single(base()?),
        special::TREE => Members::Tree(base()?),
        special::CHAIN => Members::Chain(base()?),
        _ => return Err(SceneError::InvalidArgument.into()),
    };
    let item = CollectionItem::new(members, ItemOptions::from_bits_retain(options.0));
    cx.scene_mut()
        .collections_mut()
        .get_mut(collection_handle.0)?
        .items
        .push(item);
    Ok(())
}

/// Adds to a collection, or subtracts from it: `sim.addItemToCollection` with other parameters.
///
/// @param collectionHandle the collection
/// @param objectHandle where a tree or chain starts; -1 for all
/// @param what sim.handle_single, _tree, _chain or _all
/// @param options 1: subtract; 2: without the object itself
#[api("sim.addObjectToCollection")]
fn add_object_to_collection(
    cx: &mut Cx,
    collection_handle: Number,
    object_handle: Number,
    what: Number,
    options: Number,
) -> Result<()> {
    add_item_to_collection(cx, collection_handle, what, object_handle, options)
}

/// The objects a collection holds now.
///
/// @param collectionHandle the collection
/// @return objectHandles in the order of their creation
#[api("sim.getCollectionObjects")]
fn get_collection_objects(cx: &Cx, collection_handle: Number) -> Result<Vec<Handle>> {
    Ok(cx.scene().collection_objects(collection_handle.0)?)
}
