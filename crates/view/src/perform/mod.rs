//! What pages ask for, done on the simulation's thread between two iterations.

mod button_interfaces;
mod graph;
mod inspector;
pub(crate) mod scripts;
mod values;

use serde_json::{Value, json};

use super::edit::Editor;
use super::observe::handle_of;
use super::request::Action;
use scene::{Data, Handle};
use script::log::RecentLine;
use simulator::{Simulator, property_setter};

pub(crate) use inspector::rows;
pub(crate) use values::to_json as json_of;

/// Carries out a request; lines of the log that it took to answer are added to `lines`.
///
/// # Errors
/// Why it cannot be done, in a sentence.
pub(crate) fn perform(
    sim: &mut Simulator,
    action: &Action,
    lines: &mut Vec<RecentLine>,
    editor: &mut Editor,
) -> Result<Value, String> {
    match action {
        Action::Edit { .. }
        | Action::Undo { .. }
        | Action::Redo { .. }
        | Action::Pull { .. }
        | Action::Load { .. }
        | Action::Save { .. }
        | Action::Changes => return change(sim, action, editor),
        Action::Play => sim.play(),
        Action::Pause => sim.pause(),
        Action::Stop => sim.stop_in_place_of_pause(),
        Action::Step(count) => {
            let back = |_| "only a capture goes back".to_owned();
            sim.step_and_pause(u64::try_from(*count).map_err(back)?);
        }
        Action::Seek(_) => return Err("only a capture goes to another moment".into()),
        Action::Live => return Err("the simulation is no capture: it goes on".into()),
        Action::Speed(factor) => sim.set_pace(*factor),
        Action::Select(handles) => {
            let handles: Vec<Handle> = handles
                .iter()
                .filter_map(|handle| Handle::from_raw(*handle))
                .collect();
            sim.scene_mut().select(&handles);
        }
        Action::Inspect(None)
        | Action::Watch(_)
        | Action::Show { .. }
        | Action::Sample(_)
        | Action::Author(_)
        | Action::Check { .. } => {}
        Action::Inspect(Some(handle)) => {
            let rows = rows(sim, *handle)?.into_iter().map(|(_, row)| row);
            return Ok(rows.collect());
        }
        Action::Set {
            handle,
            name,
            value,
            ..
        } => {
            return editor.record(sim, action, |_, sim| {
                set(sim, *handle, name, value)?;
                Ok((set_label(sim, *handle, name), true.into()))
            });
        }
        Action::Script(handle) => return scripts::read(sim, *handle),
        Action::SaveScript {
            handle,
            text,
            version,
        } => {
            if let Some(present) = scripts::newer(sim, *handle, version)? {
                return Ok(present); // nothing to undo
            }
            return editor.record(sim, action, |_, sim| {
                let saved = scripts::save(sim, *handle, text, version)?;
                Ok((set_label(sim, *handle, "the text"), saved))
            });
        }
        Action::Configure(handle) => {
            return sim
                .configure(*handle)
                .map(Value::Bool)
                .map_err(|error| error.to_string());
        }
        Action::Graph(handle) => return graph::curves(sim, *handle),
        Action::Ui {
            window,
            widget,
            input,
        } => use_window(sim, window, widget, input)?,
        Action::Answer { .. } => return Err("no dialog waits for an answer".into()),
        Action::Debug(_) => return Err("pages have no debugger here".into()),
        Action::Run(code) => {
            return editor.record(sim, action, |_, sim| {
                let text = run(sim, code, lines)?;
                Ok((format!("Run {}", shortened(code)), text.into()))
            });
        }
        Action::Upload { .. } => return Err("files are sent before they are loaded".into()),
    }
    Ok(Value::Bool(true))
}

/// What changes the scene, loads or saves it.
fn change(sim: &mut Simulator, action: &Action, editor: &mut Editor) -> Result<Value, String> {
    match action {
        Action::Edit {
            edit, arguments, ..
        } => editor.edit(sim, action, edit, arguments),
        Action::Undo { others } => editor.undo(sim, *others),
        Action::Redo { others } => editor.redo(sim, *others),
        Action::Pull {
            handle,
            point,
            target: Some(target),
        } => editor.pull(
            sim,
            &json!({ "handle": handle, "point": point, "target": target }),
        ),
        Action::Load {
            main,
            files,
            position,
        } => editor.load(sim, action, (main, files), position),
        Action::Save {
            path,
            model,
            may_overwrite,
        } => editor.save(sim, path, *model, *may_overwrite),
        Action::Changes => editor.changes(sim),
        _ => Ok(Value::Bool(true)),
    }
}

/// What was set, for undo.
fn set_label(sim: &Simulator, handle: i64, name: &str) -> String {
    let scene = sim.scene();
    let object = Handle::from_raw(handle).and_then(|handle| scene.object(handle).ok());
    let what = object.map_or("the scene", |object| object.alias());
    format!("Set {name} of {what}")
}

/// The first line of code, if it is short.
fn shortened(code: &str) -> String {
    let line = code.lines().next().unwrap_or_default();
    match line.char_indices().nth(30) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}

/// What a person does with a window of a script, or with a user interface of V-REP.
fn use_window(
    sim: &mut Simulator,
    window: &Value,
    widget: &Value,
    input: &Value,
) -> Result<(), String> {
    match window.as_str().and_then(handle_of) {
        Some(interface) => button_interfaces::input(sim, interface, widget, input),
        None => sim.ui_input(&ui_input(window, widget, input)?),
    }
}

/// An input with the window and the widget that it concerns.
fn ui_input(window: &Value, widget: &Value, input: &Value) -> Result<Value, String> {
    let mut members = input.as_object().cloned().ok_or("`input` is an object")?;
    for (name, value) in [("window", window), ("widget", widget)] {
        if !value.is_null() {
            members.insert(name.to_owned(), value.clone());
        }
    }
    Ok(Value::Object(members))
}

/// Sets a property, with the function that scripts use.
fn set(sim: &mut Simulator, handle: i64, name: &str, value: &Value) -> Result<(), String> {
    let ty = sim
        .property_type(handle, name)
        .map_err(|error| error.to_string())?;
    let data =
        values::from_json(ty, value).ok_or_else(|| format!("{name} is {}", values::kind(ty)))?;
    let arguments = [Data::Int(handle), Data::text(name), data];
    sim.call_api(property_setter(ty), &arguments)
        .map(drop)
        .map_err(|error| error.to_string())
}

/// What code prints, and its errors.
fn run(sim: &mut Simulator, code: &str, lines: &mut Vec<RecentLine>) -> Result<String, String> {
    lines.extend(sim.take_recent_lines());
    sim.evaluate(code).map_err(|error| error.to_string())?;
    let said = sim.take_recent_lines();
    let sandbox = Some(sim.sandbox());
    let own: Vec<&str> = said
        .iter()
        .filter(|line| line.script == sandbox)
        .map(|line| line.text.as_str())
        .collect();
    let text = own.join("\n");
    lines.extend(said);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use simulator::{Options, ScriptKind};

    fn simulator() -> Simulator {
        let sim = Simulator::new(Options::default());
        sim.keep_recent_lines();
        sim
    }

    fn done(sim: &mut Simulator, action: &Action) -> Result<Value, String> {
        perform(sim, action, &mut Vec::new(), &mut Editor::default())
    }

    #[test]
    fn code_runs_in_the_sandbox_and_answers_what_it_prints() {
        let mut sim = simulator();
        assert_eq!(done(&mut sim, &Action::Run("1 + 1".into())), Ok("2".into()));
        assert_eq!(
            done(&mut sim, &Action::Run("x = 5 print('<b>', x)".into())),
            Ok("<b>, 5".into())
        );
        let error = done(&mut sim, &Action::Run("error('no')".into())).unwrap();
        assert!(
            error.as_str().is_some_and(|text| text.contains("no")),
            "{error}"
        );
    }

    #[test]
    fn properties_are_set_with_the_checks_of_scripts() {
        let mut sim = simulator();
        sim.scene_mut().add_default_objects().unwrap();
        let floor = sim
            .scene()
            .objects()
            .find(|object| object.shape().is_ok())
            .unwrap()
            .handle()
            .raw();
        let mut set = |name: &str, value: Value| {
            done(
                &mut sim,
                &Action::Set {
                    handle: floor,
                    name: name.into(),
                    value,
                    gesture: None,
                },
            )
        };
        assert_eq!(set("alias", "Ground".into()), Ok(true.into()));
        assert_eq!(set("pose", json!([0, 0, 1, 0, 0, 0, 1])), Ok(true.into()));
        for (name, value) in [
            ("alias", 5.into()),
            ("pose", json!([0, 0, 1])),
            ("pose", json!([0, 0, 1, 0, 0, 0, "1"])),
            ("objectUid", 5.into()),
            ("nothing", 5.into()),
            ("layer", 1.5.into()),
        ] {
            let outcome = set(name, value.clone());
            assert!(
                outcome.as_ref().is_err_and(|reason| !reason.is_empty()),
                "{name} {value}: {outcome:?}"
            );
        }
        assert!(
            done(
                &mut sim,
                &Action::Set {
                    handle: 999,
                    name: "alias".into(),
                    value: "a".into(),
                    gesture: None,
                }
            )
            .is_err()
        );
        assert_eq!(
            sim.scene().object(Handle(floor as u32)).unwrap().alias(),
            "Ground"
        );
    }

    #[test]
    fn rows_have_values_types_and_units() {
        let mut sim = simulator();
        sim.scene_mut().add_default_objects().unwrap();
        let handles: Vec<i64> = sim
            .scene()
            .objects()
            .map(|object| object.handle().raw())
            .collect();
        for handle in handles.into_iter().chain([-12, -13]) {
            let rows = done(&mut sim, &Action::Inspect(Some(handle))).unwrap();
            let rows = rows.as_array().unwrap();
            assert!(rows.len() > 10, "{handle}");
            assert!(rows.iter().all(|row| row["name"].is_string()
                && row["type"].is_string()
                && row["group"].is_string()));
        }
        assert!(done(&mut sim, &Action::Inspect(Some(123_456))).is_err());
    }

    #[test]
    fn a_simulation_steps_pauses_plays_and_stops() {
        use simulator::SimulationState as State;
        let mut sim = simulator();
        done(&mut sim, &Action::Step(1)).unwrap();
        for _ in 0..5 {
            sim.iterate();
        }
        assert_eq!((sim.steps(), sim.state()), (1, State::Paused));
        done(&mut sim, &Action::Step(3)).unwrap();
        for _ in 0..5 {
            sim.iterate();
        }
        assert_eq!((sim.steps(), sim.state()), (4, State::Paused));
        done(&mut sim, &Action::Play).unwrap();
        for _ in 0..5 {
            sim.iterate();
        }
        assert_eq!((sim.steps(), sim.state()), (9, State::Running));
        // A pause that has not come yet, or has begun, gives way to what is asked for after it.
        for steps in 0..2 {
            done(&mut sim, &Action::Pause).unwrap();
            (0..steps).for_each(|_| sim.iterate());
            done(&mut sim, &Action::Play).unwrap();
            (0..4).for_each(|_| sim.iterate());
            assert_eq!(sim.state(), State::Running);
        }
        done(&mut sim, &Action::Stop).unwrap();
        for _ in 0..5 {
            sim.iterate();
        }
        assert_eq!(sim.state(), State::Stopped);
    }

    #[test]
    fn a_stop_ends_also_what_is_about_to_pause() {
        use simulator::SimulationState as State;
        let code = b"function sysCall_actuation() error('no') end";
        let mut states = Vec::new();
        for iterations in 0..6 {
            let mut sim = simulator();
            sim.add_script(ScriptKind::Customization, "", code).unwrap();
            done(&mut sim, &Action::Play).unwrap();
            for _ in 0..iterations {
                sim.iterate();
            }
            states.push(sim.state());
            done(&mut sim, &Action::Stop).unwrap();
            for _ in 0..5 {
                sim.iterate();
            }
            assert_eq!(sim.state(), State::Stopped, "after {:?}", states.last());
        }
        assert!(
            states.contains(&State::LastBeforePause) && states.contains(&State::Paused),
            "{states:?}"
        );
    }
}
