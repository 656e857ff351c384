//! The modules of the viewer's page keep to a form: they can be joined by text (docs/VIEW_PROTOCOL.md, One file), and no text becomes HTML.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::imports::{read, relative, root};

/// What would make HTML or code from text.
const FORBIDDEN: &[&str] = &[
    "innerHTML",
    "outerHTML",
    "insertAdjacentHTML",
    "document.write",
    "eval(",
    "new Function",
    "DOMParser",
];
const EXPORTS: &[&str] = &[
    "export function ",
    "export async function ",
    "export class ",
    "export const ",
];

fn modules() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join("crates/view/src/page")];
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().expect("the page is a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "js") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(found.len() > 30, "the page has modules");
    found
}

/// The path in `import { a } from './b.js';`; None in another form.
fn imported(line: &str) -> Option<&str> {
    let (names, path) = line.strip_prefix("import { ")?.split_once(" } from '")?;
    let path = path.strip_suffix("';")?;
    (path.starts_with('.') && !names.contains(" as ")).then_some(path)
}

#[test]
fn modules_can_be_joined_by_text() {
    let mut wrong = Vec::new();
    for file in modules() {
        for line in read(&file).lines() {
            let is_import = line.starts_with("import") && imported(line).is_none();
            let is_export =
                line.starts_with("export") && !EXPORTS.iter().any(|form| line.starts_with(form));
            if is_import || is_export {
                wrong.push(format!("{}: {line}", relative(&file).display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn modules_import_without_cycles() {
    let mut imports: BTreeMap<PathBuf, Vec<PathBuf>> = modules()
        .into_iter()
        .map(|file| (file.clone(), targets(&file)))
        .collect();
    while let Some(leaf) = imports
        .iter()
        .find(|(_, targets)| targets.is_empty())
        .map(|(file, _)| file.clone())
    {
        imports.remove(&leaf);
        imports
            .values_mut()
            .for_each(|targets| targets.retain(|target| *target != leaf));
    }
    assert!(
        imports.is_empty(),
        "these import each other, or what is not there: {imports:#?}"
    );
}

fn targets(file: &Path) -> Vec<PathBuf> {
    let folder = file.parent().expect("files are in folders");
    let text = read(file);
    let paths = text.lines().filter_map(imported);
    paths
        .map(|path| {
            folder
                .join(path)
                .canonicalize()
                .expect("what is imported is there")
        })
        .collect()
}

#[test]
fn no_text_becomes_html_or_code() {
    let mut wrong = Vec::new();
    for file in modules() {
        let text = read(&file);
        wrong.extend(
            FORBIDDEN
                .iter()
                .filter(|word| text.contains(**word))
                .map(|word| format!("{}: {word}", relative(&file).display())),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
