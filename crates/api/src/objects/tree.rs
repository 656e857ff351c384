//! `sim.*`: the tree of objects: parents, children, enumeration, removal, selection.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{Data, Handle, SceneError, special};
use script::{Handles, Number, ObjectRef, Table};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object_parent,
    set_object_parent,
    get_object_child,
    get_objects,
    get_objects_in_tree,
    get_object_hierarchy_order,
    set_object_hierarchy_order,
    get_object_type,
    is_handle,
    is_handle_valid,
    get_object_uid,
    get_object_from_uid,
    remove_objects,
    remove_object,
    remove_model,
    get_object_sel,
    set_object_sel,
    add_object_to_selection,
    remove_object_from_selection,
    is_object_in_selection,
];

/// `sim.handleflag_assembly`: the child is attached the way both were prepared for.
const ASSEMBLE: i64 = 0x40_0000;

/// Parent of an object.
///
/// @param objectHandle the object
/// @return parentObjectHandle -1 for roots
#[api("sim.getObjectParent")]
fn get_object_parent(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx
        .scene()
        .object(object_handle)?
        .parent()
        .map_or(-1, Handle::raw))
}

/// Makes an object the last child of another.
///
/// @param objectHandle the object
/// @param parentObjectHandle -1 makes it a root
/// @param keepInPlace keep its place in the world, otherwise its pose relative to the parent
/// @return result 1
#[api("sim.setObjectParent")]
fn set_object_parent(
    cx: &mut Cx,
    object_handle: ObjectRef,
    parent_object_handle: i64,
    #[default(true)] keep_in_place: bool,
) -> Result<i64> {
    let parent = match parent_object_handle {
        -1 => None,
        raw => Some(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?),
    };
    if object_handle.has(ASSEMBLE) && !keep_in_place {
        cx.scene().object(object_handle.handle)?;
        // Assembly tags are not kept, so that no two objects match.
        return Err(ApiError::Other("invalid assembly.".into()));
    }
    cx.scene_mut()
        .set_parent(object_handle.handle, parent, keep_in_place)?;
    Ok(1)
}

/// Child of an object, or root of the scene, by its position.
///
/// @param objectHandle the object, or sim.handle_scene
/// @param index from 0
/// @return childObjectHandle -1 past the end
#[api("sim.getObjectChild")]
fn get_object_child(cx: &Cx, object_handle: Number, index: i64) -> Result<i64> {
    let scene = cx.scene();
    let children = match object_handle.0 {
        special::SCENE => scene.roots(),
        raw => scene
            .object(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)?
            .children(),
    };
    let child = usize::try_from(index)
        .ok()
        .and_then(|index| children.get(index));
    Ok(child.map_or(-1, |child| child.raw()))
}

/// Object by its position in the order of creation.
///
/// @param index from 0
/// @param objectType sim.sceneobject_*, or sim.handle_all
/// @return objectHandle -1 past the end
#[api("sim.getObjects")]
fn get_objects(cx: &Cx, index: i64, object_type: i64) -> Result<i64> {
    let scene = cx.scene();
    let object = usize::try_from(index)
        .ok()
        .and_then(|index| scene.nth_of_type(object_type, index));
    Ok(object.map_or(-1, Handle::raw))
}

/// Objects of a tree, breadth first.
///
/// @param treeBaseHandle an object, or sim.handle_scene
/// @param objectType sim.sceneobject_*, or sim.handle_all
/// @param options 1: without the base; 2: only the base and its children
/// @return objects handles
#[api("sim.getObjectsInTree")]
fn get_objects_in_tree(
    cx: &Cx,
    tree_base_handle: Number,
    #[default(special::ALL, "sim.handle_all")] object_type: i64,
    #[default(0)] options: i64,
) -> Result<Vec<Handle>> {
    let scene = cx.scene();
    let base = match tree_base_handle.0 {
        special::SCENE => None,
        raw => Some(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?),
    };
    let mut objects = scene.tree(base, options & 2 != 0)?;
    objects.retain(|&handle| {
        let is_base = options & 1 != 0 && Some(handle) == base;
        !is_base
            && scene
                .object(handle)
                .is_ok_and(|object| object.is_of_type(object_type))
    });
    Ok(objects)
}

/// Position of an object among its siblings.
///
/// @param objectHandle the object
/// @return order from 0
/// @return totalSiblingsCount itself included
#[api("sim.getObjectHierarchyOrder")]
fn get_object_hierarchy_order(cx: &Cx, object_handle: Handle) -> Result<(i64, i64)> {
    let scene = cx.scene();
    let place = scene.place_among_siblings(object_handle)?;
    let siblings = scene.siblings(object_handle)?.len();
    Ok((numbers::count(place), numbers::count(siblings)))
}

/// Moves an object among its siblings.
///
/// @param objectHandle the object
/// @param order from 0; negative positions count from the end
#[api("sim.setObjectHierarchyOrder")]
fn set_object_hierarchy_order(cx: &mut Cx, object_handle: Handle, order: i64) -> Result<()> {
    Ok(cx.scene_mut().set_hierarchy_order(object_handle, order)?)
}

/// Type of an object.
///
/// @param objectHandle the object
/// @return objectType sim.sceneobject_*
#[api("sim.getObjectType")]
fn get_object_type(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx.scene().object(object_handle)?.kind.type_number())
}

/// Whether a handle is one of an object, a collection or a script.
///
/// @param objectHandle the handle
/// @return result true if so
#[api("sim.isHandle")]
fn is_handle(cx: &Cx, object_handle: Number) -> Result<bool> {
    Ok(exists(cx, object_handle.0))
}

fn exists(cx: &Cx, raw: i64) -> bool {
    let object = Handle::from_raw(raw).is_some_and(|handle| cx.scene().exists(handle));
    object || cx.scene().collections().get(raw).is_ok() || cx.script_by_handle(raw).is_some()
}

/// Whether a handle is valid, as a number.
///
/// @param handle the handle
/// @return result 1 or 0
#[api("sim.isHandleValid")]
fn is_handle_valid(cx: &Cx, handle: Number) -> Result<i64> {
    Ok(i64::from(exists(cx, handle.0)))
}

/// Unique identifier of an object, which is never reused.
///
/// @param objectHandle the object
/// @return uid the identifier
#[api("sim.getObjectUid")]
fn get_object_uid(cx: &Cx, object_handle: Handle) -> Result<i64> {
    Ok(cx.scene().object(object_handle)?.uid())
}

/// Object with an identifier.
///
/// @param uid the identifier
/// @param options noError: -1 instead of an error
/// @return objectHandle the object
#[api("sim.getObjectFromUid")]
fn get_object_from_uid(cx: &Cx, uid: i64, #[default(None)] options: Option<Table>) -> Result<i64> {
    let no_error = options.is_some_and(|table| table.0.field("noError").is_some_and(Data::truthy));
    match cx.scene().by_uid(uid) {
        Some(handle) => Ok(handle.raw()),
        None if no_error => Ok(-1),
        None => Err(SceneError::NoSuchObject.into()),
    }
}

/// Removes objects. Children that are not listed survive: they go to the nearest ancestor left.
///
/// @param objectHandles the objects
/// @param delayedRemoval remove them when the scripts have run
#[api("sim.removeObjects")]
fn remove_objects(
    cx: &mut Cx,
    object_handles: Handles,
    #[default(false)] delayed_removal: bool,
) -> Result<()> {
    let handles = object_handles
        .0
        .iter()
        .map(|&raw| Handle::from_raw(raw).ok_or(SceneError::InvalidHandles));
    let handles = handles.collect::<std::result::Result<Vec<_>, _>>()?;
    remove(cx, &handles, delayed_removal)
}

fn remove(cx: &mut Cx, handles: &[Handle], delayed: bool) -> Result<()> {
    if !delayed {
        return cx.remove_objects(handles);
    }
    if handles.iter().any(|&handle| !cx.scene().exists(handle)) {
        return Err(SceneError::InvalidHandles.into());
    }
    cx.remove_objects_later(handles);
    Ok(())
}

/// Removes an object. Its children survive.
///
/// @param objectHandle the object
/// @return result 1
#[api("sim.removeObject")]
fn remove_object(cx: &mut Cx, object_handle: Handle) -> Result<i64> {
    cx.scene().object(object_handle)?;
    remove(cx, &[object_handle], false)?;
    Ok(1)
}

/// Removes a model: its base and everything below.
///
/// @param objectHandle base of the model
/// @param delayedRemoval remove it when the scripts have run
/// @return objectCount how many objects it had
#[api("sim.removeModel")]
fn remove_model(
    cx: &mut Cx,
    object_handle: Handle,
    #[default(false)] delayed_removal: bool,
) -> Result<i64> {
    let is_model = cx.scene().object(object_handle)?.is_model();
    if !is_model {
        return Err(SceneError::NotAModel.into());
    }
    let objects = cx.scene().subtree(object_handle);
    remove(cx, &objects, delayed_removal)?;
    Ok(numbers::count(objects.len()))
}

/// Selected objects.
///
/// @return objectHandles the last selected one last
#[api("sim.getObjectSel")]
fn get_object_sel(cx: &Cx) -> Result<Vec<Handle>> {
    Ok(cx.scene().selection().to_vec())
}

/// Selects objects instead of those selected so far.
///
/// @param objectHandles unknown ones are left out
#[api("sim.setObjectSel")]
fn set_object_sel(cx: &mut Cx, object_handles: Handles) -> Result<()> {
    let handles: Vec<Handle> = object_handles
        .0
        .iter()
        .filter_map(|&raw| Handle::from_raw(raw))
        .collect();
    cx.scene_mut().select(&handles);
    Ok(())
}

/// The objects an old selection function means by `what` and `handle`; unknown ones of a list stay unknown.
fn objects_of(cx: &Cx, what: &Data, handle: Number) -> Result<Vec<i64>> {
    let scene = cx.scene();
    let what = match what {
        Data::Nil => return Ok(Vec::new()),
        Data::Array(list) => {
            return Ok(list
                .iter()
                .filter_map(Data::as_f64)
                .map(numbers::truncated)
                .collect());
        }
        what => numbers::truncated(what.as_f64().ok_or(ApiError::NotA {
            position: 1,
            expected: "number",
        })?),
    };
    if what == special::ALL {
        return Ok(scene
            .objects()
            .map(|object| object.handle().raw())
            .collect());
    }
    let handle = Handle::from_raw(handle.0).ok_or(SceneError::NoSuchObject)?;
    scene.object(handle)?;
    let objects: Vec<Handle> = match what {
        special::SINGLE => vec![handle],
        special::TREE => scene.subtree(handle),
        special::CHAIN => std::iter::once(handle)
            .chain(scene.ancestors(handle))
            .collect(),
        _ => return Err(SceneError::InvalidArgument.into()),
    };
    Ok(objects.into_iter().map(Handle::raw).collect())
}

/// Adds objects to the selection.
///
/// @param what sim.handle_single, _tree, _chain or _all; or a list of handles, of which unknown ones are left out
/// @param objectHandle the object meant
/// @return result 1
#[api("sim.addObjectToSelection")]
fn add_object_to_selection(
    cx: &mut Cx,
    #[default(Data::Nil)] what: Data,
    #[default(special::WORLD, "sim.handle_world")] object_handle: Number,
) -> Result<i64> {
    let added = objects_of(cx, &what, object_handle)?;
    let added = added.into_iter().filter_map(Handle::from_raw);
    // All objects are selected in their own order, whatever was selected before.
    let before = match what {
        Data::Int(special::ALL) => Vec::new(),
        _ => cx.scene().selection().to_vec(),
    };
    let selection: Vec<Handle> = before.into_iter().chain(added).collect();
    cx.scene_mut().select(&selection);
    Ok(1)
}

/// Removes objects from the selection.
///
/// @param what sim.handle_single, _tree, _chain or _all; or a list of handles
/// @param objectHandle the object meant
/// @return result 1
#[api("sim.removeObjectFromSelection")]
fn remove_object_from_selection(
    cx: &mut Cx,
    #[default(Data::Nil)] what: Data,
    #[default(special::WORLD, "sim.handle_world")] object_handle: Number,
) -> Result<i64> {
    let removed = objects_of(cx, &what, object_handle)?;
    if removed
        .iter()
        .any(|&raw| Handle::from_raw(raw).is_none_or(|handle| !cx.scene().exists(handle)))
    {
        return Err(SceneError::NoSuchObject.into());
    }
    let mut selection = cx.scene().selection().to_vec();
    selection.retain(|handle| !removed.contains(&handle.raw()));
    cx.scene_mut().select(&selection);
    Ok(1)
}

/// Whether an object is selected.
///
/// @param objectHandle the object
/// @return result bit 0: selected; bit 1: last selected
#[api("sim.isObjectInSelection")]
fn is_object_in_selection(cx: &Cx, object_handle: Number) -> Result<i64> {
    let scene = cx.scene();
    let handle = Handle::from_raw(object_handle.0);
    let selected = handle.is_some_and(|handle| scene.selection().contains(&handle));
    let last = handle.is_some() && scene.selection().last().copied() == handle;
    Ok(i64::from(selected) | i64::from(last) << 1)
}
