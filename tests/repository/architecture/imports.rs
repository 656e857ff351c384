//! What the sources import, read as text.

use std::fs;
use std::path::{Path, PathBuf};

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub fn relative(file: &Path) -> &Path {
    file.strip_prefix(root())
        .expect("sources lie below the root")
}

pub fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("sources are readable")
}

/// Every Rust file of the command and of the crates.
pub fn sources() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates"))
        .expect("crates is readable")
        .flatten();
    let folders = crates
        .map(|folder| folder.path().join("src"))
        .filter(|folder| folder.is_dir());
    rust_files(folders.chain([root().join("src")]).collect())
}

fn rust_files(mut pending: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files = Vec::new();
    while let Some(dir) = pending.pop() {
        for path in fs::read_dir(&dir)
            .expect("sources are readable")
            .flatten()
            .map(|entry| entry.path())
        {
            if path.is_dir() {
                pending.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Whether a file consists of tests.
pub fn is_test(file: &Path) -> bool {
    relative(file)
        .components()
        .any(|part| matches!(part.as_os_str().to_str(), Some("tests" | "tests.rs")))
}

/// A text up to its tests, which stand last.
pub fn without_tests(text: &str) -> String {
    text.split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or(text)
        .to_owned()
}

/// The crate of a file below `crates`, by the name of its folder.
pub fn crate_of(file: &Path) -> Option<String> {
    let name = relative(file)
        .strip_prefix("crates")
        .ok()?
        .components()
        .next()?;
    name.as_os_str().to_str().map(str::to_owned)
}

/// The module a file is: its crate, and the names from the root of the crate on. Empty for the command.
pub fn module_path(file: &Path) -> Vec<String> {
    let Some(name) = crate_of(file) else {
        return Vec::new();
    };
    let path = relative(file).with_extension("");
    let below = path
        .components()
        .skip_while(|part| part.as_os_str() != "src")
        .skip(1);
    let names = below.filter_map(|part| part.as_os_str().to_str().map(str::to_owned));
    [name]
        .into_iter()
        .chain(names.filter(|name| name != "mod" && name != "lib"))
        .collect()
}

/// The rooms of its crate that code in the module `path` names: by `crate::room` and by `super::room`.
pub fn rooms_used(text: &str, path: &[String]) -> Vec<String> {
    let code: String = code_lines(text).collect::<Vec<_>>().join("\n");
    let mut names = names_after(&code, "crate::");
    names.extend(names_after(&code, &"super::".repeat(path.len() - 1)));
    names
}

/// What follows each `prefix` that begins a path in the code: `prefix::a` and `prefix::{a, b::c}`.
fn names_after(code: &str, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        if code[..at].ends_with(['$', ':'])
            || code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_')
        {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        match rest.strip_prefix('{') {
            Some(group) => names.extend(top_level_names(group)),
            None => names.push(identifier(rest)),
        }
    }
    names
}

/// The first names of a use group, up to its closing brace.
fn top_level_names(group: &str) -> Vec<String> {
    let mut depth = 0;
    let mut names = Vec::new();
    let mut item = 0;
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(identifier(group[item..at].trim_start()));
                item = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

fn identifier(text: &str) -> String {
    text.chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

pub fn code_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
}

/// A line of code without what stands between quotes.
pub fn without_texts(line: &str) -> String {
    line.split('"').step_by(2).collect::<Vec<_>>().join("\"")
}

pub fn has_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !c.is_alphanumeric() && c != '_')
        .any(|part| part == word)
}
