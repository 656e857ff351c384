//! `sim.*`: scene and model files.
//!
//! A scene is a Lua file on top of the default scene, or the default scene alone. Reading and writing CoppeliaSim's own
//! formats is not built; asking for it says so.

use std::rc::Rc;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Result, functions};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![load_scene, close_scene];

/// Replaces the scene. For add-ons and the sandbox, while the simulation is stopped.
///
/// @param filename a `.lua` file: its text becomes a customization script of the default scene; empty for the default scene alone
/// @return result 1
#[api("sim.loadScene")]
fn load_scene(cx: &mut Cx, filename: String) -> Result<i64> {
    let code = if filename.is_empty() { None } else { Some(read_lua(&filename)?) };
    let caller = Rc::clone(cx.script());
    Rc::clone(cx.sim()).switch_scene(&caller, code.map(|code| (absolute(&filename), code)))?;
    Ok(1)
}

fn read_lua(filename: &str) -> Result<Vec<u8>> {
    let path = std::path::Path::new(filename);
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("lua") => {
            std::fs::read(path).map_err(|error| ApiError::Other(format!("'{filename}' could not be read: {error}.")))
        }
        Some(format) => Err(ApiError::NotImplemented(format!("reading scenes in the format .{format}"))),
        None => Err(ApiError::Other(format!("'{filename}' has no extension that tells its format."))),
    }
}

/// The path as scripts read it as the scene's.
fn absolute(filename: &str) -> String {
    std::path::absolute(filename).map_or_else(|_| filename.to_owned(), |path| path.to_string_lossy().into_owned())
}

/// Closes the scene: the default scene takes its place. For add-ons and the sandbox, while the simulation is stopped.
///
/// @return result 1
#[api("sim.closeScene")]
fn close_scene(cx: &mut Cx) -> Result<i64> {
    let caller = Rc::clone(cx.script());
    Rc::clone(cx.sim()).switch_scene(&caller, None)?;
    Ok(1)
}
