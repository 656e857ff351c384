//! What helps people with an error, beside its words: which are CoppeliaSim's, since scripts compare them.

use super::{Script, Sim};
use crate::binding::registry::member_by_rule;
use crate::log::missed::Missed;
use crate::log::suggestion::nearest;
use scene::SceneError;

/// The words with which Lua begins when a function is called that is not there.
const NIL_CALL: &str = "attempt to call a nil value (";

impl Sim {
    /// What else is known about the error of a script; empty where nothing is.
    pub(super) fn hint(&self, script: &Script, error: &str) -> String {
        match self.log.take_missed() {
            Some(Missed::Object(path)) if error.contains(&SceneError::NoSuchPath.to_string()) => {
                self.object_hint(&path)
            }
            Some(Missed::File(name)) if error.contains("file does not exist.") => {
                self.file_hint(&name)
            }
            Some(Missed::Argument { function, wrong })
                if error.contains(&format!("in {function}: ")) =>
            {
                format!("{function}: {wrong}")
            }
            _ => self.misspelling_hint(script, error).unwrap_or_default(),
        }
    }

    fn object_hint(&self, path: &str) -> String {
        let (scene, is_relative) = (self.scene.borrow(), !path.starts_with('/'));
        let paths = scene
            .objects()
            .filter_map(|object| scene.short_path(object.handle()).ok());
        // Relative paths have the name at their end in common with that of the object.
        let compared = |path: &str| match path.strip_prefix('/') {
            Some(rest) if !is_relative => rest.to_owned(),
            _ => path.rsplit('/').next().unwrap_or_default().to_owned(),
        };
        match nearest(
            &compared(path),
            paths.map(|known| (compared(&known), known)),
        ) {
            Some(near) => format!("no object '{path}'; did you mean '{near}'?"),
            None => format!("no object '{path}'"),
        }
    }

    fn file_hint(&self, name: &str) -> String {
        let is_relative = !name.starts_with('/');
        match &self.options.resources {
            Some(folder) if is_relative => {
                format!("no file '{name}', neither here nor in {}", folder.display())
            }
            None if is_relative => format!(
                "no file '{name}'; models of a CoppeliaSim that you have are found with --resources DIR, its folder"
            ),
            _ => format!("no file '{name}'"),
        }
    }

    /// The function of a module whose name is nearly the one that was called.
    fn misspelling_hint(&self, script: &Script, error: &str) -> Option<String> {
        let (place, called) = error.split_once(NIL_CALL)?;
        let (kind, name) = called.split_once('\'')?;
        let name = name.split_once('\'')?.0;
        if kind == "global " {
            return self.nearest_member("sim", &member_by_rule(name)?);
        }
        if !["field ", "method "].contains(&kind) {
            return None;
        }
        let number: usize = place
            .trim_end_matches(": ")
            .rsplit(':')
            .next()?
            .parse()
            .ok()?;
        let (code, _) = script.code(&self.scene.borrow());
        let code = String::from_utf8_lossy(&code);
        let table = table_before(code.lines().nth(number.checked_sub(1)?)?, name)?;
        self.nearest_member(module_called(&code, table), name)
    }

    fn nearest_member(&self, module: &str, name: &str) -> Option<String> {
        if module == "sim-2" {
            return Some("sim-2 belongs to CoppeliaSim 4.11, the version after 4.10: here it has the functions of sim, and no objects".into());
        }
        let namespace = self.modules.registry.module(module)?;
        let names = namespace.names().into_iter();
        let near = nearest(name, names.map(|name| (name.to_owned(), name.to_owned())))?;
        Some(format!("{module} has no '{name}'; did you mean '{near}'?"))
    }
}

/// The name before `.NAME` or `:NAME` in a line.
fn table_before<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let end = ['.', ':']
        .iter()
        .find_map(|dot| line.find(&format!("{dot}{name}")))?;
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let start = line[..end]
        .rfind(|c: char| !is_letter(c))
        .map_or(0, |at| at + 1);
    (start < end).then(|| &line[start..end])
}

/// The module that a variable holds: what the code requires for it, else the one with its name.
fn module_called<'a>(code: &'a str, variable: &'a str) -> &'a str {
    let required = code.lines().find_map(|line| {
        let (left, right) = line.split_once('=')?;
        let is_it = left.split_whitespace().last() == Some(variable);
        let quoted = right.trim().strip_prefix("require").filter(|_| is_it)?;
        quoted.split(['\'', '"']).nth(1)
    });
    required.unwrap_or(variable)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_a_call() {
        assert_eq!(
            table_before("  x = sim.getObjekt('/a')", "getObjekt"),
            Some("sim")
        );
        assert_eq!(table_before("getObjekt()", "getObjekt"), None);
        assert_eq!(table_before("f().getObjekt()", "getObjekt"), None);
    }

    #[test]
    fn the_module_of_a_variable() {
        let code = "local ik = require('simIK')\nlocal s=require 'sim'";
        assert_eq!(module_called(code, "ik"), "simIK");
        assert_eq!(module_called(code, "s"), "sim");
        assert_eq!(module_called(code, "simUI"), "simUI");
    }
}
