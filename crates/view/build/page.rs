//! The page of the viewer as it is embedded: its modules as one, without comments and indentation, compressed. The sources stay as readers want them.

use std::fmt::Write as _;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io::Write as _;
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::bundle;

/// The module that imports all others.
const MAIN: &str = "main.js";

/// The files of the page: names and contents.
pub fn files(root: &Path) -> Vec<(String, String)> {
    let read = |name: &str| fs::read_to_string(root.join(name)).ok();
    let text = |name: &str| read(name).unwrap_or_else(|| panic!("{name} is part of the page"));
    let program = bundle::join(MAIN, &read)
        .expect("the modules of the page can be joined (docs/VIEW_PROTOCOL.md, One file)");
    [
        ("index.html", text("index.html")),
        (MAIN, bundle::stripped(&program)),
        ("style.css", without_comments(&styles(root))),
    ]
    .map(|(name, content)| (name.to_owned(), content))
    .to_vec()
}

/// Writes files as gzip, and a table of them by name.
pub fn compress(mut files: Vec<(String, String)>, out: &Path) {
    files.sort();
    let mut table = String::from("&[\n");
    for (name, content) in files {
        let path = out.join(format!("{}.gz", name.replace('/', "_")));
        fs::write(&path, gzip(content.as_bytes())).expect("the output folder is writable");
        let mut hasher = DefaultHasher::new();
        hasher.write(content.as_bytes());
        let (path, tag) = (
            path.display().to_string(),
            format!("{:016x}", hasher.finish()),
        );
        writeln!(
            table,
            "Asset {{ name: {name:?}, gzip: include_bytes!({path:?}), tag: {tag:?} }},"
        )
        .expect("strings take all");
    }
    table.push(']');
    fs::write(out.join("page_files.rs"), table).expect("the output folder is writable");
}

/// The style sheets of the parts of the page, in the order of their names.
fn styles(root: &Path) -> String {
    let folder = root.join("styles");
    let entries = fs::read_dir(folder).expect("the page has style sheets");
    let mut paths: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    let texts = paths.iter().map(fs::read_to_string);
    texts
        .map(|text| text.expect("style sheets are text"))
        .collect()
}

fn gzip(content: &[u8]) -> Vec<u8> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    gzip.write_all(content).expect("memory takes all");
    gzip.finish().expect("memory takes all")
}

/// Style sheets without comments and indentation.
fn without_comments(style: &str) -> String {
    let mut rest = style;
    let mut kept = String::new();
    while let Some((before, comment)) = rest.split_once("/*") {
        kept += before;
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    kept += rest;
    let lines = kept.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join("\n")
}
