//! What the sources import, read as text.

use std::fs;
use std::path::{Path, PathBuf};

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub fn relative(file: &Path) -> &Path {
    file.strip_prefix(root()).expect("sources lie below the root")
}

pub fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("sources are readable")
}

/// Every Rust file below `src`.
pub fn sources() -> Vec<PathBuf> {
    rust_files(vec![root().join("src")])
}

/// Every Rust file of the crates below `crates`.
pub fn sources_of_crates() -> Vec<PathBuf> {
    rust_files(crates().iter().map(|folder| folder.join("src")).collect())
}

fn crates() -> Vec<PathBuf> {
    fs::read_dir(root().join("crates")).expect("crates is readable").flatten().map(|entry| entry.path()).collect()
}

fn rust_files(mut pending: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files = Vec::new();
    while let Some(dir) = pending.pop() {
        for path in fs::read_dir(&dir).expect("sources are readable").flatten().map(|entry| entry.path()) {
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

/// The names of all dependencies, of the package and of the crates, as code writes them.
pub fn dependencies() -> Vec<String> {
    let manifests = crates().into_iter().chain([root().to_owned()]).map(|folder| folder.join("Cargo.toml"));
    let mut names: Vec<String> = manifests.flat_map(|manifest| dependencies_of(&read(&manifest))).collect();
    names.sort();
    names.dedup();
    names
}

fn dependencies_of(manifest: &str) -> Vec<String> {
    let section = manifest.lines().skip_while(|line| *line != "[dependencies]").skip(1);
    let lines = section.take_while(|line| !line.starts_with('['));
    let name = |line: &str| line.split(['.', '=', ' ']).next().unwrap_or("").replace('-', "_");
    lines.map(name).filter(|name| !name.is_empty() && !name.starts_with('#')).collect()
}

/// Whether a file consists of tests.
pub fn is_test(file: &Path) -> bool {
    relative(file).components().any(|part| matches!(part.as_os_str().to_str(), Some("tests" | "tests.rs")))
}

/// A text up to its tests, which stand last.
pub fn without_tests(text: &str) -> String {
    text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(text).to_owned()
}

/// The module a file is, as names from the layer on.
pub fn module_path(file: &Path) -> Vec<String> {
    let path = relative(file).with_extension("");
    let names = path.components().skip(1).filter_map(|part| part.as_os_str().to_str().map(str::to_owned));
    names.filter(|name| name != "mod").collect()
}

/// The modules below `layer` that code in the module `path` names: by `crate::layer::room` and by `super::room`.
pub fn rooms_used(text: &str, path: &[String], layer: &str) -> Vec<String> {
    let code: String = code_lines(text).collect::<Vec<_>>().join("\n");
    let mut names = names_after(&code, &format!("crate::{layer}::"));
    let to_layer = "super::".repeat(path.len() - 1);
    names.extend(names_after(&code, &to_layer));
    names
}

/// What follows each `prefix` that begins a path in the code: `prefix::a` and `prefix::{a, b::c}`.
fn names_after(code: &str, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        if code[..at].ends_with(['$', ':']) || code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_') {
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

/// The top-level module a file belongs to; none for `lib.rs` and `main.rs`, which only put the layers together.
pub fn module_of(file: &Path) -> Option<String> {
    let first = relative(file).strip_prefix("src").ok()?.components().next()?;
    let name = Path::new(first.as_os_str()).file_stem()?.to_str()?;
    (!matches!(name, "lib" | "main")).then(|| name.to_owned())
}

/// What follows each `crate::` in the code: `crate::a::b` and `crate::{a, b::c}`.
pub fn crate_paths(text: &str) -> Vec<String> {
    names_after(&code_lines(text).collect::<Vec<_>>().join("\n"), "crate::")
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
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

pub fn code_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//"))
}

/// A line of code without what stands between quotes.
pub fn without_texts(line: &str) -> String {
    line.split('"').step_by(2).collect::<Vec<_>>().join("\"")
}

pub fn has_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == word)
}

/// Whether a line names a crate: at the beginning of a path, as code does.
pub fn names_crate(line: &str, name: &str) -> bool {
    line.match_indices(name).any(|(at, _)| {
        let (before, after) = (&line[..at], &line[at + name.len()..]);
        let begins =
            !before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') || before.ends_with(" ::");
        begins && (after.starts_with("::") || after.starts_with("_f64"))
    })
}
