//! Lua expressions and statements of a declaration: functions of a script that each simulator has for them.

use scene::Data;
use simulator::{ScriptKind, ScriptRef, Simulator};

use crate::declaration::{Action, Declaration, Quantity, Target};

/// The script. `compile` gives a text a number, `run` runs it.
const SCRIPT: &str = r"
sim = require 'sim'
local functions = {}

function compile(name, head, text)
    local compiled, reason = load(head .. ' ' .. text, '=' .. name)
    if not compiled then error(reason, 0) end
    functions[#functions + 1] = compiled
    return #functions
end

function run(number, ...)
    return functions[number](...)
end
";

/// The script of a simulator; none where nothing is declared in Lua, so that it costs nothing.
pub struct Expressions(Option<ScriptRef>);

impl Expressions {
    /// No expressions.
    pub fn none() -> Self {
        Self(None)
    }

    /// Adds the script.
    ///
    /// # Errors
    /// When it cannot be added.
    pub fn new(simulator: &mut Simulator) -> Result<Self, String> {
        let script = simulator.add_script(ScriptKind::AddOn, "vector", SCRIPT.as_bytes());
        Ok(Self(Some(script.map_err(|error| error.to_string())?)))
    }

    /// The script for what is declared, if anything is in Lua; its preparation has run.
    pub(crate) fn declared(
        simulator: &mut Simulator,
        declaration: &Declaration,
    ) -> Result<Self, String> {
        if !is_needed(declaration) {
            return Ok(Self::none());
        }
        let expressions = Self::new(simulator)?;
        if let Some(text) = &declaration.prepare {
            let number = expressions.compile(simulator, "the preparation", "", text)?;
            expressions.run(simulator, number, &[])?;
        }
        Ok(expressions)
    }

    fn script(&self) -> Result<&ScriptRef, String> {
        let script = self.0.as_ref();
        script.ok_or_else(|| "there is no Lua in this declaration.".to_owned())
    }

    /// The number of a text with what stands before it; `name` is what errors call it.
    ///
    /// # Errors
    /// When it is no Lua.
    pub fn compile(
        &self,
        simulator: &mut Simulator,
        name: &str,
        head: &str,
        text: &str,
    ) -> Result<i64, String> {
        let args = [name, head, text].map(Data::text);
        let number = simulator.call(self.script()?, "compile", &args);
        match number.map_err(|error| error.to_string())?.first() {
            Some(Data::Int(number)) => Ok(*number),
            _ => Err(format!("{name} has no number.")),
        }
    }

    /// Runs a text.
    ///
    /// # Errors
    /// The text's own.
    pub fn run(
        &self,
        simulator: &mut Simulator,
        number: i64,
        args: &[Data],
    ) -> Result<Vec<Data>, String> {
        let args = [&[Data::Int(number)], args].concat();
        let results = simulator.call(self.script()?, "run", &args);
        results.map_err(|error| error.to_string())
    }
}

/// Whether anything is declared in Lua.
fn is_needed(declaration: &Declaration) -> bool {
    let texts = [
        &declaration.reward,
        &declaration.terminated,
        &declaration.prepare,
        &declaration.begin,
    ];
    let mut quantities = declaration.observations.iter().chain(&declaration.infos);
    let (mut actions, mut variations) = (declaration.actions.iter(), declaration.variations.iter());
    texts.into_iter().any(Option::is_some)
        || quantities.any(|quantity| matches!(quantity, Quantity::Expression(_)))
        || actions.any(|action| matches!(action, Action::Statement(_)))
        || variations.any(|variation| matches!(variation.target, Target::Statement(_)))
}
