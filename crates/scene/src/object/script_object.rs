//! Scripts as scene objects: text and flags. The crate `script` runs them.

use crate::{Field, Handle, Object, Scene};

/// `sim.scripttype_*`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScriptType {
    /// Runs the steps of a simulation.
    Main = 0,
    /// Runs during a simulation.
    Simulation = 1,
    /// Runs in the application, whatever the scene.
    AddOn = 2,
    /// Runs as long as its scene is loaded.
    Customization = 6,
    /// Executes what a user types in.
    Sandbox = 8,
    /// Runs only when another script calls it.
    Passive = 9,
}

/// `sim.scriptexecorder_*`: when scripts run, among those of the same level of the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum ExecutionPriority {
    /// Also of scripts that are no objects, unless they say otherwise.
    #[default]
    First = 0,
    /// Before the last and after the first ones; what objects have at first.
    Normal = 1,
    /// After all others.
    Last = 2,
}

impl ExecutionPriority {
    /// The priority with a number of a script; numbers outside are the nearest one.
    pub fn from_number(number: i64) -> Self {
        match number {
            ..=0 => Self::First,
            1 => Self::Normal,
            2.. => Self::Last,
        }
    }

    /// From the number of files before 4.4: below zero is first, above zero last.
    pub fn from_order(order: i64) -> Self {
        Self::from_number(order.saturating_add(1))
    }

    /// The number that files before 4.4 have.
    pub fn order(self) -> i64 {
        self.number() - Self::Normal.number()
    }

    /// The number scripts use.
    pub fn number(self) -> i64 {
        self as i64
    }
}

impl ScriptType {
    /// The type with number `n`.
    pub fn from_number(n: i64) -> Option<Self> {
        [
            Self::Main,
            Self::Simulation,
            Self::AddOn,
            Self::Customization,
            Self::Sandbox,
            Self::Passive,
        ]
        .into_iter()
        .find(|t| *t as i64 == n)
    }
}

/// The text of a script and how it is to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct ScriptObject {
    /// When it runs.
    pub script_type: ScriptType,
    /// The text of the script.
    pub code: Vec<u8>,
    /// The file the text is from, as stack traces name it; none for a text that only the scene has.
    pub source: Option<String>,
    /// The language of the text, such as `lua`.
    pub language: String,
    /// Does not run.
    pub disabled: bool,
    /// Starts again after an error.
    pub restart_on_error: bool,
    /// Starts again after a simulation in which it had an error.
    pub reset_after_sim_error: bool,
    /// `./x` and `.` start at the parent: set for scripts converted from the associated form.
    pub parent_is_proxy: bool,
    /// Display size, metres.
    pub size: f64,
}

impl ScriptObject {
    /// A script as `sim.createScript` makes it: only Lua simulation and customization scripts start enabled.
    pub fn new(script_type: ScriptType, code: Vec<u8>, language: &str, disabled: bool) -> Self {
        let runs = matches!(
            script_type,
            ScriptType::Simulation | ScriptType::Customization
        );
        Self {
            script_type,
            code,
            source: None,
            language: language.to_owned(),
            disabled: disabled || !runs || !matches!(language, "lua" | "python"),
            restart_on_error: false,
            reset_after_sim_error: false,
            parent_is_proxy: false,
            size: 0.01,
        }
    }
}

impl Scene {
    /// Whether a script is to start again after an error: once only.
    pub fn take_restart_request(&mut self, script: Handle) -> bool {
        let is_requested = self
            .object(script)
            .and_then(Object::script)
            .is_ok_and(|script| script.restart_on_error);
        is_requested
            && self
                .try_modify(script, Field::Other, |object| {
                    object.script_mut()?.restart_on_error = false;
                    Ok(())
                })
                .is_ok()
    }
}
