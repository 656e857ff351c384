//! The pages of the modules: what each is for, and its functions.

use std::fmt::Write as _;

use super::markdown;
use super::row::FunctionDoc;
use super::stubs::modules as module_stubs;
use lua_library::FILES;
use modules::ALL;

/// Files of the library for its own use.
const INNER: &[&str] = &[
    "base",
    "checkargs/check",
    "debug_names",
    "deprecate",
    "json_scanner",
    "loaders",
    "defaultMainScript",
    "functional/functions",
    "luassert/arguments",
    "luassert/array",
    "luassert/assert",
    "luassert/assertions",
    "luassert/chain",
    "luassert/core",
    "luassert/errors",
    "luassert/failure",
    "luassert/formatters",
    "luassert/keys",
    "luassert/languages/en",
    "luassert/matchers",
    "luassert/modifiers",
    "luassert/say",
    "luassert/state",
    "main",
    "mathx/functions",
    "matrix/core",
    "matrix/globals",
    "matrix/linear",
    "matrix/maths",
    "matrix/space",
    "old_calls",
    "org/conman/cbor_tags",
    "remote/namespaces",
    "remote/ws_codecs",
    "remote/zmq_answers",
    "remote/zmq_arguments",
    "remote/zmq_clients",
    "remote/zmq_functions",
    "remote/link",
    "remote/ros2/entities",
    "remote/ros2/initial_state",
    "remote/ros2/lockstep",
    "remote/ros2/results",
    "remote/ros2/robot/body",
    "remote/ros2/robot/camera",
    "remote/ros2/robot/clouds",
    "remote/ros2/robot/drive",
    "remote/ros2/robot/forward",
    "remote/ros2/robot/frames",
    "remote/ros2/robot/imu",
    "remote/ros2/robot/joints",
    "remote/ros2/robot/lidar",
    "remote/ros2/robot/mount",
    "remote/ros2/robot/odometry",
    "remote/ros2/robot/topics",
    "remote/ros2/robot/trajectory",
    "remote/ros2/robots",
    "remote/ros2/spawning",
    "remote/ros2/worlds",
    "remote/zmq_steps",
    "remote/zmq_waits",
    "captured",
    "restricted",
    "seal",
    "shared_process",
    "simEigen/matrix",
    "simEigen/matrix_parts",
    "simEigen/pose",
    "simEigen/quaternion",
    "simIK/callbacks",
    "simIK/configs",
    "simIK/overlays",
    "simIK/paths",
    "simZMQ/proxy",
    "stringx/functions",
    "swanilda/calls",
    "swanilda/console",
    "swanilda/display",
    "swanilda/conveyors/along",
    "swanilda/conveyors/belt",
    "swanilda/conveyors/control",
    "swanilda/conveyors/parts",
    "swanilda/extensions",
    "swanilda/implicit",
    "swanilda/modload",
    "swanilda/object",
    "swanilda/old_helpers",
    "swanilda/pathmodel",
    "swanilda/paths/dialog",
    "swanilda/paths/line",
    "swanilda/paths/points",
    "swanilda/paths/sampling",
    "swanilda/python",
    "swanilda/quaternion",
    "swanilda/settings_window",
    "swanilda/test/faults",
    "swanilda/test/messages",
    "swanilda/test/properties",
    "swanilda/test/recordings",
    "swanilda/test/scripts",
    "swanilda/test/temporal",
    "swanilda/thread",
    "swanilda/trajectory",
    "tablex/functions",
    "var/functions",
];

/// `docs/api/modules.md`.
pub(super) fn page() -> String {
    let mut out =
        "# Modules\n\n[All categories](README.md)\n\nThe modules that `require` finds, except `sim`. Generated from \
                   `crates/modules` and `lua`.\n"
            .to_owned();
    for (name, source) in public() {
        let module = name.replace('/', ".");
        let _ = write!(out, "\n## {module}\n\n{}\n", summary(&module));
        match described(&module).len() {
            0 => out.push_str(&section(details(&module), source)),
            count => drop(write!(out, "\n[{count} functions]({module}.md)\n")),
        }
    }
    out
}

/// A page for each module whose functions are described with types: path and text.
pub(super) fn own_pages() -> Vec<(String, String)> {
    let pages = public().filter_map(|(name, _)| {
        let module = name.replace('/', ".");
        let functions = described(&module);
        if functions.is_empty() {
            return None;
        }
        let text = own_page(&module, &functions);
        Some((format!("docs/api/{module}.md"), text))
    });
    pages.collect()
}

fn own_page(module: &str, functions: &[FunctionDoc]) -> String {
    let summary = summary(module);
    let mut out = format!(
        "# {module}\n\n[All modules](modules.md)\n\n{summary}\n{}",
        section(details(module), "")
    );
    for function in functions {
        let _ = write!(
            out,
            "\n## {}\n\n{}",
            function.name,
            markdown::body(function)
        );
    }
    out
}

/// The functions of a module, if types of some are known.
fn described(module: &str) -> Vec<FunctionDoc> {
    let functions = module_stubs::of_module(module);
    if functions.iter().any(FunctionDoc::is_typed) {
        functions
    } else {
        Vec::new()
    }
}

/// The names of the modules.
pub(super) fn names() -> impl Iterator<Item = String> {
    public().map(|(name, _)| name.replace('/', "."))
}

/// Path below `lua` and text of every module for scripts.
pub(super) fn public() -> impl Iterator<Item = (String, &'static str)> {
    let files = FILES
        .iter()
        .filter(|(name, _)| !name.starts_with("sim/") && !INNER.contains(name));
    let native = ALL
        .iter()
        .filter(|module| module.name != "sim" && module.public_functions().next().is_some());
    let paths = native.map(|module| module.name.replace('.', "/"));
    let native = paths
        .filter(|path| !FILES.iter().any(|(name, _)| name == path))
        .map(|path| (path, ""));
    files
        .map(|&(name, source)| (name.to_owned(), source))
        .chain(native)
}

/// Summary of a module.
pub(super) fn summary(module: &str) -> &'static str {
    match about(module) {
        "" => head(source_of(module))
            .split("\n\n")
            .next()
            .unwrap_or_default(),
        about => about,
    }
}

/// Further description: the rest of the head of its Lua part.
pub(super) fn details(module: &str) -> &'static str {
    let head = head(source_of(module));
    match about(module) {
        "" => head.split_once("\n\n").map_or("", |(_, rest)| rest),
        _ => head,
    }
}

fn about(module: &str) -> &'static str {
    ALL.iter()
        .find(|of| of.name == module)
        .map_or("", |of| of.about)
}

/// The Lua part of a module; empty without one.
pub(super) fn source_of(module: &str) -> &'static str {
    let path = module.replace('.', "/");
    public()
        .find(|(known, _)| *known == path)
        .map_or("", |(_, source)| source)
}

/// The files that a module loads from the folder of its name.
pub(super) fn parts(module: &str) -> impl Iterator<Item = &'static str> {
    let folder = module.replace('.', "/") + "/";
    FILES
        .iter()
        .filter(move |(name, _)| name.starts_with(&folder) && INNER.contains(name))
        .map(|(_, source)| *source)
}

/// The comment a file begins with.
pub(super) fn head(source: &str) -> &str {
    source
        .strip_prefix("--[[")
        .and_then(|rest| rest.split_once("]]"))
        .map_or("", |(head, _)| head)
        .trim()
}

/// Details as they are, and the list of functions of a source.
fn section(details: &str, source: &str) -> String {
    let mut out = String::new();
    if !details.is_empty() {
        let _ = write!(out, "\n```text\n{details}\n```\n");
    }
    let functions: String = functions(source).collect();
    if !functions.is_empty() {
        let _ = write!(out, "\n{functions}");
    }
    out
}

/// A line for each function below a comment of three dashes.
fn functions(source: &str) -> impl Iterator<Item = String> {
    let lines: Vec<&str> = source.lines().collect();
    let starts: Vec<usize> = (0..lines.len())
        .filter(|&i| lines[i].starts_with("---") && !lines[i].starts_with("----"))
        .collect();
    starts.into_iter().filter_map(move |start| {
        let end = (start..lines.len()).find(|&i| !lines[i].starts_with("--"))?;
        let declaration = lines[end].strip_prefix("function ")?.split_once(')')?.0;
        let text: Vec<&str> = lines[start..end]
            .iter()
            .map(|line| line.trim_start_matches('-').trim())
            .collect();
        let name = declaration
            .split_once(['.', ':'])
            .map_or(declaration, |(_, name)| name);
        Some(format!("- `{name})`: {}\n", text.join(" ")))
    })
}

#[cfg(test)]
mod tests {
    use super::section;

    #[test]
    fn details_and_comments_make_a_section() {
        let source =
            "local M = {}\n\n--- The sum\n-- of both.\nfunction M.add(a, b) return a + b end\n";
        assert_eq!(
            section("Not more.", source),
            "\n```text\nNot more.\n```\n\n- `add(a, b)`: The sum of both.\n"
        );
    }
}
