//! Tasks for language models, and their solutions, which have nothing but the tools.
//!
//! Each file of `tasks` returns a table: `task` (what a model would be asked), `scene` (Lua code that builds the scene) or `arguments` of the
//! server, `solve` and `check`, functions of `call(tool, arguments)`. What `solve` returns is the answer to a question, which `check` gets; it
//! returns nothing when the task is solved, and what is wrong otherwise. `TASK=name` runs one task.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use swanilda::mlua::{self, Function, Lua, Table};

use super::values::{json_of, lua_of};

/// All tasks, or the one that is chosen.
pub fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/agents/tasks");
    let wanted = std::env::var("TASK").unwrap_or_default();
    let entries = folder.read_dir().expect("the tasks are a folder").flatten();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| path.to_string_lossy().contains(&wanted))
        .collect();
    files.sort();
    files
}

/// Calls a tool: what it answers, as `Client::call` has it.
pub type Call = Box<dyn FnMut(&str, &Value) -> Value>;

/// A task with a server of its own.
pub struct Attempt {
    lua: Lua,
    task: Table,
    call: Function,
}

impl Attempt {
    /// `start` starts a server with these arguments.
    pub fn begin(file: &Path, start: impl Fn(&[String]) -> Call) -> Result<Self, String> {
        let lua = Lua::new();
        let text = std::fs::read_to_string(file).map_err(|error| error.to_string())?;
        let chunk = lua.load(text).set_name(format!("@{}", file.display()));
        let task: Table = chunk.eval().map_err(|error| error.to_string())?;
        let arguments: Vec<String> = task.get("arguments").unwrap_or_default();
        let client = RefCell::new(start(&arguments));
        let call = lua
            .create_function(move |lua, (tool, arguments): (String, Option<Table>)| {
                let arguments =
                    arguments.map_or(json!({}), |table| json_of(&mlua::Value::Table(table)));
                // Lua has one kind of empty table.
                let arguments = if arguments == json!([]) {
                    json!({})
                } else {
                    arguments
                };
                lua_of(lua, &client.borrow_mut()(&tool, &arguments))
            })
            .map_err(|error| error.to_string())?;
        let attempt = Self { lua, task, call };
        attempt.build()?;
        Ok(attempt)
    }

    fn build(&self) -> Result<(), String> {
        let scene: Option<String> = self.task.get("scene").unwrap_or_default();
        let Some(scene) = scene else { return Ok(()) };
        let load = |lua| {
            let arguments = lua_of(lua, &json!({"lua": scene}))?;
            let loaded: Table = self.call.call(("load", arguments))?;
            Ok((loaded.get("isError")?, loaded.get("text")?))
        };
        let loaded: mlua::Result<(bool, String)> = load(&self.lua);
        match loaded.map_err(|error| error.to_string())? {
            // A scene that prints or fails is not the task.
            (false, text) if !text.contains("Output:") => Ok(()),
            (_, text) => Err(text),
        }
    }

    fn function(&self, name: &str) -> Result<Function, String> {
        self.task.get(name).map_err(|error| error.to_string())
    }

    pub fn solve(&self) -> Result<mlua::Value, String> {
        let solve = self.function("solve")?;
        solve
            .call(self.call.clone())
            .map_err(|error| format!("solve: {error}"))
    }

    /// What is wrong; None when the task is solved.
    pub fn check(&self, answer: mlua::Value) -> Result<Option<String>, String> {
        let check = self.function("check")?;
        check
            .call((self.call.clone(), answer))
            .map_err(|error| format!("check: {error}"))
    }
}
