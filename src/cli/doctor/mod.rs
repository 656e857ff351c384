//! `swanilda doctor`: which calls of scripts and scenes work here.

mod python_uses;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::{Outcome, say};
use docs::{self, Support, Use};
use format::{scene_file, script_file};
use permissions::read_bounded;

/// Exit code when something a script calls is approximated or missing.
const NOT_ALL_WORKS: u8 = 1;

/// File name endings to look for in folders.
const ENDINGS: [&str; 6] = [
    ".lua",
    ".py",
    ".ttt",
    ".ttm",
    ".simscene.xml",
    ".simmodel.xml",
];

/// Report which API calls in scripts and scenes are supported, approximated or missing
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scripts in Lua and Python, CoppeliaSim scenes and models, or folders of them
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Check Lua files as converted by --compat
    #[arg(long)]
    compat: bool,
    /// List deprecated functions too, which work, and what to call instead
    #[arg(long)]
    deprecated: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Checks everything; the exit code reports whether all of it is supported.
pub(super) fn doctor(args: &Args) -> Outcome {
    let mut report = Report {
        deprecated: args.deprecated,
        ..Report::default()
    };
    let mut unreadable = Vec::new();
    for path in &args.paths {
        let found = files(path)
            .map_err(|reason| unreadable.push(reason))
            .unwrap_or_default();
        for file in found {
            if let Err(reason) = report.add_file(&file, args.compat) {
                unreadable.push(reason);
            }
        }
    }
    if !report.scripts.is_empty() || unreadable.is_empty() {
        say(if args.json {
            report.json()
        } else {
            report.text()
        }
        .as_bytes());
    }
    if !unreadable.is_empty() {
        return Err(unreadable.join("\nswanilda: "));
    }
    Ok(if report.all_works() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(NOT_ALL_WORKS)
    })
}

/// The file, or those below the folder that are scripts or scenes, sorted.
fn files(path: &Path) -> Result<Vec<PathBuf>, String> {
    let unreadable = |error| format!("cannot read {}: {error}", path.display());
    if !path.metadata().map_err(unreadable)?.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut entries: Vec<_> = path.read_dir().map_err(unreadable)?.flatten().collect();
    entries.sort_by_key(std::fs::DirEntry::file_name);
    let mut found = Vec::new();
    for entry in entries {
        let below = entry.path();
        // Folders by their own type: a link could lead back here.
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            found.extend(files(&below)?);
        } else if ENDINGS
            .iter()
            .any(|ending| below.to_string_lossy().ends_with(ending))
        {
            found.push(below);
        }
    }
    Ok(found)
}

/// A script and what it uses.
struct CheckedScript {
    /// File, and the object in it where it is a scene.
    name: String,
    uses: Vec<Use>,
}

#[derive(Default)]
struct Report {
    scripts: Vec<CheckedScript>,
    /// What is deprecated is listed too.
    deprecated: bool,
}

impl Report {
    fn add_file(&mut self, path: &Path, compat: bool) -> Result<(), String> {
        let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
        let bytes = read_bounded(path).map_err(|error| unreadable(error.to_string()))?;
        let name = path.display().to_string();
        if scene_file::is_scene(&bytes) && script_file::check_no_xacro(path).is_ok() {
            let file = super::files::scene(path)?;
            for script in file.scripts() {
                self.add(
                    format!("{name}: {}", script.name),
                    path,
                    &script.language,
                    &script.code,
                );
            }
        } else {
            script_file::check(path, &bytes).map_err(|reason| unreadable(reason.to_string()))?;
            let language = script_file::language(Some(path), &bytes);
            let code = if compat && language == "lua" {
                scene_file::with_compat(bytes)
            } else {
                bytes
            };
            self.add(name, path, language, &code);
        }
        Ok(())
    }

    fn add(&mut self, name: String, file: &Path, language: &str, code: &[u8]) {
        let uses = uses_of(file, language, code);
        self.scripts.push(CheckedScript { name, uses });
    }

    fn uses(&self) -> impl Iterator<Item = &Use> {
        self.scripts.iter().flat_map(|script| &script.uses)
    }

    fn all_works(&self) -> bool {
        self.uses().all(|found| found.support == Support::Works)
    }

    /// How many different functions there are of each kind: working, approximated, missing.
    fn counts(&self) -> [usize; 3] {
        let by_name: BTreeMap<&str, Support> = self
            .uses()
            .map(|found| (found.name.as_str(), found.support))
            .collect();
        let count = |kind| {
            by_name
                .values()
                .filter(|support| word(**support) == kind)
                .count()
        };
        ["works", "approximated", "missing"].map(count)
    }

    /// Functions that do not work in full, script by script, then a summary.
    fn text(&self) -> String {
        let mut out: String = self
            .scripts
            .iter()
            .map(|script| script.text(self.deprecated))
            .collect();
        let [works, approximated, missing] = self.counts();
        out.push_str(&format!(
            "{} scripts call {} functions: {works} work, {approximated} are approximated, {missing} are missing.\n",
            self.scripts.len(),
            works + approximated + missing
        ));
        out
    }

    fn json(&self) -> String {
        let scripts: Vec<_> = self.scripts.iter().map(CheckedScript::json).collect();
        let [works, approximated, missing] = self.counts();
        let report = serde_json::json!({
            "scripts": scripts,
            "summary": {"works": works, "approximated": approximated, "missing": missing},
        });
        format!("{report}\n")
    }
}

/// What a script uses, which is from `file`.
pub(super) fn uses_of(file: &Path, language: &str, code: &[u8]) -> Vec<Use> {
    match language {
        "lua" => docs::uses_beside(code, file.parent().unwrap_or(Path::new("."))),
        "python" => {
            python_uses::uses(code, file).unwrap_or_else(|reason| docs::unreadable_script(&reason))
        }
        _ => docs::foreign_script(language),
    }
}

/// What is known of a name beside its support, and its lines.
type Lines<'a> = (Option<&'a str>, Vec<String>);

impl CheckedScript {
    fn text(&self, with_deprecated: bool) -> String {
        let mut lines: BTreeMap<(Support, &str), Lines<'_>> = BTreeMap::new();
        let is_listed = |found: &&Use| {
            found.support != Support::Works || with_deprecated && found.instead().is_some()
        };
        for found in self.uses.iter().filter(is_listed) {
            lines
                .entry((found.support, found.name.as_str()))
                .or_insert_with(|| (found.hint.as_deref(), Vec::new()))
                .1
                .push(found.line.to_string());
        }
        if lines.is_empty() {
            return String::new();
        }
        let rows = lines.iter().map(|((support, name), (hint, lines))| {
            let how = match support {
                Support::Approximated(how) => format!(" ({how})"),
                Support::Missing | Support::Works => docs::remedy(name)
                    .map(|remedy| format!(" (use {remedy})"))
                    .or_else(|| hint.map(|hint| format!(" ({hint})")))
                    .unwrap_or_default(),
            };
            let kind = if *support == Support::Works {
                "deprecated"
            } else {
                word(*support)
            };
            format!("  {kind:<12} {name}: line {}{how}\n", lines.join(", "))
        });
        format!("{}\n{}", self.name, rows.collect::<String>())
    }

    fn json(&self) -> serde_json::Value {
        let uses: Vec<_> = self.uses.iter().map(json_of).collect();
        serde_json::json!({"name": self.name, "uses": uses})
    }
}

fn json_of(found: &Use) -> serde_json::Value {
    let mut object =
        serde_json::json!({"name": found.name, "line": found.line, "support": word(found.support)});
    if let Some(written) = &found.written {
        object["written"] = written.as_str().into();
    }
    if let Some(hint) = &found.hint {
        object["hint"] = hint.as_str().into();
    }
    if let Some(instead) = found.instead() {
        object["instead"] = instead.into();
    }
    if let Support::Approximated(how) = found.support {
        object["difference"] = how.into();
    }
    object
}

fn word(support: Support) -> &'static str {
    match support {
        Support::Works => "works",
        Support::Approximated(_) => "approximated",
        Support::Missing => "missing",
    }
}
