//! Rows from the comments of the Lua library: `--- text`, then `-- @api results = sim.name(parameters)`, `-- @param`, `-- @return`.

use crate::row::{Doc, FunctionDoc, ParameterDoc, ResultDoc};
use lua_library::FILES;

/// The category of each file of `lua/library/sim`.
const CATEGORIES: &[(&str, &str)] = &[
    ("sim/configuration", "Old names"),
    ("sim/data", "Custom data"),
    ("sim/deprecated", "Old names"),
    ("sim/matrix", "Properties"),
    ("sim/motion", "Motion"),
    ("sim/oldfunctions", "Old names"),
    ("sim/path", "Paths"),
    ("sim/pathobject", "Paths"),
    ("sim/pose", "Motion"),
    ("sim/property", "Properties"),
    ("sim/removed", "Removed from CoppeliaSim"),
    ("sim/script", "Scripts"),
    ("sim/shape", "Shapes"),
    ("sim/thread", "Threads"),
    ("sim/serial", "Serial ports"),
    ("sim/tree", "Object tree"),
];

/// The functions of the library's files.
pub(crate) fn functions() -> Vec<FunctionDoc> {
    api::SIM
        .member_files(FILES)
        .flat_map(|(module, source)| in_file(module, source))
        .collect()
}

/// The functions that the Lua part of a module describes: any comment with `@api module.name(...)`, and calls of `declare` with
/// such a declaration. A class of the module may be named instead of the module.
pub(crate) fn in_module(module: &str, source: &str) -> Vec<FunctionDoc> {
    let mut found = Vec::new();
    for (comment, line) in comments(source) {
        let declarations = annotated(&comment).chain(declared(line));
        found.extend(
            declarations.filter_map(|declaration| described(module, module, declaration, &comment)),
        );
    }
    found
}

/// The comments of a source, each with the line below it.
fn comments(source: &str) -> impl Iterator<Item = (Vec<&str>, &str)> {
    let mut lines = source.lines().chain([""]);
    std::iter::from_fn(move || {
        let mut comment = Vec::new();
        loop {
            let line = lines.next()?;
            if !line.starts_with("--") {
                return Some((comment, line));
            }
            comment.push(line.trim_start_matches('-').trim());
        }
    })
}

/// The declarations in a comment.
fn annotated<'a>(comment: &[&'a str]) -> impl Iterator<Item = &'a str> {
    comment.iter().filter_map(|line| line.strip_prefix("@api "))
}

/// The declaration that a line passes to `declare`.
fn declared(line: &str) -> Option<&str> {
    Some(line.strip_prefix("declare('")?.split_once('\'')?.0)
}

fn in_file(module: &str, source: &str) -> Vec<FunctionDoc> {
    let category = CATEGORIES
        .iter()
        .find(|(name, _)| *name == module)
        .map_or("Other", |(_, category)| category);
    let mut found = Vec::new();
    for (comment, _) in comments(source).filter(|(_, line)| line.starts_with("function M.")) {
        let declarations = annotated(&comment);
        found.extend(
            declarations
                .filter_map(|declaration| described("sim", category, declaration, &comment)),
        );
    }
    found
}

/// The parameters of a declaration, by name.
#[cfg(test)]
fn parameter_names(declaration: &str) -> impl Iterator<Item = &str> {
    let parameters = declaration
        .split_once('(')
        .map_or("", |(_, parameters)| parameters.trim_end_matches(')'));
    split_list(parameters).into_iter().map(|text| parts(text).1)
}

/// `int result = module.name(int parameter)`, with the comment above it.
fn described(
    module: &str,
    category: &str,
    declaration: &str,
    comment: &[&str],
) -> Option<FunctionDoc> {
    let (head, parameters) = declaration.split_once('(')?;
    let (results, name) = head.split_once(" = ").unwrap_or(("", head));
    if !belongs(module, name) {
        return None;
    }
    let prose: Vec<&str> = comment
        .iter()
        .copied()
        .filter(|line| !line.starts_with("@api "))
        .collect();
    let doc = Doc::parse(&prose.join("\n"));
    let parameters = split_list(parameters.trim_end().strip_suffix(')')?);
    Some(FunctionDoc {
        name: name.to_owned(),
        category: category.to_owned(),
        parameters: parameters
            .iter()
            .map(|text| parameter(text, &doc))
            .collect(),
        results: split_list(results)
            .iter()
            .map(|text| result(text, &doc))
            .collect(),
        text: doc.text,
        alias_of: None,
        deprecated: None,
    })
}

/// `module.name`, `module:name`, and `Class:name` for the classes of a module.
fn belongs(module: &str, name: &str) -> bool {
    let is_class = name.starts_with(char::is_uppercase) && name.contains(':');
    is_class
        || name
            .strip_prefix(module)
            .is_some_and(|rest| rest.starts_with(['.', ':']))
}

fn parameter(text: &str, doc: &Doc) -> ParameterDoc {
    let (ty, name, default) = parts(text);
    ParameterDoc {
        name: name.to_owned(),
        ty: ty.to_owned(),
        default: default.map(str::to_owned),
        text: doc.of_parameter(name),
    }
}

/// Type, name and default of `int objectHandle = -1`, or `...`.
fn parts(text: &str) -> (&str, &str, Option<&str>) {
    let (declared, default) = match text.split_once('=') {
        Some((declared, default)) => (declared.trim(), Some(default.trim())),
        None => (text, None),
    };
    let (ty, name) = declared.rsplit_once(' ').unwrap_or(("any", declared));
    (ty, name, default)
}

fn result(text: &str, doc: &Doc) -> ResultDoc {
    let (ty, name) = text.rsplit_once(' ').unwrap_or((text, "result"));
    ResultDoc {
        name: name.to_owned(),
        ty: ty.to_owned(),
        text: doc.of_result(name),
    }
}

/// Splits at commas outside of braces and quotes.
fn split_list(text: &str) -> Vec<&str> {
    let (mut depth, mut is_quoted) = (0, false);
    let parts = text.split(move |c| {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            '\'' => is_quoted = !is_quoted,
            _ => {}
        }
        c == ',' && depth == 0 && !is_quoted
    });
    parts
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{FILES, annotated, comments, declared, in_file, parameter_names};

    #[test]
    fn reads_a_comment() {
        let text = "--- Waits.\n-- Long.\n-- @api float left = sim.wait(float dt, int[2] v = {1, 2}, ...)\n-- @param dt seconds\n\
                    -- @return left overshoot\nfunction M.wait() end\n";
        let [function] = &in_file("sim/thread", text)[..] else {
            panic!("one function")
        };
        assert_eq!(
            function.signature(),
            "float left = sim.wait(float dt, int[2] v = {1, 2}, ...)"
        );
        assert_eq!(
            (function.text.as_str(), function.category.as_str()),
            ("Waits.\nLong.", "Threads")
        );
        assert_eq!(
            (
                function.parameters[0].text.as_str(),
                function.results[0].text.as_str()
            ),
            ("seconds", "overshoot")
        );
    }

    /// What each `@param` names that is no parameter of the function below: what the declarations of a comment say, or else the code.
    fn strays(source: &str) -> Vec<String> {
        let source: String = source
            .lines()
            .map(|line| line.trim_start().to_owned() + "\n")
            .collect();
        let mut strays = Vec::new();
        for (comment, line) in comments(&source) {
            let mut declarations: Vec<&str> = annotated(&comment).chain(declared(line)).collect();
            if declarations.is_empty() {
                let code = line
                    .split_once("function")
                    .and_then(|(_, code)| code.split_once(')'));
                declarations.extend(code.map(|(head, _)| head));
            }
            let known: Vec<&str> = declarations.into_iter().flat_map(parameter_names).collect();
            let named = comment
                .iter()
                .filter_map(|line| line.strip_prefix("@param")?.split_whitespace().next());
            strays.extend(
                named
                    .filter(|name| !known.contains(name))
                    .map(str::to_owned),
            );
        }
        strays
    }

    #[test]
    fn descriptions_name_parameters() {
        let mut described = 0;
        for (file, source) in FILES {
            described += source.matches("-- @param ").count();
            assert_eq!(
                strays(source),
                [""; 0],
                "lua/{file}.lua describes what is no parameter"
            );
        }
        assert!(described > 400, "{described} descriptions were read");
    }

    #[test]
    fn a_description_of_no_parameter_is_found() {
        let above = |line: &str| {
            strays(&format!(
                "--- Text.\n-- @param a one\n-- @param b, c two\n{line}"
            ))
        };
        assert_eq!(
            above("-- @api sim.f(int a, int[] b = {1}, int c)\nfunction M.f(b) end"),
            ["b,"]
        );
        assert_eq!(above("declare('simEigen.f(int a)', f)"), ["b,"]);
        assert_eq!(above("    local function f(c, a)"), ["b,"]);
        assert_eq!(above("local a = 1"), ["a", "b,"]);
    }
}
