//! Scenes that a script builds when it is loaded, as files without that script.

use std::path::Path;

use super::complain;
use super::interrupt::Interrupt;
use format::scene_file;
use format::ttt::File;
use permissions::Permissions;
use scene::{Data, Handle};
use script::log::verbosity;
use simulator::{Console, LogLine, Options, ScriptKind, Simulator};

/// What a script in Lua or Python makes of the default scene until its `sysCall_init` returns. What it prints goes to standard error.
///
/// # Errors
/// When the script fails, since the scene is incomplete then, or the scene cannot be saved.
pub(super) fn scene_of(path: &Path, code: &[u8]) -> Result<File, String> {
    let failed = |reason: String| format!("cannot build the scene of {}: {reason}", path.display());
    let interrupt = Interrupt::of_scripts_here();
    let mut sim = simulator(path, &interrupt).map_err(|error| failed(error.to_string()))?;
    let builder = sim
        .add_script_of_file(ScriptKind::Customization, "scene", code, Some(path))
        .map_err(|error| failed(error.to_string()))?;
    if sim.errors() > 0 || interrupt.is_requested() {
        return Err(failed("its script did not come to its end".into()));
    }
    // Not by the API, which would let the script clean up what it has made.
    let builder: Vec<Handle> = Handle::from_raw(builder.handle()).into_iter().collect();
    sim.scene_mut()
        .remove(&builder)
        .map_err(|error| failed(error.to_string()))?;
    let saved = sim
        .call_api("sim.saveScene", &[])
        .map_err(|error| failed(error.to_string()))?;
    let [Data::Buffer(bytes)] = saved.as_slice() else {
        return Err(failed("it cannot be saved".into()));
    };
    scene_file::read_file(bytes, None, &Permissions::all())
        .map_err(|error| failed(error.to_string()))
}

fn simulator(path: &Path, interrupt: &Interrupt) -> Result<Simulator, simulator::Error> {
    let options = Options {
        package_dirs: vec![Simulator::folder_of_scene(path)],
        stop: interrupt.flag(),
        ..Options::default()
    };
    let mut sim = Simulator::with_console(options, Box::new(StandardError));
    sim.add_default_objects()?;
    let absolute = std::path::absolute(path).unwrap_or_default();
    sim.scene_mut()
        .modify_settings(|settings| settings.path = absolute.to_string_lossy().into_owned());
    Ok(sim)
}

/// Standard output belongs to the command, not to the script.
struct StandardError;

impl Console for StandardError {
    fn print(&mut self, line: &[u8], _: f64) {
        complain(&String::from_utf8_lossy(line));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !line.status && verbosity::plain(line.level) <= verbosity::SCRIPT_WARNINGS {
            complain(line.located.unwrap_or(line.text));
        }
    }
}
