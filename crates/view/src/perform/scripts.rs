//! Texts of scripts: read, and replaced by pages of which none overwrites what it has not seen.

use serde_json::{Value, json};

use crate::blobs::Hash;
use scene::object::script_object::ScriptType;
use scene::{Data, Handle, Kind};
use simulator::{SimulationState, Simulator, property_setter};

/// The text of a script, with a name of the text.
pub(super) fn read(sim: &Simulator, handle: i64) -> Result<Value, String> {
    let found = sim.script_text(handle).map_err(|error| error.to_string())?;
    Ok(described(found))
}

/// Name, language and text of a script, with a name of the text.
pub(crate) fn described((name, language, text): (String, String, Vec<u8>)) -> Value {
    json!({
        "name": name,
        "language": language,
        "text": String::from_utf8_lossy(&text),
        "version": version_of(&text),
    })
}

/// The reply to a page that would overwrite what it has not seen: the text, if it is not the one of `version` any more.
pub(super) fn newer(sim: &Simulator, handle: i64, version: &str) -> Result<Option<Value>, String> {
    let mut present = read(sim, handle)?;
    if present["version"] == version {
        return Ok(None);
    }
    present["saved"] = false.into();
    Ok(Some(present))
}

/// Gives a script another text and lets it begin anew. If its text is not the one of `version` any more, nothing happens and the reply has that text.
pub(super) fn save(
    sim: &mut Simulator,
    handle: i64,
    text: &str,
    version: &str,
) -> Result<Value, String> {
    if let Some(present) = newer(sim, handle, version)? {
        return Ok(present);
    }
    let call = |sim: &mut Simulator, name: &str, arguments: &[Data]| {
        let result = sim.call_api(name, arguments);
        result.map(drop).map_err(|error| error.to_string())
    };
    let ty = sim
        .property_type(handle, "code")
        .map_err(|error| error.to_string())?;
    let arguments = [Data::Int(handle), Data::text("code"), Data::text(text)];
    call(sim, property_setter(ty), &arguments)?;
    if takes_part(sim, handle) {
        call(sim, "sim.initScript", &[Data::Int(handle)])?;
    }
    Ok(json!({ "saved": true, "version": version_of(text.as_bytes()) }))
}

fn version_of(text: &[u8]) -> String {
    Hash::of(text).to_string()
}

/// Whether a script may run now: those of the simulation do not while it is stopped.
fn takes_part(sim: &Simulator, handle: i64) -> bool {
    let scene = sim.scene();
    let object = Handle::from_raw(handle).and_then(|handle| scene.object(handle).ok());
    let of_simulation = object.is_some_and(|object| {
        matches!(&object.kind, Kind::Script(script)
            if matches!(script.script_type, ScriptType::Simulation | ScriptType::Main))
    });
    !of_simulation || sim.state() != SimulationState::Stopped
}

#[cfg(test)]
mod tests {
    use super::*;
    use simulator::{Options, ScriptKind};

    fn script(kind: ScriptKind, code: &[u8]) -> (Simulator, i64) {
        let mut sim = Simulator::new(Options::default());
        let script = sim.add_script(kind, "", code).expect("a script is added");
        let handle = script.handle();
        (sim, handle)
    }

    fn version(sim: &Simulator, handle: i64) -> String {
        let read = read(sim, handle).expect("the script is there");
        read["version"].as_str().expect("a text").to_owned()
    }

    #[test]
    fn texts_of_scripts_are_read() {
        let (sim, handle) = script(ScriptKind::Customization, b"-- \xff hello");
        let read_now = read(&sim, handle).expect("the script is there");
        assert_eq!(
            (&read_now["language"], &read_now["text"]),
            (&"lua".into(), &"-- \u{fffd} hello".into())
        );
        assert!(read(&sim, -99).is_err());
    }

    #[test]
    fn a_saved_script_begins_anew() {
        let (mut sim, handle) = script(
            ScriptKind::Customization,
            b"function sysCall_init() x = 1 end",
        );
        let before = version(&sim, handle);
        let text = "function sysCall_init() x = 2 end function get() return x end";
        let saved = save(&mut sim, handle, text, &before).expect("it is saved");
        assert_eq!(
            (&saved["saved"], &saved["version"]),
            (&true.into(), &version(&sim, handle).into())
        );
        assert_ne!(before, version(&sim, handle));
        let arguments = [Data::text("get"), Data::Int(handle)];
        let x = sim.call_api("sim.callScriptFunction", &arguments);
        assert_eq!(x, Ok(vec![Data::Int(2)]));
    }

    #[test]
    fn scripts_of_the_simulation_wait_for_it() {
        let code = b"function sysCall_init() end";
        let (mut sim, handle) = script(ScriptKind::Simulation, code);
        let text = "function sysCall_init() sim.setStringProperty(sim.handle_scene, 'signal.a', 'begun') end";
        let begun = |sim: &mut Simulator| {
            let arguments = [Data::Int(-12), Data::text("signal.a"), Data::Map(vec![])];
            sim.call_api("sim.getStringProperty", &arguments).is_ok()
        };
        let before = version(&sim, handle);
        save(&mut sim, handle, text, &before).expect("it is saved");
        assert!(!begun(&mut sim));
        sim.play();
        sim.iterate();
        sim.iterate();
        assert!(begun(&mut sim));
    }

    #[test]
    fn nobody_overwrites_what_they_have_not_seen() {
        let (mut sim, handle) = script(ScriptKind::Customization, b"x = 1");
        let seen = version(&sim, handle);
        save(&mut sim, handle, "x = 2", &seen).expect("it is saved");
        let refused = save(&mut sim, handle, "x = 3", &seen).expect("the script is there");
        assert_eq!(
            (&refused["saved"], &refused["text"]),
            (&false.into(), &"x = 2".into())
        );
        let theirs = refused["version"].as_str().expect("a text").to_owned();
        let saved = save(&mut sim, handle, "x = 3", &theirs).expect("it is saved");
        assert_eq!(saved["saved"], true);
        assert!(save(&mut sim, -99, "x", &theirs).is_err());
    }
}
