//! Rows from the comments of the Lua library: `--- text`, then `-- @api results = sim.name(parameters)`, `-- @param`, `-- @return`.

use super::row::{Doc, Function, Parameter, Returned};
use lua_library::FILES;

/// The category of each file of `lua/library/sim`.
const CATEGORIES: &[(&str, &str)] = &[
    ("sim/data", "Custom data"),
    ("sim/deprecated", "Old names"),
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
pub(super) fn functions() -> Vec<Function> {
    api::SIM.member_files(FILES).flat_map(|(module, source)| in_file(module, source)).collect()
}

/// The functions that the Lua part of a module describes: any comment with `@api module.name(...)`, and calls of `declare` with
/// such a declaration. A class of the module may be named instead of the module.
pub(super) fn in_module(module: &str, source: &str) -> Vec<Function> {
    let mut comment: Vec<&str> = Vec::new();
    let mut found = Vec::new();
    for line in source.lines().chain([""]) {
        if line.starts_with("--") {
            comment.push(line.trim_start_matches('-').trim());
            continue;
        }
        let declarations = annotated(&comment).chain(declared(line));
        found.extend(declarations.filter_map(|declaration| described(module, module, declaration, &comment)));
        comment.clear();
    }
    found
}

/// The declarations in a comment.
fn annotated<'a>(comment: &[&'a str]) -> impl Iterator<Item = &'a str> {
    comment.iter().filter_map(|line| line.strip_prefix("@api "))
}

/// The declaration that a line passes to `declare`.
fn declared(line: &str) -> Option<&str> {
    Some(line.strip_prefix("declare('")?.split_once('\'')?.0)
}

fn in_file(module: &str, source: &str) -> Vec<Function> {
    let category = CATEGORIES.iter().find(|(name, _)| *name == module).map_or("Other", |(_, category)| category);
    let mut comment: Vec<&str> = Vec::new();
    let mut found = Vec::new();
    for line in source.lines() {
        if let Some(text) = line.strip_prefix("---").or_else(|| line.strip_prefix("--")) {
            comment.push(text.trim());
            continue;
        }
        if line.starts_with("function M.") {
            found.extend(
                annotated(&comment).filter_map(|declaration| described("sim", category, declaration, &comment)),
            );
        }
        comment.clear();
    }
    found
}

/// `int result = module.name(int parameter)`, with the comment above it.
fn described(module: &str, category: &str, declaration: &str, comment: &[&str]) -> Option<Function> {
    let (head, parameters) = declaration.split_once('(')?;
    let (results, name) = head.split_once(" = ").unwrap_or(("", head));
    if !belongs(module, name) {
        return None;
    }
    let prose: Vec<&str> = comment.iter().copied().filter(|line| !line.starts_with("@api ")).collect();
    let doc = Doc::parse(&prose.join("\n"));
    let parameters = split_list(parameters.trim_end().strip_suffix(')')?);
    Some(Function {
        name: name.to_owned(),
        category: category.to_owned(),
        parameters: parameters.iter().map(|text| parameter(text, &doc)).collect(),
        results: split_list(results).iter().map(|text| result(text, &doc)).collect(),
        text: doc.text,
        alias_of: None,
        deprecated: None,
    })
}

/// `module.name`, `module:name`, and `Class:name` for the classes of a module.
fn belongs(module: &str, name: &str) -> bool {
    let is_class = name.starts_with(char::is_uppercase) && name.contains(':');
    is_class || name.strip_prefix(module).is_some_and(|rest| rest.starts_with(['.', ':']))
}

/// `int objectHandle = -1`, or `...`.
fn parameter(text: &str, doc: &Doc) -> Parameter {
    let (declared, default) = match text.split_once('=') {
        Some((declared, default)) => (declared.trim(), Some(default.trim().to_owned())),
        None => (text, None),
    };
    let (ty, name) = declared.rsplit_once(' ').unwrap_or(("any", declared));
    Parameter { name: name.to_owned(), ty: ty.to_owned(), default, text: doc.of_parameter(name) }
}

fn result(text: &str, doc: &Doc) -> Returned {
    let (ty, name) = text.rsplit_once(' ').unwrap_or((text, "result"));
    Returned { name: name.to_owned(), ty: ty.to_owned(), text: doc.of_result(name) }
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
    parts.map(str::trim).filter(|part| !part.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::in_file;

    #[test]
    fn reads_a_comment() {
        let text = "--- Waits.\n-- Long.\n-- @api float left = sim.wait(float dt, int[2] v = {1, 2}, ...)\n-- @param dt seconds\n\
                    -- @return left overshoot\nfunction M.wait() end\n";
        let [function] = &in_file("sim/thread", text)[..] else { panic!("one function") };
        assert_eq!(function.signature(), "float left = sim.wait(float dt, int[2] v = {1, 2}, ...)");
        assert_eq!((function.text.as_str(), function.category.as_str()), ("Waits.\nLong.", "Threads"));
        assert_eq!((function.parameters[0].text.as_str(), function.results[0].text.as_str()), ("seconds", "overshoot"));
    }
}
