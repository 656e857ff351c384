//! `sim.*`: names and paths of objects.

use api_macro::api;

use super::old_name::OldName;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::{Data, Handle, SceneError, special};
use script::{Bytes, Table};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object,
    get_object_handle,
    get_object_alias,
    set_object_alias,
    get_object_name,
    set_object_name,
];

/// Object at a path; the native part of `sim.getObject`.
///
/// @param path `/a/b` from the top, `./a` below this script's object, `..` the parent, `:` the model
/// @param options index: take another match; proxy: object to start from; noError: -1 instead of an error
/// @return objectHandle the first match
#[api("sim._getObject")]
fn get_object(cx: &Cx, path: Bytes, #[default(None)] options: Option<Table>) -> Result<i64> {
    let options = Lookup::read(options.as_ref());
    let emitter = options.emitter(cx)?;
    let path = text(&path);
    let found = cx.scene().find(&path, emitter, options.index);
    options.answer(cx, &path, found)
}

/// Object at a path or with an old-style name; the native part of `sim.getObjectHandle`.
///
/// @param path as in sim.getObject, or an old name
/// @param options as in sim.getObject
/// @param nameSuffix the number that the script adds to old names without one; -1: none
/// @return objectHandle the object
#[api("sim._getObjectHandle")]
pub(crate) fn get_object_handle(
    cx: &Cx,
    path: Data,
    #[default(None)] options: Option<Table>,
    #[default(-1)] name_suffix: i64,
) -> Result<i64> {
    let mut options = Lookup::read(options.as_ref());
    let path = match path {
        // Scripts of scenes before 4.2 get the object of their script in another way.
        Data::Int(special::SELF) => return Ok(own_object(cx)),
        Data::Text(path) => text(&Bytes(path)),
        Data::Int(number) => number.to_string(),
        _ => {
            return Err(ApiError::NotA {
                position: 1,
                expected: "string/buffer",
            });
        }
    };
    if path.starts_with(['/', '.', ':']) {
        let emitter = options.emitter(cx)?;
        let found = cx.scene().find(&path, emitter, options.index);
        return options.answer(cx, &path, found);
    }
    let name = OldName::read(&path, name_suffix);
    options.no_error |= name.no_error;
    let found = name.find(&cx.scene());
    match found {
        Err(SceneError::NoSuchPath) if !options.no_error && !name.is_alternative => {
            cx.note_missing_path(&path);
            Err(ApiError::Other(not_found(&path)))
        }
        found => options.answer(cx, &path, found),
    }
}

/// The error for an old name, with advice (spec: vrep-era 1.3).
fn not_found(name: &str) -> String {
    format!(
        "{}\n\nSince version 4.3.0 objects are found by path and alias, for example \"./path/to/alias\", \":/path/to/alias\" or \
         \"/path/to/alias\".\nHere another notation was used: \"{name}\" was not found.\nAn alias is not a name: names are deprecated and not \
         shown. Prefer sim.getObject.\nSee https://manual.coppeliarobotics.com/en/accessingSceneObjects.htm",
        SceneError::NoSuchPath
    )
}

/// The object a script is attached to, the script itself where it is an object at the top.
fn own_object(cx: &Cx) -> i64 {
    let script = cx.script();
    let parent = script
        .object
        .and_then(|object| cx.scene().object(object).ok()?.parent());
    script
        .owner()
        .or(parent)
        .or(script.object)
        .map_or(special::WORLD, Handle::raw)
}

fn text(bytes: &Bytes) -> String {
    String::from_utf8_lossy(&bytes.0).into_owned()
}

/// The options of a look-up.
struct Lookup {
    index: Option<usize>,
    proxy: Option<i64>,
    no_error: bool,
}

impl Lookup {
    fn read(options: Option<&Table>) -> Self {
        let field = |name| options.and_then(|table| table.0.field(name));
        let number = |name| field(name).and_then(Data::as_f64).map(numbers::truncated);
        Self {
            index: number("index").and_then(|index| usize::try_from(index).ok()),
            proxy: number("proxy").filter(|&proxy| proxy != -1),
            no_error: field("noError").is_some_and(Data::truthy),
        }
    }

    /// Start of relative paths: the proxy, the calling script object, or the object of an attached script.
    fn emitter(&self, cx: &Cx) -> Result<Option<Handle>> {
        if let Some(raw) = self.proxy {
            let proxy = Handle::from_raw(raw).filter(|&handle| cx.scene().exists(handle));
            return Ok(Some(proxy.ok_or(SceneError::NoSuchProxy)?));
        }
        let Some(script) = cx.script().object else {
            return Ok(cx.script().owner());
        };
        let scene = cx.scene();
        let object = scene.object(script)?;
        Ok(if object.script()?.parent_is_proxy {
            object.parent()
        } else {
            Some(script)
        })
    }

    fn answer(
        &self,
        cx: &Cx,
        path: &str,
        found: std::result::Result<Handle, SceneError>,
    ) -> Result<i64> {
        match found {
            Err(SceneError::NoSuchPath) if self.no_error => Ok(-1),
            Err(error) => {
                cx.note_missing_path(path);
                Err(error.into())
            }
            Ok(found) => Ok(found.raw()),
        }
    }
}

/// Name of an object, alone or as a path.
///
/// @param objectHandle the object
/// @param options -1 alias; 0 with `[i]` among siblings; 1 short path; 2 full path; 3, 4 with the handle; 5 as log lines show it; 6 to 9 with `{n}` and up to 0, 1, 2 or 999 models in front
/// @return objectAlias alias or path
#[api("sim.getObjectAlias")]
fn get_object_alias(cx: &Cx, object_handle: Handle, #[default(-1)] options: i64) -> Result<String> {
    let scene = cx.scene();
    Ok(match options {
        0 => scene.indexed_alias(object_handle)?,
        1 => scene.short_path(object_handle)?,
        2 => scene.full_path(object_handle)?,
        3 => scene.unique_alias(object_handle)?,
        4 => scene.handle_alias(object_handle)?,
        5 => scene.print_path(object_handle)?,
        6 => scene.counted_path(object_handle, 0)?,
        7 => scene.counted_path(object_handle, 1)?,
        8 => scene.counted_path(object_handle, 2)?,
        9 => scene.counted_path(object_handle, 999)?,
        _ => scene.object(object_handle)?.alias().to_owned(),
    })
}

/// Renames an object. Everything but letters, digits and underscores becomes an underscore.
///
/// @param objectHandle the object
/// @param objectAlias need not be unique
#[api("sim.setObjectAlias")]
fn set_object_alias(cx: &mut Cx, object_handle: Handle, object_alias: Bytes) -> Result<()> {
    Ok(cx.scene_mut().set_alias(object_handle, &object_alias.0)?)
}

/// Old-style name of an object.
///
/// @param objectHandle the object
/// @return objectName the name
#[api("sim.getObjectName")]
fn get_object_name(cx: &Cx, object_handle: Handle) -> Result<String> {
    Ok(cx.scene().object(object_handle)?.old_name().to_owned())
}

/// Sets the old-style name of an object, which must be new in the scene; its alias stays.
///
/// @param objectHandle the object
/// @param objectName the name
/// @return result 1
#[api("sim.setObjectName")]
fn set_object_name(cx: &mut Cx, object_handle: Handle, object_name: String) -> Result<i64> {
    cx.scene_mut().rename(object_handle, &object_name)?;
    Ok(1)
}
