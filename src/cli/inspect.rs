//! `swanilda inspect`: contents of a scene, and whether its scripts are supported.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use super::doctor::uses_of;
use super::{Outcome, files, say};
use docs::Support;
use format::scene_file::{SceneFile, ScriptCode};
use format::scene_outline::{Outline, OutlineItem};

/// Exit code when a script uses something approximated or missing.
const NOT_ALL_WORKS: u8 = 1;

/// Show the contents of a scene or model: object tree, sizes, scripts and what they require
#[derive(clap::Args)]
pub(super) struct Args {
    /// A .ttt or .ttm file, or a folder made by unpack
    file: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Print everything as lines of text, for git's textconv
    #[arg(long, conflicts_with = "json")]
    textconv: bool,
}

/// The exit code reports whether everything the scripts use is supported.
pub(super) fn inspect(args: &Args) -> Outcome {
    let report = Report::new(args)?;
    if args.textconv {
        say(report.outline.text().as_bytes());
        return Ok(ExitCode::SUCCESS);
    }
    say(if args.json {
        report.json()
    } else {
        report.text()
    }
    .as_bytes());
    let all_works = report
        .needs
        .values()
        .all(|support| *support == Support::Works);
    Ok(if all_works {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(NOT_ALL_WORKS)
    })
}

struct Report {
    /// Kind, program and format of the file.
    what: String,
    skipped: Vec<String>,
    scripts: Vec<ScriptCode>,
    outline: Outline,
    /// Modules and functions that scripts use.
    needs: BTreeMap<String, Support>,
}

impl Report {
    fn new(args: &Args) -> Result<Self, String> {
        let file = files::scene(&args.file)?;
        let scripts = file.scripts();
        let uses = scripts
            .iter()
            .flat_map(|script| uses_of(&args.file, &script.language, &script.code));
        let needs = uses.map(|found| (found.name, found.support)).collect();
        let skipped = file.file().skipped.iter();
        let skipped = skipped
            .map(|skip| format!("{} ({} bytes)", skip.path, skip.size))
            .collect();
        let what = what(&file);
        let outline =
            Outline::new(file).map_err(|error| format!("{}: {error}", args.file.display()))?;
        Ok(Self {
            what,
            skipped,
            scripts,
            outline,
            needs,
        })
    }

    fn triangles(&self) -> usize {
        self.outline.objects.iter().map(|item| item.triangles).sum()
    }

    fn text(&self) -> String {
        let mut out = format!(
            "{}: {} objects, {} triangles\n",
            self.what,
            self.outline.objects.len(),
            self.triangles()
        );
        self.outline
            .objects
            .iter()
            .for_each(|item| out += &line(item));
        for script in &self.scripts {
            out += &format!(
                "script {} ({}, {} lines)\n",
                script.name,
                script.language,
                lines(&script.code)
            );
        }
        self.skipped
            .iter()
            .for_each(|skipped| out += &format!("not understood: {skipped}\n"));
        for (name, support) in self
            .needs
            .iter()
            .filter(|(_, support)| **support != Support::Works)
        {
            let how = if let Support::Approximated(how) = support {
                format!(" ({how})")
            } else {
                String::new()
            };
            out += &format!("{:<12} {name}{how}\n", word(*support));
        }
        let works = self
            .needs
            .values()
            .filter(|support| **support == Support::Works)
            .count();
        out + &format!(
            "{works} of {} functions and modules that scripts use work\n",
            self.needs.len()
        )
    }

    fn json(&self) -> String {
        let objects = self
            .outline
            .objects
            .iter()
            .map(|item| serde_json::json!({"path": item.path, "type": item.kind, "triangles": item.triangles}));
        let scripts = self.scripts.iter().map(|script| {
            serde_json::json!({"name": script.name, "language": script.language, "lines": lines(&script.code)})
        });
        let needs: serde_json::Map<_, _> = self
            .needs
            .iter()
            .map(|(name, support)| (name.clone(), word(*support).into()))
            .collect();
        let report = serde_json::json!({
            "file": self.what,
            "objects": objects.collect::<Vec<_>>(),
            "triangles": self.triangles(),
            "scripts": scripts.collect::<Vec<_>>(),
            "notUnderstood": self.skipped,
            "needs": needs,
        });
        format!("{report}\n")
    }
}

fn what(file: &SceneFile) -> String {
    let header = &file.file().header;
    let kind = if file.is_model() { "model" } else { "scene" };
    format!(
        "{kind} of {} (format {})",
        header.version_text(),
        header.serialization
    )
}

fn line(item: &OutlineItem) -> String {
    let name = item.path.rsplit('/').next().unwrap_or_default();
    let triangles = if item.triangles > 0 {
        format!(", {} triangles", item.triangles)
    } else {
        String::new()
    };
    format!(
        "{}{name} ({}{triangles})\n",
        "  ".repeat(item.depth + 1),
        item.kind
    )
}

fn lines(code: &[u8]) -> usize {
    code.split(|byte| *byte == b'\n').count()
}

fn word(support: Support) -> &'static str {
    match support {
        Support::Works => "works",
        Support::Approximated(_) => "approximated",
        Support::Missing => "missing",
    }
}
