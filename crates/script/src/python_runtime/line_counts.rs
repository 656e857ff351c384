//! Which lines of a Python script have run, as its process counts them.

use std::path::PathBuf;
use std::sync::Arc;

use crate::coverage::{CountedText, FunctionLines, LineCounts};
use crate::host::Sim;
use scene::{Data, Key};

/// The script's own text in reports.
pub(super) struct Own {
    /// The name it has in its process.
    pub name: String,
    /// The path of its object.
    pub path: String,
    pub text: Arc<[u8]>,
}

/// Reads the report of a process: by file, the lines that have run and its functions.
pub(super) fn read(counts: &Data, own: &Own, sim: &Sim) -> LineCounts {
    let mut all = LineCounts::default();
    let Data::Map(files) = counts else { return all };
    for (name, counted) in files {
        let (Key::Text(name), Data::Array(parts)) = (name, counted) else {
            continue;
        };
        let [lines, functions] = &parts[..] else {
            continue;
        };
        let name = String::from_utf8_lossy(name);
        let text = match name == own.name {
            true => CountedText::Script {
                scene: sim.scene_path(),
                path: own.path.clone(),
                text: own.text.to_vec(),
            },
            false => CountedText::File(PathBuf::from(&*name)),
        };
        let functions = list(functions).filter_map(function).collect();
        all.add(text.clone(), &counts_of(&numbers(lines)));
        all.functions.insert(text, functions);
    }
    all
}

/// 1 for each of the lines.
fn counts_of(lines: &[u32]) -> Vec<u64> {
    let mut counts = vec![0; lines.iter().copied().max().unwrap_or(0) as usize];
    lines
        .iter()
        .filter(|&&line| line > 0)
        .for_each(|&line| counts[line as usize - 1] = 1);
    counts
}

fn function(value: &Data) -> Option<FunctionLines> {
    let Data::Array(parts) = value else {
        return None;
    };
    let [Data::Int(line), name, lines] = &parts[..] else {
        return None;
    };
    let lines = numbers(lines);
    let name = if let Data::Text(name) = name {
        Some(String::from_utf8_lossy(name).into_owned())
    } else {
        None
    };
    (!lines.is_empty()).then_some(FunctionLines {
        line: u32::try_from(*line).ok()?,
        lines,
        name,
    })
}

fn list(value: &Data) -> impl Iterator<Item = &Data> {
    let items: &[Data] = if let Data::Array(items) = value {
        items
    } else {
        &[]
    };
    items.iter()
}

/// Numbers of lines; a text has no more than its reader takes.
fn numbers(value: &Data) -> Vec<u32> {
    const MAX_LINE: i64 = 1 << 24;
    let line = |item: &Data| {
        if let Data::Int(line) = item {
            Some(*line)
        } else {
            None
        }
    };
    list(value)
        .filter_map(line)
        .filter(|line| (0..=MAX_LINE).contains(line))
        .map(numbers::low_u32)
        .collect()
}
