//! Requests about breakpoints, and about code that stands still at one.

use serde_json::{Value, json};

use super::members::{Members, handle, text};

/// Breakpoints of a script.
const MAX_BREAKPOINTS: usize = 1000;
/// What pages may ask the debugger for, by the names of the Debug Adapter Protocol.
const COMMANDS: &[&str] = &[
    "continue",
    "next",
    "stepIn",
    "stepOut",
    "stackTrace",
    "scopes",
    "variables",
    "evaluate",
    "setVariable",
    "source",
];

/// A request to the debugger.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Debug {
    /// In place of those that the script had.
    Set {
        script: i64,
        breakpoints: Vec<Breakpoint>,
    },
    /// A request of the Debug Adapter Protocol.
    Command { name: String, arguments: Value },
}

/// Where code is to stop.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Breakpoint {
    /// From 1.
    pub line: u64,
    /// An expression: it stops only where that is true.
    pub condition: Option<String>,
}

impl Breakpoint {
    pub(crate) fn to_json(&self) -> Value {
        json!({ "line": self.line, "condition": self.condition })
    }

    fn read(value: &Value) -> Result<Self, String> {
        let line = value["line"].as_u64().filter(|line| *line > 0);
        let condition = value["condition"].as_str().map(str::trim);
        Ok(Self {
            line: line.ok_or("`line` of a breakpoint is a whole number from 1")?,
            condition: condition.filter(|text| !text.is_empty()).map(str::to_owned),
        })
    }
}

impl Debug {
    pub(super) fn set(members: &Members) -> Result<Self, String> {
        let list = members.get("breakpoints").and_then(Value::as_array);
        let list = list.filter(|list| list.len() <= MAX_BREAKPOINTS);
        let list = list.ok_or_else(|| {
            format!(
                "`breakpoints` is a list of at most {MAX_BREAKPOINTS} of `line` and `condition`"
            )
        })?;
        let breakpoints = list.iter().map(Breakpoint::read);
        Ok(Self::Set {
            script: handle(members)?,
            breakpoints: breakpoints.collect::<Result<_, _>>()?,
        })
    }

    pub(super) fn command(members: &Members) -> Result<Self, String> {
        let name = text(members, "command")?;
        if !COMMANDS.contains(&name.as_str()) {
            return Err(format!("`command` is one of {}", COMMANDS.join(", ")));
        }
        let arguments = members.get("arguments").cloned();
        Ok(Self::Command {
            name,
            arguments: arguments.unwrap_or(Value::Null),
        })
    }

    pub(super) fn to_json(&self) -> Value {
        match self {
            Self::Set {
                script,
                breakpoints,
            } => {
                let all: Vec<Value> = breakpoints.iter().map(Breakpoint::to_json).collect();
                json!({ "do": "breakpoints", "handle": script, "breakpoints": all })
            }
            Self::Command { name, arguments } => {
                json!({ "do": "debug", "command": name, "arguments": arguments })
            }
        }
    }

    /// Whether it may change what scripts do afterwards: that would be missing in a capture of the run.
    pub(crate) fn may_change_variables(&self) -> bool {
        matches!(self, Self::Command { name, .. } if name == "evaluate" || name == "setVariable")
    }
}
