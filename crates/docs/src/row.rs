//! A function as described by its documentation.

use api::ApiFn;

/// One documented function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FunctionDoc {
    /// `sim.name`, or a bare name for globals.
    pub name: String,
    /// The heading it is listed under.
    pub category: String,
    /// Its description, in one or several lines.
    pub text: String,
    /// Its parameters in the order of the call.
    pub parameters: Vec<ParameterDoc>,
    /// Its results in their order.
    pub results: Vec<ResultDoc>,
    /// The name this one is another word for.
    pub alias_of: Option<String>,
    /// Its replacement; empty without one.
    pub deprecated: Option<String>,
}

/// A parameter; `...` takes all that follow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParameterDoc {
    /// Its name, as scripts know it.
    pub name: String,
    /// Its type, in the notation of the reference.
    pub ty: String,
    /// The value when left out; None when it must be given.
    pub default: Option<String>,
    /// Its description; empty without one.
    pub text: String,
}

/// A result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultDoc {
    /// Its name.
    pub name: String,
    /// Its type, in the notation of the reference.
    pub ty: String,
    /// Its description; empty without one.
    pub text: String,
}

impl FunctionDoc {
    /// From the row `#[api]` made.
    pub(super) fn native(category: &str, function: &ApiFn) -> Self {
        let doc = Doc::parse(function.doc);
        let parameters = function.params.iter().map(|param| ParameterDoc {
            name: param.name.to_owned(),
            ty: param.ty.to_owned(),
            default: param.default.map(|default| default.text()),
            text: doc.of_parameter(param.name),
        });
        Self {
            name: function.name.to_owned(),
            category: category.to_owned(),
            parameters: parameters.collect(),
            results: doc.results(function.returns),
            text: doc.text,
            alias_of: None,
            deprecated: None,
        }
    }

    /// A function of which only the names of its parameters are known.
    pub(super) fn untyped(name: String, category: &str, parameters: &[String], text: &str) -> Self {
        let parameter = |name: &String| ParameterDoc {
            name: name.clone(),
            ty: "any".to_owned(),
            default: None,
            text: String::new(),
        };
        Self {
            name,
            category: category.to_owned(),
            parameters: parameters.iter().map(parameter).collect(),
            results: Vec::new(),
            text: text.to_owned(),
            alias_of: None,
            deprecated: None,
        }
    }

    /// Whether types are known, be it of parameters or of results.
    pub(super) fn is_typed(&self) -> bool {
        !self.results.is_empty()
            || self
                .parameters
                .iter()
                .any(|parameter| parameter.ty != "any")
    }

    /// The same function by another name.
    pub(super) fn renamed(&self, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            alias_of: Some(self.name.clone()),
            ..self.clone()
        }
    }

    /// The name without `sim.`.
    pub fn member(&self) -> &str {
        self.name.strip_prefix("sim.").unwrap_or(&self.name)
    }

    /// Whether it is for the library itself and not for scripts.
    pub(super) fn is_inner(&self) -> bool {
        self.member().starts_with('_')
    }

    /// `float[3] position = sim.getObjectPosition(int objectHandle, int relativeTo = sim.handle_world)`.
    pub fn signature(&self) -> String {
        let parameters: Vec<String> = self
            .parameters
            .iter()
            .map(ParameterDoc::declaration)
            .collect();
        let results: Vec<String> = self
            .results
            .iter()
            .map(|r| format!("{} {}", r.ty, r.name))
            .collect();
        let assignment = if results.is_empty() { "" } else { " = " };
        format!(
            "{}{assignment}{}({})",
            results.join(", "),
            self.name,
            parameters.join(", ")
        )
    }

    /// The first sentence.
    pub fn summary(&self) -> &str {
        let line = self.text.lines().next().unwrap_or_default();
        line.split_once(". ")
            .map_or(line, |(sentence, _)| sentence)
            .trim_end_matches('.')
    }
}

impl ParameterDoc {
    fn declaration(&self) -> String {
        match (&*self.name, &self.default) {
            ("...", _) => "...".to_owned(),
            (name, Some(default)) => format!("{} {name} = {default}", self.ty),
            (name, None) => format!("{} {name}", self.ty),
        }
    }
}

/// A doc comment taken apart.
pub(super) struct Doc {
    pub text: String,
    parameters: Vec<(String, String)>,
    returns: Vec<String>,
}

/// The name that a description begins with, and the rest.
fn named(line: &str) -> (String, String) {
    let (name, about) = line.split_once(' ').unwrap_or((line, ""));
    (name.to_owned(), about.trim().to_owned())
}

impl Doc {
    /// `@param name text` and `@return name text` lines stand apart from the text; lines after them continue them.
    pub(super) fn parse(doc: &str) -> Self {
        let (mut text, mut described): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
        let mut continues = false;
        for line in doc.lines().map(str::trim) {
            let begins = line.starts_with("@param ") || line.starts_with("@return ");
            continues = begins || continues && !line.is_empty();
            match described.last_mut() {
                _ if begins => described.push(line.to_owned()),
                Some(last) if continues => *last += &format!(" {line}"),
                _ => text.push(line),
            }
        }
        let all = described.iter();
        let parameters = all.clone().filter_map(|line| line.strip_prefix("@param "));
        let returns = all.filter_map(|line| line.strip_prefix("@return "));
        Self {
            text: text.join("\n").trim().to_owned(),
            parameters: parameters.map(named).collect(),
            returns: returns.map(|line| line.trim().to_owned()).collect(),
        }
    }

    pub(super) fn of_parameter(&self, name: &str) -> String {
        self.parameters
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, text)| text.clone())
            .unwrap_or_default()
    }

    /// Description of the result `name`.
    pub(super) fn of_result(&self, name: &str) -> String {
        let said = self
            .returns
            .iter()
            .filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
        said.collect::<Vec<_>>().join(" ")
    }

    /// Names and texts for results of these types: a line each, or one line with the names of all.
    fn results(&self, types: &[&str]) -> Vec<ResultDoc> {
        let types: Vec<&str> = types.iter().copied().filter(|ty| !ty.is_empty()).collect();
        let lines: Vec<&str> = match self.returns.as_slice() {
            [one] if types.len() > 1 => one.split(',').map(str::trim).collect(),
            lines => lines.iter().map(String::as_str).collect(),
        };
        let described = types.iter().enumerate().map(|(i, ty)| {
            let line = lines.get(i).copied().unwrap_or_default();
            let (name, text) = line.split_once(' ').unwrap_or((line, ""));
            let name = if name.is_empty() {
                "result"
            } else {
                name.trim_end_matches(',')
            };
            ResultDoc {
                name: name.to_owned(),
                ty: (*ty).to_owned(),
                text: text.trim().to_owned(),
            }
        });
        described.collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use modules::ALL;
    use script::literal;
    use script::pairs;

    #[test]
    fn a_constant_has_the_value_of_the_default_it_is_shown_for() {
        let constants = ALL.iter().flat_map(|of| {
            pairs(of.constants).map(|(name, value)| (format!("{}.{name}", of.name), value))
        });
        let mut constants: HashMap<String, &str> = constants.collect();
        constants.insert("math.pi".to_owned(), "3.141592653589793");
        let mut checked = 0;
        for function in ALL.iter().flat_map(|of| of.public_functions()) {
            for default in function.params.iter().filter_map(|param| param.default) {
                let Some(constant) = default.constant else {
                    continue;
                };
                let value = literal(&(default.value)());
                assert_eq!(
                    constants.get(constant),
                    Some(&value.as_str()),
                    "{}: {constant}",
                    function.name
                );
                checked += 1;
            }
        }
        assert!(checked > 30, "{checked} defaults are constants");
    }

    /// What an underscore or a capital means in Rust is of no concern to scripts.
    #[test]
    fn parameters_begin_with_a_small_letter() {
        let functions = ALL.iter().flat_map(|of| {
            of.public_functions()
                .chain(of.inner.iter().copied().flatten())
        });
        for function in functions {
            for name in function
                .params
                .iter()
                .map(|param| param.name)
                .filter(|name| *name != "...")
            {
                assert!(
                    name.starts_with(|first: char| first.is_ascii_lowercase()),
                    "{}: {name}",
                    function.name
                );
            }
        }
    }
}
