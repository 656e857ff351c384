//! Scenes, models, and files that clients send.
//!
//! They lie in a folder of the server, which goes with it. Names lead nowhere else.

use std::path::PathBuf;

use super::call::{Call, Failure, Outcome};
use scene::Data;

/// How the names of files begin that clients send to load them.
const SENT: &str = "REMOTE_API_TEMPFILE_";

/// `sim.stringparam_remoteapi_temp_file_dir`.
const FOLDER_PARAM: i64 = 16;

pub(super) fn load_scene(call: &mut Call<'_>) -> Outcome {
    let path = path(call)?;
    call.api("sim.loadScene", &[path]).map(drop)
}

pub(super) fn load_model(call: &mut Call<'_>) -> Outcome {
    let path = path(call)?;
    let base = call.integer("sim.loadModel", &[path])?;
    call.write_int(base);
    Ok(())
}

/// The path that the key means.
fn path(call: &mut Call<'_>) -> Result<Data, Failure> {
    let name = call.name()?;
    if name.is_empty() {
        return Err(Failure::Text("a file name is needed.".into()));
    }
    let path = if name.starts_with(SENT) {
        place(call, &name)?.to_string_lossy().into_owned()
    } else {
        name
    };
    Ok(Data::text(&path))
}

/// Where the file of that name is in the folder of the server.
fn place(call: &Call<'_>, name: &str) -> Result<PathBuf, Failure> {
    if name.is_empty()
        || name.contains(['/', '\\', ':'])
        || name.chars().all(|letter| letter == '.')
    {
        return Err(Failure::Text(format!("'{name}' is no plain file name.")));
    }
    let folder = call.service.folder(call.host)?;
    let path = folder.join(name);
    call.host.options().permissions.check_write(&path)?;
    call.api(
        "sim.setStringParam",
        &[
            Data::Int(FOLDER_PARAM),
            Data::text(&folder.to_string_lossy()),
        ],
    )?;
    Ok(path)
}

/// Writes a file of the client.
pub(super) fn transfer(call: &mut Call<'_>) -> Outcome {
    let name = call.name()?;
    let path = place(call, &name)?;
    let permissions = &call.host.options().permissions;
    let content = call.data.rest();
    let written = permissions.write(&path, || std::fs::write(&path, content));
    written.map_err(|error| unusable(&name, &error))
}

/// Removes it.
pub(super) fn erase(call: &mut Call<'_>) -> Outcome {
    let name = call.name()?;
    let path = place(call, &name)?;
    let permissions = &call.host.options().permissions;
    let removed = permissions.write(&path, || std::fs::remove_file(&path));
    removed.map_err(|error| unusable(&name, &error))
}

fn unusable(name: &str, error: &std::io::Error) -> Failure {
    Failure::Text(format!("'{name}': {error}."))
}
