//! References to the behaviour reference `docs/spec` lead somewhere, and nothing points to documents outside the repository.
//!
//! A reference is `spec:` with pages and sections, such as `joints 7.1, dynamics 3` (see `docs/spec/README.md`): the page must exist
//! and have a heading with that number. Links between pages of the documentation are followed too.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Sections by page: `joints` has `7` and `7.1`.
type Pages = BTreeMap<String, BTreeSet<String>>;

const FOLDERS: [&str; 8] = [
    "src", "lua", "crates", "tests", "docs", "benches", "examples", "fuzz",
];
const FILES: [&str; 3] = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"];

/// How documents outside the repository were named; split so that this file does not match itself.
const OUTSIDE: [&str; 3] = [
    concat!("SPEC", "-"),
    concat!("shared", "/spec"),
    concat!("FORMAT", ".md"),
];

#[test]
fn references_lead_to_sections() {
    let pages = pages();
    assert!(pages.len() > 20, "docs/spec has {} pages", pages.len());
    let mut count = 0;
    let mut faults = Vec::new();
    for (path, text) in texts() {
        for (number, line) in text.lines().enumerate() {
            for reference in references(line) {
                count += 1;
                if let Err(fault) = resolve(&pages, reference) {
                    faults.push(format!("{}:{}: {fault}", path.display(), number + 1));
                }
            }
        }
    }
    assert!(count > 400, "only {count} references were found");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn nothing_points_outside_of_the_repository() {
    let mut faults = Vec::new();
    for (path, text) in texts() {
        for (number, line) in text.lines().enumerate() {
            if OUTSIDE.iter().any(|name| names(line, name)) {
                faults.push(format!(
                    "{}:{}: {}",
                    path.display(),
                    number + 1,
                    line.trim()
                ));
            }
        }
    }
    assert!(
        faults.is_empty(),
        "documents outside of the repository are mentioned:\n{}",
        faults.join("\n")
    );
}

#[test]
fn links_between_pages_lead_to_files_and_sections() {
    let pages = pages();
    let mut count = 0;
    let mut faults = Vec::new();
    for (path, text) in texts()
        .into_iter()
        .filter(|(path, _)| path.extension().is_some_and(|e| e == "md"))
    {
        for link in links(&text) {
            count += 1;
            if let Err(fault) = follow(&path, &link, &pages) {
                faults.push(format!("{}: {fault}", path.display()));
            }
        }
    }
    assert!(count > 100, "only {count} links were found");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_index_of_the_reference_lists_every_page() {
    let index =
        fs::read_to_string(root().join("docs/spec/README.md")).expect("the index is readable");
    let missing: Vec<String> = pages()
        .into_keys()
        .filter(|page| !index.contains(&format!("]({page}.md)")))
        .collect();
    assert!(
        missing.is_empty(),
        "not in docs/spec/README.md: {missing:?}"
    );
}

#[test]
fn faults_are_found() {
    let pages = Pages::from([("joints".into(), BTreeSet::from(["7".into(), "7.1".into()]))]);
    let faults = |line| {
        references(line)
            .into_iter()
            .filter(|r| resolve(&pages, r).is_err())
            .count()
    };
    assert_eq!(
        faults("//! The control law (spec: joints 7.1, joints 7)."),
        0
    );
    assert_eq!(faults("-- spec: joints 8; text"), 1);
    assert_eq!(faults("-- spec: joints 7, joint 7"), 1);
    assert_eq!(faults("-- spec: The joints"), 1);
    assert_eq!(references("let spec: Spec = spec;").len(), 0);
    let outside = format!("(see {}joints 7)", OUTSIDE[0]);
    assert!(OUTSIDE.iter().any(|name| names(&outside, name)));
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn pages() -> Pages {
    let entries = fs::read_dir(root().join("docs/spec"))
        .expect("docs/spec is readable")
        .flatten();
    let files = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"));
    let name = |path: &Path| {
        path.file_stem()
            .expect("a file has a name")
            .to_string_lossy()
            .into_owned()
    };
    files
        .filter(|path| !path.ends_with("README.md"))
        .map(|path| (name(&path), sections(&path)))
        .collect()
}

/// The numbers of the headings of a page: `## 7. Dynamic control`, `### 7.1 Force`.
fn sections(path: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(path).expect("a page is readable text");
    let headings = text.lines().filter(|line| line.starts_with("##"));
    let numbers = headings.filter_map(|line| line.split_whitespace().nth(1));
    numbers
        .map(|number| number.trim_end_matches('.').to_owned())
        .collect()
}

/// Every text of the repository that may hold references, with its path from the root on.
fn texts() -> Vec<(PathBuf, String)> {
    let mut pending: Vec<PathBuf> = FOLDERS
        .iter()
        .chain(&FILES)
        .map(|name| root().join(name))
        .collect();
    let mut texts = Vec::new();
    while let Some(path) = pending.pop() {
        if path.is_dir() && !path.ends_with("target") && !path.ends_with("corpus") {
            pending.extend(
                fs::read_dir(&path)
                    .expect("a folder is readable")
                    .flatten()
                    .map(|entry| entry.path()),
            );
        } else if let Ok(text) = fs::read_to_string(&path) {
            let relative = path
                .strip_prefix(root())
                .expect("found below the root")
                .to_path_buf();
            texts.push((relative, text));
        }
    }
    texts.sort();
    texts
}

/// The references in the comment or the prose of a line: each runs to what cannot belong to it.
fn references(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for (at, _) in line.match_indices("spec: ") {
        let before = &line[..at];
        let is_comment = before.trim_start().starts_with("//")
            || before.contains("// ")
            || before.starts_with("-- ");
        let is_word = before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if is_comment && !is_word {
            found.push(&line[at + "spec: ".len()..]);
        }
    }
    found
}

/// Whether each page and section at the start of a text exists.
fn resolve(pages: &Pages, reference: &str) -> Result<(), String> {
    let mut parts = reference.split(", ");
    entry(pages, parts.next().unwrap_or_default())?;
    for part in parts {
        let mut words = part.split(' ');
        let (Some(page), Some(section)) = (words.next(), words.next()) else {
            break;
        };
        let has_section = section.starts_with(|c: char| c.is_ascii_digit());
        if !has_section || !page.chars().all(|c| c.is_ascii_lowercase() || c == '-') {
            break;
        }
        entry(pages, part)?;
    }
    Ok(())
}

/// One page, with a section or without.
fn entry(pages: &Pages, text: &str) -> Result<(), String> {
    let end = text
        .find(|c: char| !c.is_ascii_lowercase() && c != '-')
        .unwrap_or(text.len());
    let (page, rest) = text.split_at(end);
    let sections = pages
        .get(page)
        .ok_or_else(|| format!("no page docs/spec/{page}.md ({text:?})"))?;
    let Some(rest) = rest.strip_prefix(' ') else {
        return Ok(());
    };
    section(page, sections, rest)
}

/// The number at the start of a text, which must be that of a heading.
fn section(page: &str, sections: &BTreeSet<String>, text: &str) -> Result<(), String> {
    let end = text
        .find(|c: char| !c.is_ascii_digit() && c != '.')
        .unwrap_or(text.len());
    let number = text[..end].trim_end_matches('.');
    if number.is_empty() || sections.contains(number) {
        return Ok(());
    }
    Err(format!("docs/spec/{page}.md has no section {number}"))
}

/// Whether a line names a document outside: the name, not as the end of a longer word.
fn names(line: &str, name: &str) -> bool {
    line.match_indices(name)
        .any(|(at, _)| !line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
}

/// The targets of the links of a page, each with the text behind it, as far as a section may stand there.
fn links(text: &str) -> Vec<(String, String)> {
    let starts = text.match_indices("](").map(|(at, _)| &text[at + 2..]);
    let parts = starts.filter_map(|rest| rest.split_once(')'));
    parts
        .map(|(target, behind)| (target.to_owned(), behind.chars().take(20).collect()))
        .collect()
}

/// Whether a link leads to a file, and the section named behind it exists.
fn follow(page: &Path, (target, behind): &(String, String), pages: &Pages) -> Result<(), String> {
    if target.contains("://") || target.starts_with('#') {
        return Ok(());
    }
    let file = target.split('#').next().unwrap_or_default();
    let path = root()
        .join(page)
        .parent()
        .expect("a page lies in a folder")
        .join(file);
    if !path.exists() {
        return Err(format!("no file {target}"));
    }
    let name = Path::new(file)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let Some(sections) = pages.get(&name).filter(|_| page.starts_with("docs/spec")) else {
        return Ok(());
    };
    let behind = behind
        .trim_start_matches([',', ' '])
        .trim_start_matches("sections ")
        .trim_start_matches("section ");
    section(&name, sections, behind)
}

/// Rows `` | `Type::function` | `file` | `` of the map: the function is defined in that file.
#[test]
fn functions_named_in_the_architecture_exist() {
    let text =
        fs::read_to_string(root().join("docs/ARCHITECTURE.md")).expect("the map is readable");
    let mut count = 0;
    for line in text.lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, function, file, ..] = cells[..] else {
            continue;
        };
        let (Some(function), Some(file)) = (quoted(function), quoted(file)) else {
            continue;
        };
        let name = function.rsplit("::").next().unwrap_or(function);
        let code =
            fs::read_to_string(root().join(file)).unwrap_or_else(|_| panic!("no file {file}"));
        let defined = ["fn ", "function ", "function M."].iter().any(|word| {
            let start = format!("{word}{name}");
            code.match_indices(&start)
                .any(|(at, _)| code[at + start.len()..].starts_with(['(', '<']))
        });
        assert!(defined, "{function} is not defined in {file}");
        count += 1;
    }
    assert!(count > 10, "only {count} functions were found");
}

#[test]
fn paths_named_in_the_architecture_exist() {
    let text =
        fs::read_to_string(root().join("docs/ARCHITECTURE.md")).expect("the map is readable");
    let words = text.split('`').skip(1).step_by(2);
    let is_path = |word: &&str| {
        ["src/", "lua/", "tests/", "crates/"]
            .iter()
            .any(|start| word.starts_with(start))
    };
    let missing: Vec<&str> = words
        .filter(is_path)
        .filter(|word| !root().join(word.trim_end_matches('*')).exists())
        .collect();
    assert!(
        missing.is_empty(),
        "docs/ARCHITECTURE.md names what is not there: {missing:?}"
    );
}

/// The text of a cell that is all in backticks.
fn quoted(cell: &str) -> Option<&str> {
    cell.strip_prefix('`')?.strip_suffix('`')
}
