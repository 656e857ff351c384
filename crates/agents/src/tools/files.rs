//! Scenes, models and robots from files, and into them.

use std::path::{Path, PathBuf};

use format::scene_file::SceneFile;
use format::scene_input::SceneInput;
use mcp::Answer;
use scene::Data;
use simulator::{ScriptKind, Simulator};

use super::{Group, flag, happened, object, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::data;

pub(crate) const GROUP: Group = Group { tools, call };

fn tools() -> Vec<mcp::Tool> {
    vec![
        tool(
            "load",
            "Load a scene, model or robot",
            "Loads a file: a scene (.ttt, .lua, .simscene.xml), a model (.ttm), or a robot (.urdf, .sdf, MJCF .xml). A scene takes the place of the present one, with its snapshots; with `add`, a model, robot or Lua file comes into the present scene. Without arguments: the default scene.",
            &[
                ("path", text("The file")),
                (
                    "lua",
                    text(
                        "Instead of a file: Lua code of a customization script that builds a scene",
                    ),
                ),
                ("add", flag("Keep the present scene, and add to it")),
            ],
            &[],
        ),
        tool(
            "save",
            "Save",
            "Saves the scene (.ttt, .simscene.xml), or an object with all below it as a model (.ttm), to a file. The folder has to be allowed (--allow-write=DIR).",
            &[
                ("path", text("The file")),
                ("model", object("Path or handle of the base of a model")),
            ],
            &["path"],
        ),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    if tool == "save" {
        return save(agent, arguments);
    }
    let source = match (arguments.text("path"), arguments.text("lua")) {
        (Some(path), None) => Source::of_file(agent, Path::new(path))?,
        (None, Some(code)) => {
            Source::Script(PathBuf::from("scene.lua"), code.as_bytes().to_vec(), false)
        }
        (None, None) => Source::Nothing,
        _ => return Err("give `path` or `lua`, not both".into()),
    };
    let messages = source.messages();
    let loaded = source.name();
    if arguments.flag("add") {
        source.add(&mut agent.sim)?;
    } else {
        let is_empty = agent.setting.is_empty;
        let path = source.path();
        agent.replace(path.as_deref(), |sim| source.fill(sim, is_empty))?;
    }
    let count = agent.sim.scene().objects().count();
    let output = happened(agent);
    let answer = Answer::text(format!(
        "Loaded {loaded}: {count} objects now. `scene` shows them."
    ));
    Ok(answer.and_text(&messages).and_text(&output))
}

/// What is loaded.
enum Source {
    Nothing,
    /// Whether it is a file.
    Script(PathBuf, Vec<u8>, bool),
    /// With what was not understood.
    File(PathBuf, Box<SceneFile>, String),
}

impl Source {
    fn of_file(agent: &Agent, path: &Path) -> Result<Self, String> {
        let input = SceneInput::read(path, agent.permissions());
        let input = input.map_err(|error| format!("{error}{}", next_step(&error)))?;
        Ok(match input {
            SceneInput::Script(code) => Self::Script(path.to_owned(), code, true),
            SceneInput::File(file) => {
                let messages = file.messages().iter();
                let messages = messages.map(|message| format!("{message}\n")).collect();
                let scene = file
                    .scene()
                    .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
                Self::File(path.to_owned(), Box::new(scene), messages)
            }
        })
    }

    fn name(&self) -> String {
        match self {
            Self::Nothing => "the default scene".into(),
            Self::Script(path, ..) | Self::File(path, ..) => path.display().to_string(),
        }
    }

    fn path(&self) -> Option<PathBuf> {
        match self {
            Self::Nothing | Self::Script(_, _, false) => None,
            Self::Script(path, ..) | Self::File(path, ..) => Some(path.clone()),
        }
    }

    fn messages(&self) -> String {
        match self {
            Self::File(.., messages) => messages.clone(),
            _ => String::new(),
        }
    }

    /// Into the empty scene of a new simulator.
    fn fill(self, sim: &mut Simulator, is_empty: bool) -> Result<(), String> {
        if !is_empty && !self.is_scene_file() {
            sim.add_default_objects()
                .map_err(|error| error.to_string())?;
        }
        if let Some(path) = self.path() {
            let path = std::path::absolute(&path)
                .unwrap_or(path)
                .to_string_lossy()
                .into_owned();
            sim.scene_mut()
                .modify_settings(|settings| settings.path.clone_from(&path));
            self.put(sim)?;
            sim.scene_mut()
                .modify_settings(|settings| settings.path = path);
            return Ok(());
        }
        self.put(sim)
    }

    fn is_scene_file(&self) -> bool {
        matches!(self, Self::File(_, scene, _) if !scene.is_model())
    }

    /// Into a scene that is there.
    fn add(self, sim: &mut Simulator) -> Result<(), String> {
        if self.is_scene_file() {
            return Err("a scene cannot be added to another one: leave `add` out, or add a model (.ttm), a robot or a Lua file".into());
        }
        self.put(sim)
    }

    fn put(self, sim: &mut Simulator) -> Result<(), String> {
        match self {
            Self::Nothing => Ok(()),
            Self::Script(path, code, is_file) => {
                let name = path
                    .file_stem()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let file = is_file.then_some(path.as_path());
                let added = sim.add_script_of_file(ScriptKind::Customization, &name, &code, file);
                added.map(drop).map_err(|error| error.to_string())
            }
            Self::File(_, scene, _) => sim.load(*scene).map_err(|error| error.to_string()),
        }
    }
}

/// Names and texts of the scripts in a file: itself, or those of a scene or model.
pub(super) fn scripts(agent: &Agent, path: &Path) -> Result<Vec<(String, String)>, String> {
    let text = |code: &[u8]| String::from_utf8_lossy(code).into_owned();
    let name = path.display().to_string();
    match Source::of_file(agent, path)? {
        Source::File(_, scene, _) => {
            let scripts = scene.scripts().into_iter();
            let in_lua = scripts.filter(|script| script.language == "lua");
            Ok(in_lua
                .map(|script| (format!("{name}: {}", script.name), text(&script.code)))
                .collect())
        }
        Source::Script(_, code, _) => Ok(vec![(name, text(&code))]),
        Source::Nothing => Ok(Vec::new()),
    }
}

fn save(agent: &mut Agent, arguments: Arguments<'_>) -> Result<Answer, String> {
    let path = arguments.text("path").unwrap_or_default();
    let saved = match arguments.get("model") {
        Some(model) => {
            let handle = agent.helper("find", &[data(model)])?;
            agent
                .sim
                .call_api("sim.saveModel", &[handle, Data::text(path)])
        }
        None => agent.sim.call_api("sim.saveScene", &[Data::text(path)]),
    };
    saved.map_err(|error| {
        let error = error.to_string();
        format!("cannot save {path}: {error}{}", next_step(&error))
    })?;
    Ok(Answer::text(format!("Saved {path}.")).and_text(&happened(agent)))
}

/// After an error about a file.
fn next_step(error: &str) -> &'static str {
    if error.contains("not allowed") {
        " (ask the user to start `swanilda mcp` with that option)"
    } else {
        ""
    }
}
