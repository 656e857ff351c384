//! The wall between the layers: imports point inwards only (docs/ARCHITECTURE.md).

use std::fs;
use std::path::{Path, PathBuf};

/// The layers from the inside out; a module may import from its own row's modules it belongs to, and from rows above it.
const LAYERS: &[&[&str]] = &[
    &["scene"],
    &["wire"],
    &["dynamics", "format", "io"],
    &["script"],
    &["api"],
    &["modules"],
    &["simulator"],
    &["docs", "testing"],
    &["cli"],
];

/// Who may name what comes from outside the crate.
const OWNERS: &[(&str, &str)] = &[
    ("rapier3d", "src/dynamics"),
    ("mlua", "src/script"),
    ("mlua", "src/simulator/builder.rs"),
    ("mlua", "src/lib.rs"),
    ("directories", "src/script/files/app_storage"),
    ("fs4", "src/script"),
    ("image", "src/format/picture.rs"),
    ("dns_lookup", "src/io/socket"),
    ("rustix", "src/io/socket"),
    ("rustls", "src/io/socket/tls.rs"),
    ("rustls_native_certs", "src/io/socket/tls.rs"),
    ("socket2", "src/io/socket"),
    ("zmq_sys", "src/io/zmq"),
    ("tokio", "src/io"),
    ("tokio_tungstenite", "src/io/ws"),
    ("httparse", "src/io/ws"),
    ("futures", "src/io"),
    ("serialport", "src/io/serial.rs"),
    ("csv", "src/testing/batch/store.rs"),
    ("plotters", "src/testing/golden/plot.rs"),
    ("dejavu", "src/testing/golden/plot.rs"),
    ("notify", "src/cli/test/watch.rs"),
    ("quick_xml", "src/format/xml"),
    ("quick_xml", "src/testing/report/junit.rs"),
    ("clap", "src/cli"),
    ("indicatif", "src/cli"),
    ("ctrlc", "src/cli"),
];

/// Where functions for scripts stand. What they may touch is in their signature: `&Cx` reads, `&mut Cx` changes something or calls scripts.
const FUNCTIONS_FOR_SCRIPTS: &[&str] = &["src/api", "src/modules"];

/// The edges to libraries written in C.
const UNSAFE: &[&str] = &["src/script", "src/io/zmq"];

#[test]
fn imports_point_inwards() {
    let mut wrong = Vec::new();
    for file in sources() {
        let Some(layer) = module_of(&file).and_then(|module| layer_of(&module).map(|layer| (module, layer))) else {
            continue;
        };
        for target in crate_paths(&read(&file)) {
            let target_layer = layer_of(&target).unwrap_or_else(|| panic!("`{target}` belongs to no layer"));
            let is_sibling = target_layer == layer.1 && target != layer.0;
            if target_layer > layer.1 || is_sibling {
                wrong.push(format!("{}: {} must not know {target}", file.display(), layer.0));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_dependency_has_one_owner() {
    let mut wrong = Vec::new();
    for file in sources() {
        let text = read(&file);
        for (name, owner) in OWNERS {
            let owned = OWNERS.iter().any(|(of, folder)| of == name && relative(&file).starts_with(folder));
            if code_lines(&text).any(|line| names_crate(line, name)) && !owned {
                wrong.push(format!("{}: only {owner} may name {name}", file.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// `Sim` is the whole simulator: who holds it may do anything, whatever the signature says.
#[test]
fn functions_for_scripts_reach_the_simulator_through_their_context() {
    let mut wrong = Vec::new();
    let folders = |file: &PathBuf| FUNCTIONS_FOR_SCRIPTS.iter().any(|folder| relative(file).starts_with(folder));
    for file in sources().into_iter().filter(folders) {
        let text = read(&file);
        let hold = |line: &&str| line.contains(".sim()") || line.contains("sim.upgrade()") || has_word(line, "Sim");
        wrong.extend(code_lines(&text).filter(hold).map(|line| format!("{}: {}", file.display(), line.trim())));
    }
    assert!(wrong.is_empty(), "add a narrow accessor to `Cx` instead:\n{}", wrong.join("\n"));
}

/// What belongs to one part is a field of that part: `Sim` only puts the parts together.
#[test]
fn the_simulator_consists_of_few_parts() {
    let text = read(&root().join("src/script/sim.rs"));
    let (_, body) = text.split_once("struct Sim {\n").expect("the simulator is a struct");
    let (body, _) = body.split_once("\n}").expect("the struct ends");
    let fields: Vec<_> = code_lines(body).filter(|line| line.contains(": ")).collect();
    assert!((2..=15).contains(&fields.len()), "{} fields: {fields:#?}", fields.len());
}

#[test]
fn unsafe_code_stays_at_the_edges_to_c() {
    let outside: Vec<_> = sources()
        .into_iter()
        .filter(|file| !UNSAFE.iter().any(|folder| relative(file).starts_with(folder)))
        .filter(|file| code_lines(&read(file)).any(|line| line.split_whitespace().any(|word| word == "unsafe")))
        .collect();
    assert!(outside.is_empty(), "unsafe code outside {UNSAFE:?}: {outside:?}");
}

#[test]
fn every_module_says_what_it_is_for() {
    let silent: Vec<_> = sources().into_iter().filter(|file| !read(file).starts_with("//!")).collect();
    assert!(silent.is_empty(), "these begin without `//!`: {silent:?}");
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn relative(file: &Path) -> &Path {
    file.strip_prefix(root()).expect("sources lie below the root")
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("sources are readable")
}

/// Every Rust file below `src`.
fn sources() -> Vec<PathBuf> {
    let mut pending = vec![root().join("src")];
    let mut files = Vec::new();
    while let Some(dir) = pending.pop() {
        for path in fs::read_dir(&dir).expect("src is readable").flatten().map(|entry| entry.path()) {
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

/// The top-level module a file belongs to; none for `lib.rs` and `main.rs`, which only put the layers together.
fn module_of(file: &Path) -> Option<String> {
    let first = relative(file).strip_prefix("src").ok()?.components().next()?;
    let name = Path::new(first.as_os_str()).file_stem()?.to_str()?;
    (!matches!(name, "lib" | "main")).then(|| name.to_owned())
}

/// A name re-exported at the root counts as the embedding API's.
fn layer_of(module: &str) -> Option<usize> {
    let name = if module.starts_with(char::is_uppercase) { "simulator" } else { module };
    LAYERS.iter().position(|layer| layer.contains(&name))
}

/// What follows each `crate::` in the code: `crate::a::b` and `crate::{a, b::c}`.
fn crate_paths(text: &str) -> Vec<String> {
    let code: String = code_lines(text).collect::<Vec<_>>().join("\n");
    let mut names = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        if code[..at].ends_with('$') {
            continue;
        }
        let rest = &code[at + "crate::".len()..];
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
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

fn code_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//"))
}

fn has_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == word)
}

fn names_crate(line: &str, name: &str) -> bool {
    line.match_indices(name).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        let after = &line[at + name.len()..];
        before.is_none_or(|c| !c.is_alphanumeric() && c != '_')
            && (after.starts_with("::") || after.starts_with("_f64"))
    })
}
