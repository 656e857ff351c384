//! `sim.*`: collections of objects.

use api_macro::api;

use crate::api::{ApiFn, Cx, Result, functions};
use crate::scene::{CollectionItem, CollectionOptions, Handle, ItemOptions, Members, Object, SceneError, special};
use crate::script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_collection,
    destroy_collection,
    empty_collection,
    add_item_to_collection,
    add_object_to_collection,
    get_collection_objects,
];

/// Creates an empty collection. It ends with the script that created it.
///
/// @param options 1: its members override their collidable, measurable and detectable flags
/// @return collectionHandle the collection
#[api("sim.createCollection")]
fn create_collection(cx: &mut Cx, #[default(0)] options: Number) -> Result<i64> {
    let overrides = CollectionOptions::from_bits_retain(options.0).contains(CollectionOptions::OVERRIDES);
    let owner = cx.script().id;
    Ok(cx.scene_mut().collections_mut().add(overrides, Some(owner)))
}

/// Removes a collection; its objects stay.
///
/// @param collectionHandle the collection
#[api("sim.destroyCollection")]
fn destroy_collection(cx: &mut Cx, collection_handle: Number) -> Result<()> {
    Ok(cx.scene_mut().collections_mut().remove(collection_handle.0)?)
}

/// Removes all items from a collection.
///
/// @param collectionHandle the collection
#[api("sim.emptyCollection")]
fn empty_collection(cx: &mut Cx, collection_handle: Number) -> Result<()> {
    cx.scene_mut().collections_mut().get_mut(collection_handle.0)?.items.clear();
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
    cx.scene_mut().collections_mut().get_mut(collection_handle.0)?.items.push(item);
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
