//! The page of the Lua modules: what stands at the head of each file, and the functions in it that have a comment.

use std::fmt::Write as _;

use crate::script::FILES;

/// Files of the library for its own use.
const INNER: &[&str] = &[
    "base",
    "deprecate",
    "json_scanner",
    "coverage_loaders",
    "defaultMainScript",
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
    "matrix/core",
    "matrix/linear",
    "matrix/maths",
    "matrix/space",
    "no_unsafe",
    "old_calls",
    "org/conman/cbor_tags",
    "remote/namespaces",
    "remote/restrict",
    "remote/ws_codecs",
    "remote/zmq_answers",
    "remote/zmq_arguments",
    "remote/zmq_clients",
    "remote/zmq_functions",
    "shared_process",
    "simZMQ/constants",
    "simZMQ/proxy",
    "swanilda/console",
    "swanilda/display",
    "swanilda/modload",
    "swanilda/pathmodel",
    "swanilda/quaternion",
    "swanilda/test/recordings",
    "swanilda/trajectory",
];

/// `docs/api/modules.md`.
pub(super) fn page() -> String {
    let mut out = "# Modules\n\n[All categories](README.md)\n\nWhat `require` finds beside `sim`. Generated from the heads of the files in \
                   `lua`.\n"
        .to_owned();
    for (name, source) in public() {
        let _ = write!(out, "\n## {}\n\n{}", name.replace('/', "."), section(source));
    }
    out
}

/// The names of the modules.
pub(super) fn names() -> impl Iterator<Item = String> {
    public().map(|(name, _)| name.replace('/', "."))
}

/// Path below `lua` and text of every module for scripts.
pub(super) fn public() -> impl Iterator<Item = (&'static str, &'static str)> {
    FILES.iter().copied().filter(|(name, _)| !name.starts_with("sim/") && !INNER.contains(name))
}

/// The comment a file begins with.
pub(super) fn head(source: &str) -> &str {
    source.strip_prefix("--[[").and_then(|rest| rest.split_once("]]")).map_or("", |(head, _)| head).trim()
}

/// The first paragraph of the head as text, the rest as it stands, and the list of functions.
fn section(source: &str) -> String {
    let head = head(source);
    let (summary, rest) = head.split_once("\n\n").unwrap_or((head, ""));
    let mut out = format!("{summary}\n");
    if !rest.is_empty() {
        let _ = write!(out, "\n```text\n{rest}\n```\n");
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
    let starts: Vec<usize> =
        (0..lines.len()).filter(|&i| lines[i].starts_with("---") && !lines[i].starts_with("----")).collect();
    starts.into_iter().filter_map(move |start| {
        let end = (start..lines.len()).find(|&i| !lines[i].starts_with("--"))?;
        let declaration = lines[end].strip_prefix("function ")?.split_once(')')?.0;
        let text: Vec<&str> = lines[start..end].iter().map(|line| line.trim_start_matches('-').trim()).collect();
        let name = declaration.split_once(['.', ':']).map_or(declaration, |(_, name)| name);
        Some(format!("- `{name})`: {}\n", text.join(" ")))
    })
}

#[cfg(test)]
mod tests {
    use super::section;

    #[test]
    fn heads_and_comments_make_a_section() {
        let source = "--[[\nAdds.\n\nNot more.\n]]\nlocal M = {}\n\n--- The sum\n-- of both.\nfunction M.add(a, b) return a + b end\n";
        assert_eq!(section(source), "Adds.\n\n```text\nNot more.\n```\n\n- `add(a, b)`: The sum of both.\n");
    }
}
