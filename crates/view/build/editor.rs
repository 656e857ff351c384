//! The editor component of the page: CodeMirror's modules from npm's registry, made ready to be served, and ours on top of them.
//!
//! Nothing that was fetched is executed: `npm ci --ignore-scripts` checks each package against the hash of the lock file, and the modules
//! are text that is embedded. Without npm or a network the page has a plain text area.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::bundle::stripped;

/// Chooses where the component comes from: `off`, or a folder `node_modules`.
pub const SETTING: &str = "SWANILDA_EDITOR";

/// What npm may take.
const LIMIT: Duration = Duration::from_secs(120);

/// Files of ours, which import the packages.
const OWN: &[&str] = &[
    "breakpoints.js",
    "editor.js",
    "names.js",
    "offers.js",
    "styles.js",
];
/// A package, and the file of ours that others import in its place.
const WRAPPED: (&str, &str) = ("style-mod", "styles.js");

/// The modules of the packages: what an `import` calls them, and where they are below the package.
const MODULES: &[(&str, &str)] = &[
    ("@codemirror/autocomplete", "dist/index.js"),
    ("@codemirror/commands", "dist/index.js"),
    ("@codemirror/language", "dist/index.js"),
    ("@codemirror/legacy-modes/mode/lua", ""),
    ("@codemirror/legacy-modes/mode/python", ""),
    ("@codemirror/lint", "dist/index.js"),
    ("@codemirror/search", "dist/index.js"),
    ("@codemirror/state", "dist/index.js"),
    ("@codemirror/streamparser", "dist/index.js"),
    ("@codemirror/view", "dist/index.js"),
    ("@lezer/common", "dist/index.js"),
    ("@lezer/highlight", "dist/index.js"),
    ("@marijn/find-cluster-break", "src/index.js"),
    ("crelt", "index.js"),
    ("style-mod", "src/style-mod.js"),
    ("w3c-keyname", "index.js"),
];

/// What the page finds in place of the component: so that it need not ask for a file that is not there.
const NONE: &str = "export const makeEditor = null;\n";

/// The files that are served below `editor/`, by name.
pub fn files(package: &Path, out: &Path) -> Vec<(String, String)> {
    let files = modules(package, out).and_then(|modules| read(package, &modules));
    files.unwrap_or_else(|reason| {
        println!(
            "cargo:warning=the page of the viewer edits scripts in a plain text area: {reason}"
        );
        vec![("editor/editor.js".to_owned(), NONE.to_owned())]
    })
}

/// The folder with the packages.
#[allow(
    clippy::disallowed_methods,
    reason = "settings of a build come through the environment"
)]
fn modules(package: &Path, out: &Path) -> Result<PathBuf, String> {
    match env::var(SETTING).as_deref() {
        Ok("off") => Err(format!("{SETTING}=off")),
        Ok(folder) if !folder.is_empty() => Ok(PathBuf::from(folder)),
        _ => fetched(&package.join("editor"), &out.join("editor")),
    }
}

/// The packages of the lock file in `folder`, where they stay until the lock file is another one.
fn fetched(editor: &Path, folder: &Path) -> Result<PathBuf, String> {
    let failed = |error: std::io::Error| error.to_string();
    let read = |name: &str| fs::read(editor.join(name)).map_err(failed);
    let (description, lock) = (read("package.json")?, read("package-lock.json")?);
    let (modules, mark) = (folder.join("node_modules"), folder.join("fetched"));
    if fs::read(&mark).is_ok_and(|fetched| fetched == lock) && modules.is_dir() {
        return Ok(modules);
    }
    fs::create_dir_all(folder).map_err(failed)?;
    fs::write(folder.join("package.json"), description).map_err(failed)?;
    fs::write(folder.join("package-lock.json"), &lock).map_err(failed)?;
    install(folder)?;
    fs::write(mark, lock).map_err(failed)?;
    Ok(modules)
}

#[allow(clippy::disallowed_methods, reason = "a build waits for a program")]
fn install(folder: &Path) -> Result<(), String> {
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let mut command = Command::new(npm);
    command
        .arg("ci")
        .args([
            "--ignore-scripts",
            "--no-audit",
            "--no-fund",
            "--prefer-offline",
        ])
        .args([
            "--fetch-retries=1",
            "--fetch-retry-mintimeout=1000",
            "--fetch-timeout=30000",
        ])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let mut child = command
        .spawn()
        .map_err(|_| "there is no npm to fetch an editor with".to_owned())?;
    let begun = Instant::now();
    while begun.elapsed() < LIMIT {
        match child.try_wait() {
            Ok(Some(status)) if status.success() => return Ok(()),
            Ok(None) => std::thread::sleep(Duration::from_millis(50)),
            _ => return Err("npm could not fetch the editor".to_owned()),
        }
    }
    // It may have ended just now.
    let _ = child.kill();
    let _ = child.wait();
    Err("npm took too long to fetch the editor".to_owned())
}

/// All modules with their imports as addresses of the page, and the licences.
fn read(package: &Path, modules: &Path) -> Result<Vec<(String, String)>, String> {
    let text = |path: &Path| {
        fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut files = Vec::new();
    for (name, path) in MODULES {
        let file = match *path {
            "" => modules.join(format!("{name}.js")),
            path => modules.join(name).join(path),
        };
        let program = linked(&text(&file)?)
            .ok_or_else(|| format!("{} imports something unknown", file.display()))?;
        let program = format!("// {name}: see LICENSE.txt\n{}", stripped(&program));
        files.push((address(name), program));
    }
    for name in OWN {
        let program = linked(&text(&package.join("editor").join(name))?)
            .ok_or_else(|| format!("{name} imports something unknown"))?;
        files.push((format!("editor/{name}"), stripped(&program)));
    }
    files.push(("editor/LICENSE.txt".to_owned(), licences(modules)?));
    Ok(files)
}

/// Where a module is served.
fn address(name: &str) -> String {
    format!("editor/{}.js", name.replace('@', "").replace('/', "-"))
}

/// A module that imports others from where they are served; None where one is not known.
pub fn linked(program: &str) -> Option<String> {
    let lines: Option<Vec<String>> = program.lines().map(linked_line).collect();
    Some(lines?.join("\n"))
}

fn linked_line(line: &str) -> Option<String> {
    let imports = line.starts_with("import ") || line.starts_with("export ");
    let Some((names, rest)) = line.split_once(" from '").filter(|_| imports) else {
        return Some(line.to_owned());
    };
    let file = match rest.strip_suffix("';")? {
        own if own.starts_with("./") => return Some(line.to_owned()),
        wrapped if wrapped == WRAPPED.0 => WRAPPED.1.to_owned(),
        name => {
            let (known, _) = MODULES.iter().find(|(known, _)| *known == name)?;
            address(known).strip_prefix("editor/")?.to_owned()
        }
    };
    Some(format!("{names} from './{file}';"))
}

/// The licences of the packages, each with the packages that have it.
fn licences(modules: &Path) -> Result<String, String> {
    let mut texts: Vec<(Vec<String>, String)> = Vec::new();
    let mut packages: Vec<&str> = MODULES.iter().map(|(name, _)| package_of(name)).collect();
    packages.dedup();
    for package in packages {
        let path = modules.join(package).join("LICENSE");
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        match texts.iter_mut().find(|(_, known)| *known == text) {
            Some((packages, _)) => packages.push(package.to_owned()),
            None => texts.push((vec![package.to_owned()], text)),
        }
    }
    let parts = texts
        .into_iter()
        .map(|(packages, text)| format!("{}\n\n{}", packages.join(", "), text.trim()));
    Ok(parts.collect::<Vec<_>>().join("\n\n----\n\n") + "\n")
}

/// The package that a module belongs to.
fn package_of(module: &str) -> &str {
    let parts = if module.starts_with('@') { 2 } else { 1 };
    let end = module.match_indices('/').nth(parts - 1);
    end.map_or(module, |(end, _)| &module[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn imports_lead_to_what_is_served() {
        let program = "import { a } from '@lezer/common';\nimport b from 'crelt';\nimport { StyleModule } from 'style-mod';\nimport { c } from './names.js';\nconst d = \" from 'x'\";\nexport { d } from '@codemirror/legacy-modes/mode/lua';";
        assert_eq!(
            linked(program).as_deref(),
            Some(
                "import { a } from './lezer-common.js';\nimport b from './crelt.js';\nimport { StyleModule } from './styles.js';\nimport { c } from './names.js';\nconst d = \" from 'x'\";\nexport { d } from './codemirror-legacy-modes-mode-lua.js';"
            )
        );
        assert_eq!(linked("import { a } from 'unknown';"), None);
    }

    #[test]
    fn modules_belong_to_packages() {
        assert_eq!(
            package_of("@codemirror/legacy-modes/mode/lua"),
            "@codemirror/legacy-modes"
        );
        assert_eq!(package_of("@lezer/common"), "@lezer/common");
        assert_eq!(package_of("crelt"), "crelt");
    }
}
